//! `compare`: our meshers beside peers.
//!
//! An experiment like any other, with peers among its methods; see [`crate::suite::peers`].

use super::exit::{Failure, Outcome};
use super::output::{say, say_aside};
use super::sweep::{How, Place, run_plan};
use crate::meshers::MESHERS;
use crate::suite::peers::{AnyEntry, PEERS, install};

/// The plan that is run where none is named.
const DEFAULT: &str = "compare";

#[derive(clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    place: Place,
    #[command(flatten)]
    how: How,
    /// Install peers instead, those of --only or else all, into one cache folder (BITING_PEERS, or the user's cache)
    #[arg(long)]
    install: bool,
    /// Only these meshers, ours or peers; a peer named here must be installed
    #[arg(long, value_name = "NAMES", value_delimiter = ',', conflicts_with = "fresh")]
    only: Vec<String>,
    /// Only these domains
    #[arg(long, value_name = "NAMES", value_delimiter = ',', conflicts_with = "fresh")]
    domains: Vec<String>,
}

pub fn run(arguments: &Arguments) -> Outcome {
    if let Some(unknown) = arguments.only.iter().find(|name| AnyEntry::find(name).is_none()) {
        return Err(Failure::Input(format!(
            "there is no mesher `{unknown}`; `biting list` shows them"
        )));
    }
    if arguments.install {
        return install_peers(&arguments.only, arguments.how.dry_run);
    }
    for (name, state) in install::survey() {
        match state {
            Err(reason) if arguments.only.iter().any(|only| only == name) => {
                return Err(Failure::Input(format!("{name}: {reason}")));
            }
            Err(reason) => say_aside(format_args!("{name}: {reason}")),
            Ok(()) => {}
        }
    }
    let plan = arguments.place.plan(DEFAULT)?;
    let has = |list: &[String], name: &String| list.is_empty() || list.contains(name);
    run_plan(&plan, &arguments.place.folder(&plan), &arguments.how, None, |cell| {
        has(&arguments.only, &cell.mesher) && has(&arguments.domains, &cell.domain)
    })
}

/// Installs peers, the named ones or all; one that cannot be had does not stop the others. A dry run only names them.
fn install_peers(only: &[String], dry_run: bool) -> Outcome {
    if let Some(ours) = only
        .iter()
        .find(|name| MESHERS.iter().any(|entry| entry.name == **name))
    {
        return Err(Failure::Input(format!("{ours} is ours: there is nothing to install")));
    }
    let wanted = PEERS
        .iter()
        .filter(|entry| only.is_empty() || only.iter().any(|name| name == entry.name));
    let mut failed = Vec::new();
    for entry in wanted {
        if dry_run {
            say(format_args!("{}: would be installed", entry.name));
            continue;
        }
        say_aside(format_args!("{}: installing", entry.name));
        match install::install(entry.name) {
            Ok(()) => say(format_args!("{}: installed", entry.name)),
            Err(reason) => {
                say(format_args!("{}: {reason}", entry.name));
                failed.push(entry.name);
            }
        }
    }
    match failed.is_empty() {
        true => Ok(()),
        false if only.is_empty() => {
            say(format_args!(
                "{} of {} could not be installed: {}; `compare` runs the others",
                failed.len(),
                PEERS.len(),
                failed.join(", ")
            ));
            Ok(())
        }
        false => Err(Failure::Input(format!(
            "{} could not be installed; see above",
            failed.join(", ")
        ))),
    }
}
