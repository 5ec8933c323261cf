//! `lemmas`: every bound of the paper against its numerical optimum and against measured meshes.

use super::exit::{Failure, Outcome};
use super::output::say;
use crate::suite::lemmas::findings::FINDINGS;
use crate::suite::lemmas::measured::Meshes;
use crate::suite::lemmas::nearest::{self, Found};
use crate::suite::lemmas::table::{self, Line, sign};
use crate::suite::lemmas::{self, errata};
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
pub struct Arguments {
    /// Only the statements and findings whose name begins so, in full, and write nothing
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    /// First search for the meshes that come nearest to the bounds, which takes minutes
    #[arg(long, conflicts_with = "only")]
    nearest: bool,
    /// Folder that holds `results` and `paper`
    #[arg(long, value_name = "FOLDER", default_value = ".")]
    root: PathBuf,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let lines = match &arguments.only {
        Some(name) => show(&arguments.root, name)?,
        None => {
            if arguments.nearest {
                let found = |found: &Found| {
                    say(format_args!(
                        "{} at t = {}: {}",
                        found.statement, found.cell.t, found.worst
                    ))
                };
                nearest::search(&arguments.root, found).map_err(Failure::Input)?;
            }
            let (lines, written) = lemmas::write(&arguments.root).map_err(Failure::input)?;
            lines.iter().for_each(|line| say(summary(line)));
            for path in written {
                say(format_args!("wrote {}", path.display()));
            }
            lines
        }
    };
    let unsettled: Vec<&str> = lines
        .iter()
        .filter(|line| !line.is_settled())
        .map(|line| line.statement.name)
        .collect();
    if unsettled.is_empty() {
        Ok(())
    } else {
        Err(Failure::Broken(format!(
            "neither the printed formula nor a correction holds: {}",
            unsettled.join(", ")
        )))
    }
}

/// The entries of one statement or finding.
fn show(root: &Path, name: &str) -> Result<Vec<Line>, Failure> {
    let findings: Vec<_> = FINDINGS
        .iter()
        .filter(|finding| finding.name.starts_with(name))
        .collect();
    let meshes = Meshes::read(&root.join("results")).map_err(Failure::input)?;
    let lines = table::judge_all(&meshes, Some(name));
    if findings.is_empty() && lines.is_empty() {
        return Err(Failure::Input(format!(
            "there is no statement or finding `{name}`; `biting lemmas` lists the statements, paper/errata.md the findings"
        )));
    }
    for line in &lines {
        say(summary(line));
        say(errata::formula(line));
    }
    for finding in findings {
        say(errata::entry(finding).map_err(Failure::Input)?);
    }
    Ok(lines)
}

fn summary(line: &Line) -> String {
    let statement = &line.statement;
    format!(
        "{:20} {} {}: {}",
        statement.name,
        sign(statement),
        statement.printed.says,
        line.told(&line.printed)
    )
}
