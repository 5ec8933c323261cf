//! All statements, section by section, in the order of the paper.
//!
//! In every problem lengths are in units that make one radius 1, and g = c_b f is t-Lipschitz: then nothing depends on c_b and
//! α but through t = α c_b. A t-Lipschitz function on finitely many points extends to the plane with the same constant
//! (McShane), so it is enough to give g at the points that a statement speaks of.

use super::record::{Bound, Labelled, Statement};
use super::search::{Constraint, Effort, Problem, Sense, Unknown};
use super::slopes::Number;
use crate::geometry::interval::Interval;
use crate::theory::{Promises, Rule};

mod boundary;
mod control;
mod elements;
mod neighbours;
mod packing;
mod second;

pub use boundary::least_progressive_height;

/// Every statement with a bound, in the order of the paper.
pub fn all() -> Vec<Statement> {
    let parts = [
        control::STATEMENTS,
        packing::STATEMENTS,
        neighbours::STATEMENTS,
        elements::STATEMENTS,
        boundary::STATEMENTS,
        second::STATEMENTS,
    ];
    parts.concat()
}

/// What a statement has where it says nothing else.
const PLAIN: Statement = Statement {
    name: "",
    place: "",
    quantity: "",
    sense: Sense::AtLeast,
    printed: Bound {
        says: "",
        at: |_| f64::NAN,
    },
    parameter: "t",
    range: (0.0, 0.5),
    range_says: "t ≤ 1/3 is assumed in §6, and t = 1/2 recommended for practice",
    silent: &[],
    used_by: &[],
    problem: Problem {
        unknowns: &[],
        constraints: &[],
        quantity: |_, _| Number::fixed(Interval::WHOLE),
    },
    effort: Effort::USUAL,
    corrected: None,
    measured: None,
    points: |_, _| Vec::new(),
};

/// Unknown slopes: by how much of its constant a function changes between two points.
const SLOPE: Unknown = Unknown {
    name: "slope between the two points, as a share of t",
    range: |_| (-1.0, 1.0),
};

/// The bounds as the paper has them.
fn papers(t: f64) -> Promises {
    let rule = Rule::Earlier;
    Promises { rule, t }
}

fn number(value: f64) -> Number {
    Number::fixed(Interval::point(value))
}

/// A point without a radius.
fn place(label: &'static str, x: f64, y: f64) -> Labelled {
    Labelled {
        label,
        at: [x, y],
        radius: None,
    }
}

/// The centre of a circle.
fn centre(label: &'static str, x: f64, y: f64, radius: f64) -> Labelled {
    Labelled {
        label,
        at: [x, y],
        radius: Some(radius),
    }
}
