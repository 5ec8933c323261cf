//! Runs the cells of a plan and appends a row for each.
//!
//! Timed cells run alone, before the memory of others is in their way, their repeats interleaved so that a noisy minute
//! does not fall on one of them. Then cells that are only counted and measured run side by side, as far as their memory
//! fits.

use crate::meshers::{Budget, Request};
use crate::spacing::estimate_triangles;
use crate::suite::peers::{AnyEntry, AnyMesher, PeerError, RunError};
use crate::suite::rows::journal::{Journal, JournalError, Line};
use crate::suite::rows::machine;
use crate::suite::rows::record::{Cell, Outcome, Provenance, Report, Row};
use crate::suite::run::ending::{Ending, add_repeat, guarded, slim, unwritable};
use crate::suite::run::gate::Gate;
use crate::suite::run::measure::{self, Run};
use crate::suite::run::plan::PlannedCell;
use crate::suite::run::prepare::{Prepared, Store};
use crate::suite::run::tune::{NoMesh, Tuned, tune};
use crate::suite::run::work::{Task, Unit};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Memory a cell needs for each triangle, spacing and certificate included: measured as 160 to 260 bytes of peak memory
/// a triangle, from 250 thousand to four million, with room for smaller cells.
const BYTES_PER_TRIANGLE: f64 = 400.0;

/// Vertices are about half as many as triangles; a mesher is stopped at this multiple of the expected triangles, far
/// above any honest mesh.
pub(super) const VERTICES_PER_BUDGET_TRIANGLE: f64 = 2.0;

/// Told of every row as it is written.
pub trait Watch: Sync {
    /// A row was written; `weight` is its unit's share of the work, given once a unit.
    fn row(&self, row: &Row, weight: f64);
}

/// A sweep about to run.
pub struct Sweep<'a> {
    /// All cells of the plan.
    pub cells: &'a [PlannedCell],
    /// Domains and spacings.
    pub store: &'a Store,
    /// Written into every row, with the time of that row.
    pub provenance: &'a Provenance,
    /// How many cells run side by side.
    pub threads: usize,
    /// Memory that cells running side by side may use together, bytes; a cell that needs more is skipped.
    pub memory_bytes: u64,
    /// Told of every row.
    pub watch: &'a dyn Watch,
}

/// Triangles of work a unit stands for, skipped ones a little, so that progress is even.
pub fn weight(unit: &Unit, cells: &[PlannedCell]) -> f64 {
    // What a cell costs besides: its row, and little else.
    const ROW: f64 = 500.0;
    let repeats = cells[unit.cells[0]].repeats as f64;
    if unit.guessed_triangles > budget_triangles(unit, cells) {
        ROW + unit.set_up
    } else {
        ROW + unit.set_up + unit.guessed_triangles * repeats
    }
}

/// Whether the journal has a final row for that cell.
pub fn is_done(planned: &PlannedCell, journal: &Journal) -> bool {
    journal.get(&planned.key).is_some_and(|row| is_final(planned, row))
}

/// Whether nothing more comes of a cell: skipped ones are tried again where the budget would let them, since a peer or memory was
/// missing; timed ones where repeats are.
pub fn is_final(planned: &PlannedCell, row: &Row) -> bool {
    match row.outcome {
        Outcome::Skipped => row.estimated_triangles > planned.budget.triangles,
        Outcome::Measured => !planned.cell.timed || row.repeats() >= planned.repeats,
        Outcome::Declined | Outcome::Failed => true,
    }
}

/// A unit's budget: cells of one mesh may stand in groups with different ones, and the largest counts.
fn budget_triangles(unit: &Unit, cells: &[PlannedCell]) -> f64 {
    unit.cells
        .iter()
        .map(|&cell| cells[cell].budget.triangles)
        .fold(0.0, f64::max)
}

impl Sweep<'_> {
    /// Runs `tasks` and appends their rows.
    ///
    /// # Errors
    /// [`JournalError`] if a row cannot be written; the run stops then.
    pub fn run(&self, tasks: &[Task], journal: &mut Journal) -> Result<(), JournalError> {
        let (timed, untimed): (Vec<&Task>, Vec<&Task>) =
            tasks.iter().partition(|task| self.cells[task.cell].cell.timed);
        self.run_alone(&timed, journal)?;
        self.run_side_by_side(&untimed, journal)
    }

    fn run_side_by_side(&self, tasks: &[&Task], journal: &mut Journal) -> Result<(), JournalError> {
        let (next, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
        let (gate, journal) = (Gate::new(self.memory_bytes), Mutex::new(journal));
        let work = || -> Result<(), JournalError> {
            while let Some(task) = tasks.get(next.fetch_add(1, Ordering::Relaxed)) {
                if stop.load(Ordering::Relaxed) {
                    break;
                }
                let written = self.task(task, &gate, &journal);
                written.inspect_err(|_| stop.store(true, Ordering::Relaxed))?;
            }
            Ok(())
        };
        std::thread::scope(|scope| {
            let workers: Vec<_> = (0..self.threads.max(1)).map(|_| scope.spawn(work)).collect();
            workers.into_iter().try_for_each(|worker| match worker.join() {
                Ok(written) => written,
                Err(panic) => std::panic::resume_unwind(panic),
            })
        })
    }

    fn task(&self, task: &Task, gate: &Gate, journal: &Mutex<&mut Journal>) -> Result<(), JournalError> {
        let mut prepared = None;
        for unit in &task.units {
            let limit = budget_triangles(unit, self.cells);
            let ending = if unit.least_triangles > limit {
                Ending::too_large(unit.least_triangles, limit)
            } else {
                let bytes = unit.guessed_triangles.min(limit) * BYTES_PER_TRIANGLE;
                let _pass = gate.take(bytes as u64);
                let prepared = prepared.get_or_insert_with(|| self.prepare(task));
                self.first_run(unit, prepared.as_ref())
            };
            let mut journal = journal.lock().unwrap_or_else(PoisonError::into_inner);
            self.write(unit, &ending, &mut journal, weight(unit, self.cells))?;
        }
        Ok(())
    }

    fn run_alone(&self, tasks: &[&Task], journal: &mut Journal) -> Result<(), JournalError> {
        let prepared: Vec<_> = tasks.iter().map(|task| self.prepare(task)).collect();
        let rounds = self.cells.iter().map(|planned| planned.repeats).max().unwrap_or(0);
        for round in 0..rounds {
            for (task, prepared) in tasks.iter().zip(&prepared) {
                for unit in &task.units {
                    let planned = &self.cells[unit.cells[0]];
                    if round >= planned.repeats {
                        continue;
                    }
                    let before = journal
                        .get(&planned.key)
                        .filter(|row| row.outcome == Outcome::Measured)
                        .cloned();
                    let ending = match before {
                        Some(row) if row.repeats() > round => continue,
                        Some(row) => self.repeat(unit, prepared.as_ref(), row),
                        // What did not come out in the first round is not tried again.
                        None if round > 0 => continue,
                        None => self.first_run(unit, prepared.as_ref()),
                    };
                    let share = weight(unit, self.cells) / planned.repeats as f64;
                    self.write(unit, &ending, journal, share)?;
                }
            }
        }
        Ok(())
    }

    fn prepare(&self, task: &Task) -> Result<Prepared, String> {
        let cell = &self.cells[task.cell].cell;
        guarded(|| self.store.prepare(cell, task.alpha).map_err(|error| error.to_string())).and_then(|inner| inner)
    }

    /// Runs a unit and judges its mesh.
    fn first_run(&self, unit: &Unit, prepared: Result<&Prepared, &String>) -> Ending {
        let planned = &self.cells[unit.cells[0]];
        let prepared = match prepared {
            Ok(prepared) => prepared,
            Err(reason) => return Ending::without_report(Outcome::Failed, reason.clone(), unit.guessed_triangles),
        };
        let limit = budget_triangles(unit, self.cells);
        let estimated = match planned.cell.triangles {
            Some(wanted) => wanted as f64,
            None => estimate_triangles(prepared.integral.value, planned.cell.c_b),
        };
        if estimated > limit {
            return Ending::too_large(estimated, limit);
        }
        let bytes = estimated * BYTES_PER_TRIANGLE;
        if bytes > self.memory_bytes as f64 {
            let (needed, free) = (bytes / 1e9, self.memory_bytes as f64 / 1e9);
            let reason = format!("needs about {needed:.1} GB of memory, and may use {free:.1} GB");
            return Ending::without_report(Outcome::Skipped, reason, estimated);
        }
        let attempt = guarded(|| {
            let mesher = mesher(&planned.cell).map_err(|reason| (Outcome::Failed, reason))?;
            let tuned = self.first_mesh(planned, prepared, &mesher, limit)?;
            let (asked, run) = (planned.cell.scaled_to(tuned.c_b), tuned.value);
            let provenance = Provenance {
                date: machine::now(),
                ..self.provenance.clone()
            };
            let mut report = measure::judge(prepared, &asked, &mesher, &run, &provenance);
            if let Some(times) = &mut report.times {
                times.samples.push(times.seconds.total);
            }
            slim(&mut report, planned.cell.timed);
            Ok((report, tuned.tries))
        });
        match attempt {
            Ok(Ok((report, tries))) => Ending {
                outcome: if report.outside.is_some() && !report.certificate.holds {
                    Outcome::Failed
                } else {
                    Outcome::Measured
                },
                reason: not_conforming(&report),
                estimated_triangles: estimated,
                tries,
                report: Some(report),
            },
            Ok(Err((outcome, reason))) => Ending::without_report(outcome, reason, estimated),
            Err(panic) => Ending::without_report(Outcome::Failed, panic, estimated),
        }
    }

    /// The mesh of a cell: one with its c_b, or the one nearest to the number of triangles it asks for.
    fn first_mesh(
        &self,
        planned: &PlannedCell,
        prepared: &Prepared,
        mesher: &AnyMesher,
        limit: f64,
    ) -> Result<Tuned<Run>, (Outcome, String)> {
        let once = |c_b| self.mesh(planned, c_b, prepared, mesher, limit);
        let Some(wanted) = planned.cell.triangles else {
            let c_b = planned.cell.c_b;
            let value = once(c_b).map_err(ended)?;
            return Ok(Tuned {
                tries: Vec::new(),
                c_b,
                value,
            });
        };
        // As many as expected for c_b = 1, times c_b to the power −2.
        let start = (estimate_triangles(prepared.integral.value, 1.0) / wanted as f64).sqrt();
        tune(wanted, start, |c_b| {
            let run = once(c_b).map_err(|error| NoMesh {
                too_many: error.is_budget(),
                error,
            })?;
            Ok((run.mesh.triangles.len() as u64, run))
        })
        .map_err(|none| ended(none.error))
    }

    /// One more timing of a unit that has been judged: the mesh must be the same, bit by bit.
    fn repeat(&self, unit: &Unit, prepared: Result<&Prepared, &String>, row: Row) -> Ending {
        let planned = &self.cells[unit.cells[0]];
        let estimated = row.estimated_triangles;
        let limit = budget_triangles(unit, self.cells);
        let c_b = row.report.as_ref().map_or(planned.cell.c_b, |report| report.c_b);
        let attempt = guarded(|| {
            let prepared = prepared.map_err(|reason| (Outcome::Failed, reason.clone()))?;
            let mesher = mesher(&planned.cell).map_err(|reason| (Outcome::Failed, reason))?;
            self.mesh(planned, c_b, prepared, &mesher, limit).map_err(ended)
        });
        let (run, mut report) = match (attempt, row.report) {
            (Ok(Ok(run)), Some(report)) => (run, report),
            (Ok(Err((outcome, reason))), _) => return Ending::without_report(outcome, reason, estimated),
            (Err(panic), _) => return Ending::without_report(Outcome::Failed, panic, estimated),
            (_, None) => {
                return Ending::without_report(Outcome::Failed, "row lost its report; use --fresh".into(), estimated);
            }
        };
        let fingerprint = measure::fingerprint(&run.mesh);
        if let Some(outside) = report.outside.as_mut() {
            outside.repeats_differ |= fingerprint != report.fingerprint;
        } else if fingerprint != report.fingerprint {
            let reason = format!(
                "mesh {fingerprint} of a repeat differs from the first, {}",
                report.fingerprint
            );
            return Ending::without_report(Outcome::Failed, reason, estimated);
        }
        if let Some(times) = &mut report.times {
            add_repeat(times, run.times);
        }
        Ending {
            outcome: Outcome::Measured,
            reason: None,
            estimated_triangles: estimated,
            tries: row.tries,
            report: Some(report),
        }
    }

    fn mesh(
        &self,
        planned: &PlannedCell,
        c_b: f64,
        prepared: &Prepared,
        mesher: &AnyMesher,
        limit: f64,
    ) -> Result<Run, RunError> {
        let request = Request {
            c_b,
            seed: planned.cell.seed,
            threads: planned.cell.threads,
            budget: Budget {
                max_vertices: Some((VERTICES_PER_BUDGET_TRIANGLE * limit) as usize),
                max_seconds: Some(planned.budget.seconds),
                // Peers alone are held to it: what this process has besides is not the mesher's.
                max_memory: matches!(mesher, AnyMesher::Peer(_)).then_some(self.memory_bytes),
            },
        };
        if planned.cell.timed {
            machine::reset_peak_rss();
        }
        measure::run(prepared, mesher, &request)
    }

    /// Appends the rows of a unit's cells.
    fn write(&self, unit: &Unit, ending: &Ending, journal: &mut Journal, weight: f64) -> Result<(), JournalError> {
        for (place, &cell) in unit.cells.iter().enumerate() {
            let planned = &self.cells[cell];
            let mut report = ending.report.clone();
            if let Some(report) = &mut report {
                // The mesh is the same; what was asked for is not.
                let asked = planned.cell.scaled_to(report.c_b);
                (report.t, report.alpha) = (asked.t, planned.cell.t / planned.cell.c_b);
            }
            let row = Row {
                key: planned.key.clone(),
                group: planned.group.clone(),
                outcome: ending.outcome,
                reason: ending.reason.clone(),
                estimated_triangles: ending.estimated_triangles,
                cell: planned.cell.clone(),
                tries: ending.tries.clone(),
                report,
            };
            let line = Line::new(row.clone()).or_else(|error| Line::new(unwritable(row, &error.to_string())));
            if let Ok(line) = line {
                self.watch.row(&line.row, if place == 0 { weight } else { 0.0 });
                journal.append(line)?;
            }
        }
        Ok(())
    }
}

/// The mesher a cell asks for.
///
/// # Errors
/// What is wrong with its name or parameters.
pub fn mesher(cell: &Cell) -> Result<AnyMesher, String> {
    let entry = AnyEntry::find(&cell.mesher)
        .ok_or_else(|| format!("there is no mesher `{}`; `biting list` shows them", cell.mesher))?;
    let made = entry.make(&cell.params);
    made.map_err(|error| format!("mesher `{}`: {error}; `biting list` shows them", cell.mesher))
}

/// Why the mesh of a peer is none of the domain; ours are held to their certificates as a whole, by
/// what the plan expects.
fn not_conforming(report: &Report) -> Option<String> {
    report.outside.as_ref()?;
    let broken: Vec<&str> = report.certificate.broken().map(|check| check.claim.name()).collect();
    (!broken.is_empty()).then(|| format!("its mesh breaks {}", broken.join(", ")))
}

/// How a cell without a mesh ended, and why.
fn ended(error: RunError) -> (Outcome, String) {
    let outcome = match error {
        RunError::Peer(PeerError::Missing(_)) => Outcome::Skipped,
        _ if error.is_budget() || error.is_declined() => Outcome::Declined,
        _ => Outcome::Failed,
    };
    (outcome, error.to_string())
}
