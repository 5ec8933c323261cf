//! Pictures of meshes, made again from their rows.

use super::drawer::Drawer;
use super::markdown::{degrees, parameter};
use crate::mesh::Mesh;
use crate::meshers::{Budget, Request};
use crate::suite::analysis::contest::Contest;
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::measured;
use crate::suite::charts::{ChartError, draw_mesh_sheet, draw_small_mesh};
use crate::suite::rows::numbers::first_seen;
use crate::suite::rows::record::{Report, Row};
use crate::suite::run::measure::{fingerprint, run};
use crate::suite::run::plan::Section;
use crate::suite::run::prepare::Store;
use crate::suite::run::runner::mesher;

/// What is shown: where triangles can be seen, near this t and c_b.
const SHOWN_T: f64 = 0.25;
const SHOWN_C_B: f64 = 0.5;
/// The domains of the README's picture.
const SHEET: [&str; 4] = ["plate-hole", "gear", "naca0012", "iceland"];
/// A picture of more triangles shows colours only, and takes its time.
const MOST_TRIANGLES: usize = 60_000;

/// Triangles of a mesh on the sheet of meshers: enough to show what they do, few enough to be seen.
const SHEET_TRIANGLES: f64 = 900.0;

/// What the pictures are.
pub(super) fn text(_: &Results) -> String {
    "Made again from their rows, bit for bit by their fingerprints.\n\n".to_owned()
}

/// Draws a mesh of each domain of the section. A row says enough to make its mesh again, and its fingerprint whether that came out
/// the same; where it did not, on another machine or by a later version, there is no picture.
pub(super) fn charts(results: &Results, drawer: &mut Drawer) -> Result<(), ChartError> {
    let mut sheet: Vec<(String, Mesh)> = Vec::new();
    for (row, report) in chosen(results) {
        let Some(mesh) = made_again(&drawer.store, row, report) else {
            continue;
        };
        let title = format!("Mesh of {}", report.domain);
        let caption = format!("`{}` with {}", report.domain, told(report));
        let name = format!("mesh-{}", file_name(&row.cell.domain));
        draw_small_mesh(&mesh, &drawer.picture(&name, &title, &caption))?;
        if SHEET.contains(&row.cell.domain.as_str()) {
            sheet.push((row.cell.domain.clone(), mesh));
        }
    }
    if sheet.len() == SHEET.len() {
        let titled: Vec<_> = sheet.iter().map(|(title, mesh)| (title.as_str(), mesh)).collect();
        draw_mesh_sheet(&titled, &drawer.file("four-meshes"))?;
    }
    Ok(())
}

/// A domain's name as part of a file's.
pub(super) fn file_name(domain: &str) -> String {
    domain
        .chars()
        .map(|c| if c.is_alphanumeric() { c } else { '-' })
        .collect()
}

/// One measured row of each domain: of the first spacing, nearest to what is to be shown.
fn chosen(results: &Results) -> Vec<(&Row, &Report)> {
    let grids = results.grids(Section::Meshes);
    let Some((_, grid)) = grids.first() else {
        return Vec::new();
    };
    let domains = first_seen(grid.rows.iter().map(|row| row.cell.domain.as_str()));
    let far = |row: &Row| (row.cell.t - SHOWN_T).abs() + (row.cell.c_b - SHOWN_C_B).abs();
    let best = |domain: &&str| {
        let own = grid.rows.iter().filter(|row| row.cell.domain == **domain);
        let drawn = own.filter_map(|row| Some((*row, measured(row)?)));
        let drawn = drawn.filter(|(_, report)| report.statistics.triangles <= MOST_TRIANGLES);
        drawn.min_by(|a, b| far(a.0).total_cmp(&far(b.0)))
    };
    domains.iter().filter_map(best).collect()
}

/// Draws one domain meshed by the defaults of every mesher, for the same edge length.
pub(super) fn side_by_side(contest: &Contest, drawer: &mut Drawer) -> Result<(), ChartError> {
    let leads = contest.leads();
    let common = contest.common(&leads);
    let off = |task: &usize| {
        let triangles = contest.median(leads[0], &[*task], |report| Some(report.statistics.triangles as f64));
        (triangles.unwrap_or(f64::MAX) / SHEET_TRIANGLES).ln().abs()
    };
    let known = |task: &&usize| SHEET.contains(&contest.tasks[**task].domain.as_str());
    let shown = common.iter().filter(known).min_by(|a, b| off(a).total_cmp(&off(b)));
    let Some(&task) = shown.filter(|_| contest.has_several_meshers()) else {
        return Ok(());
    };
    let made = |k: &usize| {
        let (row, report) = (contest.row(*k, task)?, contest.report(*k, task)?);
        let mesh = made_again(&drawer.store, row, report)?;
        Some((contest.methods[*k].label.as_str(), mesh, told(report)))
    };
    let Some(made) = leads.iter().map(made).collect::<Option<Vec<_>>>() else {
        return Ok(());
    };
    let titled: Vec<_> = made.iter().map(|(label, mesh, _)| (*label, mesh)).collect();
    let each: Vec<String> = made
        .iter()
        .map(|(label, _, told)| format!("{label} with {told}"))
        .collect();
    let domain = &contest.tasks[task].domain;
    let title = format!("{domain} meshed by every mesher");
    let caption = format!("`{domain}` by {}", each.join("; "));
    draw_mesh_sheet(&titled, &drawer.picture("meshers-side-by-side", &title, &caption))
}

/// What was asked for, and what came out.
fn told(report: &Report) -> String {
    format!(
        "`{}`, t = {}, c_b = {}: {} triangles, smallest angle {}, mean smallest angle {}",
        report.spacing,
        parameter(report.t),
        parameter(report.c_b),
        report.statistics.triangles,
        degrees(report.statistics.min_angle_deg),
        degrees(report.statistics.mean_min_angle_deg)
    )
}

/// The mesh of a row, if its domain, spacing and mesher are still there and it comes out the same.
pub(super) fn made_again(store: &Store, row: &Row, report: &Report) -> Option<Mesh> {
    let prepared = store.prepare_for_t(&row.cell).ok()?;
    let mesher = mesher(&row.cell).ok()?;
    let request = Request {
        c_b: report.c_b,
        seed: row.cell.seed,
        threads: 1,
        budget: Budget {
            max_vertices: Some(4 * MOST_TRIANGLES),
            ..Budget::default()
        },
    };
    let mesh = run(&prepared, &mesher, &request).ok()?.mesh;
    (fingerprint(&mesh) == report.fingerprint).then_some(mesh)
}
