//! The part of the page that sets our meshers beside those outside this crate: who was there, task by task who did what, and
//! who was best how often.

use super::duels::{YARDSTICKS, Yardstick};
use super::markdown::{degrees, number, table};
use crate::suite::analysis::contest::{Contest, Method, at_equal_count, at_equal_size};
use crate::suite::analysis::remarks::ours;
use crate::suite::analysis::summary::measured;
use crate::suite::peers::PEERS;
use crate::suite::rows::numbers::{first_seen, median, quantile};
use crate::suite::rows::record::{Outcome, Report, Row};

/// Whether any row is of a mesher outside this crate.
fn has_peers(rows: &[Row]) -> bool {
    rows.iter()
        .any(|row| PEERS.iter().any(|peer| peer.name == row.cell.mesher))
}

/// The part of the page.
pub(super) fn peers(rows: &[Row]) -> String {
    if !has_peers(rows) {
        return String::new();
    }
    let contests = [
        ("equal edge length", at_equal_size(rows)),
        ("equal triangle count", at_equal_count(rows)),
    ];
    let tasks = contests
        .iter()
        .flat_map(|(title, contest)| (0..contest.tasks.len()).map(move |task| task_table(contest, task, title)));
    let timed = Contest::of(rows.iter().filter(|row| row.group == "time"));
    let largest = (0..timed.tasks.len())
        .filter(|task| {
            (0..contests[0].1.tasks.len()).all(|other| contests[0].1.tasks[other].spacing != timed.tasks[*task].spacing)
        })
        .map(|task| task_table(&timed, task, "equal edge length, once"));
    who_was_there(rows) + &tasks.chain(largest).collect::<String>() + &boundaries(rows) + &threads(rows)
}

/// Version of each peer, what it needs before it meshes, how many of its cells it measured.
fn who_was_there(rows: &[Row]) -> String {
    let line = |name: &'static str| {
        let own: Vec<&Row> = rows.iter().filter(|row| row.cell.mesher == name).collect();
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
fn boundaries(rows: &[Row]) -> String {
    let is_broken = |row: &&&Row| row.outcome == Outcome::Failed && row.report.is_some();
    let line = |name: &'static str| {
        let own: Vec<&Row> = rows.iter().filter(|row| row.cell.mesher == name).collect();
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

/// Speed by number of threads, of the methods that were run with several.
fn threads(rows: &[Row]) -> String {
    let own: Vec<&Row> = rows.iter().filter(|row| row.group == "threads").collect();
    let line = |row: &&Row| {
        vec![
            Method::of(row).label,
            row.cell.threads.to_string(),
            measured(row).map_or_else(|| "–".to_owned(), |report| report.statistics.triangles.to_string()),
            number(measured(row).and_then(speed)),
            range_of(&row.samples),
        ]
    };
    let lines: Vec<Vec<String>> = own.iter().map(line).collect();
    if lines.is_empty() {
        return String::new();
    }
    let head = ["mesher", "threads", "triangles", "10⁶ triangles/s", "range of repeats"];
    format!("### Threads\n\n{}", table(&head, &lines))
}

/// Every method on one task.
fn task_table(contest: &Contest, task: usize, title: &str) -> String {
    let asked = &contest.tasks[task];
    let wanted = asked.triangles.map_or_else(String::new, |count| format!(" of {count}"));
    let line = |method: usize| Some((contest.row(method, task)?, &contest.methods[method].label));
    let lines: Vec<Vec<String>> = contest
        .all()
        .into_iter()
        .filter_map(line)
        .map(|(row, label)| task_line(row, label))
        .collect();
    let head = [
        "mesher",
        "triangles",
        "/∫dA/f²",
        "edge/s 5, 50, 95 %",
        "smallest",
        "mean",
        "5th percentile",
        "under 20°",
        "under 30°",
        "10⁶ triangles/s",
        "range of repeats",
        "peak MB (before)",
        "",
    ];
    format!("### {}, `{}`, at {title}{wanted}\n\n", asked.domain, asked.spacing) + &table(&head, &lines)
}

/// How a row ended and why, the reason once.
fn told(how: &str, row: &Row) -> String {
    let reason = row.reason.as_deref().unwrap_or_default();
    let reason = reason
        .strip_prefix(how)
        .and_then(|rest| rest.strip_prefix(": "))
        .unwrap_or(reason);
    format!("{how}: {reason}")
}

/// A line of a task's table: also of a mesh that does not conform, with what it breaks.
fn task_line(row: &Row, label: &str) -> Vec<String> {
    let reason = match row.outcome {
        Outcome::Measured => String::new(),
        Outcome::Skipped => told("skipped", row),
        Outcome::Declined => told("declined", row),
        Outcome::Failed => told("failed", row),
    };
    let Some(report) = &row.report else {
        let blank = std::iter::repeat_n("–".to_owned(), 11);
        return std::iter::once(label.to_owned()).chain(blank).chain([reason]).collect();
    };
    let statistics = &report.statistics;
    let percent = |degrees: usize| format!("{} %", number(100.0 * statistics.share_under(degrees)));
    let edges = statistics.edge_over_size.as_ref();
    let edges = edges.map_or_else(
        || "–".to_owned(),
        |edge| [edge.p05, edge.p50, edge.p95].map(number).join(", "),
    );
    let megabytes = |bytes: u64| number(bytes as f64 / 1e6);
    vec![
        label.to_owned(),
        statistics.triangles.to_string(),
        number(report.size_ratio),
        edges,
        degrees(statistics.min_angle_free_deg),
        degrees(statistics.mean_min_angle_deg),
        degrees(statistics.p05_min_angle_deg),
        percent(20),
        percent(30),
        number(speed(report)),
        range_of(&row.samples),
        format!(
            "{} ({})",
            megabytes(report.peak_rss_bytes),
            megabytes(report.rss_before_bytes)
        ),
        reason,
    ]
}

/// Millions of triangles a second.
fn speed(report: &Report) -> Option<f64> {
    let seconds = report.seconds.total;
    (seconds > 0.0).then(|| 1e-6 * report.statistics.triangles as f64 / seconds)
}

/// From the fastest repeat to the slowest, over their median, in percent.
fn range_of(samples: &[f64]) -> String {
    let ends = [0.0, 0.5, 1.0].map(|share| quantile(samples.to_vec(), share));
    match ends {
        [Some(least), Some(middle), Some(most)] if samples.len() > 1 && middle > 0.0 => {
            let percent = |value: f64| format!("{:+.0}", 100.0 * (value / middle - 1.0));
            format!("{} to {} %", percent(least), percent(most))
        }
        _ => "–".to_owned(),
    }
}

/// Who is best by each yardstick, task by task, and where ours stands; a line for each way of asking.
pub(super) fn peer_findings(rows: &[Row]) -> Vec<String> {
    if !has_peers(rows) {
        return Vec::new();
    }
    let told = [
        ("equal edge length", at_equal_size(rows), false),
        ("equal triangle count", at_equal_count(rows), true),
    ];
    told.iter()
        .filter_map(|(title, contest, is_count)| {
            let wanted = YARDSTICKS.iter().filter(|by| by.at_equal_count || !is_count);
            let parts: Vec<String> = wanted.filter_map(|by| best(contest, by)).collect();
            (!parts.is_empty()).then(|| {
                format!(
                    "**Who is best at {title}**, task by task over {} tasks, among our meshers and those outside: {}.",
                    contest.tasks.len(),
                    parts.join("; ")
                )
            })
        })
        .collect()
}

/// How often which mesher is first by one yardstick, variants counted as the mesher's, and the place of ours.
fn best(contest: &Contest, by: &Yardstick) -> Option<String> {
    let ours = ours(contest)?;
    let mut winners: Vec<(String, usize)> = Vec::new();
    let (mut places, mut ratios) = (Vec::new(), Vec::new());
    for task in 0..contest.tasks.len() {
        let value = |method: usize| (by.value)(measured(contest.row(method, task)?)?);
        let mut all: Vec<(usize, f64)> = contest.all().into_iter().filter_map(|k| Some((k, value(k)?))).collect();
        all.sort_by(|a, b| (by.sign * b.1).total_cmp(&(by.sign * a.1)));
        let Some(&(first, top)) = all.first() else { continue };
        let name = contest.methods[first].label.clone();
        match winners.iter_mut().find(|(known, _)| *known == name) {
            Some((_, count)) => *count += 1,
            None => winners.push((name, 1)),
        }
        if let Some(own) = value(ours) {
            places.push(1.0 + all.iter().filter(|(_, other)| by.sign * other > by.sign * own).count() as f64);
            // Nothing is a number of times nothing.
            if top != 0.0 {
                ratios.push(own / top);
            }
        }
    }
    winners.sort_by_key(|winner| std::cmp::Reverse(winner.1));
    let names: Vec<String> = winners
        .iter()
        .map(|(name, count)| format!("{name} on {count}"))
        .collect();
    let times = median(ratios).map_or_else(String::new, |ratio| format!(", with {} times the best", number(ratio)));
    let standing = median(places).map_or_else(String::new, |place| {
        format!(
            " ({} is {} in the median{times})",
            contest.methods[ours].label,
            ordinal(place)
        )
    });
    (!names.is_empty()).then(|| format!("{}: {}{standing}", by.name, names.join(", ")))
}

fn ordinal(place: f64) -> String {
    match place {
        1.0 => "1st".into(),
        2.0 => "2nd".into(),
        3.0 => "3rd".into(),
        _ => format!("{place}th"),
    }
}
