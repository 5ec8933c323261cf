//! The parts of the page on smallest angles, and on the hypotheses their bound needs.

use super::findings::{low_overlaps, margin, margins, ours};
use super::markdown::{degrees, parameter, table};
use crate::suite::analysis::summary::{Grid, Setting};
use crate::suite::rows::record::Row;
use crate::theory::{Promises, Rule};

/// How far smallest angles lie above asin(1/2 − t).
pub(super) fn angle_finding(rows: &[Row]) -> Option<String> {
    let all = Grid::of(ours(rows, "grid"));
    let told = |of: Setting| {
        let spread = margin(&all, of, None)?;
        Some(format!(
            "{} to {} above asin(1/2 − t), median {}, over {} meshes",
            degrees(spread.least),
            degrees(spread.most),
            degrees(spread.median),
            spread.count
        ))
    };
    let mut line = format!(
        "**Smallest angle.** Where the hypotheses hold it lies {}.",
        told(Setting::Papers)?
    );
    if let Some(low) = told(Setting::LowOverlap) {
        line += &format!(" Where circles of neighbouring input vertices meet low: {low}.");
    }
    if let Some(acute) = told(Setting::Acute) {
        line += &format!(" Where segments meet at less than 90°: {acute}, leaving out triangles at angles under 60°.");
    }
    Some(line)
}

/// What the sweep shows of a hypothesis that the paper uses without saying so.
pub(super) fn hypothesis_finding(rows: &[Row]) -> Option<String> {
    let found = low_overlaps(rows);
    (found.low_broken > 0).then(|| {
        format!(
            "**A hypothesis the paper does not state.** Theorem 6.8 rests on Lemma 6.4, which bounds how high the circles \
             of neighbouring boundary vertices meet only where edge protection put one of the two. Where the circles of a \
             segment's two input vertices already cover it between them, nothing bounds it, and the front vertex above \
             them makes a flat triangle. Without angles under 90° and with t ≤ 1/3 that broke the bound in {} of the {} \
             meshes where such circles meet lower than (9), by up to {}, and nothing else broke it ({} other meshes). With \
             c_b + t ≤ 1 it cannot happen, since f ≤ lfs is at most half a segment's length in its middle: {} of {} such \
             meshes broke the bound. So Theorem 6.8 needs c_b + t ≤ 1.",
            found.low_broken,
            found.low,
            degrees(-found.worst_margin),
            found.unexplained,
            found.apart_broken,
            found.apart
        )
    })
}

/// Margins for each t.
pub(super) fn angles(rows: &[Row]) -> String {
    let all = Grid::of(ours(rows, "grid"));
    if all.reports().next().is_none() {
        return String::new();
    }
    let lines = margins(&all).into_iter().map(|margin| {
        let three = [margin.papers, margin.low, margin.acute]
            .into_iter()
            .flat_map(|spread| {
                let count = spread.map_or(0, |spread| spread.count).to_string();
                [
                    count,
                    degrees(spread.map(|s| s.least)),
                    degrees(spread.map(|s| s.median)),
                ]
            });
        let bound = Promises {
            rule: Rule::Earlier,
            t: margin.t,
        }
        .min_angle_deg();
        [parameter(margin.t), degrees(bound)].into_iter().chain(three).collect()
    });
    let head = [
        "t",
        "asin(1/2 − t)",
        "meshes",
        "least margin",
        "median",
        "meshes, circles meet low",
        "least margin",
        "median",
        "meshes, acute",
        "least margin",
        "median",
    ];
    "How far the smallest angle of a mesh lies above the bound for its effective t (which is smaller than t where the \
     spacing's own Lipschitz constant is): where the hypotheses hold, where circles of neighbouring input vertices meet \
     low (c_b + t > 1), and where segments meet at angles under 90° (acute). Triangles at input angles under 60° are left out; the bound is 0 from t = 1/2 on.\n\n"
        .to_string()
        + &table(&head, &lines.collect::<Vec<_>>())
}
