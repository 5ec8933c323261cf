//! What can be wrong with a domain, reported with file, line and remedy.

use std::fmt;

/// Kinds of faults a PSLG can have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FaultKind {
    /// A coordinate is NaN or infinite, or so large that areas overflow.
    NotFinite,
    /// All vertices lie so near together that areas vanish.
    TooSmall,
    /// A coordinate is so near to 0, without being it, that areas vanish.
    NearlyZero,
    /// A segment names a vertex that does not exist.
    NoSuchVertex,
    /// Fewer than three vertices or segments.
    TooFew,
    /// Two vertices at the same point.
    DuplicateVertices,
    /// A segment from a vertex to itself.
    ZeroLength,
    /// Two segments between the same vertices.
    RepeatedSegment,
    /// Two segments cross inside both.
    Crossing,
    /// Two collinear segments share more than a point.
    Overlap,
    /// A vertex lies on a segment that does not end there.
    VertexOnSegment,
    /// The segments enclose nothing.
    NotClosed,
    /// Every enclosed face is a hole.
    NothingInside,
    /// A hole point lies outside every boundary, or on a segment.
    MisplacedHole,
    /// A region point lies outside the domain, or on a segment.
    MisplacedRegion,
}

impl FaultKind {
    /// Whether [`super::repair`] can mend it.
    pub fn is_repairable(self) -> bool {
        use FaultKind::{Crossing, DuplicateVertices, Overlap, RepeatedSegment, VertexOnSegment, ZeroLength};
        matches!(
            self,
            DuplicateVertices | ZeroLength | RepeatedSegment | Crossing | Overlap | VertexOnSegment
        )
    }

    /// What to do about it.
    pub fn advice(self) -> &'static str {
        match self {
            Self::NotFinite => "give finite coordinates of at most 1e60 in size",
            Self::TooSmall => "multiply all coordinates so that the larger side is at least 1e-24",
            Self::NearlyZero => "write 0, or give coordinates of at least 1e-40 in size",
            Self::NoSuchVertex => "number the ends as the vertices are numbered",
            Self::TooFew => "a domain needs at least three vertices joined by three segments",
            Self::DuplicateVertices => "use one of them for both, or let --repair merge them",
            Self::ZeroLength => "remove it, or let --repair do so",
            Self::RepeatedSegment => "remove one, or let --repair do so",
            Self::Crossing => "add a vertex where they cross and split both, or let --repair do so",
            Self::Overlap => "keep the common part once, or let --repair do so",
            Self::VertexOnSegment => "split the segment there, or let --repair do so",
            Self::NotClosed => "close the boundary: every outer boundary must return to its first vertex",
            Self::NothingInside => "remove the hole point that lies in the part to be meshed",
            Self::MisplacedHole => "move it into the hole, off every segment, or remove it",
            Self::MisplacedRegion => "move it into the region, off every segment, or remove it",
        }
    }
}

/// One fault, with what it concerns.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// What kind it is.
    pub kind: FaultKind,
    /// The vertices concerned, as indices into the PSLG.
    pub vertices: Vec<usize>,
    /// The segments concerned, as indices into the PSLG.
    pub segments: Vec<usize>,
    /// The line of the file where the fault shows first, if there is a file.
    pub line: Option<usize>,
    /// What is wrong: a sentence without its full stop, with the numbers that the file uses.
    pub message: String,
}

/// Why there is no domain.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DomainError {
    /// The PSLG is not valid. At least one fault, in the order of the checks.
    #[error("{}", invalid(file, faults))]
    Invalid {
        /// File or gallery name.
        file: String,
        /// Every fault found.
        faults: Vec<Fault>,
    },
    /// A file does not have the form its ending promises.
    #[error("{file}{}: {message}", at_line(*line))]
    Syntax {
        /// File name.
        file: String,
        /// Line, where known.
        line: Option<usize>,
        /// What was expected, what was found, and what to do.
        message: String,
    },
    /// A file cannot be read at all.
    #[error("{file}: {message}")]
    Unreadable {
        /// File name.
        file: String,
        /// The system's reason and what to do.
        message: String,
    },
    /// There is neither a gallery domain nor a file of that name.
    #[error("{name}: {message}")]
    Unknown {
        /// What was asked for.
        name: String,
        /// What there is.
        message: String,
    },
}

impl DomainError {
    /// The faults of an invalid PSLG; none for other errors.
    pub fn faults(&self) -> &[Fault] {
        match self {
            Self::Invalid { faults, .. } => faults,
            Self::Syntax { .. } | Self::Unreadable { .. } | Self::Unknown { .. } => &[],
        }
    }
}

fn at_line(line: Option<usize>) -> String {
    line.map_or_else(String::new, |line| format!(":{line}"))
}

fn invalid(file: &str, faults: &[Fault]) -> String {
    let Some(first) = faults.first() else {
        return format!("{file}: invalid");
    };
    let mut text = format!(
        "{file}{}: {}; {}",
        at_line(first.line),
        first.message,
        first.kind.advice()
    );
    match faults.len() - 1 {
        0 => {}
        1 => text.push_str(" (and 1 more fault)"),
        more => text.push_str(&format!(" (and {more} more faults)")),
    }
    text
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; {}", self.message, self.kind.advice())
    }
}
