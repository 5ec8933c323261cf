//! The places of all methods by each measure, variants included: the best variant of another may win where its default loses.

use super::markdown::{number, table, value};
use crate::suite::analysis::contest::Contest;
use crate::suite::analysis::measures::{MIN_ANGLE, Measure, TIME, TRIANGLES};
use crate::suite::analysis::results::{Asking, Results};
use crate::suite::rows::numbers::median;
use crate::suite::run::plan::Section;

/// The methods by one measure, best first: median over the tasks that all of them measured.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Ranking {
    /// What it is by.
    pub(super) by: Measure,
    /// Methods as indices into the contest's, with their medians.
    pub(super) order: Vec<(usize, f64)>,
}

impl Ranking {
    fn of(contest: &Contest, tasks: &[usize], by: Measure) -> Self {
        let methods = contest.all();
        let tasks = contest.having(&methods, tasks, by.value);
        let mut order: Vec<(usize, f64)> = methods
            .into_iter()
            .filter_map(|method| Some((method, contest.median(method, &tasks, by.value)?)))
            .collect();
        order.sort_by(|a, b| by.gain(b.1, a.1).total_cmp(&0.0).then(a.0.cmp(&b.0)));
        Self { by, order }
    }

    /// The place of a method, from 1, shared by those with its median; and that median.
    pub(super) fn place(&self, method: usize) -> Option<(usize, f64)> {
        let own = self.order.iter().find(|(other, _)| *other == method)?.1;
        let ahead = self.order.iter().position(|(_, median)| *median == own)?;
        Some((ahead + 1, own))
    }
}

/// One ranking a measure; none where there is nobody to compare with.
pub(super) fn rankings(Asking { contest, measures, .. }: &Asking) -> Vec<Ranking> {
    let common = contest.common(&contest.all());
    if !contest.has_several_meshers() || common.is_empty() {
        return Vec::new();
    }
    measures.iter().map(|by| Ranking::of(contest, &common, *by)).collect()
}

/// For each way of asking who is best on which task, and the places of all.
pub(super) fn text(results: &Results) -> String {
    let one = |asking: &Asking| best_table(asking, &results.about) + &rank_table(asking);
    results.askings(Section::Duels).iter().map(one).collect()
}

fn rank_table(asking: &Asking) -> String {
    let (contest, rankings) = (&asking.contest, rankings(asking));
    if rankings.is_empty() {
        return String::new();
    }
    let labels: Vec<String> = rankings.iter().map(|ranking| ranking.by.label()).collect();
    let mut head = vec!["mesher"];
    head.extend(labels.iter().map(String::as_str));
    let line = |method: usize| {
        let places = rankings.iter().map(|ranking| match ranking.place(method) {
            Some((place, median)) => format!("{place} ({})", value(&ranking.by, median)),
            None => "–".to_string(),
        });
        let label = contest.methods[method].label.clone();
        std::iter::once(label).chain(places).collect()
    };
    let lines: Vec<Vec<String>> = contest.all().into_iter().map(line).collect();
    let title = asking.title;
    format!("### Places among all methods, at {title}\n\nBy medians over the tasks that all of them measured.\n\n")
        + &table(&head, &lines)
}

/// Where the mesher in question stands among all methods.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let one = |asking: &Asking| rank_finding(asking, &results.about);
    results.askings(Section::Duels).iter().filter_map(one).collect()
}

fn rank_finding(asking: &Asking, about: &str) -> Option<String> {
    let contest = &asking.contest;
    let ours = contest.lead_of(about)?;
    let places = rankings(asking).into_iter().filter_map(|ranking| {
        let is_told = [MIN_ANGLE, TRIANGLES, TIME].contains(&ranking.by);
        let place = ranking.place(ours).filter(|_| is_told)?.0;
        Some((ordinal(place as f64), ranking.by.title))
    });
    let places: Vec<(String, &str)> = places.collect();
    let (place, title) = places.first()?;
    let others: String = places[1..]
        .iter()
        .map(|(place, title)| format!(", {place} by {title}"))
        .collect();
    let (label, count) = (&contest.methods[ours].label, contest.methods.len());
    Some(format!(
        "At {} {label} is {place} of {count} methods by {title}{others}.",
        asking.title
    ))
}

/// `4th`; a place may lie between two.
fn ordinal(place: f64) -> String {
    let ending = match (place % 10.0, place % 100.0) {
        (_, 11.0 | 12.0 | 13.0) => "th",
        (1.0, _) => "st",
        (2.0, _) => "nd",
        (3.0, _) => "rd",
        _ => "th",
    };
    format!("{place}{ending}")
}

/// Who is best by one measure, task by task.
struct Best {
    /// Methods that are best somewhere, with on how many tasks; the one of most first.
    winners: Vec<(String, usize)>,
    /// Median over tasks of the place of ours.
    place: Option<f64>,
    /// Median over tasks of ours over the best.
    ratio: Option<f64>,
}

impl Best {
    fn of(contest: &Contest, ours: usize, by: &Measure) -> Self {
        let mut winners: Vec<(String, usize)> = Vec::new();
        let (mut places, mut ratios) = (Vec::new(), Vec::new());
        for task in 0..contest.tasks.len() {
            let of = |method: usize| (by.value)(contest.report(method, task)?);
            let mut all: Vec<(usize, f64)> = contest.all().into_iter().filter_map(|k| Some((k, of(k)?))).collect();
            all.sort_by(|a, b| by.gain(b.1, a.1).total_cmp(&0.0));
            let Some(&(first, top)) = all.first() else { continue };
            let name = contest.methods[first].label.clone();
            match winners.iter_mut().find(|(known, _)| *known == name) {
                Some((_, count)) => *count += 1,
                None => winners.push((name, 1)),
            }
            if let Some(own) = of(ours) {
                places.push(1.0 + all.iter().filter(|(_, other)| by.gain(*other, own) > 0.0).count() as f64);
                // Nothing is a number of times nothing.
                if top != 0.0 {
                    ratios.push(own / top);
                }
            }
        }
        winners.sort_by_key(|winner| std::cmp::Reverse(winner.1));
        Self {
            winners,
            place: median(places),
            ratio: median(ratios),
        }
    }
}

fn best_table(
    Asking {
        title,
        contest,
        measures,
        ..
    }: &Asking,
    about: &str,
) -> String {
    let Some(ours) = contest.lead_of(about).filter(|_| contest.has_several_meshers()) else {
        return String::new();
    };
    let line = |by: &Measure| {
        let best = Best::of(contest, ours, by);
        let winners = best.winners.iter().map(|(name, count)| format!("{name} on {count}"));
        vec![
            by.label(),
            winners.collect::<Vec<_>>().join(", "),
            best.place.map_or("–".into(), ordinal),
            number(best.ratio),
        ]
    };
    let label = &contest.methods[ours].label;
    let (place, ratio) = (format!("place of {label}"), format!("{label} over the best"));
    let head = ["", "best", place.as_str(), ratio.as_str()];
    format!(
        "### Who is best, at {title}\n\nTask by task over {} tasks; place and ratio are medians over the tasks.\n\n",
        contest.tasks.len()
    ) + &table(&head, &measures.iter().map(line).collect::<Vec<_>>())
}

/// Who has the best smallest angle and who is fastest, and how far ours is from these.
pub(super) fn best_findings(results: &Results) -> Vec<String> {
    let of = |asking: &Asking| {
        [MIN_ANGLE, TIME]
            .into_iter()
            .filter_map(|by| best_finding(asking, &results.about, by))
            .collect::<Vec<_>>()
    };
    results.askings(Section::Duels).iter().flat_map(of).collect()
}

fn best_finding(Asking { title, contest, .. }: &Asking, about: &str, by: Measure) -> Option<String> {
    let ours = contest.lead_of(about)?;
    let best = Best::of(contest, ours, &by);
    let (winner, count) = best.winners.first()?;
    Some(format!(
        "At {title} {winner} has the best {} on {count} of {} tasks; {} is {} in the median, with {} times the best.",
        by.title,
        contest.tasks.len(),
        contest.methods[ours].label,
        ordinal(best.place?),
        number(best.ratio)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ordinals() {
        let all = [1.0, 2.0, 3.0, 4.0, 11.0, 12.0, 13.0, 21.0, 102.0, 113.0, 2.5].map(ordinal);
        let expected = "1st 2nd 3rd 4th 11th 12th 13th 21st 102nd 113th 2.5th";
        assert_eq!(all.join(" "), expected);
    }

    #[test]
    fn equal_medians_share_a_place() {
        let ranking = Ranking {
            by: MIN_ANGLE,
            order: vec![(2, 30.0), (0, 28.0), (3, 28.0), (1, 9.0)],
        };
        let places = [0, 1, 2, 3].map(|method| ranking.place(method).unwrap().0);
        assert_eq!(places, [2, 4, 1, 2]);
        assert_eq!(ranking.place(7), None);
    }
}
