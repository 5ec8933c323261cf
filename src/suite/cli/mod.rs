//! The command line: one file per verb. The library never prints; this layer does.
//!
//! Exit status: 0 done; 1 a guaranteed check or an expectation failed; 2 bad usage or bad input; 3 nothing could be
//! measured; 4 declined, or stopped by a budget.

use clap::{Parser, Subcommand};
use std::process::ExitCode;

mod adapt;
mod asked;
mod budget;
mod check;
mod compare;
mod exit;
mod figures;
mod lemmas;
mod list;
mod mesh;
mod output;
mod progress;
mod report;
mod shards;
mod stages;
mod sweep;
mod tally;
mod values;

/// Provably good triangle meshes by biting circles off an advancing front, and the experiment about them.
#[derive(Parser)]
#[command(name = "biting", version, about, max_term_width = 110)]
struct Arguments {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// Run an experiment: mesh, judge and record every cell, then draw charts and write the page
    Sweep(sweep::Arguments),
    /// Make one mesh
    Mesh(Box<mesh::Arguments>),
    /// Adapt a mesh to the solution of a problem, round by round
    Adapt(Box<adapt::Arguments>),
    /// Judge a mesh from anywhere
    Check(check::Arguments),
    /// Set our meshers beside peers: meshers of others that people use
    Compare(compare::Arguments),
    /// Draw the paper's figures from real runs, or write a replay of one
    Figures(figures::Arguments),
    /// Judge every bound of the paper: against its numerical optimum, and against measured meshes
    Lemmas(lemmas::Arguments),
    /// Make charts and pages again from what a run left
    Report(report::Arguments),
    /// List domains, meshers with parameters, spacings, peers and experiments
    List,
    /// Run the cases that come in on standard input, one a line: what a sweep of cases that are tallied starts
    #[command(name = tally::WORKER, hide = true)]
    RunCases,
}

/// Parses the arguments, runs the verb and turns its outcome into the exit status.
pub fn main() -> ExitCode {
    let outcome = match Arguments::parse().verb {
        Verb::Sweep(arguments) => sweep::run(&arguments),
        Verb::Mesh(arguments) => mesh::run(&arguments),
        Verb::Adapt(arguments) => adapt::run(&arguments),
        Verb::Check(arguments) => check::run(&arguments),
        Verb::Compare(arguments) => compare::run(&arguments),
        Verb::Figures(arguments) => figures::run(&arguments),
        Verb::Lemmas(arguments) => lemmas::run(&arguments),
        Verb::Report(arguments) => report::run(&arguments),
        Verb::List => list::run(),
        Verb::RunCases => tally::work(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.tell(),
    }
}
