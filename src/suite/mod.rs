//! The experiment around the library. Public is what the binary calls; [`main`] is the command line.
//!
//! | module | holds |
//! |---|---|
//! | `peers` | meshers of others, behind a process boundary |
//! | `fem` | what quality is for: a Poisson problem on the mesh, its error, iterations and eigenvalues |
//! | [`rows`] | what an experiment leaves: a record for each mesh, the journal of a run, what made them |
//! | [`run`] | from a plan (TOML) to rows |
//! | `analysis` | what rows say together |
//! | `charts`, `report` | figures by plotters, pages from rows |
//! | `lemmas` | every statement of the paper with a bound, judged numerically and on meshes; errata |
//! | `figures`, `replay` | the paper's figures from real runs, and a run to step through |
//! | [`cli`] | one file per verb |

mod analysis;
mod charts;
mod cli;
mod fem;
mod figures;
mod files;
mod lemmas;
mod peers;
mod replay;
mod report;
mod rows;
mod run;

pub use cli::main;

// What benches, fuzz targets and tests of the command line take besides.
#[doc(hidden)]
pub use rows::journal::{Journal, Line, read_rows};
#[doc(hidden)]
pub use rows::numbers::{fit_line, median};
#[doc(hidden)]
pub use rows::record::{Outcome, Row};
#[doc(hidden)]
pub use rows::tables::Tables;
#[doc(hidden)]
pub use run::plan::Plan;
