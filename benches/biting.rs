//! The bite loop beside the triangulation that follows it, on the same points in the same run: read the ratio, not the
//! times.
//!
//! A million points on the unit square, f = s (1 + ½ sin 20x sin 20y). Before the timed runs, the bench prints the heap
//! growth of the bite loop in bytes per point.

mod waves;

use biting::domain::gallery;
use biting::meshers::biting::{Biting, Order};
use biting::meshers::{Budget, Mesher, Request, Trace};
use biting::suite::{fit_line, median};
use criterion::{Criterion, SamplingMode, criterion_group, criterion_main};
use peak_alloc::PeakAlloc;
use spade::{DelaunayTriangulation, Point2, Triangulation};
use std::time::{Duration, Instant};
use waves::Waves;

#[global_allocator]
static ALLOCATED: PeakAlloc = PeakAlloc;

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
    let fifo = Biting {
        order: Order::Fifo,
        ..Biting::default()
    };

    ALLOCATED.reset_peak_usage();
    let before = ALLOCATED.current_usage();
    let bitten = fifo
        .bite(&domain, &spacing, &request, &mut Trace::default())
        .expect("a bitten square");
    let grown = ALLOCATED.peak_usage() - before;
    let points = bitten.centres.len();
    println!(
        "{points} points, heap growth of the bite loop {:.0} bytes per point",
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
        let mesher = Biting {
            order,
            ..Biting::default()
        };
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

/// Slope of log seconds against log triangles, for the whole mesh and for spade's bulk load of the same points in the
/// same run: the time of a whole mesh must grow no faster than that of the triangulation in it.
fn growth(_: &mut Criterion) {
    let domain = gallery::domain("unit-square")
        .expect("a gallery name")
        .expect("a valid domain");
    let request = Request {
        c_b: 1.0,
        seed: 0,
        threads: 1,
        budget: Budget::default(),
    };
    let (mut whole, mut alone) = (Vec::new(), Vec::new());
    for triangles in [1e4, 3e4, 1e5, 3e5, 1e6, 4e6] {
        let spacing = Waves {
            scale: 0.004 * (162e3f64 / triangles).sqrt(),
        };
        let (mut meshing, mut loading, mut made) = (Vec::new(), Vec::new(), 0);
        for _ in 0..3 {
            let start = Instant::now();
            let mesh = Biting::default()
                .mesh(&domain, &spacing, &request, &mut Trace::default())
                .expect("a mesh");
            meshing.push(start.elapsed().as_secs_f64());
            let points: Vec<_> = mesh.points.iter().map(|p| Point2::new(p.x, p.y)).collect();
            let start = Instant::now();
            let loaded = DelaunayTriangulation::<Point2<f64>>::bulk_load(points).expect("points");
            loading.push(start.elapsed().as_secs_f64());
            made = mesh.triangles.len();
            assert_eq!(loaded.num_vertices(), mesh.points.len());
        }
        let (mesh, load) = (median(meshing).unwrap_or(0.0), median(loading).unwrap_or(0.0));
        println!(
            "{made} triangles: whole mesh {mesh:.4} s, spade's bulk load {load:.4} s, ratio {:.2}",
            mesh / load
        );
        whole.push(((made as f64).log10(), mesh.log10()));
        alone.push(((made as f64).log10(), load.log10()));
    }
    let slope = |points: &[(f64, f64)]| fit_line(points).map_or(f64::NAN, |line| line.slope);
    println!(
        "slope of the whole mesh {:.3}, of spade's bulk load {:.3}",
        slope(&whole),
        slope(&alone)
    );
}

criterion_group!(benches, growth, a_million_points);
criterion_main!(benches);
