//! The paper's two claims on its rivals, answered in numbers.

use super::findings::of_group;
use super::markdown::{degrees, number, table};
use crate::suite::analysis::contest::{Contest, at_equal_size};
use crate::suite::analysis::remarks::{Met, Sampling, meetings, samplings};
use crate::suite::rows::record::Row;

/// What each density of samples gave, from the cells timed for that, or else from those of the comparison.
pub(super) fn sampled(rows: &[Row]) -> Vec<Sampling> {
    let timed = Contest::of(of_group(rows, "oversampling"));
    samplings(&if timed.has_rivals() { timed } else { at_equal_size(rows) })
}

/// What meshes say of the places where fronts met: those of the comparison, so that all methods have the same tasks.
pub(super) fn met(rows: &[Row]) -> Vec<Met> {
    let contest = at_equal_size(rows);
    meetings(contest.all().into_iter().flat_map(|k| contest.rows(k)))
}

fn percent(share: f64) -> String {
    format!("{} %", number(100.0 * share))
}

/// Whether quality is lost where fronts meet: in most meshes, and in the median.
fn is_lost(met: &Met) -> bool {
    2 * met.worse > met.meshes[0] && met.met.mean_deg < met.elsewhere.mean_deg
}

/// Both, a line each.
pub(super) fn claim_findings(rows: &[Row]) -> impl Iterator<Item = String> {
    [seam_finding(rows), sampling_finding(rows)].into_iter().flatten()
}

/// Whether advancing front loses quality where fronts meet, in a line for each of its methods that are at their defaults.
pub(super) fn seam_finding(rows: &[Row]) -> Option<String> {
    let found = met(rows);
    let first = found.iter().find(|met| met.method.is_default).or(found.first())?;
    let verdict = if is_lost(first) { "holds" } else { "does not hold" };
    Some(format!(
        "**The paper's claim that an advancing front loses quality where fronts meet {verdict}** for {}: triangles there \
         ({} of all, in {} of {} meshes) have a mean smallest angle of {} against {} elsewhere, smaller in {} of {} meshes; \
         5th percentile {} against {}, under 30° {} against {} (medians over meshes).",
        first.method.label,
        percent(first.share),
        first.meshes[0],
        first.meshes[1],
        degrees(first.met.mean_deg),
        degrees(first.elsewhere.mean_deg),
        first.worse,
        first.meshes[0],
        degrees(first.met.p05_deg),
        degrees(first.elsewhere.p05_deg),
        percent(first.met.share_under_30),
        percent(first.elsewhere.share_under_30)
    ))
}

/// Whether independent sets of oversampled points cost more than biting.
pub(super) fn sampling_finding(rows: &[Row]) -> Option<String> {
    let found = sampled(rows);
    let dearer = found
        .iter()
        .filter(|one| one.seconds.is_some_and(|ratio| ratio > 1.0))
        .count();
    let verdict = match dearer {
        0 => "does not hold",
        some if some == found.len() => "holds",
        _ => "holds in part",
    };
    let told: Vec<String> = found
        .iter()
        .map(|one| {
            let end = if one.is_complete {
                "until no gap is left"
            } else {
                "once"
            };
            format!(
                "{} points a side sampled {end} take {} times the seconds, leave {} of circles at a gap and β = {}",
                number(one.points),
                number(one.seconds),
                one.gap_share.map_or("–".into(), percent),
                number(one.beta)
            )
        })
        .collect();
    let ends = [told.first()?, told.last()?];
    let ends = if told.len() > 1 {
        ends.to_vec()
    } else {
        ends[..1].to_vec()
    };
    Some(format!(
        "**The paper's claim that independent sets of oversampled points cost more {verdict}**: {} of {} densities take longer \
         than biting on the same tasks; {}.",
        dearer,
        found.len(),
        ends.into_iter().cloned().collect::<Vec<_>>().join("; ")
    ))
}

/// Tables for both.
pub(super) fn claims(rows: &[Row]) -> String {
    let mut text = String::new();
    let (found, sampled) = (met(rows), sampled(rows));
    if !found.is_empty() {
        text += "### Where fronts meet\n\n";
        text += &seam_finding(rows).map(|line| line + "\n\n").unwrap_or_default();
        let line = |one: &Met| {
            let two = |value: fn(&crate::quality::Angles) -> String| [value(&one.met), value(&one.elsewhere)];
            let mut cells = vec![
                one.method.label.clone(),
                format!("{} of {}", one.meshes[0], one.meshes[1]),
                percent(one.share),
                format!("{} of {}", one.worse, one.meshes[0]),
            ];
            cells.extend(two(|angles| degrees(angles.min_deg)));
            cells.extend(two(|angles| degrees(angles.mean_deg)));
            cells.extend(two(|angles| degrees(angles.p05_deg)));
            cells.extend(two(|angles| percent(angles.share_under_30)));
            cells
        };
        let head = [
            "mesher",
            "meshes where fronts met",
            "share of triangles",
            "mean smaller there in",
            "smallest there",
            "elsewhere",
            "mean there",
            "elsewhere",
            "5th percentile there",
            "elsewhere",
            "under 30° there",
            "elsewhere",
        ];
        text += &table(&head, &found.iter().map(line).collect::<Vec<_>>());
    }
    if !sampled.is_empty() {
        text += "### What oversampling costs\n\n";
        text += &sampling_finding(rows).map(|line| line + "\n\n").unwrap_or_default();
        let line = |one: &Sampling| {
            vec![
                one.method.label.clone(),
                format!("{} of {}", one.tasks[0], one.tasks[1]),
                number(one.beta),
                one.gap_share.map_or("–".into(), percent),
                number(one.triangles),
                number(one.seconds),
                number(one.seconds_per_triangle),
            ]
        };
        let head = [
            "mesher",
            "tasks all measured",
            "β",
            "circles at a gap",
            "triangles over biting's",
            "seconds over biting's",
            "seconds per triangle over biting's",
        ];
        text += &table(&head, &sampled.iter().map(line).collect::<Vec<_>>());
    }
    text
}
