//! The cells of a plan as work: cells with the same mesh are one unit, units with the same spacing one task.

use crate::spacing::estimate_triangles;
use crate::suite::rows::record::Cell;
use crate::suite::run::plan::PlannedCell;
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// Limiting a spacing and integrating 1 / f² takes about as long as meshing and judging so many triangles for each unit of
/// ∫ dA / f²: measured on outlines of some thousand segments.
const SET_UP_PER_INTEGRAL: f64 = 100.0;

/// What is known of a cell's surroundings before it is run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlook {
    /// Lipschitz constant of the spacing before limiting; infinite where none is proved.
    pub lipschitz: f64,
    /// ∫ dA / f² before limiting.
    pub integral: f64,
}

/// Cells that have one mesh, since limiting changes nothing in them and all else is equal.
#[derive(Clone, Debug)]
pub struct Unit {
    /// The cells as indices into the plan's, ascending; the first is run, the others report its mesh.
    pub cells: Vec<usize>,
    /// Triangles to be expected before the limited spacing is known: a guess for progress and dry runs.
    pub guessed_triangles: f64,
    /// What making the limited spacing costs, told in triangles; 0 but for the first unit of a task that limits.
    pub set_up: f64,
    /// Triangles there must be at least, since limiting only makes a spacing smaller.
    pub least_triangles: f64,
}

/// Units that share one limited spacing.
#[derive(Clone, Debug)]
pub struct Task {
    /// A cell of the task, as an index into the plan's: it tells domain, spacing and cap.
    pub cell: usize,
    /// The constant to limit to, absent where the spacing's own is no larger.
    pub alpha: Option<f64>,
    /// What to mesh.
    pub units: Vec<Unit>,
}

/// A guess at how ∫ dA / f² grows when a spacing with constant `lipschitz` is limited to `alpha`: where the boundary
/// dominates, as 1 / alpha.
fn growth(outlook: Outlook, alpha: f64) -> f64 {
    // Where no constant is proved, local feature size is what usually rules, and its constant is 1.
    let own = if outlook.lipschitz.is_finite() {
        outlook.lipschitz
    } else {
        1.0
    };
    (own / alpha).max(1.0)
}

/// Gathers cells into tasks, in the order in which their first cells stand in the plan.
///
/// `outlook` tells of each cell's spacing before limiting, `parameters` completes its parameters by the defaults.
///
/// # Errors
/// The first of `outlook`.
pub fn tasks<E>(
    cells: &[PlannedCell],
    outlook: impl Fn(&Cell) -> Result<Outlook, E>,
    parameters: impl Fn(&Cell) -> Map<String, Value>,
) -> Result<Vec<Task>, E> {
    let mut tasks: Vec<Task> = Vec::new();
    let mut task_of = BTreeMap::new();
    let mut unit_of = BTreeMap::new();
    for (at, planned) in cells.iter().enumerate() {
        let cell = &planned.cell;
        let ahead = outlook(cell)?;
        let asked = cell.t / cell.c_b;
        let alpha = (asked < ahead.lipschitz).then_some(asked);
        let spacing = (
            cell.domain.as_str(),
            cell.spacing.as_str(),
            cell.lfs_cap,
            cell.adapted_by(),
            alpha.map(f64::to_bits),
            cell.timed,
        );
        let task = *task_of.entry(spacing).or_insert_with(|| {
            tasks.push(Task {
                cell: at,
                alpha,
                units: Vec::new(),
            });
            tasks.len() - 1
        });
        let mut sorted: Vec<_> = parameters(cell).into_iter().collect();
        sorted.sort_by(|a, b| a.0.cmp(&b.0));
        let method = (
            task,
            cell.mesher.as_str(),
            Value::from_iter(sorted).to_string(),
            cell.c_b.to_bits(),
            cell.seed,
            cell.triangles,
            cell.threads,
            cell.poisson.as_deref(),
        );
        let units = &mut tasks[task].units;
        let unit = *unit_of.entry(method).or_insert_with(|| {
            let limits = alpha.is_some() && units.is_empty();
            let wanted = cell.triangles.map(|wanted| wanted as f64);
            let expected = |integral| wanted.unwrap_or_else(|| estimate_triangles(integral, cell.c_b));
            units.push(Unit {
                cells: Vec::new(),
                set_up: if limits {
                    SET_UP_PER_INTEGRAL * ahead.integral
                } else {
                    0.0
                },
                guessed_triangles: expected(ahead.integral * growth(ahead, asked)),
                least_triangles: expected(ahead.integral),
            });
            units.len() - 1
        });
        units[unit].cells.push(at);
    }
    Ok(tasks)
}

/// Which part of the tasks a process runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// From 1.
    pub number: usize,
    /// How many there are.
    pub of: usize,
}

impl Shard {
    /// Whether this shard runs the task of that index: neighbouring tasks cost alike, so they are dealt in turn.
    pub fn has(self, task: usize) -> bool {
        task % self.of == self.number - 1
    }
}

impl std::str::FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text
            .split_once('/')
            .and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((number, of)) if (1..=of).contains(&number) => Ok(Self { number, of }),
            _ => Err(format!("`{text}` is no shard; write I/N with 1 ≤ I ≤ N, such as 1/4")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::suite::run::plan::CellBudget;

    fn planned(group: &str, t: f64, c_b: f64, params: Map<String, Value>) -> PlannedCell {
        PlannedCell {
            key: format!("{group}/{t}/{c_b}"),
            group: group.into(),
            cell: Cell {
                params,
                ..Cell::new("l-shape", "biting", "lfs", t, c_b)
            },
            budget: CellBudget::default(),
            repeats: 1,
        }
    }

    fn fifo() -> Map<String, Value> {
        Map::from_iter([("order".into(), "fifo".into())])
    }

    fn gathered(cells: &[PlannedCell], lipschitz: f64) -> Vec<(Option<f64>, Vec<Vec<usize>>)> {
        tasks(
            cells,
            |_| {
                Ok::<_, String>(Outlook {
                    lipschitz,
                    integral: 10.0,
                })
            },
            |cell| {
                if cell.params.is_empty() {
                    fifo()
                } else {
                    cell.params.clone()
                }
            },
        )
        .expect("never fails")
        .into_iter()
        .map(|task| (task.alpha, task.units.into_iter().map(|unit| unit.cells).collect()))
        .collect()
    }

    #[test]
    fn cells_with_one_mesh_are_one_unit() {
        let cells = [
            planned("grid", 0.25, 0.1, Map::new()),
            planned("grid", 0.5, 0.1, Map::new()),
            planned("grid", 0.25, 1.0, Map::new()),
            planned("grid", 0.5, 0.2, Map::new()),
            planned("orders", 0.25, 1.0, fifo()),
        ];
        // lfs is 1-Lipschitz: with t ≥ c_b limiting changes nothing.
        assert_eq!(
            gathered(&cells, 1.0),
            [(None, vec![vec![0, 1], vec![3]]), (Some(0.25), vec![vec![2, 4]])]
        );
        // Where no constant is proved every α makes another spacing.
        assert_eq!(
            gathered(&cells, f64::INFINITY),
            [
                (Some(2.5), vec![vec![0], vec![3]]),
                (Some(5.0), vec![vec![1]]),
                (Some(0.25), vec![vec![2, 4]]),
            ]
        );
    }

    #[test]
    fn meshers_and_numbers_of_triangles_share_a_spacing() {
        let mut cells = vec![planned("meshers", 0.25, 1.0, fifo()); 4];
        cells[1].cell.mesher = "another".into();
        cells[2].cell.triangles = Some(1000);
        // The first with its defaults written out: the same mesh.
        cells[3].cell.params = Map::new();
        assert_eq!(
            gathered(&cells, 1.0),
            [(Some(0.25), vec![vec![0, 3], vec![1], vec![2]])]
        );
    }

    #[test]
    fn shards_share_all_tasks() {
        let shards: Vec<Shard> = ["1/3", "2/3", "3/3"]
            .iter()
            .map(|text| text.parse().expect("a shard"))
            .collect();
        for task in 0..20 {
            assert_eq!(shards.iter().filter(|shard| shard.has(task)).count(), 1);
        }
        for bad in ["0/3", "4/3", "1", "1/0", "a/b"] {
            assert!(bad.parse::<Shard>().is_err(), "{bad}");
        }
    }
}
