//! `docs/rows.md`: every column of every table, from the lists that write them.

use super::beside::{angles, broken, rounds, times};
use super::column::Column;
use super::{ANGLES, BROKEN, CASES, MESHES, ROUNDS, RUN, TALLY, TALLY_TIMES, TIMES, meshes, tally};

/// What stands in a name where a table has a column for each of several names.
const EACH: &str = "…";

/// The page.
pub fn page() -> String {
    let mut text = INTRODUCTION.to_owned();
    text += &table(MESHES, "A line a cell, measured or not.", &meshes::columns([EACH]));
    text += &table(ANGLES, "A line a mesh.", &angles());
    text += &table(
        BROKEN,
        "A line a check that does not hold although the method promises it where its hypotheses are met. What is broken of claims that a method promises nothing of is only counted, in `meshes.csv`.",
        &broken(),
    );
    text += &table(
        TIMES,
        "A line a cell that ran alone; not there where none did.",
        &times([vec![EACH], vec![EACH]]),
    );
    text += &table(
        ROUNDS,
        "A line a round; not there where nothing was adapted.",
        &rounds(),
    );
    text += &table(
        TALLY,
        "A line a method on a family of cases that are tallied; not there where none are.",
        &tally::columns(),
    );
    text += &table(CASES, "A line a case that is not certified.", &tally::case_columns());
    text += &table(TALLY_TIMES, "A line a method on a family.", &tally::times());
    text + &format!(
        "## `{RUN}`\n\n`plan` is the experiment's file as it was run. Each `[[made]]` says who made meshes of these tables: `version`, \
         `commit` and `dirty` of the code, `rustc`, `cpu`, `cores`, `os`, and the dates of the first and the last of them, `date` and \
         `until`. There is one, but where a run that was stopped went on with other code, or lines of an earlier run stayed.\n"
    )
}

const INTRODUCTION: &str = "\
# Columns of the tables

<!-- written from the code that writes the tables: `RENEW=1 cargo test --lib -- tables` -->

Each experiment leaves a folder of tables under `results/`. They are plain CSV: `pandas.read_csv(\"results/sweep/meshes.csv\")`, or in
DuckDB `FROM 'results/*/meshes.csv'`. They are joined by `key`, `angles.csv` by `fingerprint`.

* Lines stand in the plan's order. Cells that failed, declined or were skipped have a line too, with the reason.
* Measured numbers have 9 significant digits, but where the column says 3; what a cell asks for has all. Names end in the unit: `_deg` is degrees, `_seconds`,
  `_bytes`; lengths are in the domain's unit. 1 and 0 are yes and no.
* A column that says nothing on all lines is left out, and so is one that says the same default on all: the last column below has it.
* Two runs of the same code on one machine give the same bytes in all tables but `times.csv` and `tally_times.csv`. So a diff in `meshes.csv` is a change of
  behaviour. Peers that do not answer equal input by equal output are the exception (`repeats_differ`).
* A run that is finished replaces the tables. A line stays from before only where the run did not ask for its cell (`compare --only`,
  `--domains`, `sweep --timed`), or skipped it since this machine lacks its peer or the memory.
* A check's bound follows from its formula (`src/theory.rs`), `t_effective`, c_b and `integral`. Its worst value is a column
  `worst_…`, or the other column that says so; it holds where `broken_…` is 0.
* `times.csv` has only cells that ran alone. Pages quote a time if the cell has two repeats or more and its `spread` is below 0.1.

";

/// One table's columns.
fn table<R>(name: &str, about: &str, columns: &[Column<R>]) -> String {
    let mut text = format!("## `{name}`\n\n{about}\n\n| column | what | paper | if left out |\n|---|---|---|---|\n");
    // The 60 degrees of a histogram are told once.
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
