//! Plans (TOML), the runner and the rows it leaves.

pub mod machine;
pub mod plan;
pub mod record;
pub mod series;
pub mod summary;
