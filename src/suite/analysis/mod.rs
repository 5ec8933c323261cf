//! What rows say together: summaries, contests of methods, series, the expectations of a plan.

pub mod contest;
pub mod convergence;
pub mod expect;
pub mod frontier;
pub mod measures;
pub mod remarks;
pub mod results;
pub mod series;
pub mod summary;
