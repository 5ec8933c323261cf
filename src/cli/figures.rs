//! `figures`: the paper's figures from real runs, and replays.

use super::exit::{Failure, Outcome};
use super::output::say;
use crate::figures;
use std::path::PathBuf;

#[derive(clap::Args)]
pub struct Arguments {
    /// Only figures whose name begins so
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    /// Write the replay of biting this domain, and no figures: one page to step through, which opens from disk
    #[arg(long, value_name = "DOMAIN", conflicts_with = "only")]
    replay: Option<String>,
    /// Folder to write to
    #[arg(long, value_name = "FOLDER", default_value = "paper")]
    out: PathBuf,
    /// Folder of results that the figures of the study are drawn from
    #[arg(long, value_name = "FOLDER", default_value = "results", conflicts_with = "replay")]
    results: PathBuf,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let written = match &arguments.replay {
        Some(domain) => figures::replay::write(&arguments.out, domain).map(|path| vec![path]),
        None => figures::write(&arguments.out, &arguments.results, arguments.only.as_deref()),
    };
    for path in written.map_err(Failure::input)? {
        say(format_args!("wrote {}", path.display()));
    }
    Ok(())
}
