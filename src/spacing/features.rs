//! The features of a PSLG, vertices and segments, and the smallest disk that meets two that are not incident.

use crate::geometry::DVec2;

/// Distances kept on the stack; longer lists occur only while the lists are built, and at vertices of huge degree.
const BUFFER: usize = 64;

/// A vertex (both ends the same) or a segment.
#[derive(Clone, Copy, Debug)]
pub struct Feature {
    from: DVec2,
    along: DVec2,
    /// 1 / |along|², 0 for a vertex.
    inverse: f64,
    ends: [u32; 2],
}

impl Feature {
    /// A vertex, twice the same end, or a segment.
    pub fn new(at: [DVec2; 2], ends: [u32; 2]) -> Self {
        let along = at[1] - at[0];
        let inverse = if ends[0] == ends[1] {
            0.0
        } else {
            along.length_squared().recip()
        };
        Self {
            from: at[0],
            along,
            inverse,
            ends,
        }
    }

    /// From the point of the feature nearest to `x` to `x`.
    #[inline]
    fn offset(&self, x: DVec2) -> DVec2 {
        let offset = x - self.from;
        let share = (offset.dot(self.along) * self.inverse).clamp(0.0, 1.0);
        offset - share * self.along
    }

    #[inline]
    fn has_end(&self, vertex: u32) -> bool {
        self.ends[0] == vertex || self.ends[1] == vertex
    }

    #[inline]
    fn is_incident(&self, other: &Self) -> bool {
        self.has_end(other.ends[0]) || self.has_end(other.ends[1])
    }
}

/// A squared radius and the two features that a disk of it meets.
type Stop = (f64, [u32; 2]);

/// The features of a PSLG.
#[derive(Clone, Debug)]
pub struct Features(Vec<Feature>);

/// A feature K as seen from a point x.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// dist(x, K).
    pub distance: f64,
    /// ∇ dist: the unit vector away from K, 0 inside K.
    pub away: DVec2,
}

impl View {
    /// The view over `offset`, which leads from the point of K nearest to x to x.
    fn new(offset: DVec2) -> Self {
        let distance = offset.length();
        let away = if distance > 0.0 { offset / distance } else { DVec2::ZERO };
        Self { distance, away }
    }

    /// By how much the distance to `other` may gain on the distance to this one within `radius`.
    pub fn margin(&self, other: &Self, radius: f64) -> f64 {
        let turn = |view: &Self| {
            if view.distance > radius {
                0.5 * radius * radius / (view.distance - radius)
            } else {
                f64::INFINITY
            }
        };
        (radius * self.away.distance(other.away) + turn(self) + turn(other)).min(2.0 * radius)
    }
}

impl Features {
    /// All of them.
    pub fn new(features: Vec<Feature>) -> Self {
        Self(features)
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// lfs at `x` if the features in `list` are all there are, and the two that stop the disk.
    pub fn decide(&self, list: &[u32], x: DVec2) -> (f64, [u32; 2]) {
        let mut short = [0.0; BUFFER];
        let mut long = Vec::new();
        let distances = if list.len() <= BUFFER {
            &mut short[..list.len()]
        } else {
            long.resize(list.len(), 0.0);
            &mut long[..]
        };
        let mut nearest = (f64::INFINITY, 0);
        for (distance, &index) in distances.iter_mut().zip(list) {
            *distance = self.0[index as usize].offset(x).length_squared();
            if *distance < nearest.0 {
                nearest = (*distance, index);
            }
        }
        let first = &self.0[nearest.1 as usize];
        let mut stop = (f64::INFINITY, [nearest.1; 2]);
        for (&distance, &index) in distances.iter().zip(list) {
            if distance < stop.0 && !self.0[index as usize].is_incident(first) {
                stop = (distance, [nearest.1, index]);
            }
        }
        let (squared, deciding) = self.between_the_ends(first, list, distances, stop);
        (squared.sqrt(), deciding)
    }

    /// The ends of a feature, equal for a vertex.
    pub fn ends(&self, feature: u32) -> [DVec2; 2] {
        let feature = &self.0[feature as usize];
        [feature.from, feature.from + feature.along]
    }

    /// The feature as seen from `x`.
    pub fn view(&self, feature: u32, x: DVec2) -> View {
        View::new(self.0[feature as usize].offset(x))
    }

    /// The nearest feature `first` is a segment: what hangs on one of its ends may be apart from what hangs on the
    /// other (the two ends themselves are). Returns the smallest disk that meets two such, or `stop` if that is smaller.
    fn between_the_ends(&self, first: &Feature, list: &[u32], distances: &[f64], stop: Stop) -> Stop {
        let mut lowest = stop;
        if first.ends[0] == first.ends[1] {
            return lowest;
        }
        let hangs_on = |end: usize| {
            list.iter().zip(distances).filter(move |(index, _)| {
                let feature = &self.0[**index as usize];
                feature.has_end(first.ends[end]) && !feature.has_end(first.ends[1 - end])
            })
        };
        for (&one, &near) in hangs_on(0).filter(|(_, distance)| **distance < stop.0) {
            for (&two, &far) in hangs_on(1) {
                if near.max(far) < lowest.0 && !self.0[one as usize].is_incident(&self.0[two as usize]) {
                    lowest = (near.max(far), [one, two]);
                }
            }
        }
        lowest
    }
}
