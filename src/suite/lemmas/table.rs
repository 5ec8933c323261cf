//! All statements judged, as a table and as the page `results/lemmas/README.md`.

use super::judge::{Judged, Verdict, grid, optima, verdict};
use super::measured::{Meshes, Worst};
use super::nearest::{self, Found};
use super::record::{Bound, Statement};
use super::statements;
use crate::suite::charts::BoundFigure;
use crate::suite::report::markdown::{number, table};
use crate::suite::rows::tables::column::{Column, number as digits, write};

/// Steps of the grid of the parameter.
pub const STEPS: usize = 10;

/// A statement with both judgements.
pub struct Line {
    /// The statement.
    pub statement: Statement,
    /// Optima over the grid.
    pub judged: Vec<Judged>,
    /// The verdict on the printed formula.
    pub printed: Verdict,
    /// The verdict on the corrected one.
    pub corrected: Option<Verdict>,
    /// What meshes show.
    pub worst: Option<Worst>,
}

impl Line {
    /// Judges a statement.
    pub fn new(statement: Statement, meshes: &Meshes) -> Self {
        let judged = optima(&statement, &grid(&statement, STEPS));
        let on = |bound: Bound, range| verdict(&statement, &bound, range, &judged);
        Self {
            printed: on(statement.printed, statement.range),
            corrected: statement
                .corrected
                .map(|corrected| on(corrected.bound, corrected.range)),
            worst: meshes.worst(&statement),
            judged,
            statement,
        }
    }

    /// Whether the code stands by what it says: the printed formula holds or a correction of it does.
    pub fn is_settled(&self) -> bool {
        match self.corrected {
            Some(corrected) => corrected.holds() && !matches!(self.printed, Verdict::Open { .. }),
            None => self.printed.holds(),
        }
    }

    /// The figure: printed formula, corrected one, optima, worst on meshes; none where there is no range to draw over.
    pub fn figure(&self, meshes: &Meshes) -> Option<BoundFigure> {
        let statement = &self.statement;
        let (least, most) = statement.range;
        if least == most {
            return None;
        }
        let curve = |bound: Bound, (least, most): (f64, f64)| {
            let at = |k: u32| least + (most - least) * f64::from(k) / 100.0;
            (0..=100).map(|k| (at(k), (bound.at)(at(k)))).collect::<Vec<_>>()
        };
        Some(BoundFigure {
            title: statement.place.into(),
            parameter: statement.parameter.into(),
            printed: curve(statement.printed, statement.range),
            corrected: statement
                .corrected
                .map_or(Vec::new(), |corrected| curve(corrected.bound, corrected.range)),
            optimum: self
                .judged
                .iter()
                .map(|one| (one.parameter, one.optimum.found))
                .collect(),
            measured: meshes.by_t(statement).into_iter().filter(|(t, _)| *t <= most).collect(),
        })
    }

    /// Statement, formula, verdict, worst margin on meshes: a line of the table.
    fn cells(&self) -> Vec<String> {
        let measured = |pick: fn(&Worst) -> String| self.worst.as_ref().map_or("–".into(), pick);
        vec![
            self.statement.place.into(),
            self.statement.quantity.into(),
            format!("{} {}", sign(&self.statement), self.statement.printed.says),
            self.told(&self.printed),
            match (&self.statement.corrected, &self.corrected) {
                (Some(corrected), Some(verdict)) => format!("{}: {}", corrected.bound.says, verdict.word()),
                _ => "–".into(),
            },
            measured(|worst| number(worst.ratio)),
            measured(|worst| worst.meshes.to_string()),
        ]
    }

    /// A verdict in words.
    pub fn told(&self, verdict: &Verdict) -> String {
        let parameter = self.statement.parameter;
        match verdict {
            Verdict::Sharp => "sharp".into(),
            Verdict::Loose {
                parameter: at,
                bound,
                optimum,
            } => {
                format!(
                    "holds; optimum {} against {} at {parameter} = {}",
                    number(*optimum),
                    number(*bound),
                    number(*at)
                )
            }
            Verdict::Fails {
                parameter: at,
                bound,
                optimum,
            } => {
                format!(
                    "**fails** from {parameter} = {}: optimum {} against {}",
                    number(*at),
                    number(*optimum),
                    number(*bound)
                )
            }
            Verdict::Open { parameter: at } => format!("open at {parameter} = {}", number(*at)),
        }
    }
}

/// ≥ or ≤.
pub fn sign(statement: &Statement) -> &'static str {
    match statement.sense {
        super::search::Sense::AtLeast => "≥",
        super::search::Sense::AtMost => "≤",
    }
}

/// All statements, judged.
pub fn judge_all(meshes: &Meshes, only: Option<&str>) -> Vec<Line> {
    let chosen = statements::all()
        .into_iter()
        .filter(|statement| only.is_none_or(|only| statement.name.starts_with(only)));
    chosen.map(|statement| Line::new(statement, meshes)).collect()
}

/// The page.
pub fn page(lines: &[Line], meshes: &Meshes, nearest: &[Found]) -> String {
    let count = |word: &str| lines.iter().filter(|line| line.printed.word() == word).count();
    let mut text = format!(
        "# The paper's statements, judged twice\n\nMade by `cargo run --release -- lemmas`: what the paper states is written in `src/suite/lemmas/statements`, every number is \
         computed from that or read from the committed meshes.\n\n\
         **In short.** Of {} formulas {} are sharp, {} hold without being the optimum, {} fail somewhere in their range and {} are open. What is wrong, with proofs and \
         counterexamples, is in [paper/errata.md](../../paper/errata.md).\n\n\
         **Numerically**: the optimum of the bounded quantity over all configurations that the hypotheses allow, bracketed by interval branch and bound at {} \
         values of the parameter over the range that the paper claims. **On meshes**: the worst value over its bound of the certificate's check, over {} committed \
         meshes by biting, where its hypotheses hold; 1 is attained, bounds from below have ratios above 1, bounds from above below 1.\n\n",
        lines.len(),
        count("sharp"),
        count("holds"),
        count("fails"),
        count("open"),
        STEPS + 1,
        meshes.count(),
    );
    let cells: Vec<Vec<String>> = lines.iter().map(Line::cells).collect();
    text += &table(
        &[
            "statement",
            "quantity",
            "printed",
            "verdict",
            "corrected",
            "worst / bound on meshes",
            "meshes",
        ],
        &cells,
    );
    text += "## Where the worst was seen\n\n";
    text += &where_seen(lines);
    text += &nearest::section(nearest, meshes);
    text += "## Figures\n\n";
    text += &figures(lines);
    text += "## What each needs and what rests on it\n\n";
    lines.iter().fold(text, |text, line| text + &needs(&line.statement))
}

/// `statements.csv`: a line for each statement and parameter of the grid.
pub fn optima_table(lines: &[Line]) -> String {
    type At<'a> = (&'a Statement, &'a Judged);
    let column = |name, about, value: fn(&At) -> Option<String>| Column::new(name, about, value);
    let columns = [
        column("statement", "its name", |(statement, _)| Some(statement.name.into())),
        column("parameter", "what the bound is a function of", |(_, judged)| {
            Some(digits(judged.parameter))
        }),
        column("printed", "the printed formula", |(statement, judged)| {
            Some(digits((statement.printed.at)(judged.parameter)))
        }),
        column("corrected", "the corrected one", |(statement, judged)| {
            Some(digits((statement.corrected?.bound.at)(judged.parameter)))
        }),
        column("optimum", "the optimum found", |(_, judged)| {
            Some(digits(judged.optimum.found))
        }),
        column("proved", "what no configuration passes", |(_, judged)| {
            Some(digits(judged.optimum.proved))
        }),
        column("boxes", "boxes that the search needed", |(_, judged)| {
            Some(judged.optimum.boxes.to_string())
        }),
    ];
    let grid = lines
        .iter()
        .flat_map(|line| line.judged.iter().map(move |judged| (&line.statement, judged)));
    write(&columns, &grid.collect::<Vec<_>>())
}

fn where_seen(lines: &[Line]) -> String {
    let cells = |(line, worst): (&Line, &Worst)| {
        vec![
            line.statement.place.into(),
            number(worst.ratio),
            worst.seen.clone(),
            number(worst.t),
        ]
    };
    let seen = lines.iter().filter_map(|line| Some((line, line.worst.as_ref()?)));
    table(
        &["statement", "worst / bound", "cell", "t"],
        &seen.map(cells).collect::<Vec<_>>(),
    )
}

fn figures(lines: &[Line]) -> String {
    let drawn = lines.iter().map(|line| &line.statement);
    let drawn = drawn.filter(|statement| statement.range.0 < statement.range.1);
    let figure = |statement: &Statement| {
        let (place, quantity, name) = (statement.place, statement.quantity, statement.figure_name());
        format!("![{place}](charts/{name}.png)\n*{place}: {quantity}.* ([SVG](charts/{name}.svg))\n\n")
    };
    drawn.map(figure).collect()
}

fn needs(statement: &Statement) -> String {
    let mut text = format!(
        "* **{}** (`{}`), range: {}.",
        statement.place, statement.name, statement.range_says
    );
    let stated: Vec<&str> = statement
        .problem
        .constraints
        .iter()
        .map(|constraint| constraint.says)
        .collect();
    let unknowns: Vec<&str> = statement.problem.unknowns.iter().map(|unknown| unknown.name).collect();
    for (head, items) in [
        ("Searched over", unknowns),
        ("where", stated),
        ("Used without being stated", statement.silent.to_vec()),
        ("Used by", statement.used_by.to_vec()),
    ] {
        if !items.is_empty() {
            text += &format!(" {head}: {}.", items.join("; "));
        }
    }
    text + "\n"
}
