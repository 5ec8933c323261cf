//! What is in each figure against the paper's definitions, recomputed by other means than those it was found by; and the committed
//! files against what the code draws now.

mod boundary;
mod circles;
mod labels;
mod scheme;
mod stale;
mod triangles;

use super::Material;
use super::run::Run;
use crate::geometry::DVec2;
use crate::geometry::near::Disc;
use std::path::Path;
use std::sync::OnceLock;

/// What rounding may do to a distance, as a share of a circle's radius.
const ROUNDING: f64 = 1e-9;

fn material() -> &'static Material {
    static MATERIAL: OnceLock<Material> = OnceLock::new();
    MATERIAL.get_or_init(|| Material::new(&Path::new(env!("CARGO_MANIFEST_DIR")).join("results")))
}

fn is_on_circle(point: DVec2, disc: &Disc) -> bool {
    (point.distance(disc.centre) - disc.radius).abs() <= ROUNDING * disc.radius
}

/// Whether a point lies on a segment, by the triangle inequality.
fn is_on_segment(point: DVec2, [a, b]: [DVec2; 2]) -> bool {
    a.distance(point) + point.distance(b) <= a.distance(b) * (1.0 + ROUNDING)
}

/// Whether a circle is the biting circle of its centre.
fn is_biting(run: &Run, disc: &Disc) -> bool {
    let radius = run.asked.c_b * run.case.spacing.function.at(disc.centre);
    (disc.radius - radius).abs() <= ROUNDING * radius
}

/// Whether a point is in the domain, by counting the boundary to its right; not for points on it.
fn is_inside(run: &Run, point: DVec2) -> bool {
    let segments = (0..run.case.domain.segments().len()).filter(|segment| run.case.domain.is_boundary(*segment));
    let right = segments.filter(|segment| {
        let [a, b] = run.case.domain.ends(*segment);
        (a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    right.count() % 2 == 1
}
