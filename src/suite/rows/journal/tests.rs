use crate::suite::rows::journal::*;
use crate::suite::rows::record::{Cell, Outcome};

fn row(key: &str, estimated_triangles: f64) -> Line {
    Line::new(Row {
        key: key.into(),
        group: "grid".into(),
        outcome: Outcome::Skipped,
        reason: Some("too large".into()),
        estimated_triangles,
        cell: Cell::new("l-shape", "biting", "lfs", 1.0 / 3.0, 0.1),
        tries: Vec::new(),
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
    let path = folder.path().join("deep/journal.jsonl");
    let mut journal = Journal::<Row>::open(&path).expect("new");
    journal.append(row("a", 1.0)).expect("append");
    journal.append(row("b", 1.0)).expect("append");
    drop(journal);
    let whole = std::fs::read(&path).expect("read");
    for kept in 0..whole.len() {
        std::fs::write(&path, &whole[..kept]).expect("cut");
        let mut journal = Journal::<Row>::open(&path).expect("a cut-off file opens");
        let expected = whole[..kept].iter().filter(|&&byte| byte == b'\n').count();
        assert_eq!(journal.lines().len(), expected, "{kept} bytes kept");
        journal.append(row("c", 1.0)).expect("append");
        assert_eq!(read_rows::<Row>(&path).expect("whole again").len(), expected + 1);
    }
}

#[test]
fn a_later_row_replaces_an_earlier_one_and_settling_orders_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("journal.jsonl");
    let mut journal = Journal::<Row>::open(&path).expect("new");
    for line in [row("b", 1.0), row("gone", 1.0), row("a", 1.0), row("b", 0.1 + 0.2)] {
        journal.append(line).expect("append");
    }
    assert_eq!(keys(&journal), ["b", "gone", "a"]);
    journal.settle(["a", "b", "never run"]).expect("settle");
    journal.append(row("c", 1.0)).expect("append after settling");
    drop(journal);
    let journal = Journal::<Row>::open(&path).expect("again");
    assert_eq!(keys(&journal), ["a", "b", "c"]);
    assert_eq!(journal.get("b").expect("there").estimated_triangles, 0.1 + 0.2);
    assert_eq!(journal.lines()[1].text, row("b", 0.1 + 0.2).text);
}

#[test]
fn setting_aside_keeps_the_old_rows() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("journal.jsonl");
    let mut journal = Journal::<Row>::open(&path).expect("new");
    assert_eq!(journal.set_aside("now").expect("nothing to keep"), None);
    journal.append(row("a", 1.0)).expect("append");
    let backup = journal
        .set_aside("2026-01-02T03:04:05Z")
        .expect("moved")
        .expect("there was a row");
    assert!(
        backup.ends_with("journal.before-2026-01-02T03-04-05Z.jsonl"),
        "{}",
        backup.display()
    );
    assert_eq!(read_rows::<Row>(&backup).expect("readable").len(), 1);
    journal.append(row("b", 1.0)).expect("append");
    assert_eq!(read_rows::<Row>(&path).expect("readable").len(), 1);
}

#[test]
fn a_second_writer_is_told_and_a_broken_line_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("journal.jsonl");
    let journal = Journal::<Row>::open(&path).expect("new");
    let message = Journal::<Row>::open(&path).expect_err("locked").to_string();
    assert!(message.contains("another sweep (process "), "{message}");
    drop(journal);
    std::fs::write(&path, format!("{}\n{{\n", row("a", 1.0).text)).expect("write");
    let message = Journal::<Row>::open(&path).expect_err("broken").to_string();
    assert!(message.contains("journal.jsonl:2: not a row"), "{message}");
}

#[test]
fn numbers_that_json_lacks_are_refused() {
    let mut bad = row("a", 1.0).row;
    bad.estimated_triangles = f64::NAN;
    assert!(Line::new(bad).is_err());
}
