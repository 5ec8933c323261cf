//! The two rules of who bites whom, by hand.

use super::super::fixture::results;
use super::super::rules;
use super::{Row, measured, row};
use serde_json::json;

fn bitten(rule: &str, t: f64, c_b: f64, triangles: usize) -> Row {
    let mut row = row("rules", "a", "lfs", t, c_b, "fifo");
    row.cell.params.insert("rule".into(), json!(rule));
    row.key += rule;
    measured(row, 90.0, triangles, 12.0)
}

#[test]
fn meshes_are_paired_at_equal_t_and_at_equal_guaranteed_angle() {
    let rows = vec![
        bitten("earlier", 0.25, 0.5, 1000),
        bitten("later", 0.25, 0.5, 900),
        bitten("later", 0.5, 0.5, 500),
        bitten("later", 0.5, 1.0, 250),
        // Its doubles are not there.
        bitten("earlier", 0.5, 0.5, 1000),
    ];
    let findings = rules::findings(&results(&rows));
    assert_eq!(findings.len(), 3);
    for (finding, triangles) in findings.iter().zip(["0.250", "0.500", "0.700"]) {
        assert!(
            finding.contains(&format!("{triangles} times the triangles")),
            "{finding}"
        );
    }
    let text = rules::text(&results(&rows));
    assert_eq!(text.matches("### ").count(), 3);
    assert!(
        text.contains("| fifo | 0.25 : 0.5 | 0.5 : 1 | 1 of 1 | 14.48° |")
            && text.contains("| same t and c_b | 2 of 2 |"),
        "{text}"
    );
    assert!(rules::findings(&results(&rows[..1])).is_empty() && rules::text(&results(&rows[1..4])).is_empty());
}
