//! The part of the page on adaptation: error against vertices, beside uniform refinement, with fitted slopes.

use super::drawer::Drawer;
use super::markdown::{number, table};
use crate::suite::analysis::convergence::{self, Convergence, convergence};
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::measured;
use crate::suite::charts::{self, ChartError};
use crate::suite::rows::adapted::Round;
use crate::suite::rows::record::Row;
use crate::suite::run::plan::Section;

/// The part of the page: a table for each problem.
pub(super) fn text(results: &Results) -> String {
    let rows = results.of(Section::Adaptation);
    let all = convergence(&rows);
    if all.is_empty() {
        return String::new();
    }
    let mut text = String::from(
        "−Δu = g with known u by linear elements. Adapted meshes come from rounds of meshing, solving, recovering the Hessian of the \
         solution and asking for the spacing at which linear interpolation has the error eps; the rounds of each mesh are in its row. \
         Slopes are those of lines fitted to log₁₀ of the relative L2 error against log₁₀ of the vertices: −1 is the best that \
         linear elements can do.\n\n",
    );
    for both in &all {
        let title = &both[0].title;
        let head = [
            "refinement",
            "meshes",
            "vertices",
            "L2 error of the first",
            "of the last",
            "slope",
        ];
        let lines: Vec<_> = both.iter().map(line).collect();
        text += &format!("### {title}\n\n{}", table(&head, &lines));
        text += &rounds(&rows, title);
    }
    text
}

fn line(convergence: &Convergence) -> Vec<String> {
    let (first, last) = (convergence.points.first(), convergence.points.last());
    let count = |point: Option<&(f64, f64)>| point.map_or_else(|| "–".into(), |point| format!("{}", point.0));
    vec![
        convergence.name(),
        convergence.points.len().to_string(),
        format!("{} to {}", count(first), count(last)),
        number(first.map(|point| point.1)),
        number(last.map(|point| point.1)),
        number(convergence.slope()),
    ]
}

/// The rounds to the finest adapted mesh.
fn rounds(rows: &[&Row], title: &str) -> String {
    let own = rows.iter().filter(|row| convergence::title(row) == title);
    let adapted = own.filter_map(|row| Some((row.cell.adapt?, measured(row)?)));
    let Some((adapt, report)) = adapted.max_by_key(|(_, report)| report.statistics.vertices) else {
        return String::new();
    };
    let line = |(k, round): (usize, &Round)| {
        vec![
            (k + 1).to_string(),
            round.vertices.to_string(),
            number(round.l2_error),
            format!("{:.1} %", 100.0 * round.settled),
            round.independent.to_string(),
            round.kept.to_string(),
        ]
    };
    let head = [
        "round",
        "vertices",
        "L2 error",
        "settled",
        "independent for the next spacing",
        "kept from the round before",
    ];
    let lines: Vec<_> = report.rounds.iter().enumerate().map(line).collect();
    let eps = number(adapt.eps);
    format!("Rounds to the finest mesh, eps = {eps}:\n\n{}", table(&head, &lines))
}

/// For each problem the slopes, and what adaptation saves where both end.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let one = |[adapted, uniform]: &[Convergence; 2]| {
        let most = adapted.points.last()?.0.min(uniform.points.last()?.0);
        let times = uniform.at(most)? / adapted.at(most)?;
        Some(format!(
            "For `{}`, uniform meshes of {most} vertices have {} times the L2 error of adapted ones; slopes are {} and {}.",
            adapted.title,
            number(times),
            number(uniform.slope()),
            number(adapted.slope())
        ))
    };
    let all = convergence(&results.of(Section::Adaptation));
    all.iter().filter_map(one).collect()
}

/// L2 errors against vertices, adapted and uniform.
pub(super) fn charts(results: &Results, drawer: &mut Drawer) -> Result<(), ChartError> {
    for both in convergence(&results.of(Section::Adaptation)) {
        let title = &both[0].title;
        let caption = format!("{title}: relative L2 error against vertices, adapted and uniform.");
        let name = format!("adapt-{}", title.replace(' ', "-"));
        let stem = drawer.chart(&name, &caption);
        charts::adaptation(&both, &stem)?;
    }
    Ok(())
}
