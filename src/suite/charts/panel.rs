//! A plane with axes, on which the figures draw, and the legend beside it.

use super::canvas::{Area, Drawn, FINE};
use super::style::{self, GREY, INK, LABEL, Marker, PALE, SMALL, TITLE};
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::prelude::{
    Cartesian2d, ChartBuilder, ChartContext, Color, DashedLineSeries, DrawingBackend, EmptyElement, LabelAreaPosition,
    LineSeries, RGBColor, Rectangle, Text, TextStyle,
};
use plotters::style::text_anchor::{HPos, VPos};
use std::ops::Range;

/// An axis: what it says, which values it spans, where its ticks are. One type for all kinds, so that all panels
/// are of one type.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    label: String,
    log: bool,
    range: Range<f64>,
    ticks: Vec<(f64, String)>,
    light: Vec<f64>,
}

impl Axis {
    /// Linear over `range` with ticks at round numbers, about `count` of them.
    pub(super) fn linear(label: &str, range: Range<f64>, count: usize) -> Self {
        let step = round_step((range.end - range.start) / count.max(1) as f64);
        let digits = (-step.log10().floor()).max(0.0) as usize;
        let first = (range.start / step - 1e-6).ceil() as i64;
        let last = (range.end / step + 1e-6).floor() as i64;
        let ticks = (first..=last).map(|k| (k as f64 * step, format!("{:.digits$}", k as f64 * step)));
        Self {
            label: label.into(),
            log: false,
            range: range.clone(),
            ticks: ticks.collect(),
            light: Vec::new(),
        }
    }

    /// Logarithmic over the positive `range`, with ticks at 1, 2, 5 per decade, or at decades alone where these are many.
    pub(super) fn log(label: &str, range: Range<f64>) -> Self {
        let decades = (range.end / range.start).log10();
        let steps: &[f64] = if decades > 2.5 { &[1.0] } else { &[1.0, 2.0, 5.0] };
        let inside = |v: &f64| (range.start * 0.999..=range.end * 1.001).contains(v);
        let powers = range.start.log10().floor() as i32..=range.end.log10().ceil() as i32;
        let at = |steps: Vec<f64>| {
            let values = powers
                .clone()
                .flat_map(move |p| steps.clone().into_iter().map(move |s| s * 10f64.powi(p)));
            values.filter(inside).collect::<Vec<f64>>()
        };
        Self {
            label: label.into(),
            log: true,
            ticks: at(steps.to_vec())
                .into_iter()
                .map(|value| (value, thousands(value)))
                .collect(),
            light: at((1..10).map(f64::from).collect()),
            range,
        }
    }

    /// One place per name: 0, 1, 2, …
    pub(super) fn categories(label: &str, names: &[String]) -> Self {
        Self {
            label: label.into(),
            log: false,
            range: -0.5..names.len() as f64 - 0.5,
            ticks: names
                .iter()
                .enumerate()
                .map(|(k, name)| (k as f64, name.clone()))
                .collect(),
            light: Vec::new(),
        }
    }

    /// With powers of ten alone named, where there are two of them: for narrow panels.
    pub(super) fn sparse(mut self) -> Self {
        let is_power = |value: f64| (value.log10() - value.log10().round()).abs() < 1e-9;
        if self.ticks.iter().filter(|tick| is_power(tick.0)).count() > 1 {
            self.ticks.retain(|tick| is_power(tick.0));
        }
        self
    }

    /// The ticks and their names.
    pub(super) fn named_ticks(self) -> Vec<(f64, String)> {
        self.ticks
    }

    /// The same, without names at the ticks.
    pub(super) fn unnamed(mut self) -> Self {
        self.ticks.iter_mut().for_each(|tick| tick.1.clear());
        self
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let Range { start, end } = self.range;
        let share = if self.log {
            (value / start).ln() / (end / start).ln()
        } else {
            (value - start) / (end - start)
        };
        limit.0 + (share * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() {
            self.light.clone()
        } else {
            self.ticks.iter().map(|tick| tick.0).collect()
        }
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

impl ValueFormatter<f64> for Axis {
    fn format(value: &f64) -> String {
        format!("{value}")
    }

    fn format_ext(&self, value: &f64) -> String {
        let tick = self.ticks.iter().find(|tick| tick.0 == *value);
        tick.map(|tick| tick.1.clone()).unwrap_or_default()
    }
}

/// The smallest of 1, 2, 5 times a power of ten that is at least `step`.
fn round_step(step: f64) -> f64 {
    let power = 10f64.powf(step.log10().floor());
    let factor = [1.0, 2.0, 5.0]
        .into_iter()
        .find(|factor| factor * power >= step * 0.999);
    factor.unwrap_or(10.0) * power
}

/// A tick of a logarithmic axis: 10⁻⁴, 0.01, 5, 2000, 10⁶.
fn thousands(value: f64) -> String {
    if (0.99e-3..0.99e5).contains(&value) {
        return format!("{}", (value * 1e9).round() / 1e9);
    }
    let power = (value * 1.0001).log10().floor() as i32;
    let digits: String = power.to_string().chars().map(superscript).collect();
    match (value / 10f64.powi(power)).round() {
        1.0 => format!("10{digits}"),
        factor => format!("{factor}·10{digits}"),
    }
}

fn superscript(character: char) -> char {
    match character.to_digit(10) {
        Some(digit) => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize],
        None => '⁻',
    }
}

/// From a little under the smallest of `values` to a little over the largest, for a logarithmic axis.
pub(super) fn log_span(values: impl Iterator<Item = f64>) -> Range<f64> {
    let (low, high) = extremes(values.filter(|v| *v > 0.0));
    if low > high { 0.1..10.0 } else { low / 1.2..high * 1.2 }
}

/// From a little under the smallest of `values` to a little over the largest.
pub(super) fn span(values: impl Iterator<Item = f64>) -> Range<f64> {
    let (low, high) = extremes(values);
    if low > high {
        return 0.0..1.0;
    }
    let margin = 0.06 * (high - low).max(0.05 * high.abs()).max(1e-9);
    low - margin..high + margin
}

fn extremes(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    values
        .filter(|v| v.is_finite())
        .fold(start, |(low, high), v| (low.min(v), high.max(v)))
}

/// A plane with its axes drawn.
pub(super) struct Panel<'a, DB: DrawingBackend> {
    chart: ChartContext<'a, DB, Cartesian2d<Axis, Axis>>,
}

impl<'a, DB: DrawingBackend + 'a> Panel<'a, DB> {
    /// Draws title, axes and grid on `area`; `left` is the room for the labels of y, in pixels.
    pub(super) fn new(area: &'a Area<DB>, title: &str, x: Axis, y: Axis, left: i32) -> Drawn<Self> {
        let mut builder = ChartBuilder::on(area);
        builder.margin(10 * FINE).margin_right(18 * FINE);
        builder.x_label_area_size(58 * FINE).y_label_area_size(left * FINE);
        if !title.is_empty() {
            builder.caption(title, style::text(TITLE, INK, HPos::Center, VPos::Top));
        }
        let (x_label, y_label) = (x.label.clone(), y.label.clone());
        let mut chart = builder.build_cartesian_2d(x, y)?;
        let labels = |v| style::text(SMALL, INK, HPos::Center, v);
        chart
            .configure_mesh()
            // Away from the axis, where the first label of y stands.
            .set_tick_mark_size(LabelAreaPosition::Bottom, 8 * FINE)
            .axis_style(style::stroke(GREY, FINE as u32))
            .bold_line_style(style::stroke(PALE, FINE as u32))
            .light_line_style(style::stroke(PALE, 1))
            .label_style(labels(VPos::Center))
            .axis_desc_style(style::text(LABEL, INK, HPos::Center, VPos::Center))
            .x_desc(x_label)
            .y_desc(y_label)
            .draw()?;
        Ok(Self { chart })
    }

    /// A line through `points`, `width` in drawing units.
    pub(super) fn line(&mut self, points: &[(f64, f64)], colour: RGBColor, width: u32) -> Drawn {
        let style = style::stroke(colour, width);
        self.chart.draw_series(LineSeries::new(points.iter().copied(), style))?;
        Ok(())
    }

    /// A dashed line through `points`.
    pub(super) fn dashes(&mut self, points: &[(f64, f64)], colour: RGBColor, width: u32) -> Drawn {
        let style = style::stroke(colour, width);
        let series = DashedLineSeries::new(points.iter().copied(), 7 * FINE, 5 * FINE, style);
        self.chart.draw_series(series)?;
        Ok(())
    }

    /// A point.
    pub(super) fn marker(&mut self, point: (f64, f64), marker: Marker) -> Drawn {
        let area = self.chart.plotting_area().strip_coord_spec();
        let (x, y) = self.chart.backend_coord(&point);
        let base = area.get_base_pixel();
        marker.draw(&area, (x - base.0, y - base.1))
    }

    /// A filled box between two corners.
    pub(super) fn cell(&mut self, a: (f64, f64), b: (f64, f64), colour: RGBColor) -> Drawn {
        self.chart
            .draw_series(std::iter::once(Rectangle::new([a, b], colour.filled())))?;
        Ok(())
    }

    /// Text at a point, moved by `offset` pixels.
    pub(super) fn text(&mut self, point: (f64, f64), offset: (i32, i32), text: &str, style: TextStyle<'a>) -> Drawn {
        let offset = (FINE * offset.0, FINE * offset.1);
        let element = EmptyElement::at(point) + Text::new(text.to_string(), offset, style);
        self.chart.draw_series(std::iter::once(element))?;
        Ok(())
    }

    /// Where a point lies on the whole picture, in drawing units.
    pub(super) fn pixel(&self, point: (f64, f64)) -> (i32, i32) {
        self.chart.backend_coord(&point)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(axis: Axis) -> Vec<String> {
        axis.named_ticks().into_iter().map(|tick| tick.1).collect()
    }

    #[test]
    fn linear_ticks_are_round() {
        assert_eq!(
            names(Axis::linear("", 0.0..0.52, 6)),
            ["0.0", "0.1", "0.2", "0.3", "0.4", "0.5"]
        );
        assert_eq!(names(Axis::linear("", 23.0..31.0, 4)), ["24", "26", "28", "30"]);
    }

    #[test]
    fn logarithmic_ticks_name_their_powers() {
        assert_eq!(names(Axis::log("", 0.9..12.0)), ["1", "2", "5", "10"]);
        assert_eq!(
            names(Axis::log("", 1e-5..1.1)),
            ["10⁻⁵", "10⁻⁴", "0.001", "0.01", "0.1", "1"]
        );
        assert_eq!(names(Axis::log("", 9e3..1.1e7)), ["10000", "10⁵", "10⁶", "10⁷"]);
        assert_eq!(names(Axis::log("", 0.9..22.0).sparse()), ["1", "10"]);
        assert_eq!(names(Axis::log("", 1.5..6.0).sparse()), ["2", "5"]);
    }

    #[test]
    fn places_follow_the_scale() {
        let log = Axis::log("", 1.0..100.0);
        assert_eq!([1.0, 10.0, 100.0].map(|value| log.map(&value, (0, 200))), [0, 100, 200]);
        let linear = Axis::linear("", 0.0..10.0, 5);
        assert_eq!(linear.map(&2.5, (100, 0)), 75);
    }

    #[test]
    fn spans_survive_no_values_and_equal_ones() {
        assert_eq!(span(std::iter::empty()), 0.0..1.0);
        let range = span([3.0, 3.0, f64::NAN].into_iter());
        assert!(range.start < 3.0 && range.end > 3.0);
        assert_eq!(log_span([0.0, -1.0].into_iter()), 0.1..10.0);
    }
}
