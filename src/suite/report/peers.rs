//! The meshers outside this crate: who was there, and what each does to the boundary.

use super::markdown::{number, table};
use crate::suite::analysis::results::Results;
use crate::suite::peers::{self, PEERS};
use crate::suite::rows::numbers::{first_seen, median};
use crate::suite::rows::record::{Outcome, Report, Row};
use crate::suite::run::plan::Section;

/// Who was there, and what becomes of the boundary.
pub(super) fn text(results: &Results) -> String {
    let rows = results.of(Section::Peers);
    if !rows.iter().any(|row| peers::is_peer(&row.cell.mesher)) {
        return String::new();
    }
    who_was_there(&rows) + &boundaries(&rows)
}

/// Version of each peer, what it needs before it meshes, how many of its cells it measured.
fn who_was_there(rows: &[&Row]) -> String {
    let line = |name: &'static str| {
        let own: Vec<&Row> = rows.iter().copied().filter(|row| row.cell.mesher == name).collect();
        let reports: Vec<&Report> = own.iter().filter_map(|row| row.report.as_ref()).collect();
        let outside: Vec<_> = reports.iter().filter_map(|report| report.outside.as_ref()).collect();
        let count = |outcome| own.iter().filter(|row| row.outcome == outcome).count().to_string();
        let seconds = |part: &str| {
            let all = outside.iter().filter_map(|told| told.set_up_seconds.get(part).copied());
            number(median(all.collect()))
        };
        let differ = outside.iter().any(|told| told.repeats_differ);
        vec![
            format!("[{name}](../../baselines/{name}/README.md)"),
            first_seen(outside.iter().map(|told| told.version.as_str())).join(", "),
            count(Outcome::Measured),
            count(Outcome::Declined),
            count(Outcome::Failed),
            count(Outcome::Skipped),
            ["imports", "read", "size_field"].map(seconds).join(", "),
            match (outside.is_empty(), differ) {
                (true, _) => "–",
                (false, true) => "no",
                (false, false) => "yes",
            }
            .to_owned(),
        ]
    };
    let head = [
        "mesher",
        "version",
        "measured",
        "declined",
        "failed",
        "not installed",
        "seconds of imports, reading, size set-up",
        "repeats equal",
    ];
    let asked = PEERS
        .iter()
        .filter(|entry| rows.iter().any(|row| row.cell.mesher == entry.name));
    "How each is run, and how it is kept fair, is in [METHOD.md](../../baselines/METHOD.md). Its seconds count from domain and size \
     function in memory to the mesh in memory; what comes before is told here, in medians.\n\n"
        .to_owned()
        + &table(&head, &asked.map(|entry| line(entry.name)).collect::<Vec<_>>())
}

/// What the meshes of peers do to the boundary: how many conform, and what the others break, on which domains.
fn boundaries(rows: &[&Row]) -> String {
    let is_broken = |row: &&&Row| row.outcome == Outcome::Failed && row.report.is_some();
    let line = |name: &'static str| {
        let own: Vec<&Row> = rows.iter().copied().filter(|row| row.cell.mesher == name).collect();
        let broken: Vec<&&Row> = own.iter().filter(is_broken).collect();
        let made = own.iter().filter(|row| row.report.is_some()).count();
        let domains = first_seen(broken.iter().map(|row| row.cell.domain.as_str()));
        let claims = broken.iter().filter_map(|row| row.report.as_ref());
        let claims = claims.flat_map(|report| report.certificate.broken().map(|check| check.claim.name()));
        vec![
            name.to_owned(),
            format!("{} of {made}", made - broken.len()),
            if broken.is_empty() {
                "–".into()
            } else {
                domains.join(", ")
            },
            if broken.is_empty() {
                "–".into()
            } else {
                first_seen(claims).join(", ")
            },
        ]
    };
    let asked = PEERS.iter().filter(|entry| {
        rows.iter()
            .any(|row| row.cell.mesher == entry.name && row.report.is_some())
    });
    let lines: Vec<_> = asked.map(|entry| line(entry.name)).collect();
    "### What becomes of the boundary\n\nA mesh conforms if every input vertex and segment is there, nothing overlaps and the area is the domain's. Ours \
     must, by their certificates.\n\n"
        .to_owned()
        + &table(&["mesher", "meshes that conform", "broken on", "breaks"], &lines)
}
