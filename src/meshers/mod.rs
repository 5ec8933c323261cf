//! The trait [`Mesher`] with what it takes ([`Request`]) and what it returns, and the list of all meshers.

use crate::domain::Domain;
use crate::mesh::Mesh;
use crate::spacing::Spacing;
use crate::theory::{Guarantee, Rule};
use std::time::{Duration, Instant};

pub mod advancing_front;
pub mod biting;
mod budget;
pub mod delaunay_refinement;
pub mod quadtree_mis;
mod sizing;
mod snapshot;

pub use budget::Budget;
use budget::Monitor;
#[cfg(feature = "suite")]
pub(crate) use budget::resident_bytes;
pub use snapshot::{Bite, Reason, Waiting};

/// Parameters of a mesher by name.
pub type Parameters = serde_json::Map<String, serde_json::Value>;

/// Makes a mesher from its parameters, or returns a message that names the wrong one.
pub type Make = fn(&Parameters) -> Result<Box<dyn Mesher>, String>;

/// One mesher of the library. The command line, legends, conformance tests and docs iterate [`MESHERS`]; nobody types a
/// mesher's name a second time.
pub struct Entry {
    /// Name on the command line and in rows.
    pub name: &'static str,
    /// One line for `list`.
    pub summary: &'static str,
    /// The mesher's own parameters.
    pub parameters: &'static [Parameter],
    /// Makes the mesher with the given parameters and the defaults of the rest; the error names the wrong parameter.
    pub make: Make,
}

impl Entry {
    /// All parameters: the given ones, and the defaults of the rest.
    pub fn complete(&self, given: &Parameters) -> Parameters {
        complete(self.parameters, given)
    }
}

/// The given parameters, and the defaults of the rest.
pub(crate) fn complete(parameters: &[Parameter], given: &Parameters) -> Parameters {
    let mut all: Parameters = parameters
        .iter()
        .map(|parameter| (parameter.name.to_owned(), parameter_value(parameter.default)))
        .collect();
    all.extend(given.clone());
    all
}

/// A parameter's value from its text on a command line: parsed if it is JSON, else the text itself.
pub fn parameter_value(text: &str) -> serde_json::Value {
    serde_json::from_str(text).unwrap_or_else(|_| text.into())
}

/// A parameter of a mesher, as `--param name=value` sets it.
pub struct Parameter {
    /// Field of the mesher's struct.
    pub name: &'static str,
    /// The values it takes.
    pub values: &'static str,
    /// The value if none is given.
    pub default: &'static str,
    /// What it does, and where it comes from.
    pub help: &'static str,
}

/// Every mesher of the library.
pub static MESHERS: &[Entry] = &[
    biting::ENTRY,
    quadtree_mis::ENTRY,
    advancing_front::ENTRY,
    delaunay_refinement::ENTRY,
];

/// The mesher called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    MESHERS.iter().find(|entry| entry.name == name)
}

/// Checks parameters, each given as its name, value, least and most; the error names the first that is out of range.
fn within(ranges: &[(&str, f64, f64, f64)]) -> Result<(), String> {
    match ranges
        .iter()
        .find(|(_, value, least, most)| !(least..=most).contains(&value))
    {
        Some((name, value, least, most)) => Err(format!("{name} is {value}: it must be from {least} to {most}")),
        None => Ok(()),
    }
}

/// A mesher's struct from its parameters by serde, for [`Entry::make`].
fn from_parameters<M: Mesher + serde::de::DeserializeOwned + 'static>(
    parameters: &Parameters,
) -> Result<Box<dyn Mesher>, String> {
    let value = serde_json::Value::Object(parameters.clone());
    let mesher: M = serde_json::from_value(value).map_err(|error| error.to_string())?;
    mesher.check()?;
    Ok(Box::new(mesher))
}

/// Declines a spacing whose Lipschitz constant is in distances inside the domain, for a method that needs it across the
/// outside too.
fn refuse_geodesic(spacing: &dyn Spacing) -> Result<(), MeshError> {
    match spacing.is_geodesic() {
        true => Err(MeshError::Declined(NOT_GEODESIC.into())),
        false => Ok(()),
    }
}

/// The reason that such a method gives.
pub(crate) const NOT_GEODESIC: &str = "this method needs similar sizes on the two sides of a gap outside the domain, and \
    lfs:geodesic does not ensure that; use lfs as spacing, or the mesher biting or delaunay-refinement";

/// What a mesher takes besides domain and spacing.
///
/// ```
/// use biting::{Case, domain::load, meshers::biting::Biting, meshers::{Budget, MeshError, Request, Trace}};
///
/// let case = Case::new(load("plate-hole")?, "lfs", 0.25, 0.75)?;
/// let most = Budget { max_vertices: Some(100), ..Budget::default() };
/// let request = Request { seed: 7, budget: most, ..case.request() };
/// let stopped = case.mesh_as(&Biting::default(), &request, &mut Trace::default());
/// assert!(matches!(stopped, Err(MeshError::Budget { .. })));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request {
    /// Biting constant: the target edge length at x is c_b f(x).
    pub c_b: f64,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Threads that the mesher may use; the mesh does not depend on their number.
    pub threads: usize,
    /// The limits at which the mesher gives up.
    pub budget: Budget,
}

impl Request {
    /// With this biting constant: seed 0, one thread, no budget.
    pub fn new(c_b: f64) -> Self {
        Self {
            c_b,
            seed: 0,
            threads: 1,
            budget: Budget::default(),
        }
    }
}

/// Why there is no mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// A budget ran out.
    #[error("stopped by {budget} after {vertices} vertices near ({x}, {y}): {advice}")]
    Budget {
        /// Which budget, with its value.
        budget: String,
        /// Vertices placed by then.
        vertices: usize,
        /// Where the mesher was at work.
        x: f64,
        /// Where the mesher was at work.
        y: f64,
        /// What to do about it.
        advice: String,
    },
    /// The spacing is not finite and positive at a point.
    #[error("spacing is {value} at ({x}, {y}): it must be finite and positive there")]
    Spacing {
        /// The value it returned.
        value: f64,
        /// Where.
        x: f64,
        /// Where.
        y: f64,
    },
    /// The spacing is steeper between two points than its Lipschitz constant allows.
    #[error(
        "spacing is {} at ({:?}, {:?}) and {} at ({:?}, {:?}): a change of more than {alpha} times their distance, the \
         constant that lipschitz() returns; limit the spacing, or return a larger constant",
        values[0], points[0].x, points[0].y, values[1], points[1].x, points[1].y
    )]
    NotLipschitz {
        /// The two points.
        points: [crate::geometry::DVec2; 2],
        /// f there.
        values: [f64; 2],
        /// Its Lipschitz constant.
        alpha: f64,
    },
    /// The method does not take this input, for the reason given.
    #[error("declined: {0}")]
    Declined(String),
    /// The points could not be triangulated.
    #[error(transparent)]
    Triangulation(#[from] crate::delaunay::TriangulationError),
}

/// Times the steps of a run by the paper's names, and can carry every bite for figures.
#[derive(Debug, Default)]
pub struct Trace {
    /// Steps in the order they ran.
    pub steps: Vec<(&'static str, Duration)>,
    /// Counts that the mesher reports beside its mesh, such as bites or forced pieces.
    pub counts: Vec<(&'static str, f64)>,
    /// Every bite in order, for figures and replays: noted only if there is a list, as in [`Trace::noting_bites`].
    pub bites: Option<Vec<Bite>>,
}

impl Trace {
    /// A trace that notes every bite.
    pub fn noting_bites() -> Self {
        Self {
            bites: Some(Vec::new()),
            ..Self::default()
        }
    }

    /// Runs `work` as the step `name`.
    pub fn step<T>(&mut self, name: &'static str, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        self.steps.push((name, start.elapsed()));
        result
    }

    /// Notes a count.
    pub fn count(&mut self, name: &'static str, value: f64) {
        self.counts.push((name, value));
    }
}

/// A mesh generator: a struct of its paper's parameters. `examples/own_mesher.rs` is one of one's own.
///
/// ```
/// use biting::{Case, domain::load, meshers::{MESHERS, Parameters}};
///
/// let case = Case::new(load("l-shape")?, "lfs", 0.25, 0.75)?;
/// for entry in MESHERS {
///     let mesher = (entry.make)(&Parameters::new())?;
///     assert!(case.judge_of(&case.mesh(&*mesher)?, &*mesher).1.holds, "{}", entry.name);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Mesher: Send + Sync {
    /// Checks that all parameters are in their ranges; the error names one that is not.
    fn check(&self) -> Result<(), String> {
        Ok(())
    }

    /// Whose spacing sets the distance of two points: the paper's rule, unless the method has another.
    fn rule(&self) -> Rule {
        Rule::Earlier
    }

    /// The claims of the certificate that the method guarantees with these parameters; the paper's among them are
    /// guaranteed if their hypotheses hold. The structural claims other than
    /// [`Claim::ConstrainedDelaunay`](crate::theory::Claim) must hold for every method and are not listed.
    fn guarantees(&self) -> Vec<Guarantee> {
        Vec::new()
    }

    /// Meshes `domain` with edges of about c_b f. Equal input gives bit-equal output.
    fn mesh(
        &self,
        domain: &Domain,
        spacing: &dyn Spacing,
        request: &Request,
        trace: &mut Trace,
    ) -> Result<Mesh, MeshError>;
}
