//! One table that sets meshers side by side, for pages that quote the findings.

use super::duels::{YARDSTICKS, contests};
use super::markdown::{number, table};
use crate::suite::analysis::contest::Contest;
use crate::suite::analysis::results::Results;

/// One method of each mesher by every yardstick, the best in bold; empty where one mesher ran alone.
pub(super) fn standings(results: &Results) -> String {
    let contests = contests(results);
    let asked = contests.iter().find(|(_, contest, _)| contest.has_several_meshers());
    asked.map_or_else(String::new, |(title, contest, is_count)| {
        side_by_side(contest, title, *is_count)
    })
}

fn side_by_side(contest: &Contest, title: &str, is_count: bool) -> String {
    let (leads, others): (Vec<usize>, Vec<usize>) = contest
        .leads()
        .into_iter()
        .partition(|&method| contest.takes_part(method));
    let common = contest.common(&leads);
    let yardsticks: Vec<_> = YARDSTICKS.iter().filter(|by| by.at_equal_count || !is_count).collect();
    let medians: Vec<Vec<Option<f64>>> = yardsticks
        .iter()
        .map(|by| {
            leads
                .iter()
                .map(|&method| contest.median(method, &common, by.value))
                .collect()
        })
        .collect();
    let column = |k: usize| {
        let told = medians[k].iter().map(|&median| number(median));
        let best = medians[k]
            .iter()
            .flatten()
            .copied()
            .max_by(|a, b| (yardsticks[k].sign * a).total_cmp(&(yardsticks[k].sign * b)))
            .map(number);
        told.map(move |text| {
            if best.as_ref() == Some(&text) {
                format!("**{text}**")
            } else {
                text
            }
        })
        .collect::<Vec<_>>()
    };
    let columns: Vec<Vec<String>> = (0..yardsticks.len()).map(column).collect();
    let line = |k: usize| {
        let name = std::iter::once(contest.methods[leads[k]].label.clone());
        name.chain(columns.iter().map(|column| column[k].clone())).collect()
    };
    let lines: Vec<Vec<String>> = (0..leads.len()).map(line).collect();
    let head: Vec<&str> = std::iter::once("mesher")
        .chain(yardsticks.iter().map(|by| by.name))
        .collect();
    let others: Vec<&str> = others
        .iter()
        .map(|&method| contest.methods[method].label.as_str())
        .collect();
    let left_out = if others.is_empty() {
        String::new()
    } else {
        format!(" (left out: {}, with fewer than half)", others.join(", "))
    };
    format!(
        "\nAt {title}, by medians over the {} of {} tasks that all of these measured{left_out}:\n\n",
        common.len(),
        contest.tasks.len()
    ) + table(&head, &lines).trim_end()
        + "\n"
}
