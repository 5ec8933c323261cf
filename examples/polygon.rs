//! Meshes a polygon with a hole: `cargo run --release --example polygon` writes polygon.svg and polygon.vtu.

use biting::Case;
use biting::domain::{Domain, Pslg};
use biting::geometry::DVec2;
use biting::mesh::files;
use biting::meshers::biting::Biting;
use biting::theory::{Promises, Rule};
use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    // A house with a window. For one ring alone, `Domain::polygon` is shorter.
    let mut house = Pslg::new("house");
    let wall = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (2.0, 5.0), (0.0, 3.0)];
    let window = [(1.5, 1.5), (2.5, 1.5), (2.5, 2.5), (1.5, 2.5)];
    house.add_ring(wall.map(DVec2::from), 1);
    house.add_ring(window.map(DVec2::from), 2);
    house.add_hole(DVec2::new(2.0, 2.0));

    // Sizes follow local feature size, and change by at most t / c_b = 1/3 per unit of length.
    let case = Case::new(Domain::new(house)?, "lfs", 0.25, 0.75)?;
    let mesher = Biting::default();
    let mesh = case.mesh(&mesher)?;
    let (statistics, certificate) = case.judge_of(&mesh, &mesher);

    println!("{} vertices, {} triangles", statistics.vertices, statistics.triangles);
    println!(
        "smallest angle {:.2}°, at least {:.2}° was promised",
        statistics.min_angle_deg,
        Promises {
            rule: Rule::Earlier,
            t: case.t()
        }
        .min_angle_deg()
    );
    println!("every guaranteed check holds: {}", certificate.holds);
    for name in ["polygon.svg", "polygon.vtu"] {
        files::write(&mesh, Path::new(name))?;
        println!("wrote {name}");
    }
    Ok(())
}
