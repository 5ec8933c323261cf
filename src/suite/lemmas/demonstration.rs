//! Runs and numbers that show a finding, each with the command that repeats it.

use crate::geometry::DVec2;
use crate::meshers::Request;
use crate::meshers::biting::TO_THE_LETTER;
use crate::spacing::{Lfs, Spacing};
use crate::suite::rows::machine;
use crate::suite::rows::record::{Cell, Report};
use crate::suite::run::measure;
use crate::suite::run::prepare::Store;
use crate::suite::run::runner;

/// What shows a finding.
#[derive(Clone, Copy)]
pub enum Demonstration {
    /// A mesh by biting to the paper's letter.
    Mesh(MeshRun),
    /// Numbers worked out by a function.
    Numbers(fn() -> Result<Vec<Shown>, String>),
}

/// A mesh by biting to the paper's letter.
#[derive(Clone, Copy)]
pub struct MeshRun {
    /// Gallery name.
    pub domain: &'static str,
    /// Spacing.
    pub spacing: &'static str,
    /// t.
    pub t: f64,
    /// c_b.
    pub c_b: f64,
    /// Whether f is capped by lfs.
    pub lfs_cap: bool,
    /// What of the report shows it.
    pub shows: fn(&Report) -> Vec<Shown>,
}

/// A number with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    /// What it is.
    pub name: String,
    /// Its value.
    pub value: f64,
}

/// A number with its name.
pub fn shown(name: impl Into<String>, value: f64) -> Shown {
    Shown {
        name: name.into(),
        value,
    }
}

impl Demonstration {
    /// Does it again.
    ///
    /// # Errors
    /// What kept it from being done.
    pub fn run(&self) -> Result<Vec<Shown>, String> {
        match self {
            Self::Mesh(run) => report(&run.cell()).map(|report| (run.shows)(&report)),
            Self::Numbers(numbers) => numbers(),
        }
    }

    /// The command that repeats it.
    pub fn command(&self, finding: &str) -> String {
        match self {
            Self::Mesh(run) => run.command(),
            Self::Numbers(_) => format!("cargo run --release -- lemmas --only {finding}"),
        }
    }
}

impl MeshRun {
    fn cell(&self) -> Cell {
        Cell {
            lfs_cap: self.lfs_cap,
            ..Cell::new(self.domain, "biting", self.spacing, self.t, self.c_b).with(TO_THE_LETTER)
        }
    }

    fn command(&self) -> String {
        format!("cargo run --release -- mesh {}{}", self.domain, self.cell().options())
    }
}

/// Makes the mesh of `cell` and judges it.
pub(super) fn report(cell: &Cell) -> Result<Report, String> {
    let mesher = runner::mesher(cell)?;
    let prepared = Store::new(None, false)
        .prepare_for_t(cell)
        .map_err(|error| error.to_string())?;
    let request = Request {
        seed: cell.seed,
        ..Request::new(cell.c_b)
    };
    let run = measure::run(&prepared, &mesher, &request).map_err(|error| error.to_string())?;
    Ok(measure::judge(&prepared, cell, &mesher, &run, &machine::provenance()))
}

/// Lemma 2.1's strip: a rectangle 2 high and 12 long, with f = 2 + dist(x, ∂Ω) held to lfs at its ends.
pub(super) fn strip() -> Result<Vec<Shown>, String> {
    let corners = [(0.0, 0.0), (12.0, 0.0), (12.0, 2.0), (0.0, 2.0)].map(|(x, y)| DVec2::new(x, y));
    let sides = [[0, 1], [1, 2], [2, 3], [3, 0]];
    let lfs = Lfs::new(&corners, &sides).map_err(|error| error.to_string())?;
    // The largest 1-Lipschitz function that is at most lfs on the boundary, from samples of it.
    let samples: Vec<(DVec2, f64)> = (0..4)
        .flat_map(|side| {
            let (from, to) = (corners[side], corners[(side + 1) % 4]);
            (0..1200).map(move |k| from.lerp(to, f64::from(k) / 1200.0))
        })
        .map(|point| (point, lfs.at(point)))
        .collect();
    let largest = |x: DVec2| {
        samples
            .iter()
            .map(|(y, value)| value + x.distance(*y))
            .fold(f64::INFINITY, f64::min)
    };
    let (middle, side) = (DVec2::new(6.0, 1.0), DVec2::new(6.0, 0.0));
    Ok(vec![
        shown("lfs in the middle of a long side, (6, 0)", lfs.at(side)),
        shown("lfs at the centre, (6, 1)", lfs.at(middle)),
        shown(
            "the largest 1-Lipschitz f at the centre with f ≤ lfs on ∂Ω",
            largest(middle),
        ),
    ])
}

/// How far along one side of a right angle the circle of a vertex on the other side reaches, over the radius at the corner.
pub(super) fn right_angle() -> Result<Vec<Shown>, String> {
    // The vertex stands at the corner's radius 1 from it, its own radius is at most 1 + t.
    let reach = |t: f64| ((1.0 + t).powi(2) - 1.0).sqrt();
    let values = [1.0 / 3.0, 2f64.sqrt() - 1.0, 0.5];
    Ok(values
        .iter()
        .map(|t| shown(format!("largest reach at t = {t:.4}"), reach(*t)))
        .collect())
}
