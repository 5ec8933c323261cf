//! The triangulation that takes points one at a time, against the one of all points at once.

use super::*;
use crate::delaunay::triangulate;
use crate::domain::{Domain, Pslg, gallery};
use crate::mesh::Mesh;
use proptest::prelude::*;

fn p(x: f64, y: f64) -> DVec2 {
    DVec2::new(x, y)
}

/// Triangles as a set: each begins with its smallest corner, with its region.
fn as_set(mesh: &Mesh) -> Vec<([u32; 3], u64)> {
    let turned = |&[a, b, c]: &[u32; 3]| match a.min(b).min(c) {
        least if least == a => [a, b, c],
        least if least == b => [b, c, a],
        _ => [c, a, b],
    };
    let regions = mesh.regions.iter().map(|region| region.to_bits());
    let mut set: Vec<_> = mesh.triangles.iter().map(turned).zip(regions).collect();
    set.sort_unstable();
    set
}

/// Twins point at each other, share ends and piece; every vertex that is there has a way out; pieces know their edges.
fn check_links(triangulation: &Refinable) {
    for edge in 0..triangulation.origin.len() {
        let twin = triangulation.twin[edge];
        if triangulation.origin[edge] == NONE || twin == NONE {
            continue;
        }
        assert_eq!(triangulation.twin[twin as usize], edge as u32);
        assert_eq!(triangulation.piece_of[twin as usize], triangulation.piece_of[edge]);
        let [a, b] = triangulation.ends(edge as u32);
        assert_eq!(triangulation.ends(twin), [b, a]);
    }
    let mut degrees = vec![0; triangulation.out.len()];
    let origins = triangulation.origin.iter().filter(|&&vertex| vertex != NONE);
    origins.for_each(|&vertex| degrees[vertex as usize] += 1);
    for (vertex, &out) in triangulation.out.iter().enumerate() {
        assert!(out == NONE || triangulation.origin[out as usize] == vertex as u32);
        // The triangles around a vertex are connected.
        let around = if out == NONE {
            0
        } else {
            triangulation.around(vertex as u32).count()
        };
        assert_eq!(around, degrees[vertex]);
    }
    for (number, span) in triangulation.pieces.iter().enumerate() {
        let [a, b] = triangulation.ends(span.edge);
        assert_eq!(triangulation.piece_of[span.edge as usize], number as u32);
        assert!([[span.piece.a, span.piece.b], [span.piece.b, span.piece.a]].contains(&[a, b]));
    }
}

/// Holds every edge of the domain that is no piece to be Delaunay; whether there is but one such triangulation.
fn check_circles(triangulation: &Refinable) -> bool {
    let mut is_unique = true;
    for edge in 0..triangulation.origin.len() as u32 {
        if triangulation.is_inside(edge / 3) && triangulation.piece_on(edge).is_none() {
            let [a, b, c] = triangulation
                .triangle(edge / 3)
                .map(|vertex| triangulation.point(vertex));
            let beyond = triangulation.point(triangulation.apex(triangulation.twin[edge as usize]));
            let side = predicates::in_circle(a, b, c, beyond);
            assert!(side <= 0.0);
            is_unique &= side < 0.0;
        }
    }
    is_unique
}

/// Holds the triangulation against the bulk one of the same points and pieces.
fn check(triangulation: Refinable, domain: &Domain) -> Mesh {
    check_links(&triangulation);
    let is_unique = check_circles(&triangulation);
    let is_whole = !triangulation.has_overturned;
    let mesh = triangulation.into_mesh(domain);
    let bulk = triangulate(domain, mesh.points.clone(), mesh.pieces.clone()).unwrap();
    assert_eq!(mesh.triangles.len(), bulk.triangles.len());
    if is_unique {
        assert_eq!(as_set(&mesh), as_set(&bulk));
    }
    assert_eq!(mesh.pieces, bulk.pieces);
    assert_eq!(mesh.piece_markers, bulk.piece_markers);
    assert_eq!(mesh.point_markers, bulk.point_markers);
    if is_whole {
        assert_eq!(mesh.forced_pieces, bulk.forced_pieces);
    }
    mesh
}

fn first_inside(triangulation: &Refinable) -> u32 {
    let mut triangles = 0..triangulation.triangle_count() as u32;
    triangles.find(|&t| triangulation.is_inside(t)).unwrap()
}

/// Inserts `x` where it can be seen from the first triangle; the new vertex.
fn insert(triangulation: &mut Refinable, x: DVec2) -> Option<u32> {
    match triangulation.locate(first_inside(triangulation), x) {
        Location::Triangle(triangle) => {
            let mut cavity = Cavity::default();
            triangulation.dig(triangle, x, &mut cavity);
            Some(triangulation.insert(&cavity))
        }
        _ => None,
    }
}

#[test]
fn every_gallery_domain_starts_as_the_bulk_triangulation() {
    for entry in gallery::ENTRIES {
        let domain = gallery::domain(entry.name).unwrap().unwrap();
        let triangulation = Refinable::new(&domain).unwrap();
        check_links(&triangulation);
        let mesh = triangulation.into_mesh(&domain);
        let bulk = triangulate(&domain, mesh.points.clone(), mesh.pieces.clone()).unwrap();
        assert_eq!(mesh, bulk, "{}", entry.name);
    }
}

#[test]
fn a_point_is_found_where_it_lies() {
    let domain = gallery::domain("unit-square").unwrap().unwrap();
    let mut triangulation = Refinable::new(&domain).unwrap();
    let centre = insert(&mut triangulation, p(0.5, 0.5)).unwrap();
    assert_eq!(triangulation.changed().len(), 4);
    let from = first_inside(&triangulation);
    assert_eq!(triangulation.locate(from, p(0.5, 0.5)), Location::Vertex(centre));
    let piece_at = |place| match triangulation.locate(from, place) {
        Location::Piece(piece) => piece,
        other => panic!("{other:?}"),
    };
    assert_eq!(piece_at(p(0.25, 0.0)), piece_at(p(0.25, -0.1)));
    assert!(matches!(triangulation.locate(from, p(0.6, 0.5)), Location::Triangle(_)));
    assert_eq!(triangulation.around(centre).count(), 4);
    assert!(triangulation.is_free(centre));
    assert!(!triangulation.is_free(0));
}

#[test]
fn a_split_that_would_turn_a_triangle_over_is_refused() {
    // The apex is nearer to the segment than rounding puts the new point.
    let mut pslg = Pslg::new("sliver");
    let (a, b) = (p(0.1, 0.1), p(1.3, 0.7));
    let apex = a.lerp(b, 0.6) + p(-1e-16, 1e-16);
    pslg.add_ring([a, b, p(0.5, 3.0)], 1);
    pslg.add_vertex(apex);
    let Ok(domain) = Domain::new(pslg) else {
        panic!("the apex is off the segment");
    };
    let mut triangulation = Refinable::new(&domain).unwrap();
    let refused = (0..domain.segments().len() as u32)
        .flat_map(|piece| (1..100).map(move |k| (piece, f64::from(k) / 100.0)))
        .filter(|&(piece, share)| triangulation.clone().split(piece, share).is_none())
        .count();
    let before = triangulation.clone();
    for piece in 0..3 {
        if triangulation.split(piece, 0.6).is_none() {
            assert_eq!(
                format!("{before:?}"),
                format!("{triangulation:?}"),
                "nothing is changed"
            );
        }
    }
    assert!(refused > 0);
    check_links(&triangulation);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// Points inside, splits and removals in any order, on domains with holes, inner segments, cracks and free vertices,
    /// turned so that no point on a segment is exactly on it.
    #[test]
    fn any_changes_give_the_bulk_triangulation(
        name in prop::sample::select(vec!["unit-square", "plate-hole", "star", "interface", "comb", "two-arms"]),
        turn in 0.0f64..6.3,
        exponent in -6i32..7,
        changes in prop::collection::vec((0u8..8, 0.0f64..1.0, 0.0f64..1.0), 1..120),
    ) {
        let mut pslg = gallery::pslg(name).unwrap().unwrap();
        let rotation = 10f64.powi(exponent) * DVec2::from_angle(turn);
        let map = |x: DVec2| rotation.rotate(x);
        pslg.vertices.iter_mut().for_each(|x| *x = map(*x));
        pslg.regions.iter_mut().for_each(|region| region.point = map(region.point));
        if let crate::domain::Fill::HolePoints(points) = &mut pslg.fill {
            points.iter_mut().for_each(|x| *x = map(*x));
        }
        let domain = Domain::new(pslg).unwrap();
        let mut triangulation = Refinable::new(&domain).unwrap();
        let bounds = domain.bounds();
        let mut made = Vec::new();
        for (kind, u, v) in changes {
            match kind {
                0..4 => made.extend(insert(&mut triangulation, bounds.min + p(u, v) * bounds.size())),
                4..6 => {
                    let piece = (u * triangulation.piece_count() as f64) as u32;
                    let [from, to] = triangulation.shares(piece);
                    let split = triangulation.split(piece, from + (0.1 + 0.8 * v) * (to - from));
                    prop_assert!(split.is_some());
                }
                _ if !made.is_empty() => {
                    let vertex: u32 = made.swap_remove((u * made.len() as f64) as usize);
                    if triangulation.is_free(vertex) {
                        triangulation.remove(vertex);
                    }
                }
                _ => {}
            }
            for &triangle in triangulation.changed() {
                let [a, b, c] = triangulation.triangle(triangle).map(|vertex| triangulation.point(vertex));
                let may_be_turned = triangulation.has_overturned && !triangulation.is_inside(triangle);
                prop_assert!(may_be_turned || predicates::orient2d(a, b, c) > 0.0);
            }
        }
        check(triangulation, &domain);
    }
}
