//! Smallest angle against size for families of methods: each row is a point, each family has a frontier.

use crate::suite::analysis::contest::Method;
use crate::suite::analysis::summary::{measured, rounded, unbeaten};
use crate::suite::rows::numbers::{first_seen, median, quantile};
use crate::suite::rows::record::parameter_text;
use crate::suite::rows::record::{Report, Row};

/// Parameters that move a method along its family's curve, or only say that it has no size to keep.
const SWEPT: [&str; 3] = ["angle", "size", "size_rule"];

/// One setting of a method.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// What was asked: t and c_b, or an angle.
    pub setting: String,
    /// Smallest angle, leaving out triangles at input angles under 60°, degrees.
    pub angle_deg: f64,
    /// Triangles / ∫ dA / lfs².
    pub size: f64,
}

/// Methods that differ in what they were asked alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Family {
    /// The mesher, with parameters that are neither defaults nor swept.
    pub label: String,
    /// The mesher's name.
    pub mesher: String,
    /// Place of the mesher, which gives its colour.
    pub place: usize,
    /// How many rows were asked for.
    pub asked: usize,
    /// The measured ones, from few triangles to many.
    pub points: Vec<Point>,
}

impl Family {
    /// The points that no other beats in both, from few triangles to many.
    pub fn frontier(&self) -> Vec<Point> {
        unbeaten(&self.points, |point| point.size, |point| point.angle_deg)
    }

    /// The fewest triangles with a smallest angle of at least so much.
    pub fn fewest(&self, angle_deg: f64) -> Option<&Point> {
        self.points.iter().find(|point| point.angle_deg >= angle_deg)
    }
}

/// The families of some rows, in the order in which they first appear: on one domain each row is a point; over several,
/// a setting that was measured on all of them is one, with the smallest of its angles and the median of its sizes.
pub fn families(rows: &[&Row]) -> Vec<Family> {
    let labels: Vec<(String, String)> = rows.iter().map(|row| (label(row), setting(row))).collect();
    let of = |family: &str| {
        let own: Vec<(&&Row, &str)> = rows
            .iter()
            .zip(&labels)
            .filter(|(_, (label, _))| label == family)
            .map(|(row, (_, setting))| (row, setting.as_str()))
            .collect();
        let method = own.first().map(|(row, _)| Method::of(row))?;
        let settings = first_seen(own.iter().map(|(_, setting)| *setting));
        let mut points: Vec<Point> = settings.iter().filter_map(|setting| point(&own, setting)).collect();
        points.sort_by(|a, b| {
            let by_size = a.size.total_cmp(&b.size);
            by_size.then(b.angle_deg.total_cmp(&a.angle_deg))
        });
        Some(Family {
            label: family.to_owned(),
            mesher: method.mesher,
            place: method.place,
            asked: own.len(),
            points,
        })
    };
    first_seen(labels.iter().map(|(label, _)| label.as_str()))
        .into_iter()
        .filter_map(of)
        .collect()
}

/// The point of one setting; absent where a row of it was not measured.
fn point(own: &[(&&Row, &str)], setting: &str) -> Option<Point> {
    let rows = own.iter().filter(|(_, other)| *other == setting);
    let reports: Option<Vec<&Report>> = rows.map(|(row, _)| measured(row)).collect();
    let reports = reports?;
    let angles: Option<Vec<f64>> = reports
        .iter()
        .map(|report| report.statistics.min_angle_free_deg)
        .collect();
    Some(Point {
        setting: setting.to_owned(),
        angle_deg: quantile(angles?, 0.0)?,
        size: median(reports.iter().map(|report| report.size_ratio_lfs).collect())?,
    })
}

/// The family's name: the method's label without what is swept.
fn label(row: &Row) -> String {
    let label = Method::of(row).label;
    let is_kept = |word: &&str| word.split_once('=').is_none_or(|(name, _)| !SWEPT.contains(&name));
    label.split(' ').filter(is_kept).collect::<Vec<_>>().join(" ")
}

fn setting(row: &Row) -> String {
    match row.cell.params.get(SWEPT[0]) {
        Some(angle) => format!("angle {}°", parameter_text(angle)),
        None => format!("t = {}, c_b = {}", rounded(row.cell.t), rounded(row.cell.c_b)),
    }
}

/// How many times the triangles of `other`'s frontier `own` has, at the angle of each point of `own`: setting and factor.
pub fn factors<'a>(own: &'a Family, other: &'a Family) -> Vec<(&'a str, f64)> {
    let factor = |point: &'a Point| Some((point.setting.as_str(), point.size / other.fewest(point.angle_deg)?.size));
    own.points.iter().filter_map(factor).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn family(points: &[(&str, f64, f64)]) -> Family {
        let point = |(setting, angle_deg, size): &(&str, f64, f64)| Point {
            setting: (*setting).into(),
            angle_deg: *angle_deg,
            size: *size,
        };
        Family {
            label: "made up".into(),
            mesher: "made-up".into(),
            place: 0,
            asked: points.len(),
            points: points.iter().map(point).collect(),
        }
    }

    #[test]
    fn what_is_beaten_in_both_is_not_on_the_frontier() {
        let made = family(&[("a", 10.0, 1.0), ("b", 9.0, 2.0), ("c", 20.0, 3.0), ("d", 20.0, 4.0)]);
        let frontier = made.frontier();
        let frontier: Vec<&str> = frontier.iter().map(|point| point.setting.as_str()).collect();
        assert_eq!(frontier, ["a", "c"]);
        assert_eq!(made.fewest(10.0).map(|point| point.size), Some(1.0));
        assert_eq!(made.fewest(10.5).map(|point| point.size), Some(3.0));
        assert_eq!(made.fewest(20.5), None);
    }

    #[test]
    fn factors_compare_at_equal_angle() {
        let own = family(&[("x", 15.0, 6.0), ("y", 25.0, 9.0)]);
        let other = family(&[("a", 10.0, 1.0), ("b", 20.0, 3.0)]);
        assert_eq!(factors(&own, &other), [("x", 2.0)]);
    }
}
