//! Which triangles are bad, and where to put the point that breaks one.

use super::{DelaunayRefinement, Insertion, SizeRule};
use crate::geometry::{DVec2, predicates};
use crate::meshers::MeshError;
use crate::meshers::sizing::Sizing;

/// Area of the equilateral triangle with edge 1.
const EQUILATERAL: f64 = 0.433_012_701_892_219_3;

/// Height of an off-centre over the shortest edge, in edges, times the tangent of half the angle. At 0.5 the triangle
/// over the edge would have exactly the angle asked for; it is a little less, so that rounding does not make the
/// triangle bad. The value is Triangle's.
const OFF_CENTRE: f64 = 0.475;

/// What is wrong with a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flaw {
    /// It is larger than the size rule allows.
    Size,
    /// Its smallest angle, opposite to its shortest edge, is below the bound.
    Angle,
}

/// The measures of a triangle: its shortest edge, which lies opposite to its smallest angle, and its longest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    /// Which of the edges ab, bc, ca is the shortest; the first of equal ones.
    pub shortest: usize,
    /// Its length, squared.
    pub length_squared: f64,
    /// Squared cosine of the angle opposite to it.
    cosine_squared: f64,
    longest: usize,
    longest_squared: f64,
}

impl Shape {
    pub fn of(corners: [DVec2; 3]) -> Self {
        let edge = |k: usize| corners[(k + 1) % 3] - corners[k];
        let squares = [0, 1, 2].map(|k| edge(k).length_squared());
        let (mut shortest, mut longest) = (0, 0);
        for k in 1..3 {
            if squares[k] < squares[shortest] {
                shortest = k;
            }
            if squares[k] > squares[longest] {
                longest = k;
            }
        }
        let [one, other] = [(shortest + 1) % 3, (shortest + 2) % 3];
        let dot = edge(one).dot(edge(other));
        Self {
            shortest,
            length_squared: squares[shortest],
            cosine_squared: dot * dot / (squares[one] * squares[other]),
            longest,
            longest_squared: squares[longest],
        }
    }
}

/// The bounds that triangles must meet.
pub(super) struct Bounds<'a> {
    rule: SizeRule,
    sizing: Sizing<'a>,
    /// Squared cosine of the angle asked for.
    cosine_squared: f64,
}

impl<'a> Bounds<'a> {
    pub fn new(parameters: &DelaunayRefinement, sizing: Sizing<'a>) -> Self {
        Self {
            rule: parameters.size_rule,
            sizing,
            cosine_squared: parameters.angle.to_radians().cos().powi(2),
        }
    }

    /// s at a vertex, which is kept to bound s near it; infinite if sizes do not matter.
    pub fn size_at_vertex(&self, x: DVec2) -> Result<f64, MeshError> {
        match self.rule {
            SizeRule::None => Ok(f64::INFINITY),
            _ => self.sizing.at(x),
        }
    }

    /// Whether the size rule asks for a piece to be split, whatever is beside it.
    pub fn is_too_long(&self, ends: [DVec2; 2]) -> Result<bool, MeshError> {
        match self.rule {
            SizeRule::Edge => Ok(ends[0].distance(ends[1]) > self.sizing.at(ends[0].midpoint(ends[1]))?),
            _ => Ok(false),
        }
    }

    /// What is wrong with a triangle, given s at its corners.
    pub fn flaw(&self, corners: [DVec2; 3], sizes: [f64; 3], shape: &Shape) -> Result<Option<Flaw>, MeshError> {
        for (one, other) in [(0, 1), (1, 2), (2, 0)] {
            self.sizing
                .agree([corners[one], corners[other]], [sizes[one], sizes[other]])?;
        }
        if self.is_too_large(corners, sizes, shape)? {
            return Ok(Some(Flaw::Size));
        }
        Ok((shape.cosine_squared > self.cosine_squared).then_some(Flaw::Angle))
    }

    fn is_too_large(&self, corners: [DVec2; 3], sizes: [f64; 3], shape: &Shape) -> Result<bool, MeshError> {
        let [a, b, c] = corners;
        let centroid = (a + b + c) / 3.0;
        // Where s is evaluated, and the least s there for which the triangle is small enough.
        let (place, least) = match self.rule {
            SizeRule::None => return Ok(false),
            SizeRule::Area => {
                let area = 0.5 * (b - a).perp_dot(c - a);
                (centroid, (area / EQUILATERAL).max(0.0).sqrt())
            }
            SizeRule::Edge => {
                let longest = shape.longest;
                let middle = corners[longest].midpoint(corners[(longest + 1) % 3]);
                (middle, shape.longest_squared.sqrt())
            }
            SizeRule::Radius => {
                let sine = (1.0 - shape.cosine_squared).max(0.0).sqrt();
                let radius = 0.5 * shape.length_squared.sqrt() / sine;
                (centroid, radius * 3f64.sqrt())
            }
        };
        // s is t-Lipschitz: its values at the corners decide most triangles.
        let t = self.sizing.t();
        for (corner, size) in corners.into_iter().zip(sizes) {
            let change = t * corner.distance(place);
            if least <= size - change {
                return Ok(false);
            }
            if least > size + change {
                return Ok(true);
            }
        }
        Ok(least > self.sizing.at(place)?)
    }
}

/// Where to put the point that breaks a bad triangle.
pub(super) struct NewPoint {
    /// Height of the off-centre over the shortest edge, in edges; none for circumcentres.
    height: Option<f64>,
}

impl NewPoint {
    /// A point at most as far from the shortest edge as that is long: still that far from all vertices.
    pub const BESIDE: Self = Self { height: Some(1.0) };

    pub fn new(parameters: &DelaunayRefinement) -> Self {
        let half = 0.5 * parameters.angle.to_radians();
        Self {
            height: match parameters.insertion {
                Insertion::Circumcentre => None,
                Insertion::OffCentre => Some(OFF_CENTRE / half.tan()),
            },
        }
    }

    /// The circumcentre; or, if that is nearer, the point on the bisector of the shortest edge from which the edge is
    /// seen under a little more than the angle asked for.
    pub fn of(&self, corners: [DVec2; 3], shape: &Shape) -> DVec2 {
        let [p, q, r] = [0, 1, 2].map(|k| corners[(shape.shortest + k) % 3]);
        let (to_q, to_r) = (q - p, r - p);
        let twice = 2.0 * predicates::orient2d(p, q, r);
        let circumcentre = (to_q * to_r.length_squared() - to_r * to_q.length_squared()).perp() / twice;
        let off_centre = self.height.map(|height| 0.5 * to_q + height * to_q.perp());
        match off_centre {
            Some(near) if near.length_squared() < circumcentre.length_squared() => p + near,
            _ => p + circumcentre,
        }
    }
}
