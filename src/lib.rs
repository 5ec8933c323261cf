//! `domain ─► spacing ─► mesher ─► mesh ─► certificate ─► record ─► charts and report`
//!
//! The experiment that "Biting: Advancing Front Meets Sphere Packing" (Li, Teng, Üngör) never ran.
//! Each word of the pipeline is a module of this crate, in the order in which to read them:
//!
//! | module | holds |
//! |---|---|
//! | [`geometry`] | points, exact predicates (the one door for signs), near-queries |
//! | [`domain`] | the PSLG Ω to mesh: vertices, segments, holes, files, gallery, validation |
//! | [`spacing`] | control spacing f: lfs, expressions, gradient limiting, ∫ dA / f² |
//! | [`meshers`] | the trait [`meshers::Mesher`] and the list [`meshers::MESHERS`] |
//! | [`peers`] | meshers outside this crate, behind a process boundary |
//! | [`delaunay`] | points and boundary pieces → constrained Delaunay triangulation, carved |
//! | [`mesh`] | the result: triangles, markers, regions, and its files |
//! | [`quality`] | statistics and the certificate: every bound of the paper as a check |
//! | [`fem`] | what quality is for: a Poisson problem on the mesh, its error, iterations and eigenvalues |
//! | [`experiment`] | plans (TOML), the runner, records (JSON lines) |
//! | [`charts`], [`report`] | figures by plotters, pages from rows alone |
//! | [`lemmas`] | every statement of the paper with a bound, judged numerically and on meshes; errata |
//! | [`figures`] | the paper's figures from real runs, and the replay |
//! | [`cli`] | one file per verb |
//!
//! # Notation
//!
//! The only short names allowed in code are those of the paper: `alpha` (Lipschitz constant of the spacing as
//! evaluated), `c_b` (the biting circle at x is B(x, c_b f(x))), `t` = α c_b, `c_p` = c_b / (2 + t) (the packing circle
//! is B(x, c_p f(x))), `beta` = (1 + t) / (1 − t), `nn` (nearest-neighbour function), `integral` = ∫_Ω dA / f², `lfs`,
//! `nsf`, `gns`.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod charts;
pub mod cli;
pub mod delaunay;
pub mod domain;
pub mod experiment;
pub mod fem;
pub mod figures;
pub mod files;
pub mod geometry;
pub mod lemmas;
pub mod mesh;
pub mod meshers;
pub mod peers;
pub mod quality;
pub mod report;
pub mod spacing;
