//! Every kind of fault, as a user reads it.

use crate::domain::files::poly;
use crate::domain::{Domain, DomainError, FaultKind, Pslg, repair};

/// A square of four vertices in lines 2 to 5 and four segments in lines 7 to 10, counted from 1; `change` replaces text.
fn square(change: &[(&str, &str)]) -> Pslg {
    let mut text = "4 2 0 0\n1 0 0\n2 4 0\n3 4 4\n4 0 4\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n".to_owned();
    for (from, to) in change {
        assert!(text.contains(from), "{from:?} is not in {text:?}");
        text = text.replacen(from, to, 1);
    }
    poly::parse(&text, "square.poly", || {
        Err(DomainError::Unreadable {
            file: String::new(),
            message: String::new(),
        })
    })
    .unwrap()
}

fn message(change: &[(&str, &str)]) -> String {
    Domain::new(square(change)).unwrap_err().to_string()
}

#[test]
fn messages_name_file_line_and_remedy() {
    let messages = [
        message(&[("4 0 4\n", "4 0 nan\n")]),
        message(&[("4 4 1\n", "4 4 7\n")]),
        message(&[("4 2 0 0", "5 2 0 0"), ("4 0 4\n", "4 0 4\n5 4 4\n")]),
        message(&[("4 0\n1 1 2", "5 0\n5 2 2\n1 1 2")]),
        message(&[("4 0\n1 1 2", "5 0\n5 2 1\n1 1 2")]),
        message(&[("4 0\n1 1 2", "5 0\n5 1 3\n1 1 2"), ("4 4 1\n", "4 2 4\n")]),
        message(&[("4 2 0 0", "5 2 0 0"), ("4 0 4\n", "4 0 4\n5 2 0\n")]),
        message(&[
            ("4 2 0 0", "5 2 0 0"),
            ("4 0 4\n", "4 0 4\n5 6 0\n"),
            ("2 2 3", "2 1 5"),
        ]),
        message(&[("4 0\n1 1 2", "3 0\n1 1 2"), ("4 4 1\n", "")]),
        message(&[("\n0\n", "\n1\n1 2 2\n")]),
        message(&[("\n0\n", "\n1\n1 9 9\n")]),
        message(&[("\n0\n", "\n1\n1 2 0\n")]),
        message(&[("\n0\n", "\n0\n1\n1 4 2 7\n")]),
    ];
    insta::assert_snapshot!(messages.join("\n"));
}

#[test]
fn faults_that_say_so_are_repaired() {
    let dirty = square(&[
        ("4 2 0 0", "7 2 0 0"),
        ("4 0 4\n", "4 0 4\n5 4 4\n6 2 0\n7 2 5\n"),
        ("4 0\n1 1 2", "8 0\n5 2 2\n6 2 1\n7 5 1\n8 6 7\n1 1 2"),
    ]);
    let kinds: Vec<FaultKind> = crate::domain::faults(&dirty).iter().map(|fault| fault.kind).collect();
    for kind in [
        FaultKind::DuplicateVertices,
        FaultKind::ZeroLength,
        FaultKind::RepeatedSegment,
        FaultKind::Crossing,
    ] {
        assert!(kinds.contains(&kind), "{kind:?} is not in {kinds:?}");
    }
    let (mended, report) = repair(dirty);
    insta::assert_snapshot!(report, @"1 vertices merged, 1 segments of length zero removed, 1 repeated segments removed, 1 cuts at vertices on segments, 2 vertices added at crossings; largest displacement 0.000e0");
    let domain = Domain::new(mended).unwrap();
    assert_eq!((domain.area(), domain.faces().len()), (16.0, 5));
    assert_eq!(domain.notes().len(), 1, "the end that sticks out is left out");
}
