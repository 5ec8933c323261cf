//! Where the mesher in question wins, where it loses and why: task by task against each of the others.

use super::drawer::Drawer;
use super::markdown::{number, table};
use super::ranks;
use crate::suite::analysis::contest::{Contest, seconds_per_triangle};
use crate::suite::analysis::remarks::gap_share;
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::{Setting, setting};
use crate::suite::charts::{self, ChartError};
use crate::suite::peers::is_peer;
use crate::suite::rows::numbers::median;
use crate::suite::rows::record::Report;
use crate::suite::run::plan::Section;

/// A number two methods are compared by on the same task.
#[derive(Clone, Copy)]
pub(super) struct Yardstick {
    pub(super) name: &'static str,
    pub(super) value: fn(&Report) -> Option<f64>,
    /// 1 where more is better, −1 where less is.
    pub(super) sign: f64,
    /// Whether it says something at equal count too.
    pub(super) at_equal_count: bool,
}

/// Angles first; then size, gaps, time.
pub(super) const YARDSTICKS: [Yardstick; 7] = [
    yardstick(
        "smallest angle (°)",
        |report| report.statistics.min_angle_free_deg,
        1.0,
        true,
    ),
    yardstick(
        "mean smallest angle (°)",
        |report| Some(report.statistics.mean_min_angle_deg),
        1.0,
        true,
    ),
    yardstick(
        "5th percentile (°)",
        |report| Some(report.statistics.p05_min_angle_deg),
        1.0,
        true,
    ),
    yardstick(
        "under 30° (%)",
        |report| Some(100.0 * report.statistics.share_under(30)),
        -1.0,
        true,
    ),
    yardstick(
        "triangles",
        |report| Some(report.statistics.triangles as f64),
        -1.0,
        false,
    ),
    // Relative to a mesher's own c_b, which at equal count is another for each.
    yardstick("β", |report| report.statistics.beta, -1.0, false),
    yardstick(
        "µs per triangle",
        |report| Some(1e6 * seconds_per_triangle(report)?),
        -1.0,
        true,
    ),
];

const fn yardstick(
    name: &'static str,
    value: fn(&Report) -> Option<f64>,
    sign: f64,
    at_equal_count: bool,
) -> Yardstick {
    Yardstick {
        name,
        value,
        sign,
        at_equal_count,
    }
}

/// Ours against one rival by one yardstick, over the tasks that both measured.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Duel {
    pub(super) better: usize,
    pub(super) worse: usize,
    /// Tasks that both measured.
    pub(super) of: usize,
    pub(super) ours: f64,
    pub(super) theirs: f64,
    /// Median over tasks of ours less theirs.
    pub(super) difference: f64,
    /// The tasks where ours is best and worst off, with the difference there.
    pub(super) ends: [(usize, f64); 2],
}

/// Less than this share of the larger value is no difference.
const TIE: f64 = 1e-3;

/// Holds ours against a rival; absent where no task was measured by both.
pub(super) fn duel(contest: &Contest, ours: usize, rival: usize, by: Yardstick) -> Option<Duel> {
    let pairs = contest.pairs([ours, rival], by.value);
    let gain = |[own, other]: [f64; 2]| by.sign * (own - other);
    let is_tie = |pair: [f64; 2]| gain(pair).abs() <= TIE * pair[0].abs().max(pair[1].abs());
    let of = |value: &dyn Fn([f64; 2]) -> f64| median(pairs.iter().map(|(_, pair)| value(*pair)).collect());
    let mut sorted: Vec<_> = pairs.iter().map(|(task, pair)| (*task, gain(*pair))).collect();
    sorted.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    Some(Duel {
        better: pairs
            .iter()
            .filter(|(_, pair)| !is_tie(*pair) && gain(*pair) > 0.0)
            .count(),
        worse: pairs
            .iter()
            .filter(|(_, pair)| !is_tie(*pair) && gain(*pair) < 0.0)
            .count(),
        of: pairs.len(),
        ours: of(&|[own, _]| own)?,
        theirs: of(&|[_, other]| other)?,
        difference: of(&|[own, other]| own - other)?,
        ends: [*sorted.first()?, *sorted.last()?].map(|(task, gain)| (task, by.sign * gain)),
    })
}

/// Ours, and the others by their defaults.
fn sides(contest: &Contest, about: &str) -> Option<(usize, Vec<usize>)> {
    let ours = contest.lead_of(about)?;
    let others: Vec<usize> = contest.leads().into_iter().filter(|k| *k != ours).collect();
    (!others.is_empty()).then_some((ours, others))
}

/// The two ways of asking, and whether it is that of equal count.
pub(super) fn contests(results: &Results) -> [(&'static str, Contest<'_>, bool); 2] {
    [
        ("equal edge length", results.at_equal_size(Section::Duels), false),
        ("equal triangle count", results.at_equal_count(Section::Duels), true),
    ]
}

/// Task by task against each of the others, and the places of all.
pub(super) fn text(results: &Results) -> String {
    let mut text = String::new();
    for (title, contest, is_count) in contests(results) {
        let Some((ours, others)) = sides(&contest, &results.about) else {
            continue;
        };
        for rival in others {
            text += &against(&contest, ours, rival, title, is_count);
            if !is_count && !contest.pairs([ours, rival], |_| Some(0.0)).is_empty() {
                text += &why(&contest, ours, rival);
            }
        }
        text += &by_setting(&contest, ours, title);
    }
    text + &ranks::ranks(results)
}

/// Smallest and mean angles domain by domain.
pub(super) fn charts(results: &Results, drawer: &mut Drawer) -> Result<(), ChartError> {
    for (title, contest, is_count) in contests(results) {
        if contest.has_several_meshers() {
            let name = if is_count {
                "meshers-count-domains"
            } else {
                "meshers-domains"
            };
            let caption = format!("Smallest and mean angle of each mesher on each domain at {title}.");
            charts::domains(&contest, &contest.leads(), &drawer.chart(name, &caption))?;
        }
    }
    Ok(())
}

/// The comparison in short. Beside peers there are too many others for a line each.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let has_peers = results.rows.iter().any(|row| is_peer(&row.cell.mesher));
    let compared = if has_peers {
        ranks::best_findings(results)
    } else {
        duel_findings(results)
    };
    compared.into_iter().chain(ranks::rank_finding(results)).collect()
}

fn against(contest: &Contest, ours: usize, rival: usize, title: &str, is_count: bool) -> String {
    let [own, other] = [ours, rival].map(|k| contest.methods[k].label.as_str());
    let place = |(task, difference): (usize, f64)| {
        let asked = &contest.tasks[task];
        let spacing = asked.spacing.split(':').next().unwrap_or_default();
        format!("{} ({} {spacing})", signed(difference), asked.domain)
    };
    let line = |by: &Yardstick| {
        let duel = duel(contest, ours, rival, *by)?;
        Some(vec![
            by.name.to_string(),
            format!("{} of {}", duel.better, duel.of),
            format!("{} of {}", duel.worse, duel.of),
            number(duel.ours),
            number(duel.theirs),
            signed(duel.difference),
            place(duel.ends[0]),
            place(duel.ends[1]),
        ])
    };
    let wanted = YARDSTICKS.iter().filter(|by| by.at_equal_count || !is_count);
    let lines: Vec<_> = wanted.filter_map(line).collect();
    if lines.is_empty() {
        return format!("### {own} against {other}, at {title}\n\nNo task was measured by both.\n\n");
    }
    let head = [
        "",
        "better",
        "worse",
        own,
        other,
        "median difference",
        "best off",
        "worst off",
    ];
    format!("### {own} against {other}, at {title}\n\n") + &table(&head, &lines)
}

/// What the difference comes from, in numbers.
fn why(contest: &Contest, ours: usize, rival: usize) -> String {
    let [own, other] = [ours, rival].map(|k| contest.methods[k].label.as_str());
    let both = |value: fn(&Report) -> Option<f64>| {
        let pairs = contest.pairs([ours, rival], value);
        [0, 1].map(|side| number(median(pairs.iter().map(|(_, pair)| pair[side]).collect())))
    };
    let edge = |value: fn(&crate::quality::Percentiles) -> f64| {
        let pairs = contest.pairs([ours, rival], |report| {
            report.statistics.edge_over_size.as_ref().map(|_| 0.0)
        });
        let side = |k: usize| {
            let tasks: Vec<usize> = pairs.iter().map(|(task, _)| *task).collect();
            number(contest.median(k, &tasks, |report| report.statistics.edge_over_size.as_ref().map(value)))
        };
        [side(ours), side(rival)]
    };
    let (gaps, beta, efficiency) = (
        both(|report| gap_share(report).map(|share| 100.0 * share)),
        both(|report| report.statistics.beta),
        both(|report| Some(report.size_efficiency)),
    );
    let (short, middle, long) = (edge(|p| p.p05), edge(|p| p.p50), edge(|p| p.p95));
    format!(
        "Why: circles at a gap, {own} {} %, {other} {} %, with β {} and {}; edges over s at 5, 50 and 95 %, {own} {}, {} \
         and {}, {other} {}, {} and {}; so for the same s, size efficiency {} and {}.\n\n",
        gaps[0],
        gaps[1],
        beta[0],
        beta[1],
        short[0],
        middle[0],
        long[0],
        short[1],
        middle[1],
        long[1],
        efficiency[0],
        efficiency[1]
    )
}

/// Differences of smallest and mean angle where the theorem's hypotheses hold, where circles meet low, and where segments
/// meet at acute angles, for each spacing.
fn by_setting(contest: &Contest, ours: usize, title: &str) -> String {
    let others: Vec<usize> = contest.leads().into_iter().filter(|k| *k != ours).collect();
    let all: Vec<usize> = (0..contest.tasks.len()).collect();
    let mut head = vec!["spacing", "setting", "tasks"];
    head.extend(others.iter().map(|k| contest.methods[*k].label.as_str()));
    let mut lines = Vec::new();
    for (spacing, tasks) in contest.by_spacing(&all) {
        for (of, words) in [
            (Setting::Papers, "hypotheses hold"),
            (Setting::LowOverlap, "circles meet low"),
            (Setting::Acute, "acute angles"),
        ] {
            let is_of = |task: &&usize| contest.report(ours, **task).is_some_and(|report| setting(report) == of);
            let own: Vec<usize> = tasks.iter().filter(is_of).copied().collect();
            if own.is_empty() {
                continue;
            }
            let told = |rival: usize, by: Yardstick| {
                let pairs = contest.pairs([ours, rival], by.value).into_iter();
                let gains = pairs.filter(|(task, _)| own.contains(task)).map(|(_, [a, b])| a - b);
                let gains: Vec<f64> = gains.collect();
                let won = gains.iter().filter(|gain| **gain > 0.0).count();
                let of = gains.len();
                format!("{} ({won} of {of})", signed(median(gains)))
            };
            let two = |rival: &usize| [YARDSTICKS[0], YARDSTICKS[1]].map(|by| told(*rival, by)).join(" · ");
            let cells = [spacing.clone(), words.to_string(), own.len().to_string()];
            lines.push(cells.into_iter().chain(others.iter().map(two)).collect());
        }
    }
    let own = &contest.methods[ours].label;
    format!(
        "### Where, at {title}\n\nSmallest angle · mean smallest angle of {own} less those of the rival, degrees, medians \
         over the tasks that both measured, and how many of these it wins, by what the paper's theorem assumes:\n\n"
    ) + &table(&head, &lines)
}

/// A number with its sign.
pub(super) fn signed(value: impl Into<Option<f64>>) -> String {
    match value.into() {
        Some(value) if value > 0.0 => format!("+{}", number(value)),
        other => number(other),
    }
}

/// The comparison in a line for each rival: by what ours wins on most tasks, and by what it loses.
pub(super) fn duel_findings(results: &Results) -> Vec<String> {
    let [(_, size, _), (_, count, _)] = contests(results);
    let Some((ours, others)) = sides(&size, &results.about) else {
        return Vec::new();
    };
    let line = |rival: usize| {
        let [own, other] = [ours, rival].map(|k| size.methods[k].label.as_str());
        let told = outcome(&size, ours, rival, false)?;
        let mut text = format!("**{own} : {other}**, at equal edge length: {told}");
        let twin = |label: &str| count.methods.iter().position(|method| method.label == label);
        if let (Some(ours), Some(rival)) = (twin(own), twin(other)) {
            let told = outcome(&count, ours, rival, true);
            text += &told.map_or_else(String::new, |told| format!(" At equal triangle count: {told}"));
        }
        Some(text)
    };
    others.into_iter().filter_map(line).collect()
}

/// "better in … ; worse in … ; even in …": each yardstick with both medians and on how many tasks ours is better.
fn outcome(contest: &Contest, ours: usize, rival: usize, is_count: bool) -> Option<String> {
    let wanted = YARDSTICKS.iter().filter(|by| by.at_equal_count || !is_count);
    let duels: Vec<(&str, Duel)> = wanted
        .filter_map(|by| Some((by.name, duel(contest, ours, rival, *by)?)))
        .collect();
    let part = |words: &str, belongs: fn(&Duel) -> bool| {
        let told = duels.iter().filter(|(_, duel)| belongs(duel)).map(|(name, duel)| {
            let (own, other) = (number(duel.ours), number(duel.theirs));
            format!("{name} {own} : {other} ({} of {})", duel.better, duel.of)
        });
        let told: Vec<String> = told.collect();
        (!told.is_empty()).then(|| format!("{words} {}", told.join(", ")))
    };
    let parts = [
        part("better in", |duel| duel.better > duel.worse),
        part("worse in", |duel| duel.better < duel.worse),
        part("even in", |duel| duel.better == duel.worse),
    ];
    let told: Vec<String> = parts.into_iter().flatten().collect();
    (!told.is_empty()).then(|| format!("{}.", told.join("; ")))
}
