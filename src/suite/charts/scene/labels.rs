//! Where labels go.
//!
//! # Idea
//! Each label may stand on one of some rings of places around its point. A place costs what it covers: other labels and
//! points most, then leaving the picture, then lines by the length that is covered, then its distance from the point.
//! Labels take their cheapest place in turn, and again until none moves: a descent, so it ends. Equal input gives equal
//! output.

use super::clip;
use crate::geometry::predicates::{Meeting, segments_meet};
use crate::geometry::{DVec2, Rect};

/// What is to be placed: pixels, y down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wanted {
    /// The point it belongs to.
    pub at: DVec2,
    /// Width and height.
    pub size: DVec2,
}

/// What labels keep clear of: pixels, y down.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Obstacles {
    /// Where points and lengths' arrows are drawn.
    pub points: Vec<Rect>,
    /// Lines, each with its weight: what covering a pixel of it costs.
    pub lines: Vec<([DVec2; 2], f64)>,
}

/// Directions tried, from the right on; and how far the label's box stands from the point, in pixels.
const DIRECTIONS: usize = 24;
const DISTANCES: [f64; 6] = [7.0, 11.0, 16.0, 23.0, 32.0, 44.0];

/// What a pixel of distance costs; a label on another, or on a point, for each square pixel, and at least; a pixel outside the
/// picture.
const FAR: f64 = 1.6;
const COLLISION: f64 = 4.0;
const COLLIDES: f64 = 4000.0;
const OUTSIDE: f64 = 1000.0;

/// Labels keep so many pixels apart.
const APART: f64 = 2.0;

/// And so many from lines.
const LINES_APART: f64 = 2.5;

/// A label that moved this often stays.
const ROUNDS: usize = 12;

/// The boxes of all labels in `frame`.
pub(crate) fn place(wanted: &[Wanted], obstacles: &Obstacles, frame: Rect) -> Vec<Rect> {
    let fixed: Vec<Vec<(Rect, f64)>> = wanted.iter().map(|label| candidates(label, obstacles, frame)).collect();
    let mut chosen: Vec<Option<Rect>> = vec![None; wanted.len()];
    for _ in 0..ROUNDS {
        let mut moved = false;
        for k in 0..wanted.len() {
            let total = |(place, cost): &(Rect, f64)| {
                let others = chosen.iter().enumerate().filter(|(other, _)| *other != k);
                cost + others
                    .filter_map(|(_, other)| *other)
                    .map(|other| collision(*place, grown(other, APART)))
                    .sum::<f64>()
            };
            let best = fixed[k].iter().min_by(|a, b| total(a).total_cmp(&total(b)));
            let best = best.map(|(place, _)| *place);
            moved |= best != chosen[k];
            chosen[k] = best;
        }
        if !moved {
            break;
        }
    }
    chosen.into_iter().flatten().collect()
}

/// Every place of a label, with what it costs but for other labels.
fn candidates(label: &Wanted, obstacles: &Obstacles, frame: Rect) -> Vec<(Rect, f64)> {
    let half = 0.5 * label.size;
    let mut places = Vec::new();
    for distance in DISTANCES {
        for k in 0..DIRECTIONS {
            let direction = DVec2::from_angle(std::f64::consts::TAU * k as f64 / DIRECTIONS as f64);
            // The nearest point of the box lies at `distance`: move out until it does.
            let centre = label.at + direction * reach(direction, half, distance);
            let place = Rect {
                min: centre - half,
                max: centre + half,
            };
            places.push((place, cost(place, label, distance, obstacles, frame)));
        }
    }
    places
}

/// How far the centre of a box of half size `half` must be in `direction` for the box to be at `distance`.
fn reach(direction: DVec2, half: DVec2, distance: f64) -> f64 {
    let (mut near, mut far) = (0.0, distance + half.length());
    for _ in 0..30 {
        let middle = 0.5 * (near + far);
        let gap = ((direction * middle).abs() - half).max(DVec2::ZERO).length();
        if gap < distance {
            near = middle;
        } else {
            far = middle;
        }
    }
    far
}

fn cost(place: Rect, label: &Wanted, distance: f64, obstacles: &Obstacles, frame: Rect) -> f64 {
    let points: f64 = obstacles.points.iter().map(|point| collision(place, *point)).sum();
    let room = grown(place, LINES_APART);
    let lines = obstacles.lines.iter().filter_map(|(ends, weight)| {
        let [from, to] = clip::segment(*ends, room)?;
        Some(weight * (1.0 + from.distance(to)))
    });
    let lines: f64 = lines.sum();
    let outside = (frame.min - place.min)
        .max(place.max - frame.max)
        .max(DVec2::ZERO)
        .element_sum();
    // A line between a point and its label makes it seem to be on the other side.
    let nearest = label.at.clamp(place.min, place.max);
    let between = obstacles
        .lines
        .iter()
        .filter(|(ends, _)| crosses(*ends, [label.at, nearest]));
    let between: f64 = between.map(|(_, weight)| 2.0 * weight).sum();
    points + lines + between + OUTSIDE * outside + FAR * distance
}

/// Whether two segments cross away from the first end of the second.
fn crosses([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    segments_meet(a, b, c.lerp(d, 0.3), d) == Meeting::Cross
}

/// What two boxes cost that overlap.
fn collision(a: Rect, b: Rect) -> f64 {
    let common = (a.max.min(b.max) - a.min.max(b.min)).max(DVec2::ZERO);
    match common.x * common.y {
        area if area > 0.0 => COLLIDES + COLLISION * area,
        _ => 0.0,
    }
}

/// A box with a margin around it.
pub(super) fn grown(place: Rect, margin: f64) -> Rect {
    Rect {
        min: place.min - margin,
        max: place.max + margin,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Rect = Rect {
        min: DVec2::ZERO,
        max: DVec2::splat(300.0),
    };

    fn overlap(a: Rect, b: Rect) -> bool {
        a.min.cmplt(b.max).all() && b.min.cmplt(a.max).all()
    }

    fn wanted(points: &[(f64, f64)]) -> (Vec<Wanted>, Obstacles) {
        let size = DVec2::new(40.0, 16.0);
        let labels = points.iter().map(|&at| Wanted { at: at.into(), size }).collect();
        let around = |&at: &(f64, f64)| {
            let at = DVec2::from(at);
            Rect {
                min: at - 5.0,
                max: at + 5.0,
            }
        };
        let obstacles = Obstacles {
            points: points.iter().map(around).collect(),
            lines: Vec::new(),
        };
        (labels, obstacles)
    }

    #[test]
    fn labels_of_points_close_together_keep_apart() {
        let (labels, obstacles) = wanted(&[
            (150.0, 150.0),
            (160.0, 150.0),
            (150.0, 162.0),
            (140.0, 148.0),
            (298.0, 2.0),
        ]);
        let places = place(&labels, &obstacles, FRAME);
        assert_eq!(places.len(), labels.len());
        for (k, a) in places.iter().enumerate() {
            assert!(places[..k].iter().all(|b| !overlap(*a, *b)), "{k}: {places:?}");
            assert!(obstacles.points.iter().all(|b| !overlap(*a, *b)), "{k}: on a point");
            assert!(FRAME.contains(a.min) && FRAME.contains(a.max), "{k}: outside");
        }
        assert_eq!(places, place(&labels, &obstacles, FRAME), "equal input, equal output");
    }

    #[test]
    fn a_label_stays_on_its_side_of_a_line() {
        let (labels, mut obstacles) = wanted(&[(150.0, 150.0)]);
        let line = [DVec2::new(0.0, 158.0), DVec2::new(300.0, 158.0)];
        obstacles.lines.push((line, 3.0));
        let places = place(&labels, &obstacles, FRAME);
        assert!(places[0].max.y < 158.0, "{places:?}");
    }

    #[test]
    fn boxes_stand_at_their_distance() {
        let half = DVec2::new(20.0, 8.0);
        for k in 0..16 {
            let direction = DVec2::from_angle(f64::from(k) * 0.4);
            let centre = direction * reach(direction, half, 7.0);
            let gap = (centre.abs() - half).max(DVec2::ZERO).length();
            assert!((gap - 7.0).abs() < 1e-3, "{direction}: {gap}");
        }
    }
}
