//! `sweep [EXPERIMENT.toml]`: the main job.

use super::battery;
use super::exit::{Failure, Outcome};
use super::list::EXPERIMENTS;
use super::output::{say, say_aside};
use super::progress::Progress;
use super::values::bytes;
use crate::experiment::battery::CHUNKS;
use crate::experiment::expect::{Finding, anything_measured, findings};
use crate::experiment::journal::{Journal, Record};
use crate::experiment::machine;
use crate::experiment::measure;
use crate::experiment::plan::{Plan, PlannedCell};
use crate::experiment::prepare::Store;
use crate::experiment::record::{self, Cell, Provenance, Row};
use crate::experiment::runner::{self, Sweep};
use crate::experiment::work::{self, Shard, Task};
use crate::files::write_whole;
use std::path::{Path, PathBuf};

/// Of the memory that is free when a sweep starts, cells that run side by side use at most this share.
const MEMORY_SHARE: f64 = 0.6;

/// Memory taken to be there where the system does not tell, bytes.
const UNKNOWN_MEMORY: u64 = 2_000_000_000;

/// Seconds of one core a triangle costs, mesh and certificate and spacing together, for the estimate of `--dry-run`:
/// the committed sweep's, rounded up.
const SECONDS_PER_TRIANGLE: f64 = 4e-6;

#[derive(clap::Args)]
#[command(args_conflicts_with_subcommands = true)]
pub struct Arguments {
    #[command(subcommand)]
    part: Option<Part>,
    /// The experiment [default: experiments/sweep.toml]
    #[arg(value_name = "EXPERIMENT.toml")]
    experiment: Option<PathBuf>,
    #[command(flatten)]
    place: Place,
    #[command(flatten)]
    how: How,
    /// Run the I-th of N parts; `sweep merge` joins them
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
}

#[derive(clap::Subcommand)]
enum Part {
    /// Join the rows of all shards, then draw charts and write the page
    Merge(Merge),
}

#[derive(clap::Args)]
struct Merge {
    /// The experiment [default: experiments/sweep.toml]
    #[arg(value_name = "EXPERIMENT.toml")]
    experiment: Option<PathBuf>,
    #[command(flatten)]
    place: Place,
}

/// Where results go, and how much of a plan is run.
#[derive(clap::Args)]
pub struct Place {
    /// Where the folders of results stand
    #[arg(long, value_name = "FOLDER", default_value = "results")]
    results: PathBuf,
    /// Only the small part of the experiment that its `quick` tables name, in a folder of its own
    #[arg(long)]
    quick: bool,
}

/// How cells are run.
#[derive(clap::Args)]
pub struct How {
    /// Start anew; rows that are there are kept under another name
    #[arg(long)]
    fresh: bool,
    /// Print the cells and an estimate of the time, and run nothing
    #[arg(long)]
    pub(super) dry_run: bool,
    /// Cells that run side by side [default: all cores]
    #[arg(long)]
    threads: Option<usize>,
    /// Memory that cells running side by side may use together, such as 4G; a cell that needs more is skipped
    /// [default: most of what is free]
    #[arg(long, value_name = "BYTES", value_parser = bytes)]
    max_memory: Option<u64>,
}

impl Place {
    /// The plan in `experiment`, or else the one of that name among this checkout's experiments.
    pub fn plan(&self, experiment: Option<&PathBuf>, default: &str) -> Result<Plan, Failure> {
        let default = || Path::new(EXPERIMENTS).join(format!("{default}.toml"));
        let plan = Plan::read(&experiment.cloned().unwrap_or_else(default)).map_err(Failure::input)?;
        Ok(if self.quick { plan.into_quick() } else { plan })
    }

    /// The folder of a plan's results.
    pub fn folder(&self, plan: &Plan) -> PathBuf {
        self.results.join(&plan.name)
    }
}

/// The plan that `sweep` runs where none is named.
const DEFAULT: &str = "sweep";

pub fn run(arguments: &Arguments) -> Outcome {
    if let Some(Part::Merge(Merge { experiment, place })) = &arguments.part {
        let plan = place.plan(experiment.as_ref(), DEFAULT)?;
        return merge(&plan, &place.folder(&plan));
    }
    let plan = arguments.place.plan(arguments.experiment.as_ref(), DEFAULT)?;
    let folder = arguments.place.folder(&plan);
    if plan.batteries.is_empty() {
        run_cells(&plan, &folder, &arguments.how, arguments.shard, |_| true)
    } else {
        battery::run(&plan, &folder, &arguments.of_battery())
    }
}

/// Runs those of a plan's cells that are wanted and have no row, or the part of them that a shard has; then, but for a
/// shard, draws charts and page from all rows there are.
pub fn run_cells(
    plan: &Plan,
    folder: &Path,
    how: &How,
    shard: Option<Shard>,
    is_wanted: impl Fn(&Cell) -> bool,
) -> Outcome {
    let all = plan.cells().map_err(Failure::input)?;
    let cells: Vec<PlannedCell> = all.iter().filter(|planned| is_wanted(&planned.cell)).cloned().collect();
    for planned in &cells {
        runner::mesher(&planned.cell)
            .map_err(|problem| Failure::Input(format!("{}: {}: {problem}", plan.file.display(), planned.key)))?;
    }
    let store = Store::new(None, false);
    if how.dry_run {
        return dry_run(
            plan,
            &cells,
            &tasks(plan, &cells, &store, how.threads())?,
            how.threads(),
        );
    }
    let provenance = machine::provenance();
    let mut journal = open(&folder.join(file_name(record::ROWS, shard)))?;
    start_anew_if_needed(how.fresh, &all, &mut journal, &provenance)?;
    how.run_pending(plan, &cells, shard, &store, &mut journal, &provenance)?;
    journal
        .settle(all.iter().map(|planned| planned.key.as_str()))
        .map_err(Failure::input)?;
    if let Some(shard) = shard {
        say_done(shard);
        return Ok(());
    }
    let rows: Vec<Row> = journal.lines().iter().map(|line| line.row.clone()).collect();
    finish(plan, folder, &rows)
}

/// Says that a shard has run.
pub(super) fn say_done(shard: Shard) {
    say(format_args!(
        "shard {} of {} is done; `sweep merge` joins the shards",
        shard.number, shard.of
    ));
}

/// Opens a file of rows or chunks, and tells what a kill left in it.
pub fn open<R: Record>(file: &Path) -> Result<Journal<R>, Failure> {
    let journal = Journal::open(file).map_err(Failure::input)?;
    if journal.cut_off > 0 {
        say_aside(format_args!(
            "{}: cut off {} bytes of an unfinished last line",
            file.display(),
            journal.cut_off
        ));
    }
    Ok(journal)
}

impl Arguments {
    fn of_battery(&self) -> battery::Run {
        battery::Run {
            fresh: self.how.fresh,
            dry_run: self.how.dry_run,
            shard: self.shard,
            threads: self.how.threads(),
        }
    }
}

impl How {
    fn threads(&self) -> usize {
        self.threads
            .unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from))
            .max(1)
    }

    fn run_pending(
        &self,
        plan: &Plan,
        cells: &[PlannedCell],
        shard: Option<Shard>,
        store: &Store,
        journal: &mut Journal,
        provenance: &Provenance,
    ) -> Outcome {
        let done = cells.iter().filter(|planned| runner::is_done(planned, journal)).count();
        if done == cells.len() {
            say(format_args!("all {done} cells have rows; --fresh measures them anew"));
            return Ok(());
        }
        let mut tasks = tasks(plan, cells, store, self.threads())?;
        if let Some(shard) = shard {
            let all = tasks.into_iter().enumerate();
            tasks = all.filter(|(at, _)| shard.has(*at)).map(|(_, task)| task).collect();
        }
        for task in &mut tasks {
            task.units
                .retain(|unit| !unit.cells.iter().all(|&cell| runner::is_done(&cells[cell], journal)));
        }
        tasks.retain(|task| !task.units.is_empty());
        let units = || tasks.iter().flat_map(|task| &task.units);
        let pending = units().map(|unit| unit.cells.len()).sum();
        say(format_args!("{}: {pending} cells to run, {done} are done", plan.name));
        let available = || {
            let free = machine::available_memory_bytes().unwrap_or(UNKNOWN_MEMORY);
            (free as f64 * MEMORY_SHARE) as u64
        };
        let progress = Progress::new(pending, units().map(|unit| runner::weight(unit, cells)).sum());
        let sweep = Sweep {
            cells,
            store,
            provenance,
            threads: self.threads(),
            memory_bytes: self.max_memory.unwrap_or_else(available),
            watch: &progress,
        };
        let ended = sweep.run(&tasks, journal);
        progress.finish();
        ended.map_err(Failure::input)
    }
}

/// Rows are resumed where an unfinished run on a machine like this one left them. Rows of another machine, or a whole
/// set of rows by another version of the code, are kept under another name.
fn start_anew_if_needed(fresh: bool, cells: &[PlannedCell], journal: &mut Journal, provenance: &Provenance) -> Outcome {
    let reports = || journal.lines().iter().filter_map(|line| line.row.report.as_ref());
    let complete = cells.iter().all(|planned| runner::is_done(planned, journal));
    let elsewhere = reports().any(|report| !machine::same_machine(&report.provenance, provenance));
    let other_code = reports().any(|report| report.provenance.commit != provenance.commit);
    let reason = if fresh {
        "--fresh"
    } else if elsewhere {
        "they were made on another machine"
    } else if complete && other_code {
        "they are complete and were made by another commit"
    } else {
        return Ok(());
    };
    if let Some(kept) = journal.set_aside(&provenance.date).map_err(Failure::input)? {
        say(format_args!(
            "starting anew ({reason}); the rows that were there are now {}",
            kept.display()
        ));
    }
    Ok(())
}

fn tasks(plan: &Plan, cells: &[PlannedCell], store: &Store, threads: usize) -> Result<Vec<Task>, Failure> {
    store.survey(cells.iter().map(|planned| &planned.cell), threads);
    work::tasks(cells, |cell| store.outlook(cell), measure::complete)
        .map_err(|error| Failure::Input(format!("{}: {error}", plan.file.display())))
}

fn dry_run(plan: &Plan, cells: &[PlannedCell], tasks: &[Task], threads: usize) -> Outcome {
    let (mut seconds, mut meshes, mut skipped) = (0.0, 0, 0);
    for unit in tasks.iter().flat_map(|task| &task.units) {
        let first = &cells[unit.cells[0]];
        let weight = runner::weight(unit, cells);
        let cores = if first.cell.timed { 1 } else { threads };
        seconds += weight * SECONDS_PER_TRIANGLE / cores as f64;
        let above = unit.guessed_triangles > first.budget.triangles;
        (meshes, skipped) = (
            meshes + usize::from(!above),
            skipped + if above { unit.cells.len() } else { 0 },
        );
        for &cell in &unit.cells {
            let verdict = if above { ", probably skipped" } else { "" };
            say(format_args!(
                "{}  about {:.0} triangles{verdict}",
                cells[cell].key, unit.guessed_triangles
            ));
        }
    }
    say(format_args!(
        "{}: {} cells, {meshes} meshes, {skipped} cells probably skipped",
        plan.name,
        cells.len()
    ));
    say(format_args!(
        "about {:.0} s with {threads} side by side; the guess knows the spacing before limiting only",
        seconds
    ));
    Ok(())
}

/// The file of a shard's rows or chunks, where `whole` is the file of all.
pub fn file_name(whole: &str, shard: Option<Shard>) -> String {
    let stem = whole.trim_end_matches(".jsonl");
    match shard {
        Some(shard) => format!("{stem}.{}-of-{}.jsonl", shard.number, shard.of),
        None => whole.into(),
    }
}

fn merge(plan: &Plan, folder: &Path) -> Outcome {
    if plan.batteries.is_empty() {
        let cells = plan.cells().map_err(Failure::input)?;
        let keys: Vec<String> = cells.into_iter().map(|planned| planned.key).collect();
        finish(plan, folder, &join(folder, record::ROWS, &keys)?)
    } else {
        battery::finish(plan, folder, &join(folder, CHUNKS, &battery::keys(plan))?)
    }
}

/// Joins the rows, or chunks, of shards. Those of the file of all are kept where no shard has them.
fn join<R: Record>(folder: &Path, whole: &str, keys: &[String]) -> Result<Vec<R>, Failure> {
    let shards = shard_files(folder, whole)?;
    if shards.is_empty() {
        return Err(Failure::Input(format!(
            "{}: no rows of shards there; run `sweep --shard I/N`",
            folder.display()
        )));
    }
    let mut journal: Journal<R> = Journal::open(&folder.join(whole)).map_err(Failure::input)?;
    for file in &shards {
        // Opening takes the lock: a shard that is still running is not merged half.
        let shard = Journal::open(file).map_err(Failure::input)?;
        for line in shard.lines() {
            journal.append(line.clone()).map_err(Failure::input)?;
        }
        say(format_args!("{}: {} rows", file.display(), shard.lines().len()));
    }
    journal
        .settle(keys.iter().map(String::as_str))
        .map_err(Failure::input)?;
    let missing: Vec<&String> = keys.iter().filter(|key| journal.get(key).is_none()).collect();
    if let Some(first) = missing.first() {
        let many = missing.len();
        return Err(Failure::Input(format!(
            "{many} of them have no row yet, such as {first}; run the missing shards, or `sweep` to run what is left"
        )));
    }
    Ok(journal.lines().iter().map(|line| line.row.clone()).collect())
}

/// The rows of shards in a folder, by name.
fn shard_files(folder: &Path, whole: &str) -> Result<Vec<PathBuf>, Failure> {
    let stem = format!("{}.", whole.trim_end_matches(".jsonl"));
    let listed = folder
        .read_dir()
        .map_err(|cause| Failure::Input(format!("{}: {cause}", folder.display())))?;
    let is_shard = |path: &PathBuf| {
        let name = path
            .file_name()
            .map(|name| name.to_string_lossy().into_owned())
            .unwrap_or_default();
        let middle = name.strip_prefix(&stem).and_then(|rest| rest.strip_suffix(".jsonl"));
        middle
            .and_then(|middle| middle.replace("-of-", "/").parse::<Shard>().ok())
            .is_some()
    };
    let mut files: Vec<PathBuf> = listed.flatten().map(|entry| entry.path()).filter(is_shard).collect();
    files.sort();
    Ok(files)
}

/// Charts, page and verdict, once every cell has a row.
fn finish(plan: &Plan, folder: &Path, rows: &[Row]) -> Outcome {
    let copy = folder.join("plan.toml");
    write_whole(&copy, plan.text.as_bytes()).map_err(|cause| Failure::Input(format!("{}: {cause}", copy.display())))?;
    if !anything_measured(rows) {
        let reason = rows
            .iter()
            .find_map(|row| row.reason.as_deref())
            .unwrap_or("no cell was run");
        return Err(Failure::NothingMeasured(format!("nothing could be measured: {reason}")));
    }
    super::report::write(folder)?;
    tell(&findings(&plan.expect, rows))
}

/// Tells what was expected and what came out.
pub fn tell(findings: &[Finding]) -> Outcome {
    for finding in findings {
        say(format_args!(
            "{} {}: {}",
            if finding.holds { "held:  " } else { "BROKEN:" },
            finding.expected,
            finding.found
        ));
    }
    let broken = findings.iter().filter(|finding| !finding.holds).count();
    if broken > 0 {
        return Err(Failure::Broken(format!(
            "{broken} of {} expectations broke; they are named above",
            findings.len()
        )));
    }
    Ok(())
}
