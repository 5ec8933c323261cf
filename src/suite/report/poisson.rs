//! The part of the page on what quality is for: errors, iterations and eigenvalues of a Poisson problem on each mesh.

use super::drawer::Drawer;
use super::markdown::{number, table};
use crate::suite::analysis::contest::Contest;
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::measured;
use crate::suite::charts::{self, ChartError, YIELDS};
use crate::suite::fem::Solution;
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

/// What one method gave, as medians over the tasks of a contest: one number for each of [`YIELDS`].
fn yields(contest: &Contest, method: usize) -> [Option<f64>; YIELDS.len()] {
    let tasks: Vec<usize> = (0..contest.tasks.len()).collect();
    YIELDS.each_ref().map(|wanted| {
        let value = |solution: &Solution| (wanted.value)(solution);
        contest.median(method, &tasks, |report| value(report.poisson.as_ref()?))
    })
}

/// The part of the page: a table for each problem.
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
    for (title, contest) in &all {
        let line = |method: usize| {
            let [energy, l2, iterations, eigenvalue] = yields(contest, method).map(number);
            let last = contest.tasks.len().saturating_sub(1);
            let condition = contest
                .report(method, last)
                .and_then(|report| report.poisson.as_ref()?.spectrum)
                .map(|spectrum| spectrum.condition_preconditioned);
            let count = contest.rows(method).filter(|row| has_solution(row)).count();
            let of = contest.rows(method).count();
            let label = contest.methods[method].label.clone();
            vec![
                label,
                format!("{count} of {of}"),
                energy,
                l2,
                iterations,
                eigenvalue,
                number(condition),
            ]
        };
        let mut head = vec!["mesher", "solved"];
        head.extend(YIELDS.iter().map(|wanted| wanted.label));
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

/// How far ours is from the smallest error per unknown, with the least and the most over the problems.
pub(super) fn findings(results: &Results) -> Vec<String> {
    finding(results).into_iter().collect()
}

fn finding(results: &Results) -> Option<String> {
    let contests: Vec<Contest> = by_problem(results).into_iter().map(|(_, contest)| contest).collect();
    let own = contests.first()?.lead_of(&results.about)?;
    let label = &contests[0].methods[own].label;
    let part = |which: usize| {
        let shares: Vec<[f64; 3]> = contests
            .iter()
            .filter_map(|contest| over_the_best(contest, &results.about, which))
            .collect();
        let range = |k: usize| {
            let over = spread(shares.iter().map(|share| share[k]).collect())?;
            let [least, most] = [over.least, over.most].map(number);
            Some(if least == most {
                least
            } else {
                format!("{least} to {most}")
            })
        };
        Some(format!(
            "{} {} times the best method's, the median method's {}, the worst's {}",
            YIELDS[which].label,
            range(0)?,
            range(1)?,
            range(2)?
        ))
    };
    let parts: Vec<String> = [0, 1, 2].into_iter().filter_map(part).collect();
    (!parts.is_empty()).then(|| {
        format!(
            "**Error per unknown** in Poisson problems, {label}: {}.",
            parts.join("; ")
        )
    })
}

/// What ours, the median method and the worst give over what the best gives.
fn over_the_best(contest: &Contest, about: &str, which: usize) -> Option<[f64; 3]> {
    let own = yields(contest, contest.lead_of(about)?)[which]?;
    let all = contest
        .all()
        .into_iter()
        .filter_map(|method| yields(contest, method)[which]);
    let all = spread(all.collect())?;
    Some([own, all.median, all.most].map(|value| value / all.least))
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
