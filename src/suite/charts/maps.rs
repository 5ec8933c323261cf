//! Spacing functions as maps over a domain: where each is small, on one logarithmic scale of colours.

use super::canvas::{Area, ChartError, Drawn, FINE, Figure, write_both};
use super::legend::colour_bar;
use super::mesh::{View, under_titles};
use super::panel::{Axis, log_span};
use super::style::{self, INK};
use crate::domain::Domain;
use crate::geometry::{DVec2, Rect};
use crate::spacing::{Ingredients, Spacing};
use plotters::prelude::{Color, DrawingBackend, PathElement, Rectangle};
use std::ops::Range;
use std::path::Path;

/// Rows and columns of the raster, along the longer side of the domain; the colours.
const RASTER: usize = 96;
const BANDS: usize = 16;

/// With more segments their lines would hide the colours.
const MOST_SEGMENTS: usize = 2000;

/// Room for the colour bar, in pixels.
const SIDE: i32 = 130;

/// A function under its title.
type Map<'a> = (&'a str, &'a dyn Spacing);

/// Draws what a spacing is made of, lfs, nsf and gns as far as it has them, and `f`, what was left of it once limited, to `stem.svg`
/// and `stem.png`.
///
/// # Errors
/// [`ChartError`].
pub fn spacing_maps(
    domain: &Domain,
    ingredients: &Ingredients,
    f: &dyn Spacing,
    stem: &Path,
) -> Result<(), ChartError> {
    let mut maps: Vec<Map> = Vec::new();
    if let Some(lfs) = &ingredients.lfs {
        maps.push(("lfs", &**lfs));
    }
    if let Some(nsf) = &ingredients.nsf {
        maps.push(("nsf", &**nsf));
    }
    if maps.len() > 1 {
        maps.push(("gns = min(lfs, nsf)", &*ingredients.gns));
    }
    let limited = format!("f: limited to α = {:.3}", f.lipschitz());
    maps.push((&limited, f));
    write_both(&Maps::new(domain, &maps), stem)
}

/// The maps as rasters of values; none where a point is outside the domain.
struct Maps<'a> {
    domain: &'a Domain,
    titles: Vec<&'a str>,
    rasters: Vec<Vec<Option<f64>>>,
    /// From the smallest to the largest value on any map.
    span: Range<f64>,
    columns: usize,
    rows: usize,
}

impl<'a> Maps<'a> {
    fn new(domain: &'a Domain, maps: &[Map<'a>]) -> Self {
        let bounds = domain.bounds();
        let share = bounds.size() / bounds.size().max_element();
        let [columns, rows] = [share.x, share.y].map(|share| ((share * RASTER as f64).round() as usize).max(1));
        let cells = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
        let centres: Vec<Option<DVec2>> = cells
            .map(|(i, j)| cell(bounds, [columns, rows], i..i + 1, j).centre())
            .map(|x| domain.contains(x).then_some(x))
            .collect();
        let raster = |f: &dyn Spacing| centres.iter().map(|x| x.map(|x| f.at(x))).collect();
        let rasters: Vec<Vec<Option<f64>>> = maps.iter().map(|map| raster(map.1)).collect();
        Self {
            domain,
            titles: maps.iter().map(|map| map.0).collect(),
            span: log_span(rasters.iter().flatten().flatten().copied()),
            rasters,
            columns,
            rows,
        }
    }

    /// How far up the colours a value stands, from 0 to 1.
    fn share(&self, value: f64) -> f64 {
        (value / self.span.start).ln() / (self.span.end / self.span.start).ln()
    }

    fn panel<DB: DrawingBackend>(&self, area: &Area<DB>, raster: &[Option<f64>]) -> Drawn {
        let bounds = self.domain.bounds();
        let view = View::of(bounds, area.dim_in_pixel());
        let band = |value: f64| {
            (self.share(value) * BANDS as f64)
                .floor()
                .clamp(0.0, BANDS as f64 - 1.0) as usize
        };
        for (j, row) in raster.chunks(self.columns).enumerate() {
            let bands: Vec<Option<usize>> = row.iter().map(|value| value.map(band)).collect();
            let mut first = 0;
            // One rectangle for neighbours of one colour.
            for run in bands.chunk_by(|a, b| a == b) {
                let place = cell(bounds, [self.columns, self.rows], first..first + run.len(), j);
                first += run.len();
                if let Some(band) = run[0] {
                    let colour = style::continuous((band as f64 + 0.5) / BANDS as f64);
                    area.draw(&Rectangle::new(
                        [view.place(place.min), view.place(place.max)],
                        colour.filled(),
                    ))?;
                }
            }
        }
        let line = style::stroke(INK, FINE as u32);
        let shown = self.domain.segments().len() <= MOST_SEGMENTS;
        for s in (0..self.domain.segments().len()).filter(|_| shown) {
            let ends = self.domain.ends(s).map(|end| view.place(end));
            area.draw(&PathElement::new(ends.to_vec(), line))?;
        }
        Ok(())
    }
}

/// Cells of a raster over `bounds`, in one row.
fn cell(bounds: Rect, raster: [usize; 2], columns: Range<usize>, row: usize) -> Rect {
    let step = bounds.size() / DVec2::new(raster[0] as f64, raster[1] as f64);
    Rect {
        min: bounds.min + step * DVec2::new(columns.start as f64, row as f64),
        max: bounds.min + step * DVec2::new(columns.end as f64, (row + 1) as f64),
    }
}

impl Figure for Maps<'_> {
    fn size(&self) -> (u32, u32) {
        (1200, if self.titles.len() > 2 { 1100 } else { 600 })
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>) -> Drawn {
        let (left, right) = area.split_horizontally((1200 - SIDE) * FINE);
        for (body, raster) in under_titles(&left, &self.titles)?.iter().zip(&self.rasters) {
            self.panel(body, raster)?;
        }
        let ticks = Axis::log("", self.span.clone()).named_ticks().into_iter();
        let ticks: Vec<(f64, String)> = ticks.map(|(value, words)| (self.share(value), words)).collect();
        colour_bar(&right, "f(x)", 0.0..1.0, &ticks, BANDS)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::gallery;
    use crate::spacing::{Uniform, lfs_of};

    #[test]
    fn a_raster_has_values_in_the_domain_alone_and_colours_from_the_smallest_to_the_largest() {
        let domain = gallery::domain("l-shape").expect("there").expect("valid");
        let lfs = lfs_of(&domain).expect("positive");
        let maps = Maps::new(&domain, &[("lfs", &lfs), ("twice", &Uniform(2.0))]);
        assert_eq!((maps.columns, maps.rows), (RASTER, RASTER));
        // A quarter of the box is not there.
        let inside = maps.rasters[0].iter().flatten().count();
        assert_eq!(inside, RASTER * RASTER * 3 / 4);
        let least = maps.rasters[0].iter().flatten().copied().fold(f64::INFINITY, f64::min);
        assert!(maps.span.start <= least && maps.span.end >= 2.0, "{:?}", maps.span);
        // The lower left cell is the first, and y grows with rows.
        let bounds = domain.bounds();
        assert_eq!(cell(bounds, [4, 4], 0..1, 0).min, bounds.min);
        assert_eq!(cell(bounds, [4, 4], 2..4, 3).max, bounds.max);
    }
}
