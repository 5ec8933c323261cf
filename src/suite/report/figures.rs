//! Which charts the rows have numbers for.

use super::markdown::parameter;
use super::{claims, findings, frontiers, poisson, rivals};
use crate::suite::analysis::contest::{at_equal_count, at_equal_size};
use crate::suite::analysis::convergence::convergence;
use crate::suite::analysis::series::{order_groups, time_series};
use crate::suite::analysis::summary::{Grid, measured};
use crate::suite::charts::{self, ChartError};
use crate::suite::rows::record::Row;
use std::path::{Path, PathBuf};

/// What part of the page a chart belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Section {
    Angle,
    Size,
    Fewest,
    Frontier,
    Corners,
    Rules,
    Orders,
    Time,
    Rivals,
    Peers,
    Poisson,
    Adaptation,
    Duels,
    Claims,
}

/// A chart of the page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Chart {
    /// Its files are `charts/NAME.svg` and `charts/NAME.png`.
    pub(super) name: String,
    /// One line that says what is to be seen.
    pub(super) caption: String,
    /// Where it belongs.
    pub(super) section: Section,
}

/// Draws into one folder and keeps the list.
struct Drawer {
    folder: PathBuf,
    charts: Vec<Chart>,
}

impl Drawer {
    /// Where the next chart goes, without ending.
    fn next(&mut self, section: Section, name: &str, caption: &str) -> PathBuf {
        self.charts.push(Chart {
            name: name.to_owned(),
            caption: caption.to_owned(),
            section,
        });
        self.folder.join(name)
    }
}

/// Draws every chart the rows have numbers for.
pub(super) fn draw(rows: &[Row], folder: &Path) -> Result<Vec<Chart>, ChartError> {
    let mut drawer = Drawer {
        folder: folder.to_path_buf(),
        charts: Vec::new(),
    };
    draw_grid(rows, &mut drawer)?;
    draw_frontiers(rows, &mut drawer)?;
    draw_poisson(rows, &mut drawer)?;
    draw_adaptation(rows, &mut drawer)?;
    let by_rule = findings::of_group(rows, "rules");
    if !by_rule.is_empty() {
        let caption = "Smallest angles by either rule of who bites whom, against t, with the bound of each.";
        charts::rules(&by_rule, &drawer.next(Section::Rules, "rules", caption))?;
    }
    draw_orders(rows, &mut drawer)?;
    let series = time_series(&findings::ours(rows, "time"));
    if !series.is_empty() {
        let caption = "Seconds against triangles, whole and by step, with the slopes of fitted lines.";
        charts::time(&series, &drawer.next(Section::Time, "time", caption))?;
    }
    draw_rivals(rows, &mut drawer)?;
    draw_claims(rows, &mut drawer)?;
    Ok(drawer.charts)
}

/// Meshers side by side, at equal edge length and at equal count.
fn draw_rivals(rows: &[Row], drawer: &mut Drawer) -> Result<(), ChartError> {
    let (size, count, time) = (at_equal_size(rows), at_equal_count(rows), rivals::timed(rows));
    if size.has_rivals() {
        let caption = "Methods at equal edge length: median over the tasks that all measured, and the range.";
        charts::methods(&size, &drawer.next(Section::Rivals, "meshers", caption))?;
        let leads = size.leads();
        let caption =
            "How triangles spread over smallest angles, for each mesher at equal edge length; mean over meshes.";
        let stem = drawer.next(Section::Rivals, "meshers-angles", caption);
        charts::angles_by_method(&size, &leads, &stem)?;
        let caption = "Smallest and mean angle of each mesher on each domain at equal edge length.";
        charts::domains(&size, &leads, &drawer.next(Section::Duels, "meshers-domains", caption))?;
        if size.most_t() > 2 {
            let caption = "Medians over the tasks that all meshers measured, against t.";
            let stem = drawer.next(Section::Rivals, "meshers-against-t", caption);
            charts::methods_against_t(&size, &leads, &stem)?;
        }
    }
    if count.has_rivals() {
        let caption = "Methods at equal triangle count: median over the tasks that all measured, and the range.";
        charts::methods(&count, &drawer.next(Section::Rivals, "meshers-count", caption))?;
        let leads = count.leads();
        let caption = "How triangles spread over smallest angles, for each mesher at equal count; mean over meshes.";
        let stem = drawer.next(Section::Rivals, "meshers-count-angles", caption);
        charts::angles_by_method(&count, &leads, &stem)?;
        let caption = "Smallest and mean angle of each mesher on each domain at equal triangle count.";
        charts::domains(
            &count,
            &leads,
            &drawer.next(Section::Duels, "meshers-count-domains", caption),
        )?;
    }
    if time.has_rivals() {
        let caption = "Seconds against triangles for each method, with the slopes of fitted lines.";
        charts::time_by_method(&time, &drawer.next(Section::Rivals, "meshers-time", caption))?;
    }
    Ok(())
}

/// Most meshes in the chart of where fronts met.
const MOST_MEETINGS: usize = 30;

/// The paper's two claims.
fn draw_claims(rows: &[Row], drawer: &mut Drawer) -> Result<(), ChartError> {
    let size = at_equal_size(rows);
    let marked = |k: &usize| {
        size.rows(*k)
            .filter_map(measured)
            .any(|report| report.statistics.seams.is_some())
    };
    if let Some(k) = size.all().into_iter().find(marked) {
        let met = |row: &&Row| measured(row).is_some_and(|report| report.statistics.seams.is_some());
        let named = |row: &'_ &Row| {
            let spacing = row.cell.spacing.split(':').next().unwrap_or_default();
            format!(
                "{} {spacing} t={} c_b={}",
                row.cell.domain,
                parameter(row.cell.t),
                parameter(row.cell.c_b)
            )
        };
        let own: Vec<&Row> = size.rows(k).filter(met).collect();
        // A part that spreads over all of them, where they are too many to be told apart.
        let step = own.len().div_ceil(MOST_MEETINGS).max(1);
        let shown: Vec<_> = own.into_iter().step_by(step).map(|row| (row, named(&row))).collect();
        let caption = "Angles where fronts met (hollow) and elsewhere (filled), mesh by mesh.";
        charts::seams(&shown, &drawer.next(Section::Claims, "seams", caption))?;
    }
    let sampled = claims::sampled(rows);
    if sampled.len() > 1 {
        let caption = "What the density of samples does to an independent set, beside biting on the same tasks.";
        charts::oversampling(&sampled, &drawer.next(Section::Claims, "oversampling", caption))?;
    }
    Ok(())
}

fn draw_grid(rows: &[Row], drawer: &mut Drawer) -> Result<(), ChartError> {
    let grids = findings::grids(rows);
    let all = Grid::of(grids.iter().flat_map(|(_, grid)| grid.rows.iter().copied()));
    let Some(first) = grids.first().filter(|_| all.reports().next().is_some()) else {
        return Ok(());
    };
    let first = std::slice::from_ref(first);
    let caption = "Smallest angle of each mesh against t, over the bound of Theorem 6.8. \
                   Points of different c_b are moved apart sideways.";
    charts::smallest_angle(&all, &drawer.next(Section::Angle, "angle-against-t", caption))?;
    let caption = "How the triangles of a mesh spread over smallest angles, for each t; mean over meshes.";
    charts::angles_by_t(&grids, &drawer.next(Section::Angle, "angles-by-t", caption))?;
    let caption = "Triangles over ∫dA/f² for each t and c_b, median over domains; * where some domains are missing.";
    let stem = drawer.next(Section::Size, "size-heat", caption);
    charts::heat_map(&grids, charts::SIZE_RATIO, &stem)?;
    let stem = drawer.next(
        Section::Size,
        "size-against-t",
        "The same against t, one line for each c_b.",
    );
    charts::against_t(&grids, charts::SIZE_RATIO, &stem)?;
    let caption = "Triangles over ∫dA/lfs² for each t and c_b, median over domains; * where some domains are missing.";
    let stem = drawer.next(Section::Size, "size-lfs-heat", caption);
    charts::heat_map(first, charts::SIZE_RATIO_LFS, &stem)?;
    let stem = drawer.next(
        Section::Size,
        "size-lfs-against-t",
        "The same against t, one line for each c_b.",
    );
    charts::against_t(first, charts::SIZE_RATIO_LFS, &stem)?;
    let caption = "Size efficiency of each mesh against t / c_b; the dashed lines hold for constant f.";
    charts::efficiency(&grids, &drawer.next(Section::Size, "efficiency", caption))?;
    let pairs = first[0].1.without_acute().pairs();
    if !pairs.is_empty() {
        let caption = "Triangles against smallest angle for each t and c_b, on domains without angles under 90° between segments; \
                       no pair beats the filled ones in both.";
        charts::size_for_angle(&pairs, &drawer.next(Section::Fewest, "size-for-angle", caption))?;
    }
    Ok(())
}

/// What a smallest angle costs, over all domains and on each.
fn draw_frontiers(rows: &[Row], drawer: &mut Drawer) -> Result<(), ChartError> {
    for (domain, families) in frontiers::by_domain(rows).iter().rev() {
        let name = format!("frontier-{}", domain.replace(' ', "-"));
        let caption = match domain.as_str() {
            frontiers::ALL => "Smallest of the angles and median of the sizes over all domains.".to_owned(),
            _ => format!("Size against smallest angle on {domain}."),
        };
        charts::frontiers(domain, families, &drawer.next(Section::Frontier, &name, &caption))?;
    }
    Ok(())
}

/// Errors, iterations and eigenvalues of each Poisson problem.
fn draw_poisson(rows: &[Row], drawer: &mut Drawer) -> Result<(), ChartError> {
    for (number, (title, contest)) in poisson::by_problem(rows).iter().enumerate() {
        let caption = format!(
            "{title}: errors scaled by the power of unknowns with which they fall, iterations and eigenvalues."
        );
        let stem = drawer.next(Section::Poisson, &format!("poisson-{}", number + 1), &caption);
        charts::poisson(title, contest, &stem)?;
    }
    Ok(())
}

/// L2 errors against vertices, adapted and uniform.
fn draw_adaptation(rows: &[Row], drawer: &mut Drawer) -> Result<(), ChartError> {
    for both in convergence(rows) {
        let title = &both[0].title;
        let caption = format!("{title}: relative L2 error against vertices, adapted and uniform.");
        let name = format!("adapt-{}", title.replace(' ', "-"));
        let stem = drawer.next(Section::Adaptation, &name, &caption);
        charts::adaptation(&both, &stem)?;
    }
    Ok(())
}

fn draw_orders(rows: &[Row], drawer: &mut Drawer) -> Result<(), ChartError> {
    let groups = order_groups(&findings::ours(rows, "orders"));
    if groups.iter().all(|group| group.reports.is_empty()) {
        return Ok(());
    }
    let caption = "Orders of bites: median over domains, and the range from the least to the most.";
    charts::orders(&groups, &drawer.next(Section::Orders, "orders", caption))?;
    let caption = "How triangles spread over smallest angles, for each order of bites; mean over meshes.";
    charts::angles_by_order(&groups, &drawer.next(Section::Orders, "angles-by-order", caption))
}
