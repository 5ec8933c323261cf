//! Plans (TOML), the runner and the rows it leaves.

pub mod record;
