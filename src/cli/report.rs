//! `report`: charts and pages again, from the rows alone.

use super::exit::{Failure, Outcome};
use super::output::say;
use crate::report;
use std::path::PathBuf;

#[derive(clap::Args)]
pub struct Arguments {
    /// The experiment's folder, with its rows.jsonl
    #[arg(default_value = "results/sweep")]
    folder: PathBuf,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let page = report::write(&arguments.folder).map_err(Failure::input)?;
    say(format_args!("wrote {}", page.display()));
    Ok(())
}
