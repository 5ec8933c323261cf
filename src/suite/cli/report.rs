//! `report`: charts and pages again, without measuring anew.

use super::exit::{Failure, Outcome};
use super::output::say;
use crate::suite::report;
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
pub struct Arguments {
    /// The experiment's folder, with its tables
    #[arg(default_value = "results/sweep")]
    folder: PathBuf,
}

pub fn run(arguments: &Arguments) -> Outcome {
    write(&arguments.folder)
}

/// Writes charts and page of a results folder, and into the README of the working folder what that quotes of them.
pub fn write(folder: &Path) -> Outcome {
    let page = report::write(folder).map_err(Failure::input)?;
    say(format_args!("rows, charts and page: {}", page.display()));
    report::quote(folder, Path::new("README.md")).map_err(Failure::input)?;
    Ok(())
}
