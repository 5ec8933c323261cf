//! The part of the page on what quality is for: errors, iterations and eigenvalues of a Poisson problem on each mesh.

use super::drawer::Drawer;
use super::markdown::{number, range, table, value};
use crate::suite::analysis::contest::Contest;
use crate::suite::analysis::measures::{Measure, YIELDS};
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::measured;
use crate::suite::charts::{self, ChartError};
use crate::suite::rows::numbers::{first_seen, spread};
use crate::suite::rows::record::Row;
use crate::suite::run::plan::Section;

/// The rows of the section, split by what was solved where.
pub(super) fn by_problem(results: &Results) -> Vec<(String, Contest<'_>)> {
    let own = results.of(Section::Poisson);
    let task = |row: &Row| format!("{:?} {} {}", row.cell.poisson, row.cell.domain, row.cell.spacing);
    let tasks: Vec<String> = own.iter().map(|row| task(row)).collect();
    let contest = |wanted: &str| {
        let rows: Vec<&Row> = own
            .iter()
            .zip(&tasks)
            .filter(|(_, task)| *task == wanted)
            .map(|(row, _)| *row)
            .collect();
        let problem = rows
            .first()
            .and_then(|row| row.cell.poisson.as_deref())
            .unwrap_or_default();
        let domain = rows.first().map_or("", |row| row.cell.domain.as_str());
        (format!("{problem} on {domain}"), Contest::of(rows))
    };
    first_seen(tasks.iter().map(String::as_str))
        .into_iter()
        .map(contest)
        .collect()
}

/// The median of a method over all tasks of a contest.
fn median_of(contest: &Contest, method: usize, by: &Measure) -> Option<f64> {
    let tasks: Vec<usize> = (0..contest.tasks.len()).collect();
    contest.median(method, &tasks, by.value)
}

/// A table for each problem, and ours beside the best over all of them.
pub(super) fn text(results: &Results) -> String {
    let all = by_problem(results);
    if all.is_empty() {
        return String::new();
    }
    let mut text = String::from(
        "−Δu = g with known u by linear elements; errors are relative to u, in the energy norm and in L2, and scaled by the power of \
         unknowns with which they fall: so meshes of different counts can stand in one median, and less is better. Iterations are of \
         conjugate gradients preconditioned by the diagonal, to a residual of 10⁻⁸. The condition is that of the preconditioned matrix, \
         at the largest count.\n\n",
    );
    text += &beside_the_best(results);
    for (title, contest) in &all {
        let line = |method: usize| {
            let last = contest.tasks.len().saturating_sub(1);
            let condition = contest
                .report(method, last)
                .and_then(|report| report.poisson.as_ref()?.spectrum)
                .map(|spectrum| spectrum.condition_preconditioned);
            let count = contest.rows(method).filter(|row| has_solution(row)).count();
            let of = contest.rows(method).count();
            let mut line = vec![contest.methods[method].label.clone(), format!("{count} of {of}")];
            line.extend(YIELDS.iter().map(|by| value(by, median_of(contest, method, by))));
            line.push(number(condition));
            line
        };
        let mut head = vec!["mesher", "solved"];
        head.extend(YIELDS.iter().map(|by| by.title));
        head.push("condition");
        let lines: Vec<_> = contest.all().into_iter().map(line).collect();
        let spacing = contest.tasks.first().map_or("", |asked| asked.spacing.as_str());
        text += &format!("### {title}, sizes by `{spacing}`\n\n{}", table(&head, &lines));
    }
    text
}

fn has_solution(row: &Row) -> bool {
    measured(row).is_some_and(|report| report.poisson.is_some())
}

/// What findings call the first of [`YIELDS`].
const NAMES: [&str; 3] = [
    "energy error per unknown",
    "L2 error per unknown",
    "number of iterations",
];

/// How far ours is from the best method, from the least to the most over the problems; a sentence for each number.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let over = NAMES.into_iter().zip(&YIELDS).filter_map(|(name, by)| {
        let [ours, ..] = over_the_best(results, by)?;
        Some(format!(
            "In Poisson problems at equal triangle counts, {}'s {name} is {ours} times that of the best method.",
            results.about
        ))
    });
    over.collect()
}

/// Ours, the median method and the worst over the best, by each of [`YIELDS`].
fn beside_the_best(results: &Results) -> String {
    let line = |by: &Measure| {
        let over = over_the_best(results, by)?;
        Some(std::iter::once(by.title.to_owned()).chain(over).collect::<Vec<_>>())
    };
    let lines: Vec<_> = YIELDS.iter().filter_map(line).collect();
    let head = ["", results.about.as_str(), "the median method", "the worst"];
    "Over the best method, from the least to the most over the problems:\n\n".to_owned() + &table(&head, &lines)
}

/// What ours, the median method and the worst have over the best, from the least to the most over the problems.
fn over_the_best(results: &Results, by: &Measure) -> Option<[String; 3]> {
    let of = |contest: &Contest| {
        let own = median_of(contest, contest.lead_of(&results.about)?, by)?;
        let all = contest.all().into_iter();
        let all = spread(all.filter_map(|method| median_of(contest, method, by)).collect())?;
        Some([own, all.median, all.most].map(|value| value / all.least))
    };
    let shares: Vec<[f64; 3]> = by_problem(results)
        .iter()
        .filter_map(|(_, contest)| of(contest))
        .collect();
    let over = |k: usize| spread(shares.iter().map(|share| share[k]).collect());
    Some([range(&over(0)?), range(&over(1)?), range(&over(2)?)])
}

/// Errors, iterations and eigenvalues of each Poisson problem.
pub(super) fn charts(results: &Results, drawer: &mut Drawer) -> Result<(), ChartError> {
    for (number, (title, contest)) in by_problem(results).iter().enumerate() {
        let caption = format!(
            "{title}: errors scaled by the power of unknowns with which they fall, iterations and eigenvalues."
        );
        let stem = drawer.chart(&format!("poisson-{}", number + 1), &caption);
        charts::poisson(title, contest, &stem)?;
    }
    Ok(())
}
