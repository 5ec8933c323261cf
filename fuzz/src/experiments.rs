//! Experiment plans and rows.

use crate::scratch;
use biting::suite::{Journal, Line, Plan, Row, Tables, read_rows};

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

/// Rows, as the journal of a run (which begins with a brace) or as `meshes.csv`.
pub fn rows(data: &[u8]) {
    if data.starts_with(b"{") {
        journal(data);
    } else {
        tables(data);
    }
}

/// A journal opens what `read_rows` reads, and what was read can be written.
fn journal(data: &[u8]) {
    let path = scratch::put("journal.jsonl", data);
    let rows: Result<Vec<Row>, _> = read_rows(&path);
    assert_eq!(rows.is_ok(), Journal::<Row>::open(&path).is_ok());
    for row in rows.unwrap_or_default() {
        Line::new(row).expect("a row that was read can be written");
    }
}

/// Tables that were read can be written, and these are read again.
fn tables(data: &[u8]) {
    scratch::put("angles.csv", b"fingerprint\n");
    scratch::put("broken.csv", b"key\n");
    scratch::put("run.toml", b"plan = ''\nmade = []\n");
    let folder = scratch::put("meshes.csv", data);
    let folder = folder.parent().expect("a folder");
    match Tables::read(folder) {
        Ok(tables) => {
            tables.write(folder).expect("what was read can be written");
            let again = Tables::read(folder).expect("what was written can be read");
            assert_eq!(again.rows.len(), tables.rows.len());
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
