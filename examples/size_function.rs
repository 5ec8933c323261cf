//! A size function in code: `cargo run --release --example size_function` writes size_function.svg.

use biting::Case;
use biting::domain::Domain;
use biting::geometry::DVec2;
use biting::mesh::files;
use biting::meshers::biting::Biting;
use biting::spacing::Spacing;
use std::error::Error;
use std::path::Path;

/// Fine along a circle, coarser away from it.
struct AlongCircle {
    centre: DVec2,
    radius: f64,
    finest: f64,
    growth: f64,
}

impl Spacing for AlongCircle {
    fn at(&self, x: DVec2) -> f64 {
        self.finest + self.growth * (x.distance(self.centre) - self.radius).abs()
    }

    /// Distances to a point change by no more than the way, so this is proved, as it has to be.
    fn lipschitz(&self) -> f64 {
        self.growth
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let front = AlongCircle {
        centre: DVec2::new(0.3, 0.4),
        radius: 0.5,
        finest: 0.02,
        growth: 0.3,
    };
    let square = Domain::polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])?;
    // The function is capped by local feature size and limited to t / c_b, as any other; edges come out about c_b f long.
    let case = Case::from_spacing(square, front, 0.25, 0.75)?;
    let mesher = Biting::default();
    let mesh = case.mesh(&mesher)?;
    let (statistics, certificate) = case.judge_of(&mesh, &mesher);

    println!("{} triangles, t = {:.3}", statistics.triangles, case.t());
    println!("smallest angle {:.2}°", statistics.min_angle_deg);
    println!("every guaranteed check holds: {}", certificate.holds);
    files::write(&mesh, Path::new("size_function.svg"))?;
    println!("wrote size_function.svg");
    Ok(())
}
