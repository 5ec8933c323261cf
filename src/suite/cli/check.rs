//! `check DOMAIN MESH`: the certificate of a mesh from anywhere.

use super::exit::{Failure, Outcome};
use super::output::{say, say_notes, verdict};
use super::values::{parameter, positive};
use crate::mesh::files;
use crate::meshers::Parameters;
use crate::quality::{self, Check};
use crate::suite::rows::record::Cell;
use crate::suite::run::prepare::Store;
use crate::suite::run::runner;
use serde_json::Value;
use std::path::PathBuf;

#[derive(clap::Args)]
pub struct Arguments {
    /// A gallery name (`biting list`) or a file (.poly, .geojson)
    domain: String,
    /// The mesh (.node with its .ele, .vtu, .msh, .obj, .json)
    mesh: PathBuf,
    /// Hold the mesh against the paper's bounds for this control spacing too
    #[arg(long, value_name = "SPEC", requires = "t", requires = "c_b")]
    spacing: Option<String>,
    /// t = alpha c_b
    #[arg(long, value_parser = positive, requires = "spacing")]
    t: Option<f64>,
    /// Biting constant
    #[arg(long, value_parser = positive, requires = "spacing")]
    c_b: Option<f64>,
    /// The method that made the mesh, if it is one of ours: then its guarantees must hold, not only the structure
    #[arg(long, requires = "spacing")]
    mesher: Option<String>,
    /// A parameter the mesher had, name=value; may be repeated
    #[arg(long, value_name = "NAME=VALUE", value_parser = parameter, requires = "mesher")]
    param: Vec<(String, Value)>,
    /// Mend what can be mended in a domain file, and say what was changed
    #[arg(long)]
    repair: bool,
    /// Do not cap the spacing by local feature size
    #[arg(long)]
    no_lfs_cap: bool,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let store = Store::new(None, arguments.repair);
    let mesh = files::read(&arguments.mesh).map_err(Failure::input)?;
    let domain = store.domain(&arguments.domain).map_err(Failure::input)?;
    say_notes(&store, &domain);
    let (_, certificate) = match (&arguments.spacing, arguments.t, arguments.c_b) {
        (Some(spacing), Some(t), Some(c_b)) => {
            let cell = arguments.cell(spacing, t, c_b);
            let prepared = store.prepare_for_t(&cell).map_err(Failure::input)?;
            let case = prepared.case(c_b);
            match &arguments.mesher {
                Some(_) => runner::mesher(&cell).map_err(Failure::Input)?.judge(&case, &mesh),
                None => case.judge(&mesh),
            }
        }
        _ => quality::judge(&domain, &mesh, None),
    };
    say(table(&certificate.checks));
    if certificate.excused > 0 {
        say(format_args!(
            "{} triangles are excused: they touch an input angle under 60°",
            certificate.excused
        ));
    }
    verdict(&certificate)
}

impl Arguments {
    fn params(&self) -> Parameters {
        self.param.iter().cloned().collect()
    }

    fn cell(&self, spacing: &str, t: f64, c_b: f64) -> Cell {
        let mesher = self.mesher.as_deref().unwrap_or_default();
        Cell {
            params: self.params(),
            lfs_cap: !self.no_lfs_cap,
            ..Cell::new(&self.domain, mesher, spacing, t, c_b)
        }
    }
}

/// The checks as a table for the terminal.
fn table(checks: &[Check]) -> String {
    let number = |value: Option<f64>| value.map_or_else(|| "–".into(), |value| format!("{value:.6e}"));
    let mut lines = vec![format!(
        "{:<28} {:<14} {:<10} {:<7} {:>14} {:>14} {:>8}  where",
        "check", "from", "kind", "holds", "worst", "bound", "broken"
    )];
    for check in checks {
        let place = check.at.map_or_else(String::new, |[x, y]| format!("({x:.6}, {y:.6})"));
        lines.push(format!(
            "{:<28} {:<14} {:<10} {:<7} {:>14} {:>14} {:>8}  {place}",
            check.claim,
            check.lemma,
            if check.applies { "guaranteed" } else { "measured" },
            if check.holds { "yes" } else { "NO" },
            number(check.worst),
            number(check.bound),
            check.broken
        ));
    }
    lines.join("\n")
}
