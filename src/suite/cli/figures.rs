//! `figures`: the paper's figures from real runs, and replays.

use super::asked::Asked;
use super::exit::{Failure, Outcome};
use super::output::say;
use crate::meshers::MeshError;
use crate::suite::figures;
use crate::suite::replay::{self, ReplayError};
use std::path::PathBuf;

#[derive(clap::Args)]
// What is asked of a run is of a replay alone.
#[command(mut_group("Asked", |group| group.requires("replay")))]
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
    #[command(flatten, next_help_heading = "Of a replay")]
    asked: Asked,
}

/// The mesher whose run is replayed: the others take no bites.
const MESHER: &str = "biting";

pub fn run(arguments: &Arguments) -> Outcome {
    let written = match &arguments.replay {
        Some(domain) => {
            let cell = arguments.asked.cell(domain, MESHER)?;
            vec![replay::write(&arguments.out, &cell).map_err(refused)?]
        }
        None => {
            figures::write(&arguments.out, &arguments.results, arguments.only.as_deref()).map_err(Failure::input)?
        }
    };
    for path in written {
        say(format_args!("wrote {}", path.display()));
    }
    Ok(())
}

fn refused(error: ReplayError) -> Failure {
    match error {
        ReplayError::Mesh(MeshError::Budget { .. } | MeshError::Declined(_)) => Failure::Declined(error.to_string()),
        ReplayError::Mesh(_) | ReplayError::Input(_) => Failure::input(error),
    }
}
