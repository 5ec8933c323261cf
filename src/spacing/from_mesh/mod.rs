//! Spacings that an earlier mesh carries: by its edges and vertices (§2.1), or by the values at them (§2.2).

pub(super) mod field;
pub(super) mod measures;
pub(super) mod old_mesh;
pub(super) mod recover;
