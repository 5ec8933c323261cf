//! The parts of the page that answer a question each: a finding in one line, and tables.

use super::findings::{OrderFinding, broken_checks, claims, fewest, grids, order_findings, ours, slopes, spread};
use super::markdown::{degrees, number, parameter, table};
use super::page::MOST_LINES;
use crate::suite::analysis::summary::{Grid, Pair, measured};
use crate::suite::rows::numbers::{first_seen, median};
use crate::suite::rows::record::{Report, Row};

/// Between what bounds the two ratios lie.
pub(super) fn size_finding(rows: &[Row]) -> Option<String> {
    let (title, grid) = grids(rows).into_iter().next()?;
    let of = |value: fn(&Report) -> f64| spread(grid.reports().map(|(_, report)| value(report)).collect());
    let (by_f, by_lfs, efficiency) = (
        of(|r| r.size_ratio)?,
        of(|r| r.size_ratio_lfs)?,
        of(|r| r.size_efficiency)?,
    );
    Some(format!(
        "**Size** of bitten meshes, with spacing `{title}`. Triangles/∫dA/f² lie between {} and {}, times (√3/4)c_b² between {} and {} \
         (median {}). Triangles/∫dA/lfs² lie between {} and {}.",
        number(by_f.least),
        number(by_f.most),
        number(efficiency.least),
        number(efficiency.most),
        number(efficiency.median),
        number(by_lfs.least),
        number(by_lfs.most)
    ))
}

/// Tables t × c_b of medians over domains.
pub(super) fn sizes(rows: &[Row]) -> String {
    let mut text = String::new();
    for (index, (title, grid)) in grids(rows).iter().enumerate() {
        text +=
            &format!("Triangles/∫dA/f² with `{title}`, median over the measured domains (how many of how many):\n\n");
        text += &t_by_c_b(grid, |report| report.size_ratio);
        if index == 0 {
            text += &format!("Triangles/∫dA/lfs² with `{title}`, likewise:\n\n");
            text += &t_by_c_b(grid, |report| report.size_ratio_lfs);
        }
    }
    text
}

/// A table with a line for each t and a column for each c_b.
fn t_by_c_b(grid: &Grid, value: fn(&Report) -> f64) -> String {
    let head: Vec<String> = grid
        .c_bs
        .iter()
        .map(|c_b| format!("c_b = {}", parameter(*c_b)))
        .collect();
    let head: Vec<&str> = std::iter::once("t").chain(head.iter().map(String::as_str)).collect();
    let cell = |t: f64, c_b: f64| {
        let rows = grid.at(t, c_b);
        let done = rows.iter().filter(|row| measured(row).is_some()).count();
        match grid.median(t, c_b, value) {
            Some(middle) if done == rows.len() => number(middle),
            Some(middle) => format!("{} ({done} of {})", number(middle), rows.len()),
            None => format!("– (0 of {})", rows.len()),
        }
    };
    let line = |t: &f64| {
        std::iter::once(parameter(*t))
            .chain(grid.c_bs.iter().map(|c_b| cell(*t, *c_b)))
            .collect()
    };
    table(&head, &grid.ts.iter().map(line).collect::<Vec<Vec<String>>>())
}

/// The smallest angles that users ask for, degrees.
const ANGLES_DEG: [f64; 8] = [5.0, 10.0, 15.0, 20.0, 22.5, 25.0, 28.0, 30.0];

/// The pairs over domains without acute angles, and over all domains.
fn pairs(rows: &[Row]) -> [Vec<Pair>; 2] {
    match grids(rows).first() {
        Some((_, grid)) => [grid.without_acute().pairs(), grid.pairs()],
        None => Default::default(),
    }
}

/// The pairs with the fewest triangles for some angles.
pub(super) fn fewest_finding(rows: &[Row]) -> Option<String> {
    let [plain, _] = pairs(rows);
    let told = [15.0, 20.0, 25.0, 28.0].into_iter().filter_map(|angle| {
        let pair = fewest(&plain, angle)?;
        let (t, c_b) = (parameter(pair.t), parameter(pair.c_b));
        let size = number(pair.size_ratio_lfs);
        Some(format!("{angle}° by t = {t}, c_b = {c_b} ({size} per ∫dA/lfs²)"))
    });
    let told: Vec<String> = told.collect();
    let domains = plain.iter().map(|pair| pair.domains).max()?;
    (!told.is_empty()).then(|| {
        let told = told.join(", ");
        format!("**Fewest triangles for a smallest angle**, on {domains} domains without angles under 90°: {told}.")
    })
}

/// The pair with the fewest triangles for each of some angles, without acute domains and with them.
pub(super) fn fewest_triangles(rows: &[Row]) -> String {
    let [plain, all] = pairs(rows);
    let domains = |pairs: &[Pair]| pairs.iter().map(|pair| pair.domains).max();
    let mut text = String::new();
    if !plain.is_empty() {
        text += &fewest_table(&plain, "domains without angles under 90° between segments");
    }
    if domains(&all) > domains(&plain) {
        text += &fewest_table(&all, "domains, leaving out triangles at input angles under 60°");
    }
    text
}

fn fewest_table(pairs: &[Pair], title: &str) -> String {
    let domains = pairs.iter().map(|pair| pair.domains).max().unwrap_or(0);
    let lines = ANGLES_DEG.iter().map(|angle| {
        let pair = fewest(pairs, *angle);
        vec![
            format!("{angle}°"),
            pair.map_or("–".into(), |pair| parameter(pair.t)),
            pair.map_or("–".into(), |pair| parameter(pair.c_b)),
            degrees(pair.map(|pair| pair.smallest_angle_deg)),
            number(pair.map(|pair| pair.size_ratio_lfs)),
        ]
    });
    let head = [
        "smallest angle at least",
        "t",
        "c_b",
        "smallest angle",
        "triangles/∫dA/lfs²",
    ];
    format!(
        "{domains} {title}; of the {} pairs (t, c_b) for which all of these were measured:\n\n",
        pairs.len()
    ) + &table(&head, &lines.collect::<Vec<_>>())
}

/// The order with the largest median of the mean smallest angle on each spacing, and what it costs.
pub(super) fn order_finding(rows: &[Row]) -> Option<String> {
    let findings = order_findings(&ours(rows, "orders"));
    let spacings = crate::suite::rows::numbers::first_seen(findings.iter().map(|finding| finding.spacing.as_str()));
    let told: Vec<String> = spacings
        .into_iter()
        .filter_map(|spacing| best_order(&findings, spacing))
        .collect();
    (!told.is_empty()).then(|| format!("**Best order of bites**, by medians over domains: {}.", told.join("; ")))
}

fn best_order(findings: &[OrderFinding], spacing: &str) -> Option<String> {
    let own = || findings.iter().filter(|finding| finding.spacing == spacing);
    let top = |value: fn(&OrderFinding) -> Option<f64>| {
        own().filter(|finding| value(finding).is_some()).max_by(|a, b| {
            value(a)
                .unwrap_or(f64::NEG_INFINITY)
                .total_cmp(&value(b).unwrap_or(f64::NEG_INFINITY))
        })
    };
    let (mean, smallest) = (top(|finding| finding.mean_deg)?, top(|finding| finding.smallest_deg)?);
    let fewest = top(|finding| finding.efficiency.map(|efficiency| -efficiency))?;
    let fastest = own()
        .filter_map(|finding| finding.seconds_per_triangle)
        .fold(f64::INFINITY, f64::min);
    let cost = |finding: &OrderFinding| number(finding.seconds_per_triangle.map(|seconds| seconds / fastest));
    Some(format!(
        "with `{spacing}` `{}` has the largest mean smallest angle ({}, at {} times the time of the fastest order), `{}` \
         the largest smallest angle ({}, at {} times), `{}` the fewest triangles (size efficiency {}, smallest angle {}, \
         mean {})",
        mean.order,
        degrees(mean.mean_deg),
        cost(mean),
        smallest.order,
        degrees(smallest.smallest_deg),
        cost(smallest),
        fewest.order,
        number(fewest.efficiency),
        degrees(fewest.smallest_deg),
        degrees(fewest.mean_deg)
    ))
}

/// Medians of each order and spacing, and where the order is best.
pub(super) fn orders(rows: &[Row]) -> String {
    let findings = order_findings(&ours(rows, "orders"));
    if findings.is_empty() {
        return String::new();
    }
    let head = [
        "spacing",
        "order",
        "measured",
        "smallest angle",
        "mean smallest angle",
        "size efficiency",
        "µs per triangle",
        "best mean on",
        "best smallest on",
    ];
    let line = |finding: &OrderFinding| {
        vec![
            finding.spacing.clone(),
            finding.order.clone(),
            format!("{} of {}", finding.measured, finding.asked),
            degrees(finding.smallest_deg),
            degrees(finding.mean_deg),
            number(finding.efficiency),
            number(finding.seconds_per_triangle.map(|seconds| 1e6 * seconds)),
            finding.best_mean_on.join(", "),
            finding.best_smallest_on.join(", "),
        ]
    };
    let alone = ours(rows, "orders").iter().all(|row| row.cell.timed);
    let caution = if alone {
        ""
    } else {
        " Cells ran beside one another, so their times are rough."
    };
    format!(
        "Medians over domains, at one t and c_b; the last columns name the domains on which no other order does \
         better.{caution}\n\n"
    ) + &table(&head, &findings.iter().map(line).collect::<Vec<_>>())
}

/// Slopes of log seconds against log triangles.
pub(super) fn time_finding(rows: &[Row]) -> Option<String> {
    let slopes = slopes(rows);
    let whole = slopes.first()?;
    let growth = whole.slope?;
    let triangulation = slopes.iter().find(|step| step.name.contains("triangulation"));
    let beside = triangulation.map(|step| format!(", that of the triangulation within it {}", number(step.slope)));
    Some(format!(
        "**Time** of biting grows with triangles to the power {}{}; from {} to {} triangles, {} µs per triangle in the median.",
        number(growth),
        beside.unwrap_or_default(),
        number(whole.triangles.0),
        number(whole.triangles.1),
        number(whole.seconds_per_triangle.map(|seconds| 1e6 * seconds))
    ))
}

/// Slope and time per triangle of each step.
pub(super) fn time(rows: &[Row]) -> String {
    let slopes = slopes(rows);
    if slopes.is_empty() {
        return String::new();
    }
    let timed: Vec<&Report> = ours(rows, "time").into_iter().filter_map(measured).collect();
    let spreads = ours(rows, "time").into_iter().filter_map(|row| {
        let spread = spread(row.samples.clone())?;
        Some((spread.most - spread.least) / spread.median)
    });
    let lines = slopes.iter().map(|step| {
        vec![
            step.name.replace('_', " "),
            number(step.slope),
            number(step.seconds_per_triangle.map(|s| 1e6 * s)),
        ]
    });
    format!(
        "Cells run alone and repeated: {}. Each time is the median of its repeats, whose range is {} of it in the \
         median cell. Slopes are least-squares lines through the logarithms.\n\n",
        timed.len(),
        number(median(spreads.collect()))
    ) + &table(&["step", "slope", "µs per triangle"], &lines.collect::<Vec<_>>())
}

/// How many certificates hold.
pub(super) fn certificate_finding(rows: &[Row]) -> Option<String> {
    let reports: Vec<&Report> = rows.iter().filter_map(measured).collect();
    let holding = reports.iter().filter(|report| report.certificate.holds).count();
    let forced = reports.iter().filter(|report| report.forced_pieces > 0).count();
    (!reports.is_empty()).then(|| {
        format!(
            "**Certificate.** Every guaranteed check holds in {holding} of {} meshes. Boundary pieces that are no \
             Delaunay edges had to be forced in {forced}.",
            reports.len()
        )
    })
}

/// How often each claim held, and every cell in which one did not.
pub(super) fn certificate(rows: &[Row]) -> String {
    let tallies = claims(rows);
    if tallies.is_empty() {
        return String::new();
    }
    let of = |(count, held): (usize, usize)| {
        if count == 0 {
            "–".into()
        } else {
            format!("{held} of {count}")
        }
    };
    let meshers = first_seen(tallies.iter().map(|tally| tally.mesher.as_str()));
    let claims = first_seen(tallies.iter().map(|tally| tally.claim.name()));
    let mut head = vec!["claim".to_string(), "paper".to_string()];
    for mesher in &meshers {
        head.extend([format!("{mesher}: held where guaranteed"), "held elsewhere".to_string()]);
    }
    let line = |claim: &str| {
        let own = |mesher: &str| {
            tallies
                .iter()
                .find(|tally| tally.claim.name() == claim && tally.mesher == mesher)
        };
        let lemma = meshers
            .iter()
            .find_map(|mesher| own(mesher))
            .map(|tally| tally.lemma.clone());
        let mut cells = vec![claim.to_string(), lemma.unwrap_or_default()];
        for mesher in &meshers {
            let (guaranteed, measured) =
                own(mesher).map_or(((0, 0), (0, 0)), |tally| (tally.guaranteed, tally.measured));
            cells.extend([of(guaranteed), of(measured)]);
        }
        cells
    };
    let lines: Vec<_> = claims.into_iter().map(line).collect();
    let mut text =
        "## Certificate\n\nIn how many meshes each claim held: where it is guaranteed (its hypotheses hold), and \
         where it is only measured.\n\n"
            .to_string();
    text += &table(&head.iter().map(String::as_str).collect::<Vec<_>>(), &lines);
    for (applies, title) in [
        (true, "Guaranteed checks that failed"),
        (false, "Bounds that biting broke where a hypothesis fails"),
    ] {
        let lines = broken_checks(rows, applies);
        text += &format!("### {title}: {}\n\n", lines.len());
        let head = [
            "mesher",
            "domain",
            "spacing",
            "t",
            "effective t",
            "c_b",
            "claim",
            "worst",
            "bound",
            "broken",
            "at",
            "input angle",
            "segment angle",
            "circles meet low",
            "forced pieces",
        ];
        if !lines.is_empty() {
            text += &table(&head, &lines[..lines.len().min(MOST_LINES)]);
        }
        if lines.len() > MOST_LINES {
            text += &format!("and {} more in `rows.jsonl`.\n\n", lines.len() - MOST_LINES);
        }
    }
    text
}
