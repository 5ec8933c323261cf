//! The c_b that gives a mesh of so many triangles: meshers are also compared at equal triangle count.
//!
//! Triangles grow about as c_b⁻², so the search is a secant on log triangles over log c_b, held inside the interval
//! between the largest c_b known to give too many and the smallest known to give too few, which it halves where the
//! secant leaves it. Nothing is random: equal input gives the same tries.

use crate::suite::rows::record::Try;

/// How near is near enough: this share of the triangles asked for.
pub const NEAR: f64 = 0.01;

/// Most meshes made for one cell.
pub const TRIES: usize = 10;

/// Slope of log triangles over log c_b where nothing is known of it: areas grow as squares of lengths.
const SLOPE: f64 = -2.0;

/// Slopes that two close tries suggest are held to this: counts jump where the boundary takes or loses a vertex.
const SLOPES: [f64; 2] = [-6.0, -0.5];

/// Farthest step in log c_b.
const FARTHEST: f64 = 1.5;

/// Step in log c_b away from a try that made no mesh.
const AWAY: f64 = std::f64::consts::LN_2;

/// Why a try made no mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct NoMesh<E> {
    /// Whether it was stopped for having too many triangles.
    pub too_many: bool,
    /// What it said.
    pub error: E,
}

/// What came of a search.
#[derive(Debug)]
pub struct Tuned<T> {
    /// Every c_b tried, in order.
    pub tries: Vec<Try>,
    /// The one that came nearest.
    pub c_b: f64,
    /// What it gave.
    pub value: T,
}

/// Whether a count is near enough to the one asked for.
pub fn is_near(triangles: u64, wanted: u64) -> bool {
    triangles.abs_diff(wanted) as f64 <= NEAR * wanted as f64
}

/// Searches from c_b = `start` on; `run` gives a number of triangles and what goes with it.
///
/// # Errors
/// The first of `run`, if no try made a mesh.
pub fn tune<T, E>(
    wanted: u64,
    start: f64,
    mut run: impl FnMut(f64) -> Result<(u64, T), NoMesh<E>>,
) -> Result<Tuned<T>, NoMesh<E>> {
    let mut search = Search::new(start);
    let (mut best, mut first_error): (Option<(f64, f64, T)>, _) = (None, None);
    let mut tries = Vec::new();
    while tries.len() < TRIES {
        let c_b = search.at.exp();
        match run(c_b) {
            Ok((triangles, value)) => {
                tries.push(Try {
                    c_b,
                    triangles: Some(triangles),
                });
                let excess = (triangles.max(1) as f64 / wanted.max(1) as f64).ln();
                if best.as_ref().is_none_or(|(off, ..)| excess.abs() < *off) {
                    best = Some((excess.abs(), c_b, value));
                }
                if is_near(triangles, wanted) {
                    break;
                }
                search.learn(excess);
            }
            Err(refused) => {
                tries.push(Try { c_b, triangles: None });
                search.step_away(refused.too_many);
                first_error.get_or_insert(refused);
            }
        }
    }
    match (best, first_error) {
        (Some((_, c_b, value)), _) => Ok(Tuned { tries, c_b, value }),
        (None, Some(error)) => Err(error),
        (None, None) => unreachable!("there is at least one try, which either made a mesh or told why not"),
    }
}

/// Where the search stands, in log c_b.
struct Search {
    at: f64,
    /// The last try that made a mesh: log c_b, and log of its triangles over those asked for.
    last: Option<(f64, f64)>,
    /// Largest known to give too many.
    fine: f64,
    /// Smallest known to give too few.
    coarse: f64,
}

impl Search {
    fn new(start: f64) -> Self {
        Self {
            at: start.ln(),
            last: None,
            fine: f64::NEG_INFINITY,
            coarse: f64::INFINITY,
        }
    }

    /// Moves on from a mesh with e^`excess` times the triangles asked for.
    fn learn(&mut self, excess: f64) {
        let slope = match self.last {
            Some((at, before)) if at != self.at => ((excess - before) / (self.at - at)).clamp(SLOPES[0], SLOPES[1]),
            _ => SLOPE,
        };
        self.last = Some((self.at, excess));
        self.narrow(excess > 0.0);
        self.go(self.at + (-excess / slope).clamp(-FARTHEST, FARTHEST));
    }

    /// Moves on from where there was no mesh.
    fn step_away(&mut self, too_many: bool) {
        self.narrow(too_many);
        self.go(if too_many { self.at + AWAY } else { self.at - AWAY });
    }

    fn narrow(&mut self, too_many: bool) {
        if too_many {
            self.fine = self.fine.max(self.at);
        } else {
            self.coarse = self.coarse.min(self.at);
        }
    }

    fn go(&mut self, to: f64) {
        let is_between = self.fine < to && to < self.coarse;
        // Counts that do not fall steadily can cross the ends; then the secant is all there is.
        let halve = self.fine < self.coarse && (self.coarse - self.fine).is_finite() && !is_between;
        self.at = if halve { 0.5 * (self.fine + self.coarse) } else { to };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn search(wanted: u64, start: f64, count: impl Fn(f64) -> Option<u64>) -> Tuned<()> {
        tune(wanted, start, |c_b| {
            let none = NoMesh {
                too_many: false,
                error: "none",
            };
            count(c_b).map(|triangles| (triangles, ())).ok_or(none)
        })
        .expect("a mesh")
    }

    #[test]
    fn a_power_law_takes_two_tries() {
        let found = search(20_000, 1.0, |c_b| Some((1000.0 / (c_b * c_b)) as u64));
        assert_eq!(found.tries.len(), 2);
        assert!((found.c_b - 0.05f64.sqrt()).abs() < 1e-3 && is_near(20_000, 20_199) && !is_near(20_000, 20_300));
    }

    #[test]
    fn a_boundary_that_keeps_its_triangles_takes_a_few_more() {
        let count = |c_b: f64| 5_000 + (2_000.0 / c_b.powf(1.2)) as u64;
        let found = search(6_000, 0.01, |c_b| Some(count(c_b)));
        assert!(
            found.tries.len() <= TRIES && is_near(count(found.c_b), 6_000),
            "{found:?}"
        );
    }

    #[test]
    fn a_miss_keeps_the_nearest_try() {
        // Never under 900: 500 cannot be had.
        let found = search(500, 0.5, |c_b| Some((900.0 + 100.0 / c_b) as u64));
        assert_eq!(found.tries.len(), TRIES);
        let least = found.tries.iter().filter_map(|tried| tried.triangles).min();
        let reached = found
            .tries
            .iter()
            .find(|tried| tried.c_b == found.c_b)
            .and_then(|tried| tried.triangles);
        assert_eq!(reached, least);
    }

    #[test]
    fn tries_without_a_mesh_are_stepped_away_from() {
        let found = search(4_000, 2.0, |c_b| (c_b < 0.9).then_some((1000.0 / (c_b * c_b)) as u64));
        assert_eq!(found.tries[0].triangles, None);
        assert!((found.c_b - 0.5).abs() < 0.01, "{found:?}");
        let refused = tune(10, 1.0, |_| {
            Err::<(u64, ()), _>(NoMesh {
                too_many: true,
                error: "too many",
            })
        });
        assert_eq!(refused.err().map(|none| none.error), Some("too many"));
    }
}
