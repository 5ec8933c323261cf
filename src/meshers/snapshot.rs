//! What figures and replays need of every bite.

use crate::geometry::DVec2;

/// One bite: a circle removed from what is left of the domain, and what that did to the front.
#[derive(Clone, Debug, PartialEq)]
pub struct Bite {
    /// Centre of the biting circle, a mesh vertex.
    pub centre: DVec2,
    /// Its radius, c_b f at the centre.
    pub radius: f64,
    /// Why it was bitten there.
    pub reason: Reason,
    /// Front vertices that it made. Those between boundary circles belong to the last boundary circle, since the front
    /// opens after it.
    pub appeared: Vec<Waiting>,
    /// Serial numbers of the front vertices that it bit away; if its centre was one of them, that is the first.
    pub gone: Vec<u32>,
}

impl Bite {
    pub(super) fn new(centre: DVec2, radius: f64, reason: Reason) -> Self {
        Self {
            centre,
            radius,
            reason,
            appeared: Vec::new(),
            gone: Vec::new(),
        }
    }

    /// Notes that a front vertex was bitten away.
    pub(super) fn bite_away(&mut self, serial: u32, point: DVec2) {
        self.gone.push(serial);
        if point == self.centre {
            let last = self.gone.len() - 1;
            self.gone.swap(0, last);
        }
    }
}

/// Why a circle is bitten where it is, with the paper's labels of §6.2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reason {
    /// An input vertex (vertex protection).
    InputVertex,
    /// A corner is cut off there.
    CutCorner,
    /// Label B(p₁): the point where the segment leaves an earlier circle (edge protection).
    Progressive {
        /// The number of the segment.
        segment: usize,
    },
    /// Label M(p₁, p₂): the middle of q₁ and q₂, the points where the segment leaves two earlier circles.
    Middle {
        /// The number of the segment.
        segment: usize,
        /// q₁ and q₂.
        between: [DVec2; 2],
    },
    /// A front vertex in its turn (interior biting); the first of [`Bite::gone`].
    FrontVertex,
}

/// A front vertex that waits for its turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waiting {
    /// Its number, in the order in which front vertices appear.
    pub serial: u32,
    /// Where it is.
    pub point: DVec2,
    /// The two bites on whose circles it lies.
    pub circles: [u32; 2],
    /// The smallest rank is bitten first, equal ranks by serial number. 0 if the order has no ranks.
    pub rank: f64,
}
