//! Plans (TOML), the runner and the rows it leaves.
