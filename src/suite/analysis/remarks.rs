//! What the rows say of the paper's two remarks on other methods (§7): that an advancing front loses quality where fronts
//! meet, and that maximal independent sets of oversampled points cost more than biting.

use crate::quality::Angles;
use crate::suite::analysis::contest::{Contest, Method, seconds_per_triangle};
use crate::suite::analysis::summary::measured;
use crate::suite::rows::numbers::median;
use crate::suite::rows::record::{Report, Row};
use crate::theory::Claim;
use serde_json::Value;

/// The parameter by which a method says how many points it samples along a side of a leaf.
const OVERSAMPLE: &str = "oversample";
/// The parameter by which it says whether it goes on until there is no gap.
const COMPLETE: &str = "complete";

/// What one density of samples gave: medians over the tasks that ours and all densities measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampling {
    /// The method.
    pub method: Method,
    /// Points a side of a leaf.
    pub points: f64,
    /// Whether sampling went on where gaps remained.
    pub is_complete: bool,
    /// Common tasks, and all it was asked for.
    pub tasks: [usize; 2],
    /// β of Definition 4.1.
    pub beta: Option<f64>,
    /// Share of the circles that border a place that no circle covers.
    pub gap_share: Option<f64>,
    /// Triangles over those of ours.
    pub triangles: Option<f64>,
    /// Seconds over those of ours, for the whole mesh.
    pub seconds: Option<f64>,
    /// Seconds a triangle over those of ours.
    pub seconds_per_triangle: Option<f64>,
}

/// How many circles border a gap, over how many there are.
pub fn gap_share(report: &Report) -> Option<f64> {
    let check = report.certificate.check(Claim::Coverage)?;
    Some(check.broken as f64 / report.statistics.vertices.max(1) as f64)
}

/// One [`Sampling`] for each density, those that end with gaps first; ours is the method of the mesher `about`.
pub fn samplings(contest: &Contest, about: &str) -> Vec<Sampling> {
    let Some(ours) = contest.lead_of(about) else {
        return Vec::new();
    };
    let density = |k: usize| {
        let report = contest.rows(k).find_map(measured)?;
        let points = report.params.get(OVERSAMPLE)?.as_f64()?;
        let is_complete = report.params.get(COMPLETE).and_then(Value::as_bool).unwrap_or(false);
        Some((k, points, is_complete))
    };
    let mut densities: Vec<_> = contest.all().into_iter().filter_map(density).collect();
    densities.sort_by(|a, b| a.2.cmp(&b.2).then(a.1.total_cmp(&b.1)));
    let methods: Vec<usize> = densities.iter().map(|(k, ..)| *k).chain([ours]).collect();
    let common = contest.common(&methods);
    let one = |(k, points, is_complete): (usize, f64, bool)| {
        let over = |value: fn(&Report) -> Option<f64>| {
            let ratio = |task: &usize| {
                let [own, other] = [ours, k].map(|k| contest.report(k, *task).and_then(value));
                Some(other? / own?).filter(|ratio| ratio.is_finite())
            };
            median(common.iter().filter_map(ratio).collect())
        };
        Sampling {
            method: contest.methods[k].clone(),
            points,
            is_complete,
            tasks: [common.len(), contest.rows(k).count()],
            beta: contest.median(k, &common, |report| report.statistics.beta),
            gap_share: contest.median(k, &common, gap_share),
            triangles: over(|report| Some(report.statistics.triangles as f64)),
            seconds: over(Report::believable_seconds),
            seconds_per_triangle: over(seconds_per_triangle),
        }
    };
    densities.into_iter().map(one).collect()
}

/// What the meshes of one method say of the places where fronts met.
#[derive(Clone, Debug, PartialEq)]
pub struct Met {
    /// The method.
    pub method: Method,
    /// Meshes in which fronts met, and all that were measured.
    pub meshes: [usize; 2],
    /// In how many of them the mean smallest angle is smaller there than elsewhere.
    pub worse: usize,
    /// Medians over those meshes of the numbers where fronts met, and elsewhere.
    pub met: Angles,
    /// See `met`.
    pub elsewhere: Angles,
    /// Median share of triangles where fronts met.
    pub share: f64,
}

/// One [`Met`] for each method that marks such places.
pub fn meetings<'a>(rows: impl IntoIterator<Item = &'a Row>) -> Vec<Met> {
    let mut methods: Vec<(Method, Vec<&Report>)> = Vec::new();
    for (row, report) in rows.into_iter().filter_map(|row| Some((row, measured(row)?))) {
        let method = Method::of(row);
        match methods.iter_mut().find(|(known, _)| *known == method) {
            Some((_, own)) => own.push(report),
            None => methods.push((method, vec![report])),
        }
    }
    let one = |(method, reports): (Method, Vec<&Report>)| {
        let seams: Vec<_> = reports.iter().filter_map(|report| report.statistics.seams).collect();
        let seams: Vec<_> = seams.into_iter().filter(|seams| seams.met.triangles > 0).collect();
        let share = |seams: &crate::quality::Seams| {
            seams.met.triangles as f64 / (seams.met.triangles + seams.elsewhere.triangles) as f64
        };
        Some(Met {
            method,
            meshes: [seams.len(), reports.len()],
            worse: seams
                .iter()
                .filter(|seams| seams.met.mean_deg < seams.elsewhere.mean_deg)
                .count(),
            met: middle(seams.iter().map(|seams| seams.met).collect())?,
            elsewhere: middle(seams.iter().map(|seams| seams.elsewhere).collect())?,
            share: median(seams.iter().map(share).collect())?,
        })
    };
    let mut found: Vec<Met> = methods.into_iter().filter_map(one).collect();
    found.sort_by_key(|met| (met.method.place, !met.method.is_default, met.method.label.clone()));
    found
}

/// Medians number by number.
fn middle(all: Vec<Angles>) -> Option<Angles> {
    let of = |value: fn(&Angles) -> f64| median(all.iter().map(value).collect());
    Some(Angles {
        triangles: of(|angles| angles.triangles as f64)? as usize,
        min_deg: of(|angles| angles.min_deg)?,
        mean_deg: of(|angles| angles.mean_deg)?,
        p05_deg: of(|angles| angles.p05_deg)?,
        share_under_30: of(|angles| angles.share_under_30)?,
    })
}
