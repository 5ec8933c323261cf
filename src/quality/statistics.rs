//! The numbers that make meshers comparable.

use super::subject::Subject;
use super::{Angles, Percentiles, Range, Seams, Statistics, gaps, parallel, shape};

/// Bins of the histogram, one per degree: a smallest angle is at most 60°.
const BINS: usize = 60;

/// All statistics of a mesh; angles of an empty mesh are 0.
pub fn measure(subject: &Subject) -> Statistics {
    let mesh = subject.mesh;
    let triangles = mesh.triangles.len();
    let shapes = parallel::map(triangles, |t| {
        let corners = mesh.corners(t);
        let [a, b, c] = shape::angles_deg(corners);
        [a.min(b).min(c), a.max(b).max(c), shape::radius_edge(corners)]
    });
    let mut smallest: Vec<f64> = shapes.iter().map(|[smallest, ..]| *smallest).collect();
    let mut min_angle_histogram = vec![0; BINS];
    for angle in &smallest {
        min_angle_histogram[(*angle as usize).min(BINS - 1)] += 1;
    }
    let free = (0..triangles).filter(|t| !subject.is_excused(*t)).map(|t| smallest[t]);
    let seams = seams(subject, &smallest);
    let largest = |k: usize| shapes.iter().map(|shape| shape[k]).fold(0.0, f64::max);
    Statistics {
        vertices: mesh.points.len(),
        triangles,
        min_angle_deg: smallest.iter().copied().reduce(f64::min).unwrap_or(0.0),
        min_angle_free_deg: free.reduce(f64::min),
        excused: subject.excused,
        max_angle_deg: largest(1),
        mean_min_angle_deg: parallel::sum(triangles, |t| smallest[t]) / triangles.max(1) as f64,
        min_angle_histogram,
        max_radius_edge: largest(2),
        p05_min_angle_deg: percentile(&mut smallest, 0.05).unwrap_or(0.0),
        edge_over_size: edge_over_size(subject),
        nn_over_f: nn_over_f(subject),
        beta: gaps::beta(subject),
        seams,
    }
}

/// Angles where fronts met and elsewhere, given the smallest angle of each triangle.
fn seams(subject: &Subject, smallest: &[f64]) -> Option<Seams> {
    let mut is_met = vec![false; smallest.len()];
    for &t in &subject.mesh.seams {
        is_met[t as usize] = true;
    }
    let of = |met: bool| {
        let wanted = (0..smallest.len()).filter(|t| is_met[*t] == met && !subject.is_excused(*t));
        angles(wanted.map(|t| smallest[t]).collect())
    };
    (!subject.mesh.seams.is_empty()).then(|| Seams {
        met: of(true),
        elsewhere: of(false),
    })
}

fn angles(mut smallest: Vec<f64>) -> Angles {
    let count = smallest.len().max(1) as f64;
    Angles {
        triangles: smallest.len(),
        min_deg: smallest.iter().copied().reduce(f64::min).unwrap_or(0.0),
        mean_deg: smallest.iter().sum::<f64>() / count,
        share_under_30: smallest.iter().filter(|angle| **angle < 30.0).count() as f64 / count,
        p05_deg: percentile(&mut smallest, 0.05).unwrap_or(0.0),
    }
}

fn edge_over_size(subject: &Subject) -> Option<Percentiles> {
    let sizes = subject.sizes.as_ref()?;
    let over = |(edge, f): (&crate::mesh::Edge, &f64)| {
        let [a, b] = edge.ends.map(|k| subject.mesh.points[k as usize]);
        a.distance(b) / (sizes.bounds.c_b * f)
    };
    let mut ratios: Vec<f64> = subject
        .adjacency
        .edges()
        .iter()
        .zip(&sizes.at_midpoint)
        .map(over)
        .collect();
    Some(Percentiles {
        p05: percentile(&mut ratios, 0.05)?,
        p50: percentile(&mut ratios, 0.50)?,
        p95: percentile(&mut ratios, 0.95)?,
    })
}

fn nn_over_f(subject: &Subject) -> Option<Range> {
    let sizes = subject.sizes.as_ref()?;
    let ratios = sizes.nn.iter().zip(&sizes.at_vertex).map(|(nn, f)| nn / f);
    ratios
        .map(|ratio| Range { min: ratio, max: ratio })
        .reduce(|all, one| Range {
            min: all.min.min(one.min),
            max: all.max.max(one.max),
        })
}

/// The value below which `share` of the values lie, linear between neighbours; reorders them.
fn percentile(values: &mut [f64], share: f64) -> Option<f64> {
    let place = share * values.len().checked_sub(1)? as f64;
    let (_, low, above) = values.select_nth_unstable_by(place as usize, f64::total_cmp);
    let low = *low;
    let high = above.iter().copied().reduce(f64::min).unwrap_or(low);
    Some(low + (high - low) * place.fract())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_linear_between_values() {
        let mut values = [4.0, 1.0, 3.0, 2.0, 0.0];
        assert_eq!(percentile(&mut values, 0.5), Some(2.0));
        assert_eq!(percentile(&mut values, 0.05), Some(0.2));
        assert_eq!(percentile(&mut values, 1.0), Some(4.0));
        assert_eq!(percentile(&mut [], 0.5), None);
    }
}
