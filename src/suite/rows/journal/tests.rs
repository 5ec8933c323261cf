use crate::suite::rows::journal::*;
use crate::suite::rows::record::{Cell, Outcome};

fn row(key: &str, samples: &[f64]) -> Line {
    Line::new(Row {
        key: key.into(),
        group: "grid".into(),
        outcome: Outcome::Skipped,
        reason: Some("too large".into()),
        estimated_triangles: 0.1 + 0.2,
        cell: Cell::new("l-shape", "biting", "lfs", 1.0 / 3.0, 0.1),
        samples: samples.to_vec(),
        tries: Vec::new(),
        same_as: None,
        report: None,
    })
    .expect("finite numbers")
}

fn keys(journal: &Journal) -> Vec<&str> {
    journal.lines().iter().map(|line| line.row.key.as_str()).collect()
}

#[test]
fn rows_survive_a_kill_in_the_middle_of_a_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("deep/rows.jsonl");
    let mut journal = Journal::<Row>::open(&path).expect("new");
    journal.append(row("a", &[])).expect("append");
    journal.append(row("b", &[])).expect("append");
    drop(journal);
    let whole = std::fs::read(&path).expect("read");
    for kept in 0..whole.len() {
        std::fs::write(&path, &whole[..kept]).expect("cut");
        let mut journal = Journal::<Row>::open(&path).expect("a cut-off file opens");
        let expected = whole[..kept].iter().filter(|&&byte| byte == b'\n').count();
        assert_eq!(journal.lines().len(), expected, "{kept} bytes kept");
        journal.append(row("c", &[])).expect("append");
        assert_eq!(read_rows::<Row>(&path).expect("whole again").len(), expected + 1);
    }
}

#[test]
fn a_later_row_replaces_an_earlier_one_and_settling_orders_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("rows.jsonl");
    let mut journal = Journal::<Row>::open(&path).expect("new");
    for line in [
        row("b", &[1.0]),
        row("gone", &[]),
        row("a", &[]),
        row("b", &[1.0, 0.1 + 0.2]),
    ] {
        journal.append(line).expect("append");
    }
    assert_eq!(keys(&journal), ["b", "gone", "a"]);
    journal.settle(["a", "b", "never run"]).expect("settle");
    journal.append(row("c", &[])).expect("append after settling");
    drop(journal);
    let journal = Journal::<Row>::open(&path).expect("again");
    assert_eq!(keys(&journal), ["a", "b", "c"]);
    assert_eq!(journal.get("b").expect("there").samples, [1.0, 0.1 + 0.2]);
    assert_eq!(journal.lines()[1].text, row("b", &[1.0, 0.1 + 0.2]).text);
}

#[test]
fn setting_aside_keeps_the_old_rows() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("rows.jsonl");
    let mut journal = Journal::<Row>::open(&path).expect("new");
    assert_eq!(journal.set_aside("now").expect("nothing to keep"), None);
    journal.append(row("a", &[])).expect("append");
    let backup = journal
        .set_aside("2026-01-02T03:04:05Z")
        .expect("moved")
        .expect("there was a row");
    assert!(
        backup.ends_with("rows.before-2026-01-02T03-04-05Z.jsonl"),
        "{}",
        backup.display()
    );
    assert_eq!(read_rows::<Row>(&backup).expect("readable").len(), 1);
    journal.append(row("b", &[])).expect("append");
    assert_eq!(read_rows::<Row>(&path).expect("readable").len(), 1);
}

#[test]
fn a_second_writer_is_told_and_a_broken_line_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("rows.jsonl");
    let journal = Journal::<Row>::open(&path).expect("new");
    let message = Journal::<Row>::open(&path).expect_err("locked").to_string();
    assert!(message.contains("another sweep (process "), "{message}");
    drop(journal);
    std::fs::write(&path, format!("{}\n{{\n", row("a", &[]).text)).expect("write");
    let message = Journal::<Row>::open(&path).expect_err("broken").to_string();
    assert!(message.contains("rows.jsonl:2: not a row"), "{message}");
}

#[test]
fn numbers_that_json_lacks_are_refused() {
    let mut bad = row("a", &[]).row;
    bad.samples = vec![f64::NAN];
    assert!(Line::new(bad).is_err());
}
