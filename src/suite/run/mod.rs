//! From a plan to rows: [`plan`] reads an experiment's cells, [`work`] gathers those with one mesh, [`runner`] runs them by
//! [`measure`] on what [`prepare`] made; [`tally`] runs cases that leave no row each.

pub mod adapt;
mod ending;
mod gate;
pub mod measure;
pub mod plan;
pub mod prepare;
pub mod runner;
pub mod tally;
pub mod tune;
pub mod work;
