//! Meshers side by side: at equal edge length, at equal triangle count, and in time.

use super::drawer::Drawer;
use super::markdown::{number, parameter, table, told, value};
use super::meshes::side_by_side;
use crate::suite::analysis::contest::{Asked, Contest, doubt};
use crate::suite::analysis::measures::{
    BETA, EDGES, MEAN_ANGLE, MIN_ANGLE, Measure, P05_ANGLE, SIZE_EFFICIENCY, TIME, TRIANGLES, UNDER_20, UNDER_30,
};
use crate::suite::analysis::results::Results;
use crate::suite::analysis::series::TimeSeries;
use crate::suite::analysis::summary::measured;
use crate::suite::charts::{self, ChartError};
use crate::suite::rows::numbers::{distinct, first_seen, quantile};
use crate::suite::rows::record::{Outcome, Report};
use crate::suite::run::plan::Section;
use crate::suite::run::tune::{NEAR, is_near};

/// The rows of the section at equal edge length and at equal count, and those by which time is followed.
fn contests(results: &Results) -> [Contest<'_>; 3] {
    [
        results.at_equal_size(Section::Methods),
        results.at_equal_count(Section::Methods),
        Contest::of(results.of(Section::Time)),
    ]
}

/// Tables at equal edge length and at equal count, and of time; empty where one method ran alone.
pub(super) fn text(results: &Results) -> String {
    let [size, count, time] = contests(results);
    let mut text = String::new();
    if size.has_several_meshers() {
        text += &format!(
            "### At equal edge length\n\nEvery mesher is asked for edges of length s = c_b f, on {}. {}\n\n",
            tasks_told(&size),
            MEDIANS
        );
        text += &method_table(&size, &time);
        text += &by_t_and_c_b(&size);
    }
    if count.has_several_meshers() {
        text += &format!(
            "### At equal triangle count\n\nThe spacing stays, c_b is scaled until a mesh has as many triangles as asked \
             for, within {:.0} %, on {}. {} {MEDIANS}\n\n",
            100.0 * NEAR,
            tasks_told(&count),
            misses(&count)
        );
        text += &method_table(&count, &time);
    }
    if time.has_several_meshers() {
        text += &format!("### Time\n\n{}", time_table(&time));
    }
    text
}

const MEDIANS: &str = "Numbers are medians over the tasks that every mesher in the table measured; who has not measured \
                       all is counted in the first columns.";

/// What the tasks of a contest are.
fn tasks_told(contest: &Contest) -> String {
    let domains = first_seen(contest.tasks.iter().map(|asked| asked.domain.as_str())).len();
    let values = |value: fn(&Asked) -> f64| {
        let all = distinct(contest.tasks.iter().map(value));
        all.into_iter().map(parameter).collect::<Vec<_>>().join(", ")
    };
    let counts = distinct(
        contest
            .tasks
            .iter()
            .filter_map(|asked| asked.triangles)
            .map(|n| n as f64),
    );
    let counts: Vec<String> = counts.into_iter().map(parameter).collect();
    let counts = if counts.is_empty() {
        String::new()
    } else {
        format!(", for {} triangles", counts.join(" or "))
    };
    let all: Vec<usize> = (0..contest.tasks.len()).collect();
    let spacings = contest.by_spacing(&all).into_iter().map(|(title, tasks)| {
        let specs = first_seen(tasks.iter().map(|task| contest.tasks[*task].spacing.as_str())).join("`, `");
        let count = tasks.len();
        if specs == title {
            format!("{count} with `{title}`")
        } else {
            format!("{count} with {title}, that is `{specs}`")
        }
    });
    format!(
        "{} tasks: {} domains, t = {}, c_b = {}{counts}; {}",
        contest.tasks.len(),
        domains,
        values(|asked| asked.t),
        values(|asked| asked.c_b),
        spacings.collect::<Vec<_>>().join("; ")
    )
}

/// How many meshes missed the count asked for, and by how much.
fn misses(contest: &Contest) -> String {
    let all = contest.all().into_iter().flat_map(|k| contest.rows(k));
    let reached = all.filter_map(|row| Some((row.cell.triangles?, measured(row)?.statistics.triangles as u64)));
    let reached: Vec<(u64, u64)> = reached.collect();
    let off: Vec<f64> = reached
        .iter()
        .filter(|(wanted, count)| !is_near(*count, *wanted))
        .map(|(wanted, count)| (*count as f64 / *wanted as f64 - 1.0).abs())
        .collect();
    match quantile(off.clone(), 1.0) {
        None => format!("All {} meshes came so near.", reached.len()),
        Some(most) => format!(
            "{} of {} meshes did not come so near, the farthest being {} % off.",
            off.len(),
            reached.len(),
            number(100.0 * most)
        ),
    }
}

/// The columns of [`method_table`] that are medians.
const MEDIANS_OF: [Measure; 12] = [
    TRIANGLES,
    SIZE_EFFICIENCY,
    MIN_ANGLE,
    MEAN_ANGLE,
    P05_ANGLE,
    UNDER_20,
    UNDER_30,
    BETA,
    EDGES[0],
    EDGES[1],
    EDGES[2],
    TIME,
];

/// A line for each method.
fn method_table(contest: &Contest, time: &Contest) -> String {
    let common = contest.common(&contest.all());
    let line = |k: usize| {
        let asked = contest.rows(k).count();
        let count = |outcome| match contest.count(k, outcome) {
            0 => "0".to_string(),
            some => format!("{some} of {asked}"),
        };
        let median = |by: &Measure| match *by == TIME {
            true => micros(contest, k, &common),
            false => value(by, contest.median(k, &common, by.value)),
        };
        let label = &contest.methods[k].label;
        let timed = time.methods.iter().position(|method| method.label == *label);
        let growth = timed.and_then(|k| Some(TimeSeries::of_method(time, k).fit()?.slope));
        let mut cells = vec![label.clone()];
        cells.extend([Outcome::Measured, Outcome::Skipped, Outcome::Declined, Outcome::Failed].map(count));
        cells.extend(MEDIANS_OF.iter().map(median));
        let least = quantile(contest.values(k, &common, MIN_ANGLE.value), 0.0);
        cells.extend([value(&MIN_ANGLE, least), number(growth)]);
        cells
    };
    let lines: Vec<_> = contest.all().into_iter().map(line).collect();
    let labels = MEDIANS_OF.map(|measure| measure.label());
    let mut head = vec!["mesher", "measured", "skipped", "declined", "failed"];
    head.extend(labels.iter().map(String::as_str));
    head.extend(["smallest angle of all (°)", "growth of time"]);
    format!(
        "{} of {} tasks were measured by all. Smallest angles leave out triangles at input angles under 60°; growth is the \
         slope of log seconds against log triangles. Times are of cells that ran alone, with repeats that spread by less than 0.1 of \
         their median.\n\n",
        common.len(),
        contest.tasks.len()
    ) + &table(&head, &lines)
}

/// Median time a triangle over some tasks: of how many, where not all times can be believed.
fn micros(contest: &Contest, method: usize, tasks: &[usize]) -> String {
    let values = contest.values(method, tasks, TIME.value);
    let (quiet, all) = (values.len(), tasks.len());
    match quantile(values, 0.5) {
        Some(micros) if quiet == all => number(micros),
        Some(micros) => format!("{} ({quiet} of {all})", number(micros)),
        None => doubt(contest.rows(method).filter_map(measured)).into(),
    }
}

/// Smallest and mean angle and size efficiency for each t and c_b, where there are several.
fn by_t_and_c_b(contest: &Contest) -> String {
    let ts = distinct(contest.tasks.iter().map(|asked| asked.t));
    let c_bs = distinct(contest.tasks.iter().map(|asked| asked.c_b));
    if ts.len() * c_bs.len() < 4 || contest.most_t() < 2 {
        return String::new();
    }
    let leads = contest.leads();
    let mut head = vec!["t".to_string(), "c_b".to_string(), "tasks".to_string()];
    head.extend(leads.iter().map(|k| contest.methods[*k].label.clone()));
    let line = |t: f64, c_b: f64| {
        let here = contest.only(|asked| asked.t == t && asked.c_b == c_b);
        let common = here.common(&leads);
        let three = |k: &usize| {
            let told = |by: Measure| told(&by, here.median(*k, &common, by.value));
            [MIN_ANGLE, MEAN_ANGLE, SIZE_EFFICIENCY].map(told).join(" · ")
        };
        let count = format!("{} of {}", common.len(), here.tasks.len());
        let own = leads.iter().map(three);
        [parameter(t), parameter(c_b), count]
            .into_iter()
            .chain(own)
            .collect::<Vec<_>>()
    };
    let lines: Vec<_> = ts.iter().flat_map(|t| c_bs.iter().map(|c_b| line(*t, *c_b))).collect();
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    "Smallest angle · mean smallest angle · size efficiency, medians over the tasks that all measured:\n\n".to_string()
        + &table(&head, &lines)
}

/// Time a triangle at the fewest and the most triangles, growth, and ratios to the first method on the same tasks.
fn time_table(time: &Contest) -> String {
    let head = [
        "mesher",
        "measured",
        "triangles",
        "µs per triangle, fewest",
        "most",
        "growth",
        "seconds over the first's",
    ];
    let line = |k: usize| {
        let points = TimeSeries::of_method(time, k).points;
        let by_count = |least: bool| {
            let order = |a: &&(f64, f64), b: &&(f64, f64)| a.0.total_cmp(&b.0);
            let end = if least {
                points.iter().min_by(order)
            } else {
                points.iter().max_by(order)
            };
            end.copied()
        };
        let ends = [by_count(true), by_count(false)];
        let each = ends.map(|end| number(end.map(|(triangles, seconds)| 1e6 * seconds / triangles)));
        let ratios = time.pairs([0, k], Report::believable_seconds);
        let ratios: Vec<f64> = ratios.iter().map(|(_, [first, own])| own / first).collect();
        vec![
            time.methods[k].label.clone(),
            format!("{} of {}", points.len(), time.rows(k).count()),
            ends.map(|end| number(end.map(|end| end.0))).join(" to "),
            each[0].clone(),
            each[1].clone(),
            number(TimeSeries::of_method(time, k).fit().map(|line| line.slope)),
            number(quantile(ratios, 0.5)),
        ]
    };
    let lines: Vec<_> = time.all().into_iter().map(line).collect();
    "Cells run alone and repeated; each time is the median of its repeats. Growth is the slope of log seconds against log \
     triangles; the last column is the median over the tasks that both measured.\n\n"
        .to_string()
        + &table(&head, &lines)
}

/// Both ways of asking, and time.
pub(super) fn charts(results: &Results, drawer: &mut Drawer) -> Result<(), ChartError> {
    let [size, count, time] = contests(results);
    charts_of(&size, "edge length", "meshers", drawer)?;
    charts_of(&count, "triangle count", "meshers-count", drawer)?;
    if time.has_several_meshers() {
        let caption = "Seconds against triangles for each method, with the slopes of fitted lines.";
        charts::time_by_method(&time, &drawer.chart("meshers-time", caption))?;
    }
    side_by_side(&size, drawer)
}

/// Medians of each method, how triangles spread over angles, and where there are several t, medians against these.
fn charts_of(contest: &Contest, equal: &str, name: &str, drawer: &mut Drawer) -> Result<(), ChartError> {
    if !contest.has_several_meshers() {
        return Ok(());
    }
    let caption = format!("Methods at equal {equal}: median over the tasks that all measured, and the range.");
    charts::methods(contest, &drawer.chart(name, &caption))?;
    let leads = contest.leads();
    let caption =
        format!("How triangles spread over smallest angles, for each mesher at equal {equal}; mean over meshes.");
    charts::angles_by_method(contest, &leads, &drawer.chart(&format!("{name}-angles"), &caption))?;
    if contest.most_t() > 2 {
        let caption = "Medians over the tasks that all meshers measured, against t.";
        charts::methods_against_t(contest, &leads, &drawer.chart(&format!("{name}-against-t"), caption))?;
    }
    Ok(())
}
