//! Figures, drawn by plotters: one function a figure, one style file.
//!
//! Every figure is written twice, as SVG and as PNG, from the same drawing code.

mod adaptation;
mod angles;
mod bitmap;
mod bounds;
mod canvas;
mod corners;
mod dots;
mod fewest;
mod frontier;
mod histograms;
mod legend;
mod maps;
mod mesh;
mod methods;
mod orders;
mod oversampling;
mod panel;
mod poisson;
mod rules;
pub mod scene;
mod seams;
mod size;
mod style;
mod time;

pub use adaptation::adaptation;
pub use angles::smallest_angle;
pub use bounds::{BoundFigure, bound};
pub use canvas::ChartError;
pub use corners::{side_by_side, window};
pub use fewest::fewest;
pub use frontier::frontier;
pub use histograms::{angles_by_method, angles_by_order, angles_by_t};
pub use maps::spacing_maps;
pub use mesh::{draw_mesh, draw_mesh_sheet, draw_small_mesh};
pub use methods::{domains, methods, methods_against_t};
pub use orders::orders;
pub use oversampling::oversampling;
pub use poisson::poisson;
pub use rules::rules;
pub use seams::seams;
pub use size::{against_t, efficiency, heat_map};
pub use time::{time, time_by_method, time_per_triangle};
