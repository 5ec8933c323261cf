//! Deals cases of groups that are tallied out to workers, chunk by chunk, and appends a line for each chunk.

use crate::suite::rows::hash::digest;
use crate::suite::rows::journal::{Journal, JournalError, Line};
use crate::suite::rows::machine;
use crate::suite::rows::record::Provenance;
use crate::suite::rows::tally::{Chunk, Uncertified};
use crate::suite::run::tally::family::{Family, Part, Trial};
use crate::suite::run::tally::trial::Tried;
use crate::suite::run::tally::worker::Worker;
use std::io;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Why a campaign stopped.
#[derive(Debug, thiserror::Error)]
pub enum CampaignError {
    /// A line could not be written.
    #[error(transparent)]
    Journal(#[from] JournalError),
    /// A worker could not be started, or gave no answer that can be read.
    #[error("a process that runs cases: {0}; start this again to go on")]
    Worker(#[from] io::Error),
    /// A line could not be read back.
    #[error("chunk {key}: {cause}")]
    Line {
        /// Its key.
        key: String,
        /// What the parser says.
        cause: serde_json::Error,
    },
}

/// Told of every chunk as it is written.
pub trait Watch: Sync {
    /// A chunk was written.
    fn chunk(&self, chunk: &Chunk);
}

/// Chunks about to be run.
pub struct Campaign<'a> {
    /// The program and its arguments that a worker is: something that calls [`crate::suite::run::tally::worker::serve`].
    pub worker: (PathBuf, &'a [&'a str]),
    /// Written into every line, with the time of that line.
    pub provenance: &'a Provenance,
    /// How many workers run side by side.
    pub threads: usize,
    /// Told of every chunk.
    pub watch: &'a dyn Watch,
}

impl Campaign<'_> {
    /// Runs chunks of families and appends their lines.
    ///
    /// # Errors
    /// [`CampaignError`]; the run stops then.
    pub fn run(&self, parts: &[(&Family, Part)], journal: &mut Journal<Chunk>) -> Result<(), CampaignError> {
        let (next, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
        let journal = Mutex::new(journal);
        let work = || -> Result<(), CampaignError> {
            let mut worker = Worker::new(self.worker.0.clone(), self.worker.1);
            while let Some((family, part)) = parts.get(next.fetch_add(1, Ordering::Relaxed)) {
                let Some(chunk) = self.chunk(family, part, &mut worker, &stop)? else {
                    break;
                };
                let key = chunk.key.clone();
                let line = Line::new(chunk).map_err(|cause| CampaignError::Line { key, cause })?;
                self.watch.chunk(&line.row);
                journal.lock().unwrap_or_else(PoisonError::into_inner).append(line)?;
            }
            Ok(())
        };
        let guarded = || work().inspect_err(|_| stop.store(true, Ordering::Relaxed));
        std::thread::scope(|scope| {
            let workers: Vec<_> = (0..self.threads.max(1)).map(|_| scope.spawn(guarded)).collect();
            workers.into_iter().try_for_each(|worker| match worker.join() {
                Ok(written) => written,
                Err(panic) => std::panic::resume_unwind(panic),
            })
        })
    }

    /// The line of a chunk, nothing if the run is being stopped.
    fn chunk(&self, family: &Family, part: &Part, worker: &mut Worker, stop: &AtomicBool) -> io::Result<Option<Chunk>> {
        let methods = family.methods();
        let mut chunk = Chunk::new(&part.key, &family.name, methods.clone());
        chunk.skipped = family.missing.clone();
        for number in part.first..part.end {
            if stop.load(Ordering::Relaxed) {
                return Ok(None);
            }
            let trial = family.case(number);
            let tried = worker.run(&trial)?;
            note(&mut chunk, &trial, &tried, number % methods.len() == 0);
        }
        chunk.provenance = Provenance {
            date: machine::now(),
            ..self.provenance.clone()
        };
        Ok(Some(chunk))
    }
}

/// Counts a case; `is_new_domain` where it is the first of its domain.
fn note(chunk: &mut Chunk, trial: &Trial, tried: &Tried, is_new_domain: bool) {
    let method = trial.method();
    if is_new_domain {
        chunk.discarded += tried.discarded as u64;
    }
    chunk.digest = digest(&chunk.digest, &tried.fingerprint);
    if let Some(tally) = chunk.tallies.iter_mut().find(|tally| tally.method == method) {
        *tally.cases.entry(tried.verdict).or_default() += 1;
        tally.triangles += tried.triangles as u64;
        tally.seconds += tried.seconds;
    }
    chunk.uncertified.extend(tried.reason.iter().map(|reason| Uncertified {
        method: method.clone(),
        verdict: tried.verdict,
        domain: trial.cell.domain.clone(),
        reason: reason.clone(),
        command: trial.command(),
    }));
}
