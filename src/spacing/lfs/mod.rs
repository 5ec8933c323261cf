//! Local feature size, exactly as Definition 2.1 says.
//!
//! # Idea
//! The features are the vertices and the segments. Two are incident when they are the same, a segment and its end, or
//! two segments with a common end. lfs(x) is the radius of the smallest disk around x that meets two features that are
//! not incident: with features met nearest first, the first one that is not incident to an earlier one stops the disk.
//! [`Shortlists`] hold the few features that can matter in each part of the plane, so no search is needed.
//!
//! # Guarantee
//! `lfs` is 1-Lipschitz on the whole plane, and nowhere below half the smallest lfs of a vertex.
//!
//! # Deviations from the paper
//! None. Distances are Euclidean, so two arms that are close in the plane and far apart along the domain affect one another; the
//! geodesic variant of the paper's footnote is [`crate::spacing::GeodesicLfs`].

mod features;
pub(super) mod items;
pub(super) mod shortlist;

use crate::geometry::tolerance::RESOLUTION;
use crate::geometry::{DVec2, Rect};
use crate::spacing::lfs::features::{Feature, Features};
use crate::spacing::lfs::items::Items;
use crate::spacing::lfs::shortlist::Shortlists;
use crate::spacing::{Spacing, SpacingError};
use std::fmt;

/// Where lfs is smallest among the vertices, and why.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Narrowest {
    /// lfs there.
    pub value: f64,
    /// The vertex.
    pub at: DVec2,
    /// The feature at that distance: the ends of a segment, or twice a vertex.
    pub other: [DVec2; 2],
}

impl fmt::Display for Narrowest {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let [a, b] = self.other;
        let (x, y) = (self.at.x, self.at.y);
        write!(
            out,
            "local feature size falls to {:.3e} at ({x:?}, {y:?}), so near is ",
            self.value
        )?;
        if a == b {
            write!(out, "the vertex ({:?}, {:?})", a.x, a.y)
        } else {
            write!(out, "the segment from ({:?}, {:?}) to ({:?}, {:?})", a.x, a.y, b.x, b.y)
        }
    }
}

/// lfs of a planar straight-line graph.
#[derive(Clone, Debug)]
pub struct Lfs {
    features: Features,
    lists: Shortlists,
    narrowest: Narrowest,
}

impl Lfs {
    /// Indexes the features of a PSLG: all `vertices`, and `segments` between two of them.
    ///
    /// # Errors
    /// [`SpacingError::NoFeatures`] if no two features are apart, [`SpacingError::NotPositive`] if two coincide,
    /// [`SpacingError::Unresolved`] if two are so near that no mesher could put an edge between them.
    pub fn new(vertices: &[DVec2], segments: &[[usize; 2]]) -> Result<Self, SpacingError> {
        let points = vertices
            .iter()
            .zip(0..)
            .map(|(&at, index)| Feature::new([at, at], [index, index]));
        let edges = segments
            .iter()
            .map(|&[a, b]| Feature::new([vertices[a], vertices[b]], [a as u32, b as u32]));
        let features = Features::new(points.chain(edges).collect());
        let bounds = Rect::around(vertices.iter().copied());
        if vertices.len() < 2 {
            return Err(SpacingError::NoFeatures);
        }
        // Some room outside, for a mesher that evaluates f past the boundary; farther away a query visits every feature. Beside a
        // long thin domain lists would be long, and nothing is evaluated that far away.
        let room = DVec2::splat((0.05 * bounds.diagonal()).min(bounds.size().min_element()));
        let root = Rect {
            min: bounds.min - room,
            max: bounds.max + room,
        };
        let all: Vec<u32> = (0..features.len() as u32).collect();
        let lists = Shortlists::new(&features, &all, root);
        let mut lfs = Self {
            features,
            lists,
            narrowest: Narrowest {
                value: f64::INFINITY,
                at: vertices[0],
                other: [vertices[0]; 2],
            },
        };
        lfs.narrowest = lfs.lowest(vertices)?;
        Ok(lfs)
    }

    /// Where lfs is smallest among the vertices, if it can be resolved there.
    fn lowest(&self, vertices: &[DVec2]) -> Result<Narrowest, SpacingError> {
        let values = vertices.iter().map(|&vertex| (self.at(vertex), vertex));
        let lower = |lowest: (f64, DVec2), next: (f64, DVec2)| if next.0 < lowest.0 { next } else { lowest };
        let (value, at) = values.fold((f64::INFINITY, vertices[0]), lower);
        let (x, y) = (at.x, at.y);
        if value.is_infinite() {
            return Err(SpacingError::NoFeatures);
        }
        if value <= 0.0 {
            return Err(SpacingError::NotPositive { value: 0.0, x, y });
        }
        if value < RESOLUTION * Rect::around(vertices.iter().copied()).largest_coordinate() {
            return Err(SpacingError::Unresolved { value, x, y });
        }
        let list = self.lists.at(at).unwrap_or_default();
        let other = self.features.ends(self.features.decide(list, at).1[1]);
        Ok(Narrowest { value, at, other })
    }

    /// The largest lower bound of lfs on the whole plane: inf lfs = ½ min over vertices v of lfs(v).
    ///
    /// The two features of the smallest disk are nearest to each other at a vertex of one of them, and lfs at a vertex
    /// is its distance to the nearest feature not incident to it.
    pub fn smallest(&self) -> f64 {
        0.5 * self.narrowest.value
    }

    /// Where lfs is smallest among the vertices.
    pub fn narrowest(&self) -> Narrowest {
        self.narrowest
    }
}

impl Spacing for Lfs {
    fn at(&self, x: DVec2) -> f64 {
        match self.lists.at(x) {
            Some(list) => self.features.decide(list, x).0,
            None => {
                let all: Vec<u32> = (0..self.features.len() as u32).collect();
                self.features.decide(&all, x).0
            }
        }
    }

    fn lipschitz(&self) -> f64 {
        1.0
    }

    fn lower_bound(&self, cell: Rect) -> f64 {
        self.lower_bound_from(cell, self.at(cell.centre()))
    }

    fn lower_bound_from(&self, cell: Rect, at_centre: f64) -> f64 {
        (at_centre - 0.5 * cell.diagonal()).max(self.smallest())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spacing::testing::{gear, naive_lfs, pseudo_random_points};
    use proptest::prelude::*;

    fn square() -> (Vec<DVec2>, Vec<[usize; 2]>) {
        (
            vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y],
            vec![[0, 1], [1, 2], [2, 3], [3, 0]],
        )
    }

    fn assert_is_naive(vertices: &[DVec2], segments: &[[usize; 2]], points: &[DVec2]) {
        let lfs = Lfs::new(vertices, segments).unwrap();
        for &x in points {
            let (found, expected) = (lfs.at(x), naive_lfs(vertices, segments, x));
            assert!(
                (found - expected).abs() <= 1e-14 * (1.0 + x.length()),
                "lfs({x}) = {found}, naive {expected}"
            );
        }
    }

    #[test]
    fn the_oracle_knows_the_unit_square() {
        let (vertices, segments) = square();
        let at = |x, y| naive_lfs(&vertices, &segments, DVec2::new(x, y));
        assert_eq!(at(0.0, 0.0), 1.0);
        assert_eq!(at(0.5, 0.5), 0.5);
        assert_eq!(at(0.5, 0.0), 0.5);
        assert_eq!(at(0.25, 0.0), 0.75);
    }

    #[test]
    fn lfs_is_the_oracle_on_the_square() {
        let (vertices, segments) = square();
        let points: Vec<DVec2> = pseudo_random_points(2000)
            .into_iter()
            .map(|p| 3.0 * p - DVec2::ONE)
            .collect();
        assert_is_naive(&vertices, &segments, &points);
        assert_is_naive(&vertices, &segments, &vertices);
    }

    #[test]
    fn lfs_is_the_oracle_on_a_gear_and_at_its_vertices() {
        let (vertices, segments) = gear(40);
        let points: Vec<DVec2> = pseudo_random_points(500)
            .into_iter()
            .map(|p| 2.6 * p - DVec2::splat(1.3))
            .collect();
        assert_is_naive(&vertices, &segments, &points);
        assert_is_naive(&vertices, &segments, &vertices);
    }

    #[test]
    fn smallest_is_the_infimum_of_lfs() {
        let (vertices, segments) = gear(40);
        let lfs = Lfs::new(&vertices, &segments).unwrap();
        let mut lowest = f64::INFINITY;
        for (a, &v) in vertices.iter().enumerate() {
            for (b, &w) in vertices.iter().enumerate() {
                if a != b {
                    lowest = lowest.min(lfs.at(0.5 * (v + w)));
                }
            }
        }
        assert!(
            lfs.smallest() <= lowest && lowest <= lfs.smallest() * (1.0 + 1e-12),
            "{} {lowest}",
            lfs.smallest()
        );
    }

    #[test]
    fn one_vertex_is_an_error_and_two_are_not() {
        assert_eq!(Lfs::new(&[DVec2::ZERO], &[]).err(), Some(SpacingError::NoFeatures));
        assert_eq!(
            Lfs::new(&[DVec2::ZERO, DVec2::X], &[[0, 1]])
                .unwrap()
                .at(DVec2::new(0.5, 0.0)),
            0.5
        );
        assert!(matches!(
            Lfs::new(&[DVec2::X, DVec2::X], &[]),
            Err(SpacingError::NotPositive { .. })
        ));
    }

    #[test]
    fn the_narrowest_place_names_both_features() {
        let (mut vertices, segments) = square();
        vertices.push(DVec2::new(0.4, 0.01));
        let narrowest = Lfs::new(&vertices, &segments).unwrap().narrowest();
        assert_eq!((narrowest.value, narrowest.at), (0.01, vertices[4]));
        assert_eq!(narrowest.other, [DVec2::ZERO, DVec2::X]);
        let told =
            "local feature size falls to 1.000e-2 at (0.4, 0.01), so near is the segment from (0.0, 0.0) to (1.0, 0.0)";
        assert_eq!(narrowest.to_string(), told);
    }

    #[test]
    fn a_vertex_that_is_too_near_is_named_as_one() {
        let lfs = Lfs::new(&[DVec2::ZERO, DVec2::new(0.0, 0.5), DVec2::new(4.0, 0.0)], &[]).unwrap();
        let narrowest = lfs.narrowest();
        assert_eq!(
            (narrowest.value, narrowest.at, lfs.smallest()),
            (0.5, DVec2::ZERO, 0.25)
        );
        let told = "local feature size falls to 5.000e-1 at (0.0, 0.0), so near is the vertex (0.0, 0.5)";
        assert_eq!(narrowest.to_string(), told);
    }

    #[test]
    fn lfs_on_a_box_is_bounded_by_its_constant_and_by_its_smallest_value() {
        let (vertices, segments) = square();
        let lfs = Lfs::new(&vertices, &segments).unwrap();
        assert_eq!((lfs.lipschitz(), lfs.smallest()), (1.0, 0.5));
        let cell = Rect {
            min: DVec2::new(-3.0, -2.0),
            max: DVec2::new(0.0, 2.0),
        };
        // At (−1.5, 0) the corner is 1.5 away, the corner above it √3.25, the side opposite 2.5; half a diagonal is 2.5.
        assert_eq!(lfs.lower_bound(cell), 0.5);
        let cell = Rect {
            min: DVec2::new(-1.8, -0.4),
            max: DVec2::new(-1.2, 0.4),
        };
        assert!((lfs.lower_bound(cell) - (lfs.at(DVec2::new(-1.5, 0.0)) - 0.5)).abs() < 1e-15);
    }

    /// A fan: its segments stay on the lists of all cells around its vertex, which were cut to a thousandth of lfs.
    #[test]
    fn the_index_of_a_fan_is_small() {
        let tip = |k: usize| DVec2::from_angle((33.0 + k as f64).to_radians());
        let mut vertices = vec![DVec2::ZERO];
        vertices.extend((0..24).map(tip));
        let segments: Vec<[usize; 2]> = (1..=24).map(|k| [0, k]).collect();
        let (nodes, entries) = Lfs::new(&vertices, &segments).unwrap().lists.size();
        assert!(
            (100..40_000).contains(&nodes) && (100..1_000_000).contains(&entries),
            "{nodes} nodes, {entries} entries"
        );
        let points: Vec<DVec2> = pseudo_random_points(500).into_iter().map(|p| 1.2 * p).collect();
        assert_is_naive(&vertices, &segments, &points);
    }

    #[test]
    fn a_vertex_that_nearly_touches_a_side_is_told_with_the_place() {
        let (mut vertices, segments) = square();
        vertices.push(DVec2::new(0.4, 1e-15));
        let told = Lfs::new(&vertices, &segments).err();
        assert!(
            matches!(told, Some(SpacingError::Unresolved { x: 0.4, .. })),
            "{told:?}"
        );
        for size in [1.0, 1024.0] {
            let mut vertices: Vec<DVec2> = square().0.into_iter().map(|x| size * x).collect();
            let least = RESOLUTION * size;
            vertices.push(DVec2::new(0.5 * size, least));
            assert!(Lfs::new(&vertices, &segments).is_ok(), "{size}");
            vertices[4].y = least.next_down();
            assert!(Lfs::new(&vertices, &segments).is_err(), "{size}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        // Any planar set of features will do, whether or not they cross.
        #[test]
        fn lfs_is_the_oracle_on_anything(
            coordinates in prop::collection::vec((0.0f64..1.0, 0.0f64..1.0), 2..30),
            pairs in prop::collection::vec((0usize..30, 0usize..30), 0..40),
            scale in -3i32..4,
        ) {
            let size = 10f64.powi(scale);
            let vertices: Vec<DVec2> = coordinates.iter().map(|&(x, y)| size * DVec2::new(x, y)).collect();
            let count = vertices.len();
            let mut segments: Vec<[usize; 2]> = Vec::new();
            for (a, b) in pairs.into_iter().map(|(a, b)| (a % count, b % count)) {
                if a != b && !segments.contains(&[a, b]) && !segments.contains(&[b, a]) {
                    segments.push([a, b]);
                }
            }
            let lfs = Lfs::new(&vertices, &segments).unwrap();
            for p in pseudo_random_points(60) {
                let x = size * (1.4 * p - DVec2::splat(0.2));
                let expected = naive_lfs(&vertices, &segments, x);
                prop_assert!((lfs.at(x) - expected).abs() <= 1e-14 * size, "lfs({x}) = {}, naive {expected}", lfs.at(x));
            }
        }
    }
}
