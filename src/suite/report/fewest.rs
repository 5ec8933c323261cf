//! Which (t, c_b) has the fewest triangles for a smallest angle.

use super::drawer::Drawer;
use super::markdown::{degrees, number, parameter, table};
use crate::suite::analysis::results::Results;
use crate::suite::analysis::summary::Pair;
use crate::suite::charts::{self, ChartError};
use crate::suite::run::plan::Section;

/// The smallest angles that users ask for, degrees.
const ANGLES_DEG: [f64; 8] = [5.0, 10.0, 15.0, 20.0, 22.5, 25.0, 28.0, 30.0];

/// The pairs over domains without acute angles, and over all domains.
fn pairs(results: &Results) -> [Vec<Pair>; 2] {
    match results.grids(Section::Fewest).first() {
        Some((_, grid)) => [grid.without_acute().pairs(), grid.pairs()],
        None => Default::default(),
    }
}

/// Angles that findings name, degrees.
const TOLD_DEG: [f64; 2] = [20.0, 28.0];

/// A sentence for each of some angles: the pair with the fewest triangles.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let [plain, _] = pairs(results);
    let domains = plain.iter().map(|pair| pair.domains).max().unwrap_or(0);
    let of = |angle: f64| {
        let pair = fewest(&plain, angle)?;
        let (t, c_b) = (parameter(pair.t), parameter(pair.c_b));
        Some(format!(
            "For a smallest angle of {angle}° t = {t} and c_b = {c_b} have the fewest triangles, {} per ∫dA/lfs², on {domains} domains \
             without angles under 90°.",
            number(pair.size_ratio_lfs)
        ))
    };
    TOLD_DEG.into_iter().filter_map(of).collect()
}

/// The pair with the fewest triangles for each of some angles, without acute domains and with them.
pub(super) fn text(results: &Results) -> String {
    let [plain, all] = pairs(results);
    let domains = |pairs: &[Pair]| pairs.iter().map(|pair| pair.domains).max();
    let mut text = String::new();
    if !plain.is_empty() {
        text += &fewest_table(&plain, "domains without angles under 90° between segments");
    }
    if domains(&all) > domains(&plain) {
        text += &fewest_table(&all, "domains, leaving out triangles at input angles under 60°");
    }
    text
}

fn fewest_table(pairs: &[Pair], title: &str) -> String {
    let domains = pairs.iter().map(|pair| pair.domains).max().unwrap_or(0);
    let lines = ANGLES_DEG.iter().map(|angle| {
        let pair = fewest(pairs, *angle);
        vec![
            format!("{angle}°"),
            pair.map_or("–".into(), |pair| parameter(pair.t)),
            pair.map_or("–".into(), |pair| parameter(pair.c_b)),
            degrees(pair.map(|pair| pair.smallest_angle_deg)),
            number(pair.map(|pair| pair.size_ratio_lfs)),
        ]
    });
    let head = [
        "smallest angle at least",
        "t",
        "c_b",
        "smallest angle",
        "triangles/∫dA/lfs²",
    ];
    format!(
        "{domains} {title}; of the {} pairs (t, c_b) for which all of these were measured:\n\n",
        pairs.len()
    ) + &table(&head, &lines.collect::<Vec<_>>())
}

/// The pair with the fewest triangles among those whose smallest angle is at least `angle_deg`.
pub(super) fn fewest(pairs: &[Pair], angle_deg: f64) -> Option<Pair> {
    let enough = pairs.iter().filter(|pair| pair.smallest_angle_deg >= angle_deg);
    enough
        .min_by(|a, b| a.size_ratio_lfs.total_cmp(&b.size_ratio_lfs))
        .copied()
}

/// Triangles against smallest angle, a point for each pair.
pub(super) fn charts(results: &Results, drawer: &mut Drawer) -> Result<(), ChartError> {
    let [plain, _] = pairs(results);
    if plain.is_empty() {
        return Ok(());
    }
    let caption = "Triangles against smallest angle for each t and c_b, on domains without angles under 90° between segments; \
                   no pair beats the filled ones in both.";
    charts::fewest(&plain, &drawer.chart("size-for-angle", caption))
}
