//! Meshes by biting with corners bitten like any other, beside those with corners cut off.

use super::drawer::Drawer;
use super::markdown::{degrees, number, parameter, table};
use super::meshes::{file_name, made_again};
use crate::domain::Domain;
use crate::geometry::DVec2;
use crate::mesh::Mesh;
use crate::quality::shape::angles_deg;
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::measured;
use crate::suite::charts::{ChartError, side_by_side, window};
use crate::suite::rows::numbers::{first_seen, spread};
use crate::suite::rows::record::{Report, Row};
use crate::suite::run::plan::Section;

/// Two rows that differ in what is done about corners.
struct Pair<'a> {
    /// To the paper's letter, and with corners cut off.
    rows: [&'a Row; 2],
    reports: [&'a Report; 2],
}

fn is_bitten(row: &Row) -> bool {
    row.cell.params.get("corners").and_then(|value| value.as_str()) == Some("bite")
}

fn pairs(results: &Results) -> Vec<Pair<'_>> {
    let own = results.of(Section::Corners);
    let asked = |row: &Row| {
        (
            row.cell.domain.clone(),
            row.cell.spacing.clone(),
            [row.cell.t, row.cell.c_b],
        )
    };
    let mut pairs = Vec::new();
    for row in own.iter().copied().filter(|row| is_bitten(row)) {
        let partner = own
            .iter()
            .copied()
            .find(|other| !is_bitten(other) && asked(other) == asked(row));
        if let Some((other, bitten, cut)) = partner.and_then(|other| Some((other, measured(row)?, measured(other)?))) {
            pairs.push(Pair {
                rows: [row, other],
                reports: [bitten, cut],
            });
        }
    }
    pairs
}

/// The smallest angle beyond corners, in degrees.
fn free(report: &Report) -> f64 {
    report.statistics.min_angle_free_deg.unwrap_or(60.0)
}

fn triangles(pair: &Pair) -> f64 {
    pair.reports[1].statistics.triangles as f64 / pair.reports[0].statistics.triangles as f64
}

/// What cutting corners off does, mesh by mesh.
pub(super) fn text(results: &Results) -> String {
    let pairs = pairs(results);
    if pairs.is_empty() {
        return String::new();
    }
    let line = |pair: &Pair| {
        let [bitten, cut] = pair.reports;
        let each = |of: &dyn Fn(&Report) -> String| [of(bitten), of(cut)];
        let under = |report: &Report| number(100.0 * report.statistics.share_under(20));
        let head = [
            bitten.domain.clone(),
            parameter(bitten.c_b),
            degrees(bitten.smallest_input_angle_deg),
            cut.counts
                .get("corners_cut")
                .map_or("–".into(), |count| format!("{count:.0}")),
            bitten.statistics.triangles.to_string(),
            number(triangles(pair)),
        ];
        let angles = each(&|report| degrees(free(report)));
        let low = each(&|report| degrees(report.statistics.p05_min_angle_deg));
        head.into_iter().chain(angles).chain(low).chain(each(&under)).collect()
    };
    let head = [
        "domain",
        "c_b",
        "smallest input angle",
        "corners cut off",
        "triangles, bitten",
        "times as many, cut",
        "smallest angle beyond corners, bitten",
        "cut",
        "5th percentile, bitten",
        "cut",
        "% under 20°, bitten",
        "cut",
    ];
    let lines: Vec<Vec<String>> = pairs.iter().map(line).collect();
    "Input angles under 90°, which the paper excludes, bitten like any other (`corners=bite`, `head_on=leave`: the paper to the \
     letter), and cut off before biting and given back (the default).\n\n"
        .to_string()
        + &table(&head, &lines)
}

/// What cutting corners off gains, and what it costs.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let pairs = pairs(results);
    let of = |value: &dyn Fn(&Pair) -> f64| spread(pairs.iter().map(value).collect());
    let finding = || {
        let [bitten, cut] = [of(&|pair| free(pair.reports[0]))?, of(&|pair| free(pair.reports[1]))?];
        Some(format!(
            "Beyond input angles under 60°, cutting corners off lifts the smallest angle from {} to {}, in the median from {} to {}.",
            degrees(bitten.least),
            degrees(cut.least),
            degrees(bitten.median),
            degrees(cut.median)
        ))
    };
    let cost = of(&triangles).map(|times| {
        format!(
            "Cutting corners off makes {} times as many triangles in the median over {} pairs of meshes, at most {} times.",
            number(times.median),
            times.count,
            number(times.most)
        )
    });
    finding().into_iter().chain(cost).collect()
}

/// How much of a mesh the close look shows: so many times the longest edge of its worst triangle.
const WINDOW_EDGES: f64 = 8.0;

/// Draws, for each domain, the pair of meshes with the fewest triangles, with a close look at the worst triangle that biting
/// leaves beyond corners.
pub(super) fn charts(results: &Results, drawer: &mut Drawer) -> Result<(), ChartError> {
    let pairs = pairs(results);
    for domain in first_seen(pairs.iter().map(|pair| pair.reports[0].domain.as_str())) {
        let own = pairs.iter().filter(|pair| pair.reports[0].domain == domain);
        let Some(pair) = own.min_by_key(|pair| pair.reports[0].statistics.triangles) else {
            continue;
        };
        let made = [0, 1].map(|k| made_again(&drawer.store, pair.rows[k], pair.reports[k]));
        let [Some(bitten), Some(cut)] = made else {
            continue;
        };
        let Ok(own) = drawer.store.domain(&pair.rows[0].cell.domain) else {
            continue;
        };
        let Some((place, edge)) = worst(&bitten, &own) else {
            continue;
        };
        let told = |what: &str, report: &Report| {
            format!(
                "{what}: {} triangles, from {}",
                report.statistics.triangles,
                degrees(free(report))
            )
        };
        let titles = [told("bitten", pair.reports[0]), told("cut off", pair.reports[1])];
        let meshes = [(titles[0].as_str(), &bitten), (titles[1].as_str(), &cut)];
        let report = pair.reports[0];
        let caption = format!(
            "`{domain}` with `{}`, t = {}, c_b = {}: left corners {}, right {} beyond input angles under 60°; below, the \
             place of the worst triangle on the left, and how triangles spread over smallest angles",
            report.spacing,
            parameter(report.t),
            parameter(report.c_b),
            titles[0],
            titles[1]
        );
        let title = format!("Meshes of {domain} before and after corners are cut off");
        let file = drawer.picture(&format!("corners-{}", file_name(domain)), &title, &caption);
        side_by_side(meshes, window(place, WINDOW_EDGES * edge), &file)?;
    }
    Ok(())
}

/// Where the smallest angle beyond corners is, and the longest edge of that triangle.
fn worst(mesh: &Mesh, domain: &Domain) -> Option<(DVec2, f64)> {
    // Input vertices come first in a mesh, in order.
    let is_excused = |k: &u32| domain.acute_vertices().contains(&(*k as usize));
    let free = (0..mesh.triangles.len()).filter(|&t| !mesh.triangles[t].iter().any(is_excused));
    let smallest = |t: usize| angles_deg(mesh.corners(t)).into_iter().fold(180.0, f64::min);
    let [a, b, c] = mesh.corners(free.min_by(|&one, &other| smallest(one).total_cmp(&smallest(other)))?);
    let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
    Some(((a + b + c) / 3.0, longest))
}
