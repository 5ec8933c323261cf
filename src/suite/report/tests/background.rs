//! Backgrounds beside the spacing itself, by hand.

use super::super::background::background_findings;
use super::{Row, measured, row};

fn bitten(background: Option<f64>, triangles: usize) -> Row {
    let mut row = row("background", "a", "lfs", 0.25, 0.5, "fifo");
    row.cell.background = background;
    measured(row, 90.0, triangles, 12.0)
}

#[test]
fn cells_are_paired_that_differ_in_the_background_alone() {
    let mut other = bitten(Some(0.05), 1);
    other.cell.c_b = 1.0;
    let rows = vec![bitten(None, 1000), bitten(Some(0.05), 950), other];
    let findings = background_findings(&rows);
    assert_eq!(findings.len(), 1);
    assert!(
        findings[0].contains("on 1 pairs: 0.950 times") && findings[0].contains("all of the pairs"),
        "{findings:?}"
    );
    assert!(background_findings(&rows[1..]).is_empty());
}

#[test]
fn the_largest_error_is_also_set_beside_the_smallest() {
    let rows = vec![bitten(Some(0.05), 1030), bitten(None, 1100), bitten(Some(0.01), 1000)];
    let findings = background_findings(&rows);
    assert_eq!(findings.len(), 2);
    assert!(
        findings[0].contains("beside the spacing itself**, on 1 pairs: 0.936 times"),
        "{findings:?}"
    );
    assert!(
        findings[1].contains("of error 0.0500 beside one of error 0.0100**, on 1 pairs: 1.03 times"),
        "{findings:?}"
    );
}
