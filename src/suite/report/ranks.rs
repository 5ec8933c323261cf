//! The places of all methods by each yardstick, variants included: the best variant of another may win where its default loses.

use super::duels::{YARDSTICKS, Yardstick, contests};
use super::markdown::{number, table};
use crate::suite::analysis::contest::Contest;
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::measured;
use crate::suite::rows::numbers::median;

/// The methods by one yardstick, best first: median over the tasks that all of them measured.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Ranking {
    /// What it is by.
    pub(super) name: &'static str,
    /// Methods as indices into the contest's, with their medians.
    pub(super) order: Vec<(usize, f64)>,
}

impl Ranking {
    fn by(contest: &Contest, tasks: &[usize], by: &Yardstick) -> Self {
        let medians = contest.all().into_iter();
        let mut order: Vec<(usize, f64)> = medians
            .filter_map(|method| Some((method, contest.median(method, tasks, by.value)?)))
            .collect();
        order.sort_by(|a, b| (by.sign * b.1).total_cmp(&(by.sign * a.1)).then(a.0.cmp(&b.0)));
        Self { name: by.name, order }
    }

    /// The place of a method, from 1, shared by those with its median; and that median.
    pub(super) fn place(&self, method: usize) -> Option<(usize, f64)> {
        let own = self.order.iter().find(|(other, _)| *other == method)?.1;
        let ahead = self.order.iter().position(|(_, median)| *median == own)?;
        Some((ahead + 1, own))
    }
}

/// One ranking a yardstick; none where there is nobody to compare with.
pub(super) fn rankings(contest: &Contest, is_count: bool) -> Vec<Ranking> {
    let common = contest.common(&contest.all());
    if !contest.has_several_meshers() || common.is_empty() {
        return Vec::new();
    }
    let wanted = YARDSTICKS.iter().filter(|by| by.at_equal_count || !is_count);
    wanted.map(|by| Ranking::by(contest, &common, by)).collect()
}

/// The part of the page: a table for each way of asking.
pub(super) fn ranks(results: &Results) -> String {
    contests(results)
        .iter()
        .map(|(title, contest, is_count)| rank_table(contest, &rankings(contest, *is_count), title))
        .collect()
}

fn rank_table(contest: &Contest, rankings: &[Ranking], title: &str) -> String {
    if rankings.is_empty() {
        return String::new();
    }
    let mut head = vec!["mesher"];
    head.extend(rankings.iter().map(|ranking| ranking.name));
    let line = |method: usize| {
        let places = rankings.iter().map(|ranking| match ranking.place(method) {
            Some((place, median)) => format!("{place} ({})", number(median)),
            None => "–".to_string(),
        });
        let label = contest.methods[method].label.clone();
        std::iter::once(label).chain(places).collect()
    };
    let lines: Vec<Vec<String>> = contest.all().into_iter().map(line).collect();
    format!("### Places among all methods, at {title}\n\nBy medians over the tasks that all of them measured.\n\n")
        + &table(&head, &lines)
}

/// Where the paper's method stands among all, variants included, and who is first, in a line.
pub(super) fn rank_finding(results: &Results) -> Option<String> {
    let [(_, contest, _), _] = contests(results);
    let ours = contest.lead_of(&results.about)?;
    if contest.leads().len() == contest.methods.len() {
        // Without variants the duels say all.
        return None;
    }
    let told = rankings(&contest, false).into_iter().filter_map(|ranking| {
        let (place, own) = ranking.place(ours)?;
        let (first, best) = *ranking.order.first()?;
        let name = ranking.name;
        Some(if place == 1 {
            format!("{name} 1st with {}", number(own))
        } else {
            let ahead = &contest.methods[first].label;
            format!(
                "{name} {} with {}, behind {ahead} with {}",
                ordinal(place),
                number(own),
                number(best)
            )
        })
    });
    let told: Vec<String> = told.collect();
    let (label, count) = (&contest.methods[ours].label, contest.methods.len());
    (!told.is_empty()).then(|| {
        format!(
            "**{label} among all {count} methods**, variants included, at equal edge length: {}.",
            told.join("; ")
        )
    })
}

fn ordinal(place: usize) -> String {
    let ending = match (place % 10, place % 100) {
        (_, 11..=13) => "th",
        (1, _) => "st",
        (2, _) => "nd",
        (3, _) => "rd",
        _ => "th",
    };
    format!("{place}{ending}")
}

/// Who is best by each yardstick, task by task, and where ours stands; a line for each way of asking.
pub(super) fn best_findings(results: &Results) -> Vec<String> {
    contests(results)
        .iter()
        .filter_map(|(title, contest, is_count)| {
            let wanted = YARDSTICKS.iter().filter(|by| by.at_equal_count || !is_count);
            let parts: Vec<String> = wanted.filter_map(|by| best(contest, &results.about, by)).collect();
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
fn best(contest: &Contest, about: &str, by: &Yardstick) -> Option<String> {
    let ours = contest.lead_of(about)?;
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
            place_of(place)
        )
    });
    (!names.is_empty()).then(|| format!("{}: {}{standing}", by.name, names.join(", ")))
}

/// A place that may lie between two.
fn place_of(place: f64) -> String {
    if place.fract() == 0.0 {
        ordinal(place as usize)
    } else {
        format!("{place}th")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ordinals() {
        let all = [1, 2, 3, 4, 11, 12, 13, 21, 102, 113].map(ordinal);
        assert_eq!(
            all,
            [
                "1st", "2nd", "3rd", "4th", "11th", "12th", "13th", "21st", "102nd", "113th"
            ]
        );
    }

    #[test]
    fn equal_medians_share_a_place() {
        let ranking = Ranking {
            name: "angle",
            order: vec![(2, 30.0), (0, 28.0), (3, 28.0), (1, 9.0)],
        };
        let places = [0, 1, 2, 3].map(|method| ranking.place(method).unwrap().0);
        assert_eq!(places, [2, 4, 1, 2]);
        assert_eq!(ranking.place(7), None);
    }
}
