//! Parameters and spacings that are refused.

use super::*;
use crate::meshers::Parameters;

#[test]
fn parameters_out_of_range_are_refused() {
    for (name, value) in [
        ("search", 0.1),
        ("cleft", 150.0),
        ("accept", -1.0),
        ("low", 0.2),
        ("high", 0.5),
        ("smooth", 1e4),
    ] {
        let value = if name == "smooth" {
            serde_json::json!(value as u32)
        } else {
            serde_json::json!(value)
        };
        let refused = (ENTRY.make)(&Parameters::from_iter([(name.to_owned(), value)]))
            .err()
            .expect("refused");
        assert!(refused.contains(name) && refused.contains("from"), "{refused}");
    }
}

/// A spacing that is not positive and finite in the middle of the square.
struct Broken(f64);

impl Spacing for Broken {
    fn at(&self, x: crate::geometry::DVec2) -> f64 {
        if x.distance(crate::geometry::DVec2::splat(0.5)) > 0.25 {
            0.1
        } else {
            self.0
        }
    }

    fn lipschitz(&self) -> f64 {
        0.1
    }
}

#[test]
fn a_spacing_that_is_not_positive_is_reported_with_the_place() {
    for value in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
        let refused = AdvancingFront::DEFAULT.mesh(
            &domain("unit-square"),
            &Broken(value),
            &request(1.0),
            &mut Trace::default(),
        );
        assert!(
            matches!(refused, Err(MeshError::Spacing { x, y, .. }) if (x - 0.5).hypot(y - 0.5) <= 0.25),
            "{value}: {refused:?}"
        );
    }
}
