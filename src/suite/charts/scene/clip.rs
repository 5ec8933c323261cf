//! What of a line or a convex area lies in a box: plotters does not clip to the part of a picture that is drawn on.

use crate::geometry::predicates::orient2d;
use crate::geometry::{DVec2, Rect};

/// The parts of a line through `points` that lie in `frame`.
pub(super) fn line(points: &[DVec2], frame: Rect) -> Vec<Vec<DVec2>> {
    let mut parts: Vec<Vec<DVec2>> = Vec::new();
    for ends in points.windows(2) {
        let Some([from, to]) = segment([ends[0], ends[1]], frame) else {
            continue;
        };
        match parts.last_mut().filter(|part| part.last() == Some(&from)) {
            Some(part) => part.push(to),
            None => parts.push(vec![from, to]),
        }
    }
    parts
}

/// The part of a segment that lies in `frame` (Liang and Barsky).
pub(super) fn segment([from, to]: [DVec2; 2], frame: Rect) -> Option<[DVec2; 2]> {
    let step = to - from;
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    let sides = [
        (-step.x, from.x - frame.min.x),
        (step.x, frame.max.x - from.x),
        (-step.y, from.y - frame.min.y),
        (step.y, frame.max.y - from.y),
    ];
    for (speed, room) in sides {
        if speed == 0.0 && room < 0.0 {
            return None;
        }
        if speed < 0.0 {
            enter = enter.max(room / speed);
        } else if speed > 0.0 {
            leave = leave.min(room / speed);
        }
    }
    let at = |share: f64| if share == 1.0 { to } else { from + share * step };
    (enter < leave).then(|| [at(enter), at(leave)])
}

/// The part of a convex polygon on the left of the line from `from` to `to` (Sutherland and Hodgman).
pub(super) fn left_of(polygon: &[DVec2], [from, to]: [DVec2; 2]) -> Vec<DVec2> {
    let side = |point: DVec2| orient2d(from, to, point);
    let mut kept = Vec::new();
    for (k, &point) in polygon.iter().enumerate() {
        let next = polygon[(k + 1) % polygon.len()];
        let (here, there) = (side(point), side(next));
        if here >= 0.0 {
            kept.push(point);
        }
        if (here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0) {
            kept.push(point.lerp(next, here / (here - there)));
        }
    }
    kept
}

/// The part of a convex polygon that lies in `frame`.
pub(super) fn convex(polygon: &[DVec2], frame: Rect) -> Vec<DVec2> {
    let corners = [
        frame.min,
        DVec2::new(frame.max.x, frame.min.y),
        frame.max,
        DVec2::new(frame.min.x, frame.max.y),
    ];
    (0..4).fold(polygon.to_vec(), |rest, k| {
        left_of(&rest, [corners[k], corners[(k + 1) % 4]])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Rect = Rect {
        min: DVec2::ZERO,
        max: DVec2::new(2.0, 1.0),
    };

    #[test]
    fn a_line_that_leaves_and_returns_comes_in_parts() {
        let points = [(0.5, 0.5), (0.5, 2.0), (1.5, 2.0), (1.5, 0.5), (1.0, 0.5)].map(DVec2::from);
        let parts = line(&points, FRAME);
        assert_eq!(parts.len(), 2);
        assert_eq!(parts[0], [(0.5, 0.5), (0.5, 1.0)].map(DVec2::from));
        assert_eq!(parts[1], [(1.5, 1.0), (1.5, 0.5), (1.0, 0.5)].map(DVec2::from));
        assert_eq!(segment([DVec2::new(-1.0, 2.0), DVec2::new(3.0, 2.0)], FRAME), None);
    }

    #[test]
    fn a_square_over_a_corner_keeps_its_quarter() {
        let square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 0.5), (-1.0, 0.5)].map(DVec2::from);
        let part = convex(&square, FRAME);
        let area: f64 = (0..part.len())
            .map(|k| part[k].perp_dot(part[(k + 1) % part.len()]))
            .sum();
        assert!((0.5 * area - 0.5).abs() < 1e-12, "{part:?}");
    }
}
