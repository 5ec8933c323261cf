//! What the step `delaunay_triangulation` costs above spade's bulk load of the same points: constraints, flood, carving.
//!
//! 10⁵ points of the unit square, random and nearly hexagonal, with its boundary cut into pieces of the same length.

use biting::delaunay::triangulate;
use biting::domain::{Domain, gallery};
use biting::geometry::DVec2;
use biting::mesh::Piece;
use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use spade::{DelaunayTriangulation, Point2, Triangulation};

/// Points along a side of the square; there are about the square of this number inside.
const SIDE: usize = 316;

/// The square's vertices, its sides cut into [`SIDE`] pieces each, then `inside`.
fn boundary(domain: &Domain, inside: impl IntoIterator<Item = DVec2>) -> (Vec<DVec2>, Vec<Piece>) {
    let (mut points, mut pieces) = (domain.vertices().to_vec(), Vec::new());
    for (s, segment) in domain.segments().iter().enumerate() {
        let [a, b] = domain.ends(s);
        let mut last = segment.a as u32;
        for k in 1..SIDE {
            pieces.push(Piece {
                a: last,
                b: points.len() as u32,
                segment: s as u32,
            });
            last = points.len() as u32;
            points.push(a.lerp(b, k as f64 / SIDE as f64));
        }
        pieces.push(Piece {
            a: last,
            b: segment.b as u32,
            segment: s as u32,
        });
    }
    points.extend(inside);
    (points, pieces)
}

fn random() -> Vec<DVec2> {
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let mut coordinate = || random.random_range(0.0..1.0);
    (0..SIDE * SIDE)
        .map(|_| DVec2::new(coordinate(), coordinate()))
        .collect()
}

fn hexagonal() -> Vec<DVec2> {
    let step = 1.0 / SIDE as f64;
    let rows = (1.0 / (step * 0.75f64.sqrt())) as usize;
    let row = |j: usize| {
        (0..SIDE - 1).map(move |i| {
            let shift = if j.is_multiple_of(2) { 0.25 } else { 0.75 };
            DVec2::new((i as f64 + shift) * step, j as f64 * step * 0.75f64.sqrt())
        })
    };
    (1..rows).flat_map(row).collect()
}

fn a_hundred_thousand_points(criterion: &mut Criterion) {
    let domain = gallery::domain("unit-square")
        .expect("a gallery name")
        .expect("a valid domain");
    for (name, inside) in [("random", random()), ("hexagonal", hexagonal())] {
        let mut group = criterion.benchmark_group(format!("triangulation-{name}"));
        group.sample_size(20);
        let (points, pieces) = boundary(&domain, inside);
        group.bench_function("spade-bulk-load", |bencher| {
            let points: Vec<_> = points.iter().map(|p| Point2::new(p.x, p.y)).collect();
            let load = |points| {
                DelaunayTriangulation::<Point2<f64>>::bulk_load(points)
                    .expect("points")
                    .num_vertices()
            };
            bencher.iter_batched(|| points.clone(), load, BatchSize::LargeInput);
        });
        group.bench_function("triangulate", |bencher| {
            let run = |(points, pieces)| triangulate(&domain, points, pieces).expect("a mesh").triangles.len();
            bencher.iter_batched(|| (points.clone(), pieces.clone()), run, BatchSize::LargeInput);
        });
        group.finish();
    }
}

criterion_group!(benches, a_hundred_thousand_points);
criterion_main!(benches);
