//! Domains by seed, from a generator whose stream does not change between versions.

use crate::domain::{Domain, Pslg};
use crate::geometry::DVec2;
use crate::geometry::predicates::{Meeting, segments_meet};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// A random convex polygon of `count` vertices in the unit square.
///
/// Valtr's algorithm: random x and y steps that sum to zero, paired at random, laid end to end by angle.
/// Reference: P. Valtr, "Probability that n Random Points Are in Convex Position", 1995.
pub(super) fn convex(count: usize, seed: u64) -> Pslg {
    let mut random = Pcg64::seed_from_u64(seed);
    let along_x = closed_steps(count, &mut random);
    let mut along_y = closed_steps(count, &mut random);
    shuffle(&mut along_y, &mut random);
    let mut steps: Vec<DVec2> = along_x
        .into_iter()
        .zip(along_y)
        .map(|(x, y)| DVec2::new(x, y))
        .collect();
    steps.sort_by(|u, v| u.y.atan2(u.x).total_cmp(&v.y.atan2(v.x)));
    let mut at = DVec2::ZERO;
    let mut points = Vec::with_capacity(count);
    for step in steps {
        points.push(at);
        at += step;
    }
    let low = points.iter().copied().fold(DVec2::INFINITY, DVec2::min);
    let mut pslg = Pslg::new("random-convex");
    pslg.add_ring(points.into_iter().map(|p| p - low), 1);
    pslg
}

/// The steps of two monotone chains between the extremes of `count` random numbers: they sum to zero.
fn closed_steps(count: usize, random: &mut Pcg64) -> Vec<f64> {
    let mut values: Vec<f64> = (0..count).map(|_| random.random_range(0.0..1.0)).collect();
    values.sort_by(f64::total_cmp);
    let (low, high) = (values[0], values[count - 1]);
    let (mut up, mut down) = (low, low);
    let mut steps = Vec::with_capacity(count);
    for &value in &values[1..count - 1] {
        if random.random_range(0..2) == 0 {
            steps.push(value - up);
            up = value;
        } else {
            steps.push(down - value);
            down = value;
        }
    }
    steps.extend([high - up, down - high]);
    steps
}

fn shuffle<T>(values: &mut [T], random: &mut Pcg64) {
    for last in (1..values.len()).rev() {
        values.swap(last, random.random_range(0..last + 1));
    }
}

/// A random simple polygon of `count` vertices in the unit square: points no closer than half the spacing of a square grid
/// of as many points, joined in random order, uncrossed by 2-opt moves. Every move shortens the tour, so the moves end.
pub(super) fn simple(count: usize, seed: u64) -> Pslg {
    let mut random = Pcg64::seed_from_u64(seed);
    loop {
        let mut tour = separate_points(count, &mut random);
        uncross(&mut tour);
        let mut pslg = Pslg::new("random-simple");
        pslg.add_ring(tour, 1);
        // Three points on a line turn up once in some 10^10 draws; the next draw is as good.
        if Domain::new(pslg.clone()).is_ok() {
            return pslg;
        }
    }
}

fn separate_points(count: usize, random: &mut Pcg64) -> Vec<DVec2> {
    let apart = 0.5 / (count as f64).sqrt();
    let mut points: Vec<DVec2> = Vec::with_capacity(count);
    while points.len() < count {
        let x = DVec2::new(random.random_range(0.0..1.0), random.random_range(0.0..1.0));
        if points.iter().all(|p| p.distance(x) >= apart) {
            points.push(x);
        }
    }
    points
}

/// Reverses the part of the tour between two crossing edges until none cross. Quadratic a pass: for up to a thousand.
fn uncross(tour: &mut [DVec2]) {
    let count = tour.len();
    let mut crossed = true;
    while crossed {
        crossed = false;
        for i in 0..count {
            for j in i + 2..count {
                let meeting = segments_meet(tour[i], tour[i + 1], tour[j], tour[(j + 1) % count]);
                if meeting == Meeting::Cross {
                    tour[i + 1..=j].reverse();
                    crossed = true;
                }
            }
        }
    }
}
