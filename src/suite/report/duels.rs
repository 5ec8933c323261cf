//! Where the mesher in question wins, where it loses and why: task by task against each of the others.

use super::drawer::Drawer;
use super::markdown::{signed, table, told, value};
use super::ranks;
use crate::suite::analysis::contest::Contest;
use crate::suite::analysis::measures::{MEAN_ANGLE, MIN_ANGLE, Measure};
use crate::suite::analysis::results::{Asking, Results};
use crate::suite::analysis::summary::{Setting, setting};
use crate::suite::charts::{self, ChartError};
use crate::suite::peers::is_peer;
use crate::suite::rows::numbers::median;
use crate::suite::run::plan::Section;

/// Ours against another by one measure, over the tasks that both measured.
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
    /// The tasks where ours is best and worst off, with ours less theirs there.
    pub(super) ends: [(usize, f64); 2],
}

/// Less than this share of the larger value is no difference.
const TIE: f64 = 1e-3;

/// Holds ours against another; absent where no task was measured by both.
pub(super) fn duel(contest: &Contest, [ours, other]: [usize; 2], by: &Measure) -> Option<Duel> {
    let mut pairs = contest.pairs([ours, other], by.value);
    let gain = |[own, other]: [f64; 2]| by.gain(own, other);
    let is_tie = |pair: [f64; 2]| gain(pair).abs() <= TIE * pair[0].abs().max(pair[1].abs());
    let count = |wins: bool| {
        let decided = pairs.iter().filter(|(_, pair)| !is_tie(*pair));
        decided.filter(|(_, pair)| (gain(*pair) > 0.0) == wins).count()
    };
    let of = |value: fn([f64; 2]) -> f64| median(pairs.iter().map(|(_, pair)| value(*pair)).collect());
    let (better, worse) = (count(true), count(false));
    let (ours, theirs) = (of(|[own, _]| own)?, of(|[_, other]| other)?);
    let difference = of(|[own, other]| own - other)?;
    pairs.sort_by(|a, b| gain(b.1).total_cmp(&gain(a.1)).then(a.0.cmp(&b.0)));
    Some(Duel {
        better,
        worse,
        of: pairs.len(),
        ours,
        theirs,
        difference,
        ends: [*pairs.first()?, *pairs.last()?].map(|(task, [own, other])| (task, own - other)),
    })
}

/// Ours, and the others by their defaults.
fn sides(contest: &Contest, about: &str) -> Option<(usize, Vec<usize>)> {
    let ours = contest.lead_of(about)?;
    let others: Vec<usize> = contest.leads().into_iter().filter(|k| *k != ours).collect();
    (!others.is_empty()).then_some((ours, others))
}

/// Task by task against each of the others, and the places of all.
pub(super) fn text(results: &Results) -> String {
    let mut text = String::new();
    for asking in results.askings(Section::Duels) {
        let Some((ours, others)) = sides(&asking.contest, &results.about) else {
            continue;
        };
        text += &others
            .iter()
            .map(|&other| against(&asking, [ours, other]))
            .collect::<String>();
        text += &by_setting(&asking, ours, &others);
    }
    text + &ranks::text(results)
}

/// Smallest and mean angles domain by domain.
pub(super) fn charts(results: &Results, drawer: &mut Drawer) -> Result<(), ChartError> {
    let names = ["meshers-domains", "meshers-count-domains"];
    for (Asking { title, contest, .. }, name) in results.askings(Section::Duels).iter().zip(names) {
        if contest.has_several_meshers() {
            let caption = format!("Smallest and mean angle of each mesher on each domain at {title}.");
            charts::domains(contest, &contest.leads(), &drawer.chart(name, &caption))?;
        }
    }
    Ok(())
}

/// The place of ours, then the others one by one; beside peers, who are too many for that, who is best.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let has_peers = results.rows.iter().any(|row| is_peer(&row.cell.mesher));
    let compared = if has_peers {
        ranks::best_findings(results)
    } else {
        duel_findings(results)
    };
    ranks::findings(results).into_iter().chain(compared).collect()
}

fn against(
    Asking {
        title,
        contest,
        measures,
        reasons,
    }: &Asking,
    sides: [usize; 2],
) -> String {
    let [own, other] = sides.map(|k| contest.methods[k].label.as_str());
    let place = |(task, difference): (usize, f64)| {
        let asked = &contest.tasks[task];
        let spacing = asked.spacing.split(':').next().unwrap_or_default();
        format!("{} ({} {spacing})", signed(difference), asked.domain)
    };
    let line = |by: &Measure| {
        let duel = duel(contest, sides, by)?;
        Some(vec![
            by.label(),
            format!("{} of {}", duel.better, duel.of),
            format!("{} of {}", duel.worse, duel.of),
            value(by, duel.ours),
            value(by, duel.theirs),
            signed(duel.difference),
            place(duel.ends[0]),
            place(duel.ends[1]),
        ])
    };
    let lines: Vec<_> = measures.iter().chain(*reasons).filter_map(line).collect();
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
    let body = match lines.is_empty() {
        true => "No task was measured by both.\n\n".to_owned(),
        false => table(&head, &lines),
    };
    format!("### {own} against {other}, at {title}\n\n{body}")
}

/// Differences of smallest and mean angle where the theorem's hypotheses hold, where circles meet low, and where segments
/// meet at acute angles, for each spacing.
fn by_setting(Asking { title, contest, .. }: &Asking, ours: usize, others: &[usize]) -> String {
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
            let one = |other: usize, by: &Measure| {
                let pairs = contest.pairs([ours, other], by.value).into_iter();
                let gains = pairs.filter(|(task, _)| own.contains(task)).map(|(_, [a, b])| a - b);
                let gains: Vec<f64> = gains.collect();
                let won = gains.iter().filter(|gain| **gain > 0.0).count();
                let of = gains.len();
                format!("{} ({won} of {of})", signed(median(gains)))
            };
            let two = |other: &usize| [MIN_ANGLE, MEAN_ANGLE].map(|by| one(*other, &by)).join(" · ");
            let cells = [spacing.clone(), words.to_string(), own.len().to_string()];
            lines.push(cells.into_iter().chain(others.iter().map(two)).collect());
        }
    }
    let own = &contest.methods[ours].label;
    format!(
        "### Where, at {title}\n\nSmallest angle · mean smallest angle of {own} less those of the other, in degrees: medians over \
         the tasks that both measured, and on how many of these it wins, by what the paper's theorem assumes.\n\n"
    ) + &table(&head, &lines)
}

/// A sentence for each of the others and each way of asking: in how many measures ours is better on most tasks, and the first
/// of them with the one that is not equal by asking.
fn duel_findings(results: &Results) -> Vec<String> {
    let askings = results.askings(Section::Duels);
    let of = |asking: &Asking| {
        let Some((ours, others)) = sides(&asking.contest, &results.about) else {
            return Vec::new();
        };
        let others = others.into_iter();
        others.filter_map(|other| duel_finding(asking, [ours, other])).collect()
    };
    askings.iter().flat_map(of).collect()
}

fn duel_finding(
    Asking {
        title,
        contest,
        measures,
        ..
    }: &Asking,
    sides: [usize; 2],
) -> Option<String> {
    let [own, other] = sides.map(|k| contest.methods[k].label.as_str());
    let duels: Vec<(&Measure, Duel)> = measures
        .iter()
        .filter_map(|by| Some((by, duel(contest, sides, by)?)))
        .collect();
    let won = duels.iter().filter(|(_, duel)| duel.better > duel.worse).count();
    let compared = duels.iter().filter(|(by, _)| [MIN_ANGLE, MEAN_ANGLE].contains(by));
    let compared = compared.map(|(by, duel)| {
        let [ours, theirs] = [duel.ours, duel.theirs].map(|value| told(by, value));
        format!("{} {ours} against {theirs}", by.title)
    });
    let compared: Vec<String> = compared.collect();
    let of = duels.len();
    (of > 0).then(|| {
        format!(
            "At {title} {own} is better than {other} in {won} of {of} measures; {}.",
            compared.join(", ")
        )
    })
}
