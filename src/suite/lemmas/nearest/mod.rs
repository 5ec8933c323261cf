//! How near meshes come to the bounds: for each bound that the certificate measures, a search for the domain, spacing, order and
//! c_b whose mesh by biting is nearest to it.
//!
//! # Idea
//! Rectangles with vertices inside and spacings of cones, varied at random; of each round's offspring the best is kept if it is
//! better, and steps shrink while none is. The same seeds give the same search. What was found is committed as domains and cells,
//! and `lemmas` meshes them again.
//!
//! # Deviations
//! A search proves nothing: that nothing nearer is known does not mean that there is nothing.

mod candidate;

use super::demonstration::report;
use super::judge::optima;
use super::measured::Meshes;
use super::record::{Measured, Statement};
use super::statements;
use crate::Case;
use crate::quality::{self};
use crate::suite::files::write_whole;
use crate::suite::report::markdown::{number, table};
use crate::suite::rows::record::{Cell, quoted};
use crate::suite::run::runner;
use candidate::Candidate;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The values of t that are searched.
const TS: [f64; 3] = [0.1, 0.25, 0.4];
/// Candidates at random that a search begins with, its rounds, and the offspring of each.
const FIRST: u64 = 256;
const ROUNDS: u64 = 120;
const OFFSPRING: u64 = 16;
/// The first step, by the side of the domain, and how it changes after rounds that were better and that were not.
const STEP: f64 = 0.1;
const BETTER: f64 = 1.3;
const NOT_BETTER: f64 = 0.85;
const LEAST_STEP: f64 = 1e-7;
/// Larger meshes show nothing that smaller ones do not, and take time.
const MOST_VERTICES: usize = 2000;
/// Below `results/lemmas`.
const FOLDER: &str = "nearest";

/// What a search found, as its line of `nearest/rows.jsonl`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// The statement's name.
    pub statement: String,
    /// What its mesh is asked for by; the domain is a file.
    pub cell: Cell,
    /// The statement's quantity at its worst.
    pub worst: f64,
}

impl Found {
    fn statement(&self) -> Option<Statement> {
        statements::all()
            .into_iter()
            .find(|statement| statement.name == self.statement)
    }
}

/// Searches for all statements that meshes measure point by point, and writes what was found into `results/lemmas/nearest`
/// below `root`.
///
/// # Errors
/// What could not be written.
pub fn search(root: &Path, say: impl Fn(&Found)) -> Result<(), String> {
    let mut rows = String::new();
    let write = |path: &Path, text: &str| {
        write_whole(path, text.as_bytes()).map_err(|error| format!("could not write {}: {error}", path.display()))
    };
    for statement in statements::all() {
        let Some(measured) = statement.measured else { continue };
        for t in TS
            .into_iter()
            .filter(|t| (statement.range.0..=statement.range.1).contains(t))
        {
            let Some((best, worst)) = nearest(&measured, t) else {
                continue;
            };
            let stem = format!("{}-t{:03}", statement.figure_name(), (100.0 * t).round());
            let file = format!("results/lemmas/{FOLDER}/{stem}.poly");
            let Some(domain) = best.domain(&stem) else { continue };
            write(&root.join(&file), &domain.to_poly())?;
            let found = Found {
                statement: statement.name.into(),
                cell: best.cell(&file, t),
                worst,
            };
            say(&found);
            rows += &(serde_json::to_string(&found).map_err(|error| error.to_string())? + "\n");
        }
    }
    write(&root.join("results/lemmas").join(FOLDER).join("rows.jsonl"), &rows)
}

/// The best candidate, with the statement's quantity.
fn nearest(measured: &Measured, t: f64) -> Option<(Candidate, f64)> {
    measured.quantity?;
    let sign = measured.sense.sign();
    let tried = |seeds: std::ops::Range<u64>, make: &(dyn Fn(&mut Pcg64) -> Candidate + Sync)| {
        let all: Vec<_> = seeds
            .into_par_iter()
            .filter_map(|seed| {
                let candidate = make(&mut Pcg64::seed_from_u64(seed));
                let worst = worst(&candidate, measured, t)?;
                Some((candidate, worst))
            })
            .collect();
        all.into_iter().min_by(|a, b| (sign * a.1).total_cmp(&(sign * b.1)))
    };
    let mut best = tried(0..FIRST, &Candidate::random)?;
    let mut step = STEP;
    for round in 0..ROUNDS {
        let first = FIRST + round * OFFSPRING;
        let next = tried(first..first + OFFSPRING, &|random| best.0.near(step, random));
        match next.filter(|next| sign * next.1 < sign * best.1) {
            Some(better) => {
                best = better;
                step = (step * BETTER).min(STEP);
            }
            None => step = (step * NOT_BETTER).max(LEAST_STEP),
        }
    }
    Some(best)
}

/// The statement's quantity at its worst over a candidate's mesh; none where there is no mesh or the check does not apply.
fn worst(candidate: &Candidate, measured: &Measured, t: f64) -> Option<f64> {
    let domain = candidate.domain("candidate")?;
    let cell = candidate.cell("candidate", t);
    let case = Case::new(domain, &cell.spacing, t, cell.c_b).ok()?;
    let mesher = runner::mesher(&cell).ok()?;
    let mut request = case.request();
    request.seed = cell.seed;
    request.budget.max_vertices = Some(MOST_VERTICES);
    let mesh = mesher.mesh(&case.domain, &*case.spacing.function, &request).ok()?;
    let (_, certificate) = mesher.judge(&case, &mesh);
    quantity(&certificate, measured, cell.c_b, case.t())
}

fn quantity(certificate: &quality::Certificate, measured: &Measured, c_b: f64, t: f64) -> Option<f64> {
    let check = certificate.check(measured.claim).filter(|check| check.applies)?;
    Some(measured.quantity?(check.worst?, c_b, t))
}

/// What was found before, meshed and judged again.
///
/// # Errors
/// Rows that cannot be read, cells that cannot be run.
pub fn again(root: &Path) -> Result<Vec<Found>, String> {
    let path = root.join("results/lemmas").join(FOLDER).join("rows.jsonl");
    if !path.is_file() {
        return Ok(Vec::new());
    }
    let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let lines: Vec<&str> = text.lines().collect();
    lines
        .par_iter()
        .map(|line| {
            let found: Found = serde_json::from_str(line).map_err(|error| format!("{}: {error}", path.display()))?;
            let measured = found.statement().and_then(|statement| statement.measured);
            let measured = measured.ok_or_else(|| format!("{}: no statement {}", path.display(), found.statement))?;
            let below = root.join(&found.cell.domain).display().to_string();
            let report = report(&Cell {
                domain: below,
                ..found.cell.clone()
            })?;
            let worst = quantity(&report.certificate, &measured, report.c_b, report.t_effective)
                .ok_or_else(|| format!("{}: {} does not apply", found.cell.domain, measured.claim))?;
            Ok(Found { worst, ..found })
        })
        .collect()
}

/// The section of the page, beside the committed meshes of the same t.
pub fn section(found: &[Found], meshes: &Meshes) -> String {
    if found.is_empty() {
        return String::new();
    }
    let mut text = format!(
        "## How near meshes come\n\nFor each of these bounds `cargo run --release -- lemmas --nearest` looked for the rectangle with \
         vertices inside, the spacing of cones, the order and the c_b whose mesh comes nearest, over {} meshes each; the meshes are \
         made again whenever this page is. What is found over the bound is 1 where it is attained; what no configuration passes \
         is the optimum above, over the bound. A search proves nothing about what it did not find.\n\n",
        FIRST + ROUNDS * OFFSPRING
    );
    let mut commands = String::new();
    let cells = |found: &Found| {
        let statement = found.statement()?;
        let t = found.cell.t;
        let bound = (statement.printed.at)(t);
        let optimum = optima(&statement, &[t]).first().map(|judged| judged.optimum.found)?;
        let committed = meshes.by_t(&statement).into_iter().find(|(at, _)| *at == t);
        Some(vec![
            statement.place.into(),
            number(t),
            number(bound),
            number(optimum / bound),
            number(found.worst / bound),
            committed.map_or("–".into(), |(_, worst)| number(worst / bound)),
        ])
    };
    let lines: Vec<Vec<String>> = found.iter().filter_map(cells).collect();
    text += &table(
        &[
            "statement",
            "t",
            "bound",
            "optimum / bound",
            "found / bound",
            "committed meshes / bound",
        ],
        &lines,
    );
    for found in found {
        commands += &format!(
            "cargo run --release -- mesh {}{}\n",
            quoted(&found.cell.domain),
            found.cell.options()
        );
    }
    text + "In the same order:\n\n```sh\n" + &commands + "```\n\n"
}

#[cfg(test)]
mod tests;
