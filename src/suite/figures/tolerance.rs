//! Tolerances of figures and replays, each with its reason.

/// A point lies on a circle, or on a segment, if it is off by less than this share of the circle's radius. Points on
/// segments are rounded, and biting shrinks circles by far less ([`COVERED`](crate::geometry::tolerance::COVERED)).
pub const ON_CIRCLE: f64 = 1e-6;

/// Shorter parts of a circle, in radians, or of a segment, as a share of it, are rounding errors where others meet.
pub const NOTHING: f64 = 1e-6;

/// Corners of a triangle are moved by this share of the way to its middle before it is asked what they see, since rounding
/// puts corners on a segment beside it, which would then hide them.
pub const PULLED_IN: f64 = 1e-6;

/// Replay: a centre lies on a side of a notch if its direction from the notch's vertex is off by less than this many radians:
/// centres on segments are rounded.
pub const ON_SIDE: f64 = 1e-9;
