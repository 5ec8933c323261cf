//! `adapt DOMAIN`: mesh, solve, recover the Hessian, new spacing, and again; the last mesh, its files and its report.

use super::asked::Asked;
use super::exit::{Failure, Outcome};
use super::output::{self, Target, say};
use super::stages;
use super::values::{Limits, positive};
use crate::mesh::files;
use crate::meshers::Request;
use crate::suite::fem::{self, PROBLEMS, Problem};
use crate::suite::rows::adapted::{Adapt, Round};
use crate::suite::rows::record::Cell;
use crate::suite::run::measure::Run;
use crate::suite::run::prepare::{Prepared, Store};
use crate::suite::run::runner;
use clap::builder::PossibleValuesParser;
use std::path::PathBuf;

#[derive(clap::Args)]
pub struct Arguments {
    /// A gallery name (`biting list`) or a file (.poly, .geojson)
    domain: String,
    /// The Poisson problem whose solution is followed; corner is for l-shape
    #[arg(long, default_value = "layer", value_parser = problems())]
    problem: String,
    /// Error of linear interpolation that is allowed, in the unit of u
    #[arg(long, value_parser = positive, default_value = "1e-3")]
    eps: f64,
    /// Most rounds before the last mesh; fewer where the spacing settles
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// Take the Hessian from u itself at the vertices, in place of the solution
    #[arg(long)]
    sample: bool,
    /// The method; `biting list` shows all
    #[arg(long, default_value = "biting")]
    mesher: String,
    #[command(flatten)]
    asked: Asked,
    /// Where the last mesh goes, by the file's ending as for `mesh`; .vtu and .node carry u, so that `field:FILE` can take it;
    /// may be repeated
    #[arg(long, value_name = "FILE")]
    out: Vec<String>,
    /// Where the report of the last mesh goes
    #[arg(long, value_name = "FILE.json")]
    report: Option<PathBuf>,
    #[command(flatten)]
    limits: Limits,
}

pub fn run(arguments: &Arguments) -> Outcome {
    let targets = Target::parse_all(&arguments.out)?;
    let cell = arguments.cell()?;
    let mesher = runner::mesher(&cell).map_err(Failure::Input)?;
    let request = Request {
        seed: cell.seed,
        budget: arguments.limits.budget(),
        ..Request::new(cell.c_b)
    };
    let store = Store::new(None, false).up_to(request.budget.max_vertices);
    let (_, prepared) = stages::prepare(store, &cell, &request.budget)?;
    let (prepared, mesher, run) = stages::mesh(prepared, mesher, request)?;
    let (prepared, run, report) = stages::judge((prepared, mesher), run, &cell, &request.budget)?;
    say(table(&report.rounds));
    if let Some(solution) = &report.poisson {
        say(format_args!(
            "last mesh: {} vertices, {} triangles, L2 error {:.3e}, energy error {:.3e}, smallest angle {:.2}°",
            report.statistics.vertices,
            report.statistics.triangles,
            solution.l2_error / solution.l2_norm,
            solution.energy_error / solution.energy_norm,
            report.statistics.min_angle_deg
        ));
    }
    for target in &targets {
        write(target, &prepared, &run, &arguments.problem)?;
    }
    if let Some(path) = &arguments.report {
        let text = serde_json::to_string_pretty(&report).map_err(Failure::input)?;
        output::write_file(path, &text)?;
    }
    output::verdict(&report.certificate)
}

/// The names there are.
fn problems() -> PossibleValuesParser {
    PossibleValuesParser::new(PROBLEMS.map(|problem| problem.name))
}

impl Arguments {
    fn cell(&self) -> Result<Cell, Failure> {
        Ok(Cell {
            poisson: Some(self.problem.clone()),
            adapt: Some(Adapt {
                eps: self.eps,
                rounds: self.rounds,
                sample: self.sample,
            }),
            ..self.asked.cell(&self.domain, &self.mesher)?
        })
    }
}

/// Writes the mesh, with the solution where the format can carry it.
fn write(target: &Target, prepared: &Prepared, run: &Run, problem: &str) -> Outcome {
    let domain = &prepared.site.domain;
    let carrier = match target {
        Target::Mesh(path) if files::carries_values(path) => path,
        _ => return output::write(target, domain, &run.mesh).map(|_| ()),
    };
    let problem = Problem::named(problem, domain.bounds()).map_err(Failure::input)?;
    let (_, values) = fem::solve_at_vertices(&run.mesh, &problem).map_err(Failure::input)?;
    let encoded = files::encode_with_values(&run.mesh, &values, carrier).map_err(Failure::input)?;
    output::write_all(encoded).map(|_| ())
}

/// The rounds as a table for the terminal.
fn table(rounds: &[Round]) -> String {
    let mut text = format!(
        "{:>5} {:>9} {:>9} {:>10} {:>12} {:>8} {:>11} {:>7}",
        "round", "vertices", "triangles", "L2 error", "energy error", "settled", "independent", "kept"
    );
    for (number, round) in rounds.iter().enumerate() {
        text += &format!(
            "\n{:>5} {:>9} {:>9} {:>10.3e} {:>12.3e} {:>7.1}% {:>11} {:>7}",
            number + 1,
            round.vertices,
            round.triangles,
            round.l2_error,
            round.energy_error,
            100.0 * round.settled,
            round.independent,
            round.kept
        );
    }
    text
}
