//! Figures, drawn by plotters: one function a figure, one style file.
//!
//! Every figure is written twice, as SVG and as PNG, from the same drawing code.

mod adapt;
mod angles;
mod bitmap;
mod bounds;
mod canvas;
mod corners;
mod dots;
mod frontier;
mod frontiers;
mod histograms;
mod legend;
mod maps;
mod mesh;
mod orders;
mod oversampling;
mod panel;
mod poisson;
mod rivals;
mod rules;
pub mod scene;
mod size;
mod style;
mod time;

pub use adapt::adaptation;
pub use angles::smallest_angle;
pub use bounds::{BoundFigure, bound};
pub use canvas::ChartError;
pub use corners::{side_by_side, window};
pub use frontier::size_for_angle;
pub use frontiers::frontiers;
pub use histograms::{angles_by_method, angles_by_order, angles_by_t};
pub use maps::spacing_maps;
pub use mesh::{draw_mesh, draw_mesh_sheet};
pub use orders::orders;
pub use oversampling::oversampling;
pub use poisson::{YIELDS, poisson};
pub use rivals::{domains, methods, methods_against_t, seams};
pub use rules::rules;
pub use size::{SIZE_RATIO, SIZE_RATIO_LFS, against_t, efficiency, heat_map};
pub use time::{time, time_by_method, time_per_triangle};
