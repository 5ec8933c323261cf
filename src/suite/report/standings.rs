//! One table that sets meshers side by side, for pages that quote it.

use super::markdown::{table, value};
use crate::suite::analysis::measures::Measure;
use crate::suite::analysis::results::{Asking, Results};
use crate::suite::run::plan::Section;

/// The named meshers, each by its lead method, by every measure at equal edge length, or where that was not asked at equal count:
/// medians over the tasks that all of them measured, the best in bold, without measures that none of them has. Empty where fewer
/// than two of them were run.
pub(super) fn standings(results: &Results, meshers: &[&str]) -> String {
    let askings = results.askings(Section::Duels);
    let asked = askings.iter().find(|asking| asking.contest.has_several_meshers());
    asked.map_or_else(String::new, |asking| side_by_side(asking, meshers))
}

fn side_by_side(Asking { contest, measures, .. }: &Asking, meshers: &[&str]) -> String {
    let chosen: Vec<usize> = meshers.iter().filter_map(|mesher| contest.lead_of(mesher)).collect();
    if chosen.len() < 2 {
        return String::new();
    }
    let common = contest.common(&chosen);
    let medians = |by: &Measure| -> Vec<Option<f64>> {
        let tasks = contest.having(&chosen, &common, by.value);
        let median = |&method: &usize| contest.median(method, &tasks, by.value);
        chosen.iter().map(median).collect()
    };
    // Times of a busy machine are not quoted.
    let measures: Vec<&Measure> = measures
        .iter()
        .filter(|by| medians(by).iter().any(Option::is_some))
        .collect();
    let column = |by: &Measure| {
        let medians = medians(by);
        let best = medians.iter().flatten().copied().reduce(
            |best, other| {
                if by.gain(other, best) > 0.0 { other } else { best }
            },
        );
        let best = best.map(|best| value(by, best));
        let cell = |median: &Option<f64>| match value(by, *median) {
            text if best.as_ref() == Some(&text) => format!("**{text}**"),
            text => text,
        };
        medians.iter().map(cell).collect::<Vec<String>>()
    };
    let columns: Vec<Vec<String>> = measures.iter().map(|by| column(by)).collect();
    let line = |k: usize| {
        let name = std::iter::once(contest.methods[chosen[k]].label.clone());
        name.chain(columns.iter().map(|column| column[k].clone())).collect()
    };
    let lines: Vec<Vec<String>> = (0..chosen.len()).map(line).collect();
    let labels: Vec<String> = measures.iter().map(|by| by.label()).collect();
    let head: Vec<&str> = std::iter::once("mesher")
        .chain(labels.iter().map(String::as_str))
        .collect();
    table(&head, &lines).trim_end().to_owned()
}
