//! Plans (TOML), the runner and the rows it leaves.
//!
//! [`plan`] reads an experiment's cells, [`work`] gathers those with one mesh, [`runner`] runs them by [`measure`] on what
//! [`prepare`] made, [`journal`] keeps the rows, [`expect`] holds them against what was expected.

pub mod adapt;
pub mod battery;
pub mod claims;
pub mod contest;
pub mod convergence;
mod ending;
pub mod expect;
pub mod frontier;
mod gate;
pub mod journal;
pub mod machine;
pub mod measure;
pub mod plan;
pub mod prepare;
pub mod record;
pub mod runner;
pub mod series;
pub mod summary;
pub mod tune;
pub mod work;
