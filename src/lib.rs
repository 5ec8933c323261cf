//! Provably good triangle meshes of domains in the plane, by *biting*: an advancing front that packs circles (Li, Teng,
//! Üngör, "Biting: Advancing Front Meets Sphere Packing"), with three other methods to compare it with and a
//! certificate that checks every bound of the paper on every mesh.
//!
//! ```
//! use biting::{Case, domain::Domain, mesh::files, meshers::biting::Biting};
//!
//! let house = Domain::polygon(&[[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [2.0, 5.0], [0.0, 3.0]])?;
//! // Sizes follow local feature size; t bounds how fast they change, edges are about c_b times as long.
//! let case = Case::new(house, "lfs", 0.25, 0.75)?;
//! let mesher = Biting::default();
//! let mesh = case.mesh(&mesher)?;
//! let (statistics, certificate) = case.judge_of(&mesh, &mesher);
//! assert!(certificate.holds && statistics.min_angle_deg > 14.47); // asin(1/2 − t)
//! files::write(&mesh, &std::env::temp_dir().join("house.vtu"))?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The folder `examples/` has a polygon with a hole, a size function in code, and a mesher of one's own.
//!
//! # Pipeline
//!
//! `domain ─► spacing ─► mesher ─► mesh ─► certificate ─► record ─► charts and report`
//!
//! [`Case`] is one domain with the f and the c_b by which to mesh it. The modules, in the order in which to read them:
//!
//! | module | contains |
//! |---|---|
//! | [`theory`] | the paper's formulas, hypotheses and claims, each once |
//! | [`geometry`] | points, exact predicates (all signs come from there), near-queries |
//! | [`domain`] | the PSLG Ω to mesh: vertices, segments, holes; files, gallery, validation, repair |
//! | [`mesh`] | the mesh: triangles, markers, regions, and its files |
//! | [`delaunay`] | points and boundary pieces → constrained Delaunay triangulation, carved |
//! | [`spacing`] | control spacing f: local feature size, expressions, earlier meshes; gradient limiting; ∫ dA / f² |
//! | [`meshers`] | the trait [`meshers::Mesher`] and the list [`meshers::MESHERS`]; [`meshers::biting`] is the paper's |
//! | [`quality`] | statistics and the certificate: every bound of the paper as a check |
//! | `suite` | the experiment around the library: record, charts, report, command line |
//!
//! # Features
//!
//! `suite`, which is on by default, adds the experiment and the command line with their dependencies. A program that only makes
//! meshes needs none of it: `default-features = false`.
//!
//! # Notation
//!
//! The only short names in the code are those of the paper:
//!
//! | name | paper | meaning |
//! |---|---|---|
//! | `alpha` | α | Lipschitz constant of the spacing f as it is evaluated |
//! | `c_b` | c_b | the biting circle at x is B(x, c_b f(x)) |
//! | `t` | t = α c_b | what the bounds on angles and size depend on |
//! | `c_p` | c_p = c_b / (2 + t) | the packing circle at x is B(x, c_p f(x)) |
//! | `beta` | β = (1 + t) / (1 − t) | how wide a gap between packing circles can be |
//! | `nn` | nn(x) | nearest-neighbour function of a mesh |
//! | `integral` | ∫_Ω dA / f² | what the number of triangles is measured by |
//! | `lfs`, `nsf`, `gns` | the same | local feature size, numerical spacing function, the smaller of the two |
#![forbid(unsafe_code)]
#![warn(missing_docs)]
// Private items have their pages with `cargo doc --document-private-items`.
#![allow(rustdoc::private_intra_doc_links)]

mod case;
pub mod delaunay;
pub mod domain;
pub mod geometry;
pub mod mesh;
pub mod meshers;
pub mod quality;
pub mod spacing;
#[cfg(feature = "suite")]
pub mod suite;
pub mod theory;

pub use case::Case;
