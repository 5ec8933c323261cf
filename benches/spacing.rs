//! Cost of the control spacing: building and evaluating lfs, the limiter and an expression, and ∫ dA / f².
//!
//! The domain is a real outline of 3601 segments; queries come in the order of a mesh, neighbours after one another. The
//! nearest-segment query of the domain stands beside lfs: lfs should cost at most three times as much.

use biting::domain::{Domain, gallery};
use biting::geometry::{DVec2, Rect};
use biting::spacing::{Expression, Options, Spacing, Uniform, background, build, integrate, lfs_of, limit};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::sync::Arc;

/// A real coast with islands.
fn outline() -> Domain {
    gallery::domain("aegean")
        .expect("the gallery has it")
        .expect("the gallery is valid")
}

/// Points of the domain row by row, every other row backwards.
fn walk(domain: &Domain, side: usize) -> Vec<DVec2> {
    let bounds = domain.bounds();
    let place =
        |i: usize, j: usize| bounds.min + bounds.size() * DVec2::new(i as f64 + 0.5, j as f64 + 0.5) / side as f64;
    let row = |j: usize| (0..side).map(move |i| if j.is_multiple_of(2) { i } else { side - 1 - i });
    let all = (0..side).flat_map(|j| row(j).map(move |i| place(i, j)));
    all.filter(|&x| domain.contains(x)).collect()
}

fn evaluate(points: &[DVec2], f: impl Fn(DVec2) -> f64) -> f64 {
    points.iter().map(|&x| f(x)).sum()
}

fn evaluations(criterion: &mut Criterion) {
    let domain = outline();
    let points = walk(&domain, 300);
    let lfs = Arc::new(lfs_of(&domain).expect("a polygon has features"));
    let unit = Rect {
        min: DVec2::ZERO,
        max: DVec2::ONE,
    };
    let waves = Expression::new("0.004*(1+0.5*sin(20*x)*sin(20*y))", unit).expect("the formula is one");
    let mut group = criterion.benchmark_group("evaluate");
    group.throughput(Throughput::Elements(points.len() as u64));
    group.bench_function("nearest-segment", |b| {
        b.iter(|| {
            evaluate(&points, |x| {
                domain.index().nearest(x).map_or(0.0, |(_, distance)| distance)
            })
        });
    });
    group.bench_function("lfs", |b| b.iter(|| evaluate(&points, |x| lfs.at(x))));
    group.bench_function("expression", |b| b.iter(|| evaluate(&points, |x| waves.at(x))));
    for alpha in [0.1, 0.25, 0.5, 0.8] {
        let limited = limit(lfs.clone(), &domain, alpha, 0.9).expect("lfs is positive");
        group.bench_function(BenchmarkId::new("limited-lfs", alpha), |b| {
            b.iter(|| evaluate(&points, |x| limited.at(x)));
        });
        let background = background(lfs.clone(), &domain, alpha, 0.1).expect("lfs is positive");
        group.bench_function(BenchmarkId::new("background", alpha), |b| {
            b.iter(|| evaluate(&points, |x| background.at(x)));
        });
    }
    group.finish();
}

fn builds(criterion: &mut Criterion) {
    let domain = outline();
    let lfs = Arc::new(lfs_of(&domain).expect("a polygon has features"));
    let mut group = criterion.benchmark_group("build");
    group.sample_size(10);
    group.bench_function("lfs", |b| b.iter(|| black_box(lfs_of(&domain))));
    for alpha in [0.1, 0.25, 0.5, 0.8] {
        group.bench_function(BenchmarkId::new("limited-lfs", alpha), |b| {
            b.iter(|| limit(lfs.clone(), &domain, alpha, 0.9).map(|f| f.lipschitz()));
        });
        group.bench_function(BenchmarkId::new("background", alpha), |b| {
            b.iter(|| background(lfs.clone(), &domain, alpha, 0.1).map(|f| f.lipschitz()));
        });
    }
    group.finish();
}

fn integrals(criterion: &mut Criterion) {
    let domain = outline();
    let mut group = criterion.benchmark_group("integral");
    group.sample_size(10);
    group.bench_function("uniform", |b| b.iter(|| integrate(&Uniform(0.1), &domain, 1e-3)));
    for alpha in [0.25, 1.0] {
        let f = build("lfs", &domain, &Options::with_alpha(alpha))
            .expect("lfs is positive")
            .function;
        group.bench_function(BenchmarkId::new("lfs", alpha), |b| {
            b.iter(|| integrate(f.as_ref(), &domain, 1e-3))
        });
    }
    group.finish();
}

criterion_group!(spacing, evaluations, builds, integrals);
criterion_main!(spacing);
