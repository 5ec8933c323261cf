//! Which charts the rows have numbers for.

use super::findings;
use crate::charts::{self, ChartError};
use crate::experiment::record::Row;
use crate::experiment::series::{order_groups, time_series};
use crate::experiment::summary::Grid;
use std::path::{Path, PathBuf};

/// What part of the page a chart belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Section {
    Angle,
    Size,
    Fewest,
    Orders,
    Time,
}

/// A chart of the page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Chart {
    /// Its files are `charts/NAME.svg` and `charts/NAME.png`.
    pub(super) name: &'static str,
    /// One line that says what is to be seen.
    pub(super) caption: &'static str,
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
    fn next(&mut self, section: Section, name: &'static str, caption: &'static str) -> PathBuf {
        self.charts.push(Chart { name, caption, section });
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
    draw_orders(rows, &mut drawer)?;
    let series = time_series(&findings::of_group(rows, "time"));
    if !series.is_empty() {
        let caption = "Seconds against triangles, whole and by step, with the slopes of fitted lines.";
        charts::time(&series, &drawer.next(Section::Time, "time", caption))?;
    }
    Ok(drawer.charts)
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

fn draw_orders(rows: &[Row], drawer: &mut Drawer) -> Result<(), ChartError> {
    let groups = order_groups(&findings::of_group(rows, "orders"));
    if groups.iter().all(|group| group.reports.is_empty()) {
        return Ok(());
    }
    let caption = "Orders of bites: median over domains, and the range from the least to the most.";
    charts::orders(&groups, &drawer.next(Section::Orders, "orders", caption))?;
    let caption = "How triangles spread over smallest angles, for each order of bites; mean over meshes.";
    charts::angles_by_order(&groups, &drawer.next(Section::Orders, "angles-by-order", caption))
}
