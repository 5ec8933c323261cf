//! What is not in the paper: how small angles are cut off, notches, circles that would meet low, distances inside the
//! domain, and the rule of the later point.

pub(super) mod capped;
pub(super) mod corners;
pub(super) mod crossing;
mod fan;
pub mod inside;
pub(super) mod notches;
pub mod rule;
