use super::*;
use crate::domain::{Domain, Pslg, Region};
use crate::geometry::predicates::{in_circle, orient2d};
use crate::mesh::NONE;
use proptest::prelude::*;

fn p(x: f64, y: f64) -> DVec2 {
    DVec2::new(x, y)
}

fn square() -> Pslg {
    let mut pslg = Pslg::new("square");
    pslg.add_ring([p(0.0, 0.0), p(1.0, 0.0), p(1.0, 1.0), p(0.0, 1.0)], 4);
    pslg
}

/// The domain's vertices and every segment as one piece.
fn bare(domain: &Domain) -> (Vec<DVec2>, Vec<Piece>) {
    cut(domain, 1)
}

/// The domain's vertices and every segment cut into `parts` equal pieces, as exactly as rounding lets it.
fn cut(domain: &Domain, parts: usize) -> (Vec<DVec2>, Vec<Piece>) {
    let (mut points, mut pieces) = (domain.vertices().to_vec(), Vec::new());
    for (s, segment) in domain.segments().iter().enumerate() {
        let [a, b] = domain.ends(s);
        let mut last = segment.a;
        for k in 1..parts {
            pieces.push(Piece {
                a: last as u32,
                b: points.len() as u32,
                segment: s as u32,
            });
            last = points.len();
            points.push(a.lerp(b, k as f64 / parts as f64));
        }
        pieces.push(Piece {
            a: last as u32,
            b: segment.b as u32,
            segment: s as u32,
        });
    }
    (points, pieces)
}

fn area(mesh: &Mesh) -> f64 {
    (0..mesh.triangles.len())
        .map(|t| mesh.corners(t))
        .map(|[a, b, c]| 0.5 * (b - a).perp_dot(c - a))
        .sum()
}

/// Judges a mesh by definition: counter-clockwise, the domain's area, edges Delaunay unless they are pieces.
fn validate(domain: &Domain, mesh: &Mesh) {
    for t in 0..mesh.triangles.len() {
        let [a, b, c] = mesh.corners(t);
        assert!(orient2d(a, b, c) > 0.0, "triangle {t}: {a} {b} {c}");
    }
    let (found, expected) = (area(mesh), domain.area());
    assert!(
        (found - expected).abs() <= 1e-12 * expected,
        "area {found}, domain {expected}"
    );
    let adjacency = mesh.adjacency();
    let is_piece = |ends: [u32; 2]| {
        mesh.pieces
            .iter()
            .any(|piece| ends == [piece.a.min(piece.b), piece.a.max(piece.b)])
    };
    for edge in adjacency.edges() {
        assert!(edge.is_manifold());
        let piece = is_piece(edge.ends);
        assert!(piece || edge.uses == 2, "{edge:?} bounds the mesh but is no piece");
        if piece || edge.left == NONE {
            continue;
        }
        let [a, b, c] = mesh.corners(edge.left as usize);
        let far = mesh.triangles[edge.right as usize]
            .iter()
            .find(|k| !edge.ends.contains(k))
            .unwrap();
        assert!(
            in_circle(a, b, c, mesh.points[*far as usize]) <= 0.0,
            "{edge:?} is not Delaunay"
        );
    }
    for piece in &mesh.pieces {
        assert!(adjacency.find(piece.a, piece.b).is_some(), "{piece:?} is no edge");
    }
}

#[test]
fn a_square_is_two_triangles() {
    let domain = Domain::new(square()).unwrap();
    let (points, pieces) = bare(&domain);
    let mesh = triangulate(&domain, points, pieces).unwrap();
    validate(&domain, &mesh);
    assert_eq!((mesh.triangles.len(), mesh.pieces.len(), mesh.forced_pieces), (2, 4, 0));
    assert_eq!((mesh.input_vertices, mesh.piece_markers), (4, vec![4; 4]));
}

#[test]
fn holes_are_carved_and_regions_kept() {
    let mut pslg = square();
    pslg.add_ring([p(0.2, 0.2), p(0.4, 0.2), p(0.4, 0.4), p(0.2, 0.4)], 5);
    pslg.add_hole(p(0.3, 0.3));
    pslg.add_ring([p(0.6, 0.6), p(0.8, 0.6), p(0.8, 0.8), p(0.6, 0.8)], 6);
    pslg.regions = vec![
        Region {
            point: p(0.7, 0.7),
            attribute: 2.0,
            max_area: None,
        },
        Region {
            point: p(0.1, 0.1),
            attribute: 1.0,
            max_area: None,
        },
    ];
    pslg.add_chain([p(0.1, 0.9), p(0.3, 0.7)], 7);
    let free = pslg.add_vertex(p(0.9, 0.1));
    let domain = Domain::new(pslg).unwrap();
    let (points, pieces) = cut(&domain, 3);
    let mesh = triangulate(&domain, points, pieces).unwrap();
    validate(&domain, &mesh);
    for t in 0..mesh.triangles.len() {
        let centre = mesh.corners(t).iter().sum::<DVec2>() / 3.0;
        let inner = centre.cmpge(p(0.6, 0.6)).all() && centre.cmple(p(0.8, 0.8)).all();
        assert_eq!(mesh.regions[t], if inner { 2.0 } else { 1.0 }, "at {centre}");
    }
    assert!(mesh.triangles.as_flattened().contains(&(free as u32)));
    // Points on segments carry the segment's marker.
    let marker = |x: DVec2| mesh.point_markers[mesh.points.iter().position(|y| y.distance(x) < 1e-9).unwrap()];
    assert_eq!(marker(p(0.1 + 0.2 / 3.0, 0.9 - 0.2 / 3.0)), 7);
    assert_eq!(marker(p(0.9, 0.1)), 0);
}

#[test]
fn a_piece_through_a_point_is_cut_there() {
    let domain = Domain::new(square()).unwrap();
    let (mut points, pieces) = bare(&domain);
    points.push(p(0.5, 0.0));
    let mesh = triangulate(&domain, points, pieces).unwrap();
    validate(&domain, &mesh);
    assert_eq!(
        mesh.pieces[..2],
        [Piece { a: 0, b: 4, segment: 0 }, Piece { a: 4, b: 1, segment: 0 }]
    );
    assert_eq!(mesh.point_markers[4], 4);
}

#[test]
fn pieces_that_are_no_delaunay_edges_are_counted() {
    let mut pslg = square();
    pslg.add_chain([p(0.2, 0.5), p(0.8, 0.5)], 0);
    pslg.add_vertex(p(0.5, 0.52));
    pslg.add_vertex(p(0.5, 0.48));
    let domain = Domain::new(pslg).unwrap();
    let (points, pieces) = bare(&domain);
    let mesh = triangulate(&domain, points.clone(), pieces).unwrap();
    validate(&domain, &mesh);
    assert_eq!(mesh.forced_pieces, 1);
    let (points, pieces) = cut(&domain, 16);
    assert_eq!(triangulate(&domain, points, pieces).unwrap().forced_pieces, 0);
}

#[test]
fn every_kind_of_bad_input_is_named() {
    let domain = Domain::new(square()).unwrap();
    let (points, pieces) = bare(&domain);
    let with = |extra: &[DVec2]| [points.as_slice(), extra].concat();
    let and = |extra: &[[u32; 3]]| {
        let extra = extra.iter().map(|&[a, b, segment]| Piece { a, b, segment });
        pieces.iter().copied().chain(extra).collect::<Vec<_>>()
    };
    let run = |points: Vec<DVec2>, pieces: Vec<Piece>| triangulate(&domain, points, pieces).unwrap_err();
    use TriangulationError as E;
    assert_eq!(
        run(with(&[p(0.5, 0.5), p(0.25, 0.5), p(0.5, 0.5)]), pieces.clone()),
        E::Coincident {
            first: 4,
            second: 6,
            x: 0.5,
            y: 0.5
        }
    );
    assert_eq!(
        run(points.clone(), and(&[[0, 2, 0], [1, 3, 0]])),
        E::Crossing { x: 0.5, y: 0.5 }
    );
    assert_eq!(
        run(points.clone(), and(&[[1, 2, 3]])),
        E::Overlap {
            first: 1,
            second: 3,
            x: 1.0,
            y: 0.5
        }
    );
    assert_eq!(run(points.clone(), and(&[[0, 9, 0]])), E::Index { piece: 4 });
    assert_eq!(run(points.clone(), and(&[[0, 1, 9]])), E::Index { piece: 4 });
    assert_eq!(
        run(with(&[p(2.0, 2.0)]), pieces.clone()),
        E::Outside {
            point: 4,
            x: 2.0,
            y: 2.0
        }
    );
    assert!(matches!(run(points.clone(), pieces[..3].to_vec()), E::Leak { .. }));
    assert!(matches!(run(with(&[p(f64::NAN, 0.0)]), pieces.clone()), E::Refused(_)));
    let no_triangle = run(vec![p(0.0, 0.0), p(1.0, 0.0)], vec![]);
    assert_eq!(
        no_triangle,
        E::Outside {
            point: 0,
            x: 0.0,
            y: 0.0
        }
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    /// A star-shaped polygon, turned and scaled so that no point on a segment is exactly on it, with points inside.
    #[test]
    fn random_polygons_with_random_points(
        radii in prop::collection::vec(0.5f64..1.0, 5..12),
        turn in 0.0f64..6.3,
        exponent in -6i32..7,
        parts in 1usize..9,
        inside in prop::collection::vec((0.0f64..1.0, 0.0f64..1.0), 0..60),
    ) {
        let scale = 10f64.powi(exponent);
        let at = |k: f64, r: f64| {
            scale * (p(3.0, 5.0) + r * DVec2::from_angle(turn + std::f64::consts::TAU * k / radii.len() as f64))
        };
        let mut pslg = Pslg::new("star");
        pslg.add_ring(radii.iter().enumerate().map(|(k, r)| at(k as f64, *r)), 1);
        let domain = Domain::new(pslg).unwrap();
        let (mut points, pieces) = cut(&domain, parts);
        let mut inside: Vec<_> = inside.iter().map(|(k, r)| at(k * radii.len() as f64, 0.39 * r.sqrt())).collect();
        inside.sort_by(|u, v| u.x.total_cmp(&v.x));
        inside.dedup();
        points.extend(inside);
        let mesh = triangulate(&domain, points.clone(), pieces.clone()).unwrap();
        validate(&domain, &mesh);
        prop_assert_eq!(mesh.pieces.len(), pieces.len());
        prop_assert_eq!(&triangulate(&domain, points, pieces).unwrap(), &mesh);
    }
}
