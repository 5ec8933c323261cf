//! The features of a PSLG, vertices and segments, and the smallest disk that meets two that are not incident.

use crate::geometry::DVec2;
use crate::spacing::lfs::items::Items;

/// Number of distances kept on the stack; longer lists occur only while the lists are built, and at vertices of huge degree.
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

/// A squared radius, and the two features that the disk of this radius meets.
type Stop = (f64, [u32; 2]);

/// The features of a PSLG.
#[derive(Clone, Debug)]
pub struct Features(Vec<Feature>);

impl Features {
    /// All of them.
    pub fn new(features: Vec<Feature>) -> Self {
        Self(features)
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// The ends of a feature, equal for a vertex.
    pub fn ends(&self, feature: u32) -> [DVec2; 2] {
        let feature = &self.0[feature as usize];
        [feature.from, feature.from + feature.along]
    }

    /// For a segment `first` as the nearest feature: features at one of its ends may not be incident to features at the other (the
    /// two ends themselves are not). Returns the smallest disk that meets two such, or `stop` if that is smaller.
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

impl Items for Features {
    /// lfs at `x`, and the two features that stop the disk.
    fn decide(&self, list: &[u32], x: DVec2) -> (f64, [u32; 2]) {
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

    #[inline]
    fn offset(&self, feature: u32, x: DVec2) -> (DVec2, f64) {
        (self.0[feature as usize].offset(x), 0.0)
    }

    fn slope(&self) -> f64 {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vertex(x: f64, y: f64, index: u32) -> Feature {
        Feature::new([DVec2::new(x, y); 2], [index; 2])
    }

    #[test]
    fn an_offset_leads_from_the_nearest_point() {
        let features = Features::new(vec![
            Feature::new([DVec2::ZERO, DVec2::new(4.0, 0.0)], [0, 1]),
            vertex(1.0, 1.0, 2),
        ]);
        assert_eq!(
            (features.len(), features.ends(0)),
            (2, [DVec2::ZERO, DVec2::new(4.0, 0.0)])
        );
        for (x, expected) in [
            ((3.0, 2.0), (0.0, 2.0)),
            ((-3.0, 1.0), (-3.0, 1.0)),
            ((7.0, 0.0), (3.0, 0.0)),
        ] {
            assert_eq!(Items::offset(&features, 0, x.into()), (expected.into(), 0.0));
        }
        assert_eq!(Items::offset(&features, 1, DVec2::ZERO), (DVec2::new(-1.0, -1.0), 0.0));
    }

    /// Lists longer than the buffer give the same as shorter ones.
    #[test]
    fn long_lists_are_decided_as_short_ones_are() {
        for count in [
            2,
            BUFFER as u32 - 1,
            BUFFER as u32,
            BUFFER as u32 + 1,
            3 * BUFFER as u32,
        ] {
            let features = Features::new((0..count).map(|k| vertex(f64::from(k), 0.0, k)).collect());
            let all: Vec<u32> = (0..count).rev().collect();
            assert_eq!(features.decide(&all, DVec2::new(0.25, 0.0)), (0.75, [0, 1]));
        }
    }

    /// A segment is nearest, and the features at its ends are nearer than all others.
    #[test]
    fn what_hangs_on_one_end_may_stop_the_disk_with_what_hangs_on_the_other() {
        // A tall U, its bottom from (0, 0) to (4, 0), arms to (0, 9) and (4, 9), and a vertex far away.
        let corners = [(0.0, 0.0), (4.0, 0.0), (0.0, 9.0), (4.0, 9.0), (50.0, 50.0)].map(DVec2::from);
        let segments = [[0, 1], [0, 2], [1, 3]];
        let points = (0..5).map(|k| vertex(corners[k].x, corners[k].y, k as u32));
        let lines = segments.map(|[a, b]| Feature::new([corners[a], corners[b]], [a as u32, b as u32]));
        let features = Features::new(points.chain(lines).collect());
        let all: Vec<u32> = (0..8).collect();
        // From (2, 1) both arms are 2 away, the vertices at the ends of the bottom √5.
        let (value, deciding) = features.decide(&all, DVec2::new(2.0, 1.0));
        assert_eq!((value, deciding), (2.0, [6, 7]));
        // From (1, ½) the bottom is nearest, then the left arm and corner; the right arm stops the disk at 3.
        let (value, deciding) = features.decide(&all, DVec2::new(1.0, 0.5));
        assert!(value == 3.0 && deciding[1] == 7, "{value} {deciding:?}");
        // From (2, 0), on the bottom, its two ends are 2 away, and so are the arms.
        assert_eq!(features.decide(&all, DVec2::new(2.0, 0.0)).0, 2.0);
    }
}
