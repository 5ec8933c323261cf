//! What the gradient limiter reaches of the largest α-Lipschitz function below lfs (§2.3), on a real outline of more than 10⁴
//! segments, against a dense reference that shares nothing with it.

use crate::domain::{Domain, gallery};
use crate::files::write_whole;
use crate::geometry::DVec2;
use crate::spacing::{Options, build_with, largest_at, lfs_of};
use crate::suite::report::markdown::{number, table};
use crate::suite::rows::numbers::median;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The outline.
const OUTLINE: &str = "norway";
/// The Lipschitz constants; from the limit factor on, lfs is scaled instead, and from 1 on it is left as it is.
const ALPHAS: [f64; 9] = [0.05, 0.1, 0.2, 1.0 / 3.0, 0.5, 0.6, 0.7, 0.9, 1.0];
/// Points looked at: so many at random in the domain, and as many along its segments.
const POINTS: usize = 300;
/// How near the reference is to be.
const GAP: f64 = 1e-3;
/// Below `root`.
const ROWS: &str = "results/lemmas/limiter.jsonl";

/// The limiter for one α, as its line of `limiter.jsonl`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Limiting {
    /// The domain.
    pub domain: String,
    /// Its segments.
    pub segments: usize,
    /// The Lipschitz constant asked for.
    pub alpha: f64,
    /// The share of the largest function that is promised.
    pub promised: f64,
    /// The smallest share seen, against an upper bound of the largest function.
    pub least: f64,
    /// The median.
    pub middle: f64,
    /// The largest, against a lower bound: above 1 would be above the largest function.
    pub most: f64,
    /// Where the smallest was seen.
    pub at: [f64; 2],
    /// How far apart the two bounds are at worst, as a share.
    pub gap: f64,
    /// Points looked at.
    pub points: usize,
}

/// Measures, and writes the rows below `root`; returns the file.
///
/// # Errors
/// What could not be made or written.
pub fn measure(root: &Path, say: impl Fn(&Limiting)) -> Result<PathBuf, String> {
    let domain = gallery::domain(OUTLINE).ok_or("the gallery has no such outline")?;
    let domain = domain.map_err(|error| error.to_string())?;
    let mut rows = String::new();
    for alpha in ALPHAS {
        let row = limiting(&domain, alpha, POINTS)?;
        say(&row);
        rows += &(serde_json::to_string(&row).map_err(|error| error.to_string())? + "\n");
    }
    let path = root.join(ROWS);
    write_whole(&path, rows.as_bytes()).map_err(|error| format!("could not write {}: {error}", path.display()))?;
    Ok(path)
}

fn limiting(domain: &Domain, alpha: f64, count: usize) -> Result<Limiting, String> {
    let lfs = Arc::new(lfs_of(domain).map_err(|error| error.to_string())?);
    let options = Options::with_alpha(alpha);
    let given = || Ok(lfs.clone());
    let limited = build_with("lfs", domain, &options, given).map_err(|error| error.to_string())?;
    let points = points(domain, count);
    let shares: Vec<[f64; 3]> = points
        .par_iter()
        .map(|&x| {
            let [least, most] = largest_at(&*lfs, domain, alpha, x, GAP);
            let value = limited.function.at(x);
            [value / most, value / least, most / least - 1.0]
        })
        .collect();
    let worst = shares.iter().zip(&points).min_by(|a, b| a.0[0].total_cmp(&b.0[0]));
    let (_, at) = worst.ok_or("no points")?;
    let column = |k: usize| shares.iter().map(move |share| share[k]);
    Ok(Limiting {
        domain: OUTLINE.into(),
        segments: domain.segments().len(),
        alpha,
        promised: options.limit_factor,
        least: column(0).fold(f64::INFINITY, f64::min),
        middle: median(column(0).collect()).unwrap_or(f64::NAN),
        most: column(1).fold(0.0, f64::max),
        at: at.to_array(),
        gap: column(2).fold(0.0, f64::max),
        points: points.len(),
    })
}

/// Points at random in the domain, and points along its segments at random.
fn points(domain: &Domain, count: usize) -> Vec<DVec2> {
    let mut random = Pcg64::seed_from_u64(0);
    let bounds = domain.bounds();
    let mut points = Vec::with_capacity(2 * count);
    while points.len() < count {
        let x = bounds.min + bounds.size() * DVec2::new(random.random(), random.random());
        if domain.contains(x) {
            points.push(x);
        }
    }
    for _ in 0..count {
        let [a, b] = domain.ends(random.random_range(0..domain.segments().len()));
        points.push(a.lerp(b, random.random()));
    }
    points
}

/// The rows that were committed, none where there are none.
///
/// # Errors
/// A row that cannot be read.
pub fn read(root: &Path) -> Result<Vec<Limiting>, String> {
    let path = root.join(ROWS);
    if !path.is_file() {
        return Ok(Vec::new());
    }
    let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let row = |line: &str| serde_json::from_str(line).map_err(|error| format!("{}: {error}", path.display()));
    text.lines().map(row).collect()
}

/// The section of the page.
pub fn section(rows: &[Limiting]) -> String {
    let Some(first) = rows.first() else {
        return String::new();
    };
    let cells = |row: &Limiting| {
        vec![
            number(row.alpha),
            number(row.promised),
            number(row.least),
            number(row.middle),
            number(row.most),
            number(row.gap),
        ]
    };
    format!(
        "## The limiter against the largest function\n\n§2.3: of all α-Lipschitz functions below lfs there is a largest, f_α. The \
         limited lfs of `{}` ({} segments) over f_α, at {} points, half of them at random in the domain and half along segments. f_α \
         is bracketed by branch and bound over the domain, which shares nothing with the limiter; the smallest share and the median \
         are over its upper bound, the largest is over its lower one, and would be above 1 + bracket if the limited function \
         were not below f_α. Measured by `cargo run --release -- lemmas --limiter`.\n\n",
        first.domain, first.segments, first.points
    ) + &table(
        &[
            "α",
            "promised",
            "smallest share",
            "median",
            "largest share",
            "bracket at worst",
        ],
        &rows.iter().map(cells).collect::<Vec<_>>(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limiter_keeps_its_promise_and_lfs_itself_is_the_largest_for_alpha_1() {
        let domain = gallery::domain("gear").expect("there").expect("valid");
        let row = limiting(&domain, 0.3, 20).expect("positive");
        assert!(row.promised <= row.least && row.most <= 1.0 + row.gap + 1e-9, "{row:?}");
        assert!(
            row.gap < 2.0 * GAP && row.least <= row.middle && row.points == 40,
            "{row:?}"
        );
        let row = limiting(&domain, 1.0, 5).expect("positive");
        assert!(
            (row.least - 1.0).abs() <= row.gap && (row.most - 1.0).abs() <= row.gap,
            "{row:?}"
        );
    }

    #[test]
    fn rows_are_read_as_written_and_told() {
        let folder = tempfile::tempdir().expect("a folder");
        assert_eq!((read(folder.path()), section(&[])), (Ok(Vec::new()), String::new()));
        let domain = gallery::domain("unit-square").expect("there").expect("valid");
        let row = limiting(&domain, 0.5, 3).expect("positive");
        let path = folder.path().join(ROWS);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        std::fs::write(&path, serde_json::to_string(&row).expect("a row") + "\n").expect("written");
        assert_eq!(read(folder.path()), Ok(vec![row.clone()]));
        assert!(section(&[row]).contains("4 segments"));
        std::fs::write(&path, "{").expect("written");
        assert!(read(folder.path()).expect_err("no row").contains("limiter.jsonl"));
    }
}
