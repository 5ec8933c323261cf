//! Experiment plans and rows.

use crate::scratch;
use biting::suite::{Journal, Line, Plan, Row, read_rows};

/// A plan: its cells, whole and quick.
pub fn plan(data: &[u8]) {
    match Plan::read(&scratch::put("plan.toml", data)) {
        Ok(plan) => {
            assert!(!plan.cells().expect("a plan that was read has cells").is_empty());
            // A quick part may have no cells, and says so.
            let _ = plan.into_quick().cells();
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// A file of rows: those that are read can be written, and a journal opens what `read_rows` reads.
pub fn rows(data: &[u8]) {
    let path = scratch::put("rows.jsonl", data);
    let rows: Result<Vec<Row>, _> = read_rows(&path);
    assert_eq!(rows.is_ok(), Journal::<Row>::open(&path).is_ok());
    for row in rows.unwrap_or_default() {
        Line::new(row).expect("a row that was read can be written");
    }
}
