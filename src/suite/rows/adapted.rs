//! What a cell asks of adaptation, and what came of each round.

use serde::{Deserialize, Serialize};
use std::fmt;

/// What is asked of an adaptation; the problem is the cell's.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Adapt {
    /// The error of linear interpolation that is allowed, in the unit of u; positive.
    pub eps: f64,
    /// Most rounds before the mesh that is reported; default 10.
    #[serde(default = "ten")]
    pub rounds: u32,
    /// Whether the Hessian comes from u itself at the vertices, in place of the solution u_h. Default false.
    #[serde(default)]
    pub sample: bool,
}

fn ten() -> u32 {
    10
}

impl fmt::Display for Adapt {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sample = if self.sample { ",sample" } else { "" };
        write!(out, "{},rounds={}{sample}", self.eps, self.rounds)
    }
}

impl Adapt {
    /// Whether its numbers are in range.
    ///
    /// # Errors
    /// Which is not.
    pub fn check(&self) -> Result<(), String> {
        if !(self.eps > 0.0 && self.eps.is_finite()) {
            return Err(format!("eps = {} must be positive and finite", self.eps));
        }
        if self.rounds == 0 {
            return Err("rounds = 0 would adapt nothing; leave `adapt` out for that".into());
        }
        Ok(())
    }
}

/// What came of a round.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Round {
    /// Vertices of its mesh.
    pub vertices: usize,
    /// Triangles of its mesh.
    pub triangles: usize,
    /// L2 error of the solution on it over the L2 norm of u.
    pub l2_error: f64,
    /// Energy error of the solution on it over the energy norm of u.
    pub energy_error: f64,
    /// Share of its vertices whose spacing has settled.
    pub settled: f64,
    /// The smallest ratio of the next spacing to the last one at its vertices.
    pub least_change: f64,
    /// Points of a maximal independent set of its vertices for the next spacing.
    pub independent: usize,
    /// Vertices it has in common with the mesh before; 0 in the first round.
    pub kept: usize,
}
