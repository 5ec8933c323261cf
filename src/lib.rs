//! `domain ─► spacing ─► mesher ─► mesh ─► certificate ─► record ─► charts and report`
//!
//! The experiment that "Biting: Advancing Front Meets Sphere Packing" (Li, Teng, Üngör) never ran.
//! Each word of the pipeline is a module of this crate, in the order in which to read them:
//!
//! | module | holds |
//! |---|---|
//! | [`theory`] | the paper's formulas, hypotheses and claims, each once |
//! | [`geometry`] | points, exact predicates (the one door for signs), near-queries |
//! | [`domain`] | the PSLG Ω to mesh: vertices, segments, holes, files, gallery, validation |
//! | [`mesh`] | the result: triangles, markers, regions, and its files |
//! | [`delaunay`] | points and boundary pieces → constrained Delaunay triangulation, carved |
//! | [`spacing`] | control spacing f: lfs, expressions, gradient limiting, ∫ dA / f² |
//! | [`meshers`] | the trait [`meshers::Mesher`] and the list [`meshers::MESHERS`] |
//! | [`quality`] | statistics and the certificate: every bound of the paper as a check |
//! | `suite` | the experiment around the library, behind the feature of that name |
//!
//! # Notation
//!
//! The only short names allowed in code are those of the paper: `alpha` (Lipschitz constant of the spacing as
//! evaluated), `c_b` (the biting circle at x is B(x, c_b f(x))), `t` = α c_b, `c_p` = c_b / (2 + t) (the packing circle
//! is B(x, c_p f(x))), `beta` = (1 + t) / (1 − t), `nn` (nearest-neighbour function), `integral` = ∫_Ω dA / f², `lfs`,
//! `nsf`, `gns`.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod case;
pub mod delaunay;
pub mod domain;
pub mod files;
pub mod geometry;
pub mod mesh;
pub mod meshers;
pub mod quality;
pub mod spacing;
#[cfg(feature = "suite")]
pub mod suite;
pub mod theory;

pub use case::Case;
