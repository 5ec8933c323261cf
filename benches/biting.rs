//! The bite loop beside the triangulation it feeds, on the same points in the same run: read the ratio, not the times.
//!
//! A million points on the unit square, f = s (1 + ½ sin 20x sin 20y). Before the timed runs the heap growth of the bite
//! loop is printed in bytes a point.

use biting::domain::gallery;
use biting::geometry::DVec2;
use biting::meshers::biting::{Biting, Order};
use biting::meshers::{Budget, Mesher, Request, Trace};
use biting::spacing::Spacing;
use criterion::{Criterion, SamplingMode, criterion_group, criterion_main};
use peak_alloc::PeakAlloc;
use spade::{DelaunayTriangulation, Point2, Triangulation};
use std::time::Duration;

#[global_allocator]
static ALLOCATED: PeakAlloc = PeakAlloc;

/// f = scale (1 + ½ sin 20x sin 20y); |∇f| ≤ 10 scale.
struct Waves {
    scale: f64,
}

impl Spacing for Waves {
    fn at(&self, x: DVec2) -> f64 {
        self.scale * (1.0 + 0.5 * (20.0 * x.x).sin() * (20.0 * x.y).sin())
    }

    fn lipschitz(&self) -> f64 {
        10.0 * self.scale
    }
}

fn a_million_points(criterion: &mut Criterion) {
    let domain = gallery::domain("unit-square")
        .expect("a gallery name")
        .expect("a valid domain");
    let spacing = Waves { scale: 0.004 * 0.283 };
    let request = Request {
        c_b: 1.0,
        seed: 0,
        threads: 1,
        budget: Budget::default(),
    };
    let fifo = Biting { order: Order::Fifo };

    ALLOCATED.reset_peak_usage();
    let before = ALLOCATED.current_usage();
    let bitten = fifo
        .bite(&domain, &spacing, &request, &mut Trace::default())
        .expect("a bitten square");
    let grown = ALLOCATED.peak_usage() - before;
    let points = bitten.centres.len();
    println!(
        "{points} points, heap growth of the bite loop {:.0} bytes a point",
        grown as f64 / points as f64
    );

    let mut group = criterion.benchmark_group("million-points");
    group
        .sample_size(10)
        .sampling_mode(SamplingMode::Flat)
        .warm_up_time(Duration::from_millis(500));
    group.bench_function("spade-bulk-load", |bencher| {
        let points: Vec<_> = bitten.centres.iter().map(|p| Point2::new(p.x, p.y)).collect();
        bencher.iter(|| {
            DelaunayTriangulation::<Point2<f64>>::bulk_load(points.clone())
                .expect("points")
                .num_vertices()
        });
    });
    for order in Order::ALL {
        let mesher = Biting { order };
        group.bench_function(format!("bite-{order:?}").to_lowercase(), |bencher| {
            bencher.iter(|| {
                mesher
                    .bite(&domain, &spacing, &request, &mut Trace::default())
                    .map(|b| b.centres.len())
            });
        });
    }
    group.bench_function("whole-mesh-fifo", |bencher| {
        bencher.iter(|| {
            fifo.mesh(&domain, &spacing, &request, &mut Trace::default())
                .map(|mesh| mesh.triangles.len())
        });
    });
    group.finish();
}

criterion_group!(benches, a_million_points);
criterion_main!(benches);
