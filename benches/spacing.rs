//! Cost of the control spacing: building and evaluating lfs, the limiter and an expression, and ∫ dA / f².
//!
//! The domain is a real outline of 10 223 segments; queries are at the centres of the triangles of a mesh by biting, in
//! the order of the mesh. The nearest-segment query of the domain is timed for comparison: lfs should cost at most
//! three times as much.

use biting::domain::{Domain, gallery};
use biting::geometry::{DVec2, Rect};
use biting::meshers::biting::Biting;
use biting::meshers::{Mesher, Request, Trace};
use biting::spacing::{
    Expression, Hessian, Lfs, Limited, Options, Spacing, Tolerance, Uniform, build, integrate, lfs_of, limit,
    of_samples,
};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::sync::Arc;

/// A real coast with islands.
fn outline() -> Domain {
    gallery::domain("norway")
        .expect("the gallery has it")
        .expect("the gallery is valid")
}

/// α = t / c_b of the default pair.
const ALPHA: f64 = 1.0 / 3.0;

/// The centres of the first 10⁵ triangles of a mesh by biting.
fn places(domain: &Domain) -> Vec<DVec2> {
    let spacing = build("lfs", domain, &Options::with_alpha(ALPHA)).expect("lfs is positive");
    let mesh = Biting::default()
        .mesh(domain, &*spacing.function, &Request::new(0.75), &mut Trace::default())
        .expect("it is meshed");
    let centre = |t: usize| mesh.corners(t).into_iter().sum::<DVec2>() / 3.0;
    (0..mesh.triangles.len().min(100_000)).map(centre).collect()
}

/// lfs at every tenth of the points, as sizes there.
fn sizes(points: &[DVec2], lfs: &Lfs) -> Limited {
    let points: Vec<DVec2> = points.iter().copied().step_by(10).collect();
    let values: Vec<f64> = points.iter().map(|&x| lfs.at(x)).collect();
    of_samples(ALPHA, &points, &values).expect("lfs is positive")
}

fn evaluate(points: &[DVec2], f: impl Fn(DVec2) -> f64) -> f64 {
    points.iter().map(|&x| f(x)).sum()
}

fn evaluations(criterion: &mut Criterion) {
    let domain = outline();
    let points = places(&domain);
    let lfs = Arc::new(lfs_of(&domain).expect("a polygon has features"));
    let unit = Rect {
        min: DVec2::ZERO,
        max: DVec2::ONE,
    };
    let waves = Expression::new("0.004*(1+0.5*sin(20*x)*sin(20*y))", unit).expect("the formula is one");
    let tolerance = Tolerance {
        eps: 0.02,
        min: None,
        max: Some(0.5),
    };
    let front = Hessian::new("tanh((x+y-1)/0.1)", &tolerance, unit).expect("the formula is one");
    let sizes = sizes(&points, lfs.as_ref());
    let mut group = criterion.benchmark_group("evaluate");
    group.throughput(Throughput::Elements(points.len() as u64));
    group.bench_function("nearest-segment", |b| {
        b.iter(|| evaluate(&points, |x| domain.nearest_segment(x).1));
    });
    group.bench_function("lfs", |b| b.iter(|| evaluate(&points, |x| lfs.at(x))));
    group.bench_function("expression", |b| b.iter(|| evaluate(&points, |x| waves.at(x))));
    group.bench_function("hessian", |b| b.iter(|| evaluate(&points, |x| front.at(x))));
    group.bench_function("points", |b| b.iter(|| evaluate(&points, |x| sizes.at(x))));
    for alpha in [0.1, ALPHA, 0.5] {
        let limited = limit(lfs.clone(), &domain, alpha, 0.9).expect("lfs is positive");
        group.bench_function(BenchmarkId::new("limited-lfs", alpha), |b| {
            b.iter(|| evaluate(&points, |x| limited.at(x)));
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
    let points = places(&domain);
    group.bench_function("points", |b| b.iter(|| black_box(sizes(&points, &lfs))));
    for alpha in [0.1, ALPHA, 0.5] {
        group.bench_function(BenchmarkId::new("limited-lfs", alpha), |b| {
            b.iter(|| limit(lfs.clone(), &domain, alpha, 0.9).map(|f| f.lipschitz()));
        });
    }
    group.finish();
}

fn integrals(criterion: &mut Criterion) {
    let domain = outline();
    let mut group = criterion.benchmark_group("integral");
    group.sample_size(10);
    group.bench_function("uniform", |b| b.iter(|| integrate(&Uniform(0.1), &domain, 1e-3)));
    for alpha in [ALPHA, 1.0] {
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
