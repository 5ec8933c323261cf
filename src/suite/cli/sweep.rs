//! `sweep [EXPERIMENT.toml]`: the main job.

use super::exit::{Failure, Outcome};
use super::list::EXPERIMENTS;
use super::output::{say, say_aside};
use super::progress::Progress;
use super::shards::{self, file_name, join, say_done};
use super::tally;
use super::values::bytes;
use crate::suite::analysis::expect::{Finding, anything_measured, findings};
use crate::suite::analysis::results::Results;
use crate::suite::rows::journal::{JOURNAL, Journal, Record};
use crate::suite::rows::machine;
use crate::suite::rows::record::{Cell, Provenance, Row};
use crate::suite::rows::tables::Tables;
use crate::suite::rows::tally::{CHUNKS, Chunk};
use crate::suite::run::plan::{Plan, PlannedCell};
use crate::suite::run::prepare::Store;
use crate::suite::run::runner::{self, Sweep};
use crate::suite::run::work::{self, Shard, Task};
use std::collections::HashMap;
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
    #[command(flatten)]
    place: Place,
    #[command(flatten)]
    how: How,
    /// Run the I-th of N parts; `sweep merge` joins them
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Only the cells that are timed alone; all other lines of the tables stay
    #[arg(long, conflicts_with = "shard")]
    timed: bool,
}

#[derive(clap::Subcommand)]
enum Part {
    /// Join what all shards measured: tables, charts and page
    Merge(Place),
}

/// Which plan, how much of it, and where its results go.
#[derive(clap::Args)]
pub struct Place {
    /// The experiment [default: the one in experiments/ named as the verb]
    #[arg(value_name = "EXPERIMENT.toml")]
    experiment: Option<PathBuf>,
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
    /// Start anew also where a run was stopped; what it had measured is kept under another name
    #[arg(long)]
    pub(super) fresh: bool,
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
    /// The plan of the experiment, by default the one of that name among this checkout's.
    pub fn plan(&self, default: &str) -> Result<Plan, Failure> {
        let default = || Path::new(EXPERIMENTS).join(format!("{default}.toml"));
        let plan = Plan::read(&self.experiment.clone().unwrap_or_else(default)).map_err(Failure::input)?;
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
    if let Some(Part::Merge(place)) = &arguments.part {
        let plan = place.plan(DEFAULT)?;
        return merge(&plan, &place.folder(&plan));
    }
    let plan = arguments.place.plan(DEFAULT)?;
    let folder = arguments.place.folder(&plan);
    run_plan(&plan, &folder, &arguments.how, arguments.shard, |cell| {
        cell.timed || !arguments.timed
    })
}

/// Runs those of a plan's cells that are wanted and that a stopped run has not measured, and its cases that are tallied, or the part
/// of them that a shard has; then, but for a shard, writes tables, charts and page.
pub fn run_plan(
    plan: &Plan,
    folder: &Path,
    how: &How,
    shard: Option<Shard>,
    is_wanted: impl Fn(&Cell) -> bool,
) -> Outcome {
    let rows = run_cells(plan, folder, how, shard, is_wanted)?;
    let chunks = tally::run(plan, folder, how, shard)?;
    if let Some(shard) = shard.filter(|_| !how.dry_run) {
        say_done(shard);
    }
    match rows.zip(chunks) {
        Some((rows, chunks)) => finish(plan, folder, &rows, &chunks),
        None => Ok(()),
    }
}

/// Runs cells, and returns all rows there are, but for a dry run or a shard.
fn run_cells(
    plan: &Plan,
    folder: &Path,
    how: &How,
    shard: Option<Shard>,
    is_wanted: impl Fn(&Cell) -> bool,
) -> Result<Option<Vec<Row>>, Failure> {
    let all = plan.cells().map_err(Failure::input)?;
    if all.is_empty() {
        return Ok((!how.dry_run && shard.is_none()).then(Vec::new));
    }
    let cells: Vec<PlannedCell> = all.iter().filter(|planned| is_wanted(&planned.cell)).cloned().collect();
    for planned in &cells {
        runner::mesher(&planned.cell)
            .map_err(|problem| Failure::Input(format!("{}: {}: {problem}", plan.file.display(), planned.key)))?;
    }
    let store = Store::new(None, false);
    if how.dry_run {
        let threads = how.threads();
        dry_run(plan, &cells, &tasks(plan, &cells, &store, threads)?, threads);
        return Ok(None);
    }
    let provenance = machine::provenance();
    let mut journal = open(&folder.join(file_name(JOURNAL, shard)))?;
    start_anew_if_needed(how.fresh, &all, &mut journal, &provenance)?;
    how.run_pending(plan, &cells, shard, &store, &mut journal, &provenance)?;
    Ok(shard
        .is_none()
        .then(|| journal.lines().iter().map(|line| line.row.clone()).collect()))
}

/// Writes the tables of a run that is finished; [`crate::suite::rows::tables`] says which lines of earlier ones stay.
fn write_tables(plan: &Plan, folder: &Path, rows: &[Row], chunks: &[Chunk]) -> Result<Tables, Failure> {
    let cells = plan.cells().map_err(Failure::input)?;
    let by_key: HashMap<&str, &PlannedCell> = cells.iter().map(|planned| (planned.key.as_str(), planned)).collect();
    let is_final = |row: &Row| {
        by_key
            .get(row.key.as_str())
            .is_some_and(|planned| runner::is_final(planned, row))
    };
    let is_whole = rows.iter().filter(|row| is_final(row)).count() == cells.len();
    let earlier = match is_whole || !Tables::are_in(folder) {
        true => None,
        false => Some(Tables::read(folder).map_err(Failure::input)?),
    };
    let keys = cells.iter().map(|planned| planned.key.as_str());
    let tables = Tables::gather(&plan.text, keys, rows, is_final, chunks, earlier);
    tables.write(folder).map_err(Failure::input)?;
    Ok(tables)
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

impl How {
    pub(super) fn threads(&self) -> usize {
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
            say(format_args!(
                "all {done} cells were measured by a run that was stopped; --fresh measures them anew"
            ));
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

/// A run that was stopped is resumed on a machine like its own. What was measured on another machine, or all of it by another
/// version of the code, is kept under another name.
fn start_anew_if_needed(fresh: bool, cells: &[PlannedCell], journal: &mut Journal, provenance: &Provenance) -> Outcome {
    let reports = || journal.lines().iter().filter_map(|line| line.row.report.as_ref());
    let complete = cells.iter().all(|planned| runner::is_done(planned, journal));
    let mades = || reports().filter_map(|report| report.provenance.as_ref());
    let elsewhere = mades().any(|made| !machine::same_machine(made, provenance));
    let other_code = mades().any(|made| made.commit != provenance.commit);
    let reason = if fresh {
        "--fresh"
    } else if elsewhere {
        "it was measured on another machine"
    } else if complete && other_code {
        "it is complete and was measured by another commit"
    } else {
        return Ok(());
    };
    if let Some(kept) = journal.set_aside(&provenance.date).map_err(Failure::input)? {
        say(format_args!(
            "starting anew ({reason}); what a stopped run measured is now {}",
            kept.display()
        ));
    }
    Ok(())
}

fn tasks(plan: &Plan, cells: &[PlannedCell], store: &Store, threads: usize) -> Result<Vec<Task>, Failure> {
    store.survey(cells.iter().map(|planned| &planned.cell), threads);
    work::tasks(cells, |cell| store.outlook(cell), Cell::complete)
        .map_err(|error| Failure::Input(format!("{}: {error}", plan.file.display())))
}

fn dry_run(plan: &Plan, cells: &[PlannedCell], tasks: &[Task], threads: usize) {
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
    for (section, groups) in &plan.sections {
        let groups: Vec<&str> = groups.iter().map(String::as_str).collect();
        say(format_args!("its page shows `{section}` of {}", groups.join(", ")));
    }
}

fn merge(plan: &Plan, folder: &Path) -> Outcome {
    let cells = plan.cells().map_err(Failure::input)?;
    let keys: Vec<String> = cells.into_iter().map(|planned| planned.key).collect();
    let rows = join(folder, JOURNAL, &keys)?;
    finish(plan, folder, &rows, &join(folder, CHUNKS, &tally::keys(plan))?)
}

/// Tables in place of the journals, then charts, page and verdict, once everything is run.
fn finish(plan: &Plan, folder: &Path, rows: &[Row], chunks: &[Chunk]) -> Outcome {
    let tables = write_tables(plan, folder, rows, chunks)?;
    for journal in [JOURNAL, CHUNKS] {
        shards::remove(folder, journal)?;
    }
    let skipped = tables
        .families
        .iter()
        .filter_map(|family| Some((&family.name, family.skipped.as_ref()?)));
    skipped.for_each(|(family, reason)| say(format_args!("skipped {family}: {reason}")));
    let is_tallied = tables.families.iter().any(|family| !family.tallies.is_empty());
    if !anything_measured(&tables.rows) && !is_tallied {
        let reason = tables
            .rows
            .iter()
            .find_map(|row| row.reason.as_deref())
            .unwrap_or("there were no cells or cases to run");
        return Err(Failure::NothingMeasured(format!("nothing could be measured: {reason}")));
    }
    super::report::write(folder)?;
    tell(&findings(&Results::new(plan.clone(), tables)))
}

/// Tells what was expected and what came out.
fn tell(findings: &[Finding]) -> Outcome {
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
