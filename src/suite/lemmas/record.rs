//! A statement of the paper as data: formula, hypotheses, range, what rests on it.

use super::search::{Effort, Problem, Sense};
use crate::theory::Claim;

/// A bound as a function of the parameter.
pub type Formula = fn(f64) -> f64;

/// A bound with the text that says it.
#[derive(Clone, Copy)]
pub struct Bound {
    /// As one would write it.
    pub says: &'static str,
    /// Its value.
    pub at: Formula,
}

/// A numbered statement with a bound, or an inequality inside a proof.
#[derive(Clone, Copy)]
pub struct Statement {
    /// Unique, in kebab case.
    pub name: &'static str,
    /// Where in the paper.
    pub place: &'static str,
    /// What is bounded.
    pub quantity: &'static str,
    /// Which way.
    pub sense: Sense,
    /// The bound as printed.
    pub printed: Bound,
    /// What the parameter is: t = α c_b, or α.
    pub parameter: &'static str,
    /// The values of the parameter that the paper claims it for.
    pub range: (f64, f64),
    /// Why that range, in words.
    pub range_says: &'static str,
    /// Hypotheses that the paper uses without stating or proving them; those it states are the problem's constraints.
    pub silent: &'static [&'static str],
    /// Statements that rest on it.
    pub used_by: &'static [&'static str],
    /// The configurations that the hypotheses allow.
    pub problem: Problem,
    /// How near the numerical optimum must be known.
    pub effort: Effort,
    /// A formula that holds where the printed one does not, or that is nearer to the optimum; with its derivation.
    pub corrected: Option<Corrected>,
    /// The certificate's check that measures it on meshes.
    pub measured: Option<Measured>,
    /// A configuration in coordinates, for a witness.
    pub points: fn(f64, &[f64]) -> Vec<Labelled>,
}

/// A point of a configuration, with the value of c_b f there where it has one.
#[derive(Clone, Debug, PartialEq)]
pub struct Labelled {
    /// Its name in the paper.
    pub label: &'static str,
    /// Coordinates.
    pub at: [f64; 2],
    /// c_b f there.
    pub radius: Option<f64>,
}

impl Statement {
    /// Name of its figure's files: without the full stop, which would begin an ending.
    pub fn figure_name(&self) -> String {
        self.name.replace('.', "-")
    }
}

/// A corrected bound.
#[derive(Clone, Copy)]
pub struct Corrected {
    /// The formula.
    pub bound: Bound,
    /// The range of the parameter it is derived for.
    pub range: (f64, f64),
    /// The derivation, or why the printed formula is wrong, in a few sentences.
    pub why: &'static str,
    /// What becomes of the statements that rest on it.
    pub consequence: &'static str,
}

/// How meshes measure a statement.
#[derive(Clone, Copy)]
pub struct Measured {
    /// The check of the certificate.
    pub claim: Claim,
    /// Which way the check bounds: of counts of vertices the other way than the integral that the statement is about.
    pub sense: Sense,
    /// The statement's quantity from the check's worst value, c_b and t; absent where the check measures a consequence.
    pub quantity: Option<fn(f64, f64, f64) -> f64>,
}
