//! What is asked of a mesher on one domain, as `mesh` and `figures --replay` take it.

use super::exit::Failure;
use super::values::{parameter, positive};
use crate::spacing;
use crate::suite::rows::record::Cell;
use serde_json::Value;

/// The default of `--t`: see the page of findings in `results/sweep`.
pub const DEFAULT_T: &str = "0.25";

/// The default of `--c-b`: see the page of findings in `results/sweep`.
pub const DEFAULT_C_B: &str = "0.75";

#[derive(clap::Args)]
pub struct Asked {
    /// Control spacing f: lfs, uniform:H, expr:EXPRESSION in x and y, min(A, B); `biting list` shows all
    #[arg(long, value_name = "SPEC", default_value = "lfs")]
    spacing: String,
    /// Edge length wanted, an expression in x and y, in place of --spacing (f = size / c_b)
    #[arg(long, value_name = "EXPRESSION", conflicts_with = "spacing")]
    size: Option<String>,
    /// t = alpha c_b: the spacing is limited to the Lipschitz constant t / c_b
    #[arg(long, value_parser = positive, default_value = DEFAULT_T)]
    t: f64,
    /// Biting constant: edges are about c_b f long
    #[arg(long, value_parser = positive, default_value = DEFAULT_C_B)]
    pub c_b: f64,
    /// Seed of everything random
    #[arg(long, default_value_t = 0)]
    pub seed: u64,
    /// A parameter of the mesher, name=value; may be repeated
    #[arg(long, value_name = "NAME=VALUE", value_parser = parameter)]
    param: Vec<(String, Value)>,
    /// Do not cap the spacing by local feature size; the bounds of the paper no longer apply
    #[arg(long)]
    no_lfs_cap: bool,
}

impl Asked {
    /// Of that mesher on that domain.
    pub fn cell(&self, domain: &str, mesher: &str) -> Result<Cell, Failure> {
        let spacing = match &self.size {
            Some(size) => spacing::spec_for_size(size, self.c_b).map_err(Failure::input)?,
            None => self.spacing.clone(),
        };
        Ok(Cell {
            params: self.param.iter().cloned().collect(),
            seed: self.seed,
            lfs_cap: !self.no_lfs_cap,
            ..Cell::new(domain, mesher, &spacing, self.t, self.c_b)
        })
    }
}
