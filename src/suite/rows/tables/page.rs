//! `docs/rows.md`: every column of every table, from the lists that write them.

use super::beside::{angles, broken, rounds, times};
use super::column::Column;
use super::{ANGLES, BROKEN, CASES, MESHES, ROUNDS, RUN, TALLY, TALLY_TIMES, TIMES, meshes, tally};

/// Stands in the name of a column that a table has once for each of several names.
const EACH: &str = "…";

/// The page.
pub fn page() -> String {
    let mut text = INTRODUCTION.to_owned();
    text += &table(
        MESHES,
        "One line for each cell, measured or not.",
        &meshes::columns([EACH]),
    );
    text += &table(ANGLES, "One line for each mesh.", &angles());
    text += &table(
        BROKEN,
        "One line for each check that does not hold although the method promises it under its hypotheses. Breaches of claims that the method does not promise are only counted, in `meshes.csv`.",
        &broken(),
    );
    text += &table(
        TIMES,
        "One line for each cell that ran alone; there is no such table if none did.",
        &times([vec![EACH], vec![EACH]]),
    );
    text += &table(
        ROUNDS,
        "One line for each round; there is no such table if nothing was adapted.",
        &rounds(),
    );
    text += &table(
        TALLY,
        "One line for each method on each family of cases that are tallied; there is no such table if none are.",
        &tally::columns(),
    );
    text += &table(
        CASES,
        "One line for each case that is not certified.",
        &tally::case_columns(),
    );
    text += &table(TALLY_TIMES, "One line for each method on each family.", &tally::times());
    text + &format!(
        "## `{RUN}`\n\n`plan` is the experiment's file as it was run. Each `[[made]]` says who made meshes of these tables: `version`, \
         `commit` and `dirty` of the code, `rustc`, `cpu`, `cores`, `os`, and the dates of the first and the last of them, `date` and \
         `until`. There is more than one if a run that was stopped went on with other code, or if lines of an earlier run stayed.\n"
    )
}

const INTRODUCTION: &str = "\
# Columns of the tables

<!-- written from the code that writes the tables: `RENEW=1 cargo test --lib -- tables` -->

Each experiment leaves a folder of tables under `results/`. They are plain CSV: `pandas.read_csv(\"results/sweep/meshes.csv\")`, or in
DuckDB `FROM 'results/*/meshes.csv'`. `key` joins them, and `fingerprint` joins `angles.csv`.

* Lines stand in the plan's order. Cells that failed, declined or were skipped have a line too, with the reason.
* Measured numbers have 9 significant digits, or 3 if the column says so; numbers that a cell asks for have all. Names end in
  the unit: `_deg` is degrees, `_seconds`, `_bytes`; lengths are in the domain's unit. 1 and 0 are yes and no.
* A column that is empty on all lines is left out, and so is one that has its default on all: the last column below names the default.
* Two runs of the same code on one machine give the same bytes in all tables but `times.csv` and `tally_times.csv`. So a diff in
  `meshes.csv` is a change of behaviour. Peers whose output differs for equal input are the exception (`repeats_differ`).
* A run that is finished replaces the tables. A line of an earlier run stays only if the run did not ask for its cell (`compare --only`,
  `--domains`, `sweep --timed`), or skipped it because this machine lacks its peer or the memory.
* A check's bound follows from its formula (`src/theory.rs`), `t_effective`, c_b and `integral`. Its worst value is a column
  `worst_…`, or the other column that says so; it holds if `broken_…` is 0.
* `times.csv` has only cells that ran alone. Pages quote a time if the cell has two repeats or more and its `spread` is below 0.1.

";

/// One table's columns.
fn table<R>(name: &str, about: &str, columns: &[Column<R>]) -> String {
    let mut text = format!("## `{name}`\n\n{about}\n\n| column | what | paper | if left out |\n|---|---|---|---|\n");
    // The 60 degrees of a histogram are listed once.
    let (bins, others): (Vec<_>, Vec<_>) = columns.iter().partition(|column| is_bin(&column.name));
    for column in others {
        text += &line(&format!("`{}`", column.name), column);
    }
    if let [first, .., last] = &bins[..] {
        text += &line(&format!("`{}` to `{}`", first.name, last.name), first);
    }
    text + "\n"
}

fn is_bin(name: &str) -> bool {
    name.starts_with("from_")
}

fn line<R>(name: &str, column: &Column<R>) -> String {
    let default = column.default.unwrap_or_default();
    format!(
        "| {name} | {} | {} | {default} |\n",
        column.about.replace('|', "\\|"),
        column.paper
    )
}
