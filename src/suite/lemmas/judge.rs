//! The numerical judgement: a formula against the optimum of what it bounds, over a grid of the parameter.

use super::record::{Bound, Statement};
use super::search::{Optimum, Sense};
use rayon::prelude::*;

/// The optimum of a statement's quantity at one value of the parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// The parameter.
    pub parameter: f64,
    /// The optimum over all configurations.
    pub optimum: Optimum,
}

/// By how much of a bound a value may miss it and still count as equal, unless a search was content with less.
pub const SAME: f64 = 1e-4;

/// What comes out for a formula over a grid of the parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// It is the optimum, everywhere.
    Sharp,
    /// It holds; the optimum is farthest from it at this value of the parameter.
    Loose {
        /// Where.
        parameter: f64,
        /// The bound there.
        bound: f64,
        /// The optimum there.
        optimum: f64,
    },
    /// A configuration breaks it.
    Fails {
        /// The first value of the grid where one does.
        parameter: f64,
        /// The bound there.
        bound: f64,
        /// The optimum there.
        optimum: f64,
    },
    /// Neither proved nor refuted: the search was not long enough.
    Open {
        /// The first such value of the grid.
        parameter: f64,
    },
}

impl Verdict {
    /// Whether no configuration breaks the formula.
    pub fn holds(&self) -> bool {
        matches!(self, Self::Sharp | Self::Loose { .. })
    }

    /// One word.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Sharp => "sharp",
            Self::Loose { .. } => "holds",
            Self::Fails { .. } => "fails",
            Self::Open { .. } => "open",
        }
    }
}

/// Equal steps over the range of a statement's parameter.
pub fn grid(statement: &Statement, steps: usize) -> Vec<f64> {
    let (least, most) = statement.range;
    if least == most {
        return vec![least];
    }
    let step = (most - least) / steps as f64;
    (0..=steps).map(|k| least + step * k as f64).collect()
}

/// The optima of a statement's quantity over some values of its parameter, on all cores.
pub fn optima(statement: &Statement, parameters: &[f64]) -> Vec<Judged> {
    let judged = parameters.par_iter().filter_map(|&parameter| {
        let optimum = statement
            .problem
            .optimum(statement.sense, parameter, statement.effort)?;
        Some(Judged { parameter, optimum })
    });
    judged.collect()
}

/// The verdict on a formula for a statement's quantity, over those of the optima that lie in a range of the parameter.
pub fn verdict(statement: &Statement, formula: &Bound, range: (f64, f64), judged: &[Judged]) -> Verdict {
    let share = SAME.max(1.01 * statement.effort.gap);
    let mut loosest = (1.0 + share, Verdict::Sharp);
    for Judged { parameter, optimum } in judged
        .iter()
        .filter(|one| range.0 <= one.parameter && one.parameter <= range.1)
    {
        let (parameter, bound) = (*parameter, (formula.at)(*parameter));
        let found = Verdict::Fails {
            parameter,
            bound,
            optimum: optimum.found,
        };
        if !statement.sense.allows(bound, optimum.found, share) {
            return found;
        }
        if !statement.sense.allows(bound, optimum.proved, share) {
            return Verdict::Open { parameter };
        }
        let factor = slack(statement.sense, bound, optimum.found, share);
        if factor > loosest.0 {
            loosest = (
                factor,
                Verdict::Loose {
                    parameter,
                    bound,
                    optimum: optimum.found,
                },
            );
        }
    }
    loosest.1
}

/// By which factor an optimum is on the safe side of a bound; 1 where they are the same.
pub fn slack(sense: Sense, bound: f64, optimum: f64, share: f64) -> f64 {
    if (optimum - bound).abs() <= share {
        return 1.0;
    }
    match sense {
        Sense::AtLeast => optimum / bound,
        Sense::AtMost => bound / optimum,
    }
}
