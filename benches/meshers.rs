//! Every mesher of the list on the same tasks in one run: read the ratios, not the times.
//!
//! There are two tasks on the unit square, a uniform spacing and f = s (1 + ½ sin 20x sin 20y), each with an s for
//! which biting makes about 10⁵ triangles. Throughput is in triangles of the mesher that runs. Before the timed runs,
//! the bench prints the ratios to the first mesher of the list, per mesh and per triangle, as medians of interleaved
//! runs.

mod waves;

use biting::domain::{Domain, gallery};
use biting::meshers::{Budget, Entry, MESHERS, Mesher, Parameters, Request, Trace};
use biting::spacing::{Spacing, Uniform};
use biting::suite::median;
use criterion::{Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use std::time::{Duration, Instant};
use waves::Waves;

/// The number of interleaved runs; the printed ratios are their medians.
const RUNS: usize = 5;

const REQUEST: Request = Request {
    c_b: 1.0,
    seed: 0,
    threads: 1,
    budget: Budget {
        max_vertices: None,
        max_seconds: None,
        max_memory: None,
    },
};

fn meshers() -> Vec<(&'static Entry, Box<dyn Mesher>)> {
    let made = |entry: &'static Entry| (entry, (entry.make)(&Parameters::new()).expect("defaults are valid"));
    MESHERS.iter().map(made).collect()
}

fn triangles(mesher: &dyn Mesher, domain: &Domain, spacing: &dyn Spacing) -> usize {
    let mesh = mesher.mesh(domain, spacing, &REQUEST, &mut Trace::default());
    mesh.expect("a mesh").triangles.len()
}

fn ratios(name: &str, domain: &Domain, spacing: &dyn Spacing) {
    let all = meshers();
    let mut samples = vec![Vec::new(); all.len()];
    let mut made = vec![0; all.len()];
    for _ in 0..RUNS {
        for (k, (_, mesher)) in all.iter().enumerate() {
            let start = Instant::now();
            made[k] = triangles(&**mesher, domain, spacing);
            samples[k].push(start.elapsed().as_secs_f64());
        }
    }
    let seconds: Vec<f64> = samples.into_iter().map(|own| median(own).unwrap_or(f64::NAN)).collect();
    for (k, (entry, _)) in all.iter().enumerate() {
        let each = |k: usize| seconds[k] / made[k] as f64;
        println!(
            "{name} {}: {} triangles, {:.4} s, {:.2} times the first's seconds, {:.2} a triangle",
            entry.name,
            made[k],
            seconds[k],
            seconds[k] / seconds[0],
            each(k) / each(0)
        );
    }
}

fn all_meshers(criterion: &mut Criterion) {
    let domain = gallery::domain("unit-square")
        .expect("a gallery name")
        .expect("a valid domain");
    let tasks: [(&str, Box<dyn Spacing>); 2] = [
        ("uniform", Box::new(Uniform(0.0048))),
        ("graded", Box::new(Waves { scale: 0.0051 })),
    ];
    for (name, spacing) in tasks {
        ratios(name, &domain, &*spacing);
        let mut group = criterion.benchmark_group(name);
        group
            .sample_size(10)
            .sampling_mode(SamplingMode::Flat)
            .warm_up_time(Duration::from_millis(500));
        for (entry, mesher) in meshers() {
            let made = triangles(&*mesher, &domain, &*spacing);
            group.throughput(Throughput::Elements(made as u64));
            group.bench_function(entry.name, |bencher| {
                bencher.iter(|| triangles(&*mesher, &domain, &*spacing));
            });
        }
        group.finish();
    }
}

criterion_group!(benches, all_meshers);
criterion_main!(benches);
