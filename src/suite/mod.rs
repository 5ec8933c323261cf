//! The experiment around the library. Public is what the binary and the fuzz targets need.
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

// Its docs are for those who work on it: `cargo doc --document-private-items`.
#![allow(rustdoc::private_intra_doc_links)]

mod analysis;
mod charts;
pub mod cli;
mod fem;
mod figures;
mod files;
mod lemmas;
mod peers;
mod replay;
mod report;
pub mod rows;
pub mod run;
mod tolerance;
