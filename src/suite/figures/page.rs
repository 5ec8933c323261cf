//! The texts beside the pictures: a caption for each, and the table of all.

use super::Entry;
use super::drawing::Drawing;
use crate::suite::rows::hash::fnv;
use serde_json::Value;

/// The command that draws a figure.
fn command(entry: &Entry) -> String {
    format!("cargo run --release -- figures --only {}", entry.name)
}

/// A hash of a value's text, in hexadecimal.
pub(super) fn hash(value: &Value) -> String {
    format!("{:016x}", fnv(&value.to_string()))
}

/// The caption file of a figure.
pub(super) fn caption(entry: &Entry, drawing: &Drawing) -> String {
    let name = entry.name;
    let numbers = Value::from(drawing.numbers.clone());
    let commands: Vec<String> = drawing
        .commands
        .iter()
        .map(|command| format!("    {command}\n"))
        .collect();
    format!(
        "# {title}\n\n![{title}]({name}.svg)\n\n{caption}\n\nDrawn by\n\n    {draw}\n\nfrom the numbers in [{name}.json]({name}.json), \
         hash `{hash}`. What it was drawn from comes by\n\n{commands}",
        title = entry.title,
        caption = drawing.caption,
        draw = command(entry),
        hash = hash(&numbers),
        commands = distinct(commands).concat(),
    )
}

fn distinct(mut texts: Vec<String>) -> Vec<String> {
    texts.dedup();
    texts
}

/// The numbers of a figure as a file.
pub(super) fn numbers(drawing: &Drawing) -> String {
    let value = Value::from(drawing.numbers.clone());
    lines(&value, 0) + "\n"
}

/// JSON with one line for each name, and long lists on lines of their own.
fn lines(value: &Value, depth: usize) -> String {
    let indent = "  ".repeat(depth + 1);
    match value {
        Value::Object(map) if depth < 2 => {
            let entries = map
                .iter()
                .map(|(name, value)| format!("{indent}{}: {}", Value::from(name.as_str()), lines(value, depth + 1)));
            format!(
                "{{\n{}\n{}}}",
                entries.collect::<Vec<_>>().join(",\n"),
                "  ".repeat(depth)
            )
        }
        Value::Array(list) if list.iter().any(Value::is_object) => {
            let entries = list.iter().map(|value| format!("{indent}{value}"));
            format!(
                "[\n{}\n{}]",
                entries.collect::<Vec<_>>().join(",\n"),
                "  ".repeat(depth)
            )
        }
        _ => value.to_string(),
    }
}

/// `README.md` of the folder.
pub(super) fn readme(entries: &[Entry]) -> String {
    let row = |entry: &Entry| {
        let name = entry.name;
        let files: Vec<String> = ["md", "svg", "png", "json"]
            .iter()
            .map(|ending| format!("[{ending}](figures/{name}.{ending})"))
            .collect();
        format!("| {} | `{}` | {} |\n", entry.title, command(entry), files.join(" · "))
    };
    let rows: String = entries.iter().map(row).collect();
    format!(
        "# Figures\n\nThe figures of *Biting: Advancing Front Meets Sphere Packing*, drawn from real runs, and those of the study. Nothing \
         is placed by hand: each looks for the situation it shows among runs of `biting`, to the letter of the paper, on many \
         domains, and takes the clearest by a rule that its caption states.\n\nThis page and all files under `figures/` are made by\n\n    \
         cargo run --release -- figures\n\n| figure | command | caption, pictures, numbers |\n|---|---|---|\n{rows}\n\
         The caption of each says what is to be seen, in which run it was found, by which command the run can be made again, and \
         the hash of the numbers that it was drawn from; a test makes the numbers again and fails where a figure is stale \
         (`src/suite/figures/tests/`).\n\n\
         Beside them: [what is wrong in the paper](errata.md) (`cargo run --release -- lemmas`), and a run to step through in a \
         browser, [a plate with a hole](replay-plate-hole.html) (`cargo run --release -- figures --replay plate-hole`; a coast: \
         `--replay italy --t 0.4 --c-b 1`).\n"
    )
}
