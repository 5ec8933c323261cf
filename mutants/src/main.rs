//! Mutation testing in one build: `biting-mutants [--jobs N] [--rest] [--under S] [--modules A,B] [--tests PREFIX]...
//! GLOB...`; `../run` calls it.
//!
//! cargo-mutants compiles once per mutant. Here its list of mutants is compiled at once, each behind a switch that an
//! environment variable sets ([`schema`]); what does not compile so is left to cargo-mutants itself. Each test is run once
//! to see which mutants it reaches, then each mutant is run against those tests alone.

mod list;
mod log;
mod report;
mod run;
mod schema;
mod tree;

use anyhow::{Context, Result};
use list::Mutant;
use log::Log;
use run::{Outcome, Runner};
use std::path::Path;

struct Arguments {
    jobs: usize,
    /// Believes the last runs of mutants that they killed, or that timed out, where their lines have not changed since.
    rest: bool,
    /// Seconds of work a test may take; those that take more are left out.
    under: Option<f64>,
    /// Of the crate, these modules alone, with their unit tests; all, with the integration tests, where there is none.
    modules: Option<Vec<String>>,
    /// Of the tests, those whose names (`lib::geometry::near::…`) begin so; all where there is none.
    tests: Vec<String>,
    /// Globs of cargo-mutants.
    files: Vec<String>,
}

fn arguments() -> Result<Arguments> {
    let mut parsed = Arguments {
        jobs: 2,
        rest: false,
        under: None,
        modules: None,
        tests: Vec::new(),
        files: Vec::new(),
    };
    let mut all = std::env::args().skip(1);
    while let Some(argument) = all.next() {
        let mut value = || all.next().with_context(|| format!("{argument} takes a value"));
        match argument.as_str() {
            "--jobs" => parsed.jobs = value()?.parse()?,
            "--rest" => parsed.rest = true,
            "--under" => parsed.under = Some(value()?.parse()?),
            "--modules" => parsed.modules = Some(value()?.split(',').map(str::to_owned).collect()),
            "--tests" => parsed.tests.push(value()?),
            _ => parsed.files.push(argument),
        }
    }
    Ok(parsed)
}

fn main() -> Result<()> {
    let arguments = arguments()?;
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = here.parent().context("the crate is the parent folder")?;
    let mutants = list::list(root, &arguments.files)?;
    eprintln!("{} mutants", mutants.len());
    let out = here.join("target");
    let mut tree = tree::Tree::new(root, out.join("crate"), &mutants)?;
    let programs = tree.build(arguments.modules.as_deref())?;
    let runner = Runner {
        place: &tree.place,
        programs: &programs,
        jobs: arguments.jobs,
        under: arguments.under,
    };
    let tests = runner
        .record(|name| arguments.tests.is_empty() || arguments.tests.iter().any(|prefix| name.starts_with(prefix)))?;
    let seconds: f64 = tests.iter().map(|test| test.seconds).sum();
    eprintln!("{} tests, {seconds:.0} s one after another", tests.len());
    let numbered: Vec<(usize, &Mutant)> = mutants.iter().enumerate().map(|(k, mutant)| (k + 1, mutant)).collect();
    let log = Log::open(out.join("outcomes.log"), arguments.rest)?;
    let outcomes = runner.parallel(&numbered, |_, (number, mutant)| -> Result<Option<Outcome>> {
        if tree.left_out.contains(number) {
            return Ok(None);
        }
        if let Some(told) = log.told(mutant) {
            return Ok(Some(told));
        }
        let outcome = runner.judge(*number, mutant, &tests)?;
        log.note(mutant, Some(&outcome))?;
        Ok(Some(outcome))
    });
    let judged: Vec<(Mutant, Option<Outcome>)> = mutants
        .iter()
        .cloned()
        .zip(outcomes.into_iter().collect::<Result<Vec<_>>>()?)
        .collect();
    for (mutant, _) in judged.iter().filter(|(_, outcome)| outcome.is_none()) {
        log.note(mutant, None)?;
    }
    let explained = report::Explained::read(&here.join("explained.toml"))?;
    let (table, open) = report::report(&judged, &explained);
    println!("{table}");
    open.iter().for_each(|line| println!("{line}"));
    std::process::exit(i32::from(!open.is_empty()))
}
