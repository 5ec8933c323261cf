//! What can be wrong with a spacing.

/// Why there is no spacing, or no integral of it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SpacingError {
    /// The text is not a SPEC.
    #[error("spacing `{spec}`, column {column}: {message}")]
    Parse {
        /// The text.
        spec: String,
        /// Column in characters, from 1.
        column: usize,
        /// What is wrong and what to write instead.
        message: String,
    },
    /// A kind of spacing that does not exist.
    #[error("spacing `{kind}` is unknown; there are {known}")]
    UnknownKind {
        /// What was asked for.
        kind: String,
        /// The kinds there are.
        known: String,
    },
    /// The mesh from which the spacing is to come is not usable.
    #[error("spacing `{spec}`: {message}")]
    Mesh {
        /// The spacing.
        spec: String,
        /// What is wrong with its mesh, or with its file.
        message: String,
    },
    /// An option out of its range.
    #[error("{name} is {value}: it must be {range}")]
    Option {
        /// The option.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// No two features of the domain are apart, so lfs is nowhere defined.
    #[error("local feature size needs two features that are not incident; give the domain a second vertex")]
    NoFeatures,
    /// f is not positive, or not finite, somewhere on the domain.
    #[error("spacing is {value:?} at ({x:?}, {y:?}): it must be finite and positive on the domain")]
    NotPositive {
        /// What it is there.
        value: f64,
        /// Where.
        x: f64,
        /// Where.
        y: f64,
    },
    /// f is positive where it was evaluated, but no lower bound proves it nearby.
    #[error(
        "spacing is {value:?} at ({x:?}, {y:?}), and nothing proves it positive and finite around there; write it so that it \
         stays above a constant, such as max(1e-3, ...)"
    )]
    Unproved {
        /// What it is there.
        value: f64,
        /// Where.
        x: f64,
        /// Where.
        y: f64,
    },
    /// f is smaller than coordinates, or the cells of the index, resolve.
    #[error(
        "spacing falls to {value:e} near ({x:?}, {y:?}), which is too small to resolve in a domain of this size and place; \
         join the vertices and segments that nearly touch there, or move them apart"
    )]
    Unresolved {
        /// What it is there.
        value: f64,
        /// Where.
        x: f64,
        /// Where.
        y: f64,
    },
    /// f is so small on so long a stretch that its integral cannot be resolved.
    #[error(
        "spacing is too small near ({x:?}, {y:?}), where it is {value:e}, to integrate 1 / f^2: no memory holds so fine a mesh; \
         choose a larger one, or move apart what nearly touches"
    )]
    TooSmall {
        /// What it is there.
        value: f64,
        /// Where.
        x: f64,
        /// Where.
        y: f64,
    },
    /// Something that distances inside the domain cannot be combined with.
    #[error("lfs:geodesic {message}")]
    Geodesic {
        /// What that is, and what to do.
        message: &'static str,
    },
    /// The integral was not found to the tolerance.
    #[error("the integral of 1 / f^2 has relative error {error}, and {tolerance} was asked for; ask for less")]
    NotConverged {
        /// What was asked for.
        tolerance: f64,
        /// What was reached.
        error: f64,
    },
    /// The domain could not be triangulated.
    #[error(transparent)]
    Triangulation(#[from] crate::delaunay::TriangulationError),
    /// Gradient limiting would need too large an index.
    #[error(
        "limiting the spacing to Lipschitz constant {alpha} needs more than {cells} cells near ({x}, {y}); choose a larger \
         t / c_b, a lower limit factor, or a spacing that is not so small there"
    )]
    TooManyCells {
        /// The limit.
        cells: usize,
        /// The Lipschitz constant asked for.
        alpha: f64,
        /// Where cells were being split.
        x: f64,
        /// Where cells were being split.
        y: f64,
    },
}
