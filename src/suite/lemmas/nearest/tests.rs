//! Tests of the search.

use super::*;

fn packing() -> Measured {
    let statement = statements::all()
        .into_iter()
        .find(|statement| statement.name == "lemma-5.4");
    statement.and_then(|statement| statement.measured).expect("measured")
}

#[test]
fn a_candidate_is_what_its_file_and_cell_say() {
    let measured = packing();
    let folder = tempfile::tempdir().expect("a folder");
    let mut judged = 0;
    for seed in 0..12 {
        let candidate = Candidate::random(&mut Pcg64::seed_from_u64(seed));
        let Some(worst) = worst(&candidate, &measured, 0.25) else {
            continue;
        };
        let file = folder.path().join("candidate.poly");
        let domain = candidate.domain("candidate").expect("it has a mesh");
        std::fs::write(&file, domain.to_poly()).expect("a file");
        let report = report(&candidate.cell(&file.display().to_string(), 0.25)).expect("a mesh");
        let again = quantity(&report.certificate, &measured, report.c_b, report.t_effective);
        assert_eq!(again, Some(worst), "seed {seed}");
        judged += 1;
    }
    assert!(judged >= 6, "{judged}");
}

#[test]
fn offspring_are_near_and_in_range() {
    let mut random = Pcg64::seed_from_u64(7);
    let candidate = Candidate::random(&mut random);
    assert_eq!(candidate, Candidate::random(&mut Pcg64::seed_from_u64(7)));
    for _ in 0..200 {
        let next = candidate.near(0.1, &mut random);
        if let Some(domain) = next.domain("next") {
            assert!(domain.has_no_acute_angle() && domain.bounds().max.x == 1.0);
        }
        let cell = next.cell("next", 0.4);
        assert!(cell.c_b + cell.t <= 1.0 && cell.c_b >= 0.17);
    }
}

#[test]
fn what_was_found_is_found_again() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(root.join("results/lemmas/nearest/rows.jsonl")).expect("committed rows");
    let before: Vec<Found> = text
        .lines()
        .map(|line| serde_json::from_str(line).expect("a row"))
        .collect();
    let now = again(root).expect("all can be run");
    assert!(now.len() > 12 && now == before);
    for found in now {
        let statement = found.statement().expect("a statement");
        let sense = statement.measured.expect("measured").sense;
        let bound = (statement.printed.at)(found.cell.t);
        assert!(sense.allows(bound, found.worst, 1e-6), "{found:?}");
    }
}
