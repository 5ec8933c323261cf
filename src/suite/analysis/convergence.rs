//! L2 error against vertices, gathered by problem, adapted and uniform.

use crate::suite::analysis::summary::measured;
use crate::suite::rows::numbers::{Line, first_seen, fit_line};
use crate::suite::rows::record::{Report, Row};

/// Meshes of one problem on one domain, either adapted or not.
#[derive(Clone, Debug, PartialEq)]
pub struct Convergence {
    /// What was solved where: `corner on l-shape`.
    pub title: String,
    /// Whether the meshes are adapted.
    pub is_adapted: bool,
    /// Cells asked for.
    pub asked: usize,
    /// Vertices and relative L2 error of the measured ones, by vertices.
    pub points: Vec<(f64, f64)>,
    /// The line through log₁₀ error against log₁₀ vertices.
    pub fit: Option<Line>,
}

impl Convergence {
    /// What kind of refinement it is, and how many of its cells are missing.
    pub fn name(&self) -> String {
        let kind = if self.is_adapted { "adapted" } else { "uniform" };
        match self.asked - self.points.len() {
            0 => kind.into(),
            missing => format!("{kind}, {missing} missing"),
        }
    }

    /// The slope of the line.
    pub fn slope(&self) -> Option<f64> {
        self.fit.as_ref().map(|line| line.slope)
    }

    /// The error that the line has at so many vertices.
    pub fn at(&self, vertices: f64) -> Option<f64> {
        let line = self.fit.as_ref()?;
        Some(10f64.powf(line.slope * vertices.log10() + line.intercept))
    }
}

/// What a row solves where.
pub fn title(row: &Row) -> String {
    let problem = row.cell.poisson.as_deref().unwrap_or_default();
    format!("{problem} on {}", row.cell.domain)
}

/// Two for each problem on each domain, as they first appear: the adapted meshes, then the uniform ones.
pub fn convergence(rows: &[&Row]) -> Vec<[Convergence; 2]> {
    let own: Vec<(String, &Row)> = rows.iter().map(|row| (title(row), *row)).collect();
    let titles = first_seen(own.iter().map(|(title, _)| title.as_str()));
    let one = |wanted: &str, is_adapted: bool| {
        let asked: Vec<&Row> = own
            .iter()
            .filter(|(title, row)| title == wanted && row.cell.adapt.is_some() == is_adapted)
            .map(|(_, row)| *row)
            .collect();
        let mut points: Vec<(f64, f64)> = asked.iter().filter_map(|row| point(measured(row)?)).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let logarithms: Vec<_> = points.iter().map(|(x, y)| (x.log10(), y.log10())).collect();
        Convergence {
            title: wanted.to_owned(),
            is_adapted,
            asked: asked.len(),
            points,
            fit: fit_line(&logarithms),
        }
    };
    let both = |title: &str| [one(title, true), one(title, false)];
    titles.into_iter().map(both).collect()
}

fn point(report: &Report) -> Option<(f64, f64)> {
    let solution = report.poisson.as_ref()?;
    let error = solution.l2_error / solution.l2_norm;
    (error > 0.0).then_some((report.statistics.vertices as f64, error))
}
