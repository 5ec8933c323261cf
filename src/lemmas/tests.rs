use super::record::{Verdict, verdict};
use super::statements;

#[test]
fn print_all() {
    for statement in statements::all() {
        let start = std::time::Instant::now();
        let judged = statement.judge(statement.printed.at, &statement.grid(10));
        let boxes: usize = judged.iter().map(|one| one.optimum.boxes).sum();
        let gap = judged
            .iter()
            .map(|one| (one.optimum.found - one.optimum.proved).abs())
            .fold(0.0, f64::max);
        println!(
            "{:22} {:?} boxes {boxes} gap {gap:.1e} {:.2?}",
            statement.name,
            verdict(statement.sense, &judged),
            start.elapsed()
        );
        if let Some(corrected) = statement.corrected {
            let judged = statement.judge(corrected.bound.at, &statement.grid(10));
            println!("    corrected: {:?}", verdict(statement.sense, &judged));
        }
        for one in judged.iter().step_by(5) {
            println!(
                "      {:.3}: bound {:.5} optimum {:.5} (proved {:.5}) at {:?}",
                one.parameter, one.bound, one.optimum.found, one.optimum.proved, one.optimum.at
            );
        }
    }
    let _ = Verdict::Sharp;
}
