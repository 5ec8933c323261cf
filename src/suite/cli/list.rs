//! `list`: what there is to choose from.

use super::exit::Outcome;
use super::output::say;
use crate::domain::gallery;
use crate::meshers::{Entry, MESHERS, Parameters};
use crate::spacing;
use crate::suite::peers::{AnyEntry, PEERS, install};
use crate::suite::run::plan::Plan;
use crate::theory::Guarantee;
use std::path::{Path, PathBuf};

/// Where the experiments stand in a checkout.
pub const EXPERIMENTS: &str = "experiments";

pub fn run() -> Outcome {
    say("Domains");
    say(format_args!(
        "  {:<16} {:>8} {:>8} {:>9} {:>9}",
        "", "vertices", "segments", "inside", "any side"
    ));
    for entry in gallery::ENTRIES {
        if let Some(Ok(domain)) = gallery::domain(entry.name) {
            let (vertices, segments) = (domain.vertices().len(), domain.segments().len());
            let (inside, any) = (domain.smallest_input_angle_deg(), domain.smallest_segment_angle_deg());
            say(format_args!(
                "  {:<16} {vertices:>8} {segments:>8} {inside:>8.1}° {any:>8.1}°  {}",
                entry.name, entry.about
            ));
        }
    }
    for (name, about) in gallery::kinds() {
        say(format_args!("    random-pslg:kind={name}  {about}"));
    }
    say("  FILE.poly, FILE.geojson\n\nMeshers");
    for entry in MESHERS {
        say_entry(AnyEntry::Ours(entry));
        say(format_args!("    guarantees by default {}", guarantees(entry)));
    }
    say("\nPeers");
    for entry in PEERS {
        say_entry(AnyEntry::Peer(entry));
        match install::command(entry.name) {
            Ok(_) => say("    installed"),
            Err(reason) => say(format_args!("    {reason}")),
        }
    }
    say("\nSpacings");
    for kind in spacing::KINDS {
        say(format_args!("  {kind}"));
    }
    say(format_args!(
        "  in expressions {{x0}} {{y0}} {{w}} {{h}} stand for corner, width and height of the domain's box"
    ));
    say("\nExperiments");
    for file in experiments() {
        match Plan::read(&file) {
            Ok(plan) => say(format_args!("  {:<28} {}", file.display(), plan.question.trim())),
            Err(error) => say(format_args!("  {error}")),
        }
    }
    Ok(())
}

/// A mesher with its parameters.
fn say_entry(entry: AnyEntry) {
    say(format_args!("  {:<16} {}", entry.name(), entry.summary()));
    for parameter in entry.parameters() {
        say(format_args!(
            "    --param {}={}  {}",
            parameter.name, parameter.default, parameter.help
        ));
        say(format_args!("      values: {}", parameter.values));
    }
}

/// The claims a method guarantees with its defaults beyond the structural ones.
fn guarantees(entry: &Entry) -> String {
    let guarantees = (entry.make)(&Parameters::new()).map_or_else(|_| Vec::new(), |mesher| mesher.guarantees());
    let one = |guarantee: Guarantee| match guarantee.plain {
        true => format!("{} (no angle under 90°, c_b + t ≤ 1)", guarantee.claim),
        false => guarantee.claim.to_string(),
    };
    let structure = std::iter::once("structure".to_owned());
    let all: Vec<String> = structure.chain(guarantees.into_iter().map(one)).collect();
    all.join(", ")
}

/// The experiment files of this checkout, by name.
fn experiments() -> Vec<PathBuf> {
    let Ok(folder) = Path::new(EXPERIMENTS).read_dir() else {
        return Vec::new();
    };
    let mut files: Vec<PathBuf> = folder.flatten().map(|entry| entry.path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending == "toml"));
    files.sort();
    files
}
