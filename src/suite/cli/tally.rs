//! Groups that are tallied: their cases run by processes of their own, chunk by chunk.

use super::exit::{Failure, Outcome};
use super::output::{say, say_aside};
use super::shards::file_name;
use super::sweep::How;
use crate::suite::rows::journal::Journal;
use crate::suite::rows::machine;
use crate::suite::rows::tally::{CHUNKS, Chunk, Tally, Verdict};
use crate::suite::run::plan::Plan;
use crate::suite::run::tally::campaign::{Campaign, Watch};
use crate::suite::run::tally::family::{Family, Part};
use crate::suite::run::tally::worker;
use crate::suite::run::work::Shard;
use std::path::Path;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The hidden verb that workers are started with.
pub const WORKER: &str = "run-cases";

/// A line at most this often, besides those about what must not be.
const LINE_EVERY: Duration = Duration::from_secs(5);

/// Runs cases that come in on standard input: what a worker does.
pub fn work() -> Outcome {
    // This very thread as rayon's only one: handing work to another costs more than small cases are worth. Where there are
    // others already, they do as well.
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread();
    let _ = alone.build_global();
    worker::serve(std::io::stdin().lock(), std::io::stdout().lock()).map_err(Failure::input)
}

/// Runs the chunks of a plan that have no line yet, or the part of them that a shard has. Returns all, but for a dry run or a shard.
pub fn run(plan: &Plan, folder: &Path, how: &How, shard: Option<Shard>) -> Result<Option<Vec<Chunk>>, Failure> {
    let families = Family::all(plan);
    for family in &families {
        family
            .check()
            .map_err(|problem| Failure::Input(format!("{}: {}: {problem}", plan.file.display(), family.name)))?;
    }
    let parts: Vec<(&Family, Part)> = families
        .iter()
        .flat_map(|family| family.chunks().into_iter().map(move |part| (family, part)))
        .collect();
    if parts.is_empty() {
        return Ok((!how.dry_run && shard.is_none()).then(Vec::new));
    }
    let cases: usize = families.iter().map(Family::cases).sum();
    if how.dry_run {
        for family in &families {
            let missing = family.missing.as_deref().unwrap_or_default();
            say(format_args!("{}: {} cases {missing}", family.name, family.cases()));
        }
        say(format_args!("{}: {cases} cases in {} chunks", plan.name, parts.len()));
        return Ok(None);
    }
    let mut journal: Journal<Chunk> = super::sweep::open(&folder.join(file_name(CHUNKS, shard)))?;
    let provenance = machine::provenance();
    let is_complete = parts.iter().all(|(_, part)| journal.get(&part.key).is_some());
    let is_other = journal
        .lines()
        .iter()
        .any(|line| line.row.provenance.commit != provenance.commit);
    if (how.fresh || (is_complete && is_other))
        && let Some(kept) = journal.set_aside(&provenance.date).map_err(Failure::input)?
    {
        say(format_args!(
            "starting anew; the chunks that were there are now {}",
            kept.display()
        ));
    }
    let mut pending = parts.clone();
    if let Some(shard) = shard {
        let all = pending.into_iter().enumerate();
        pending = all.filter(|(at, _)| shard.has(*at)).map(|(_, part)| part).collect();
    }
    pending.retain(|(_, part)| journal.get(&part.key).is_none());
    say(format_args!(
        "{}: {cases} cases in {} chunks, {} chunks to run",
        plan.name,
        parts.len(),
        pending.len()
    ));
    let program = std::env::current_exe().map_err(Failure::input)?;
    let progress = Progress::new(pending.len());
    let campaign = Campaign {
        worker: (program, &[WORKER]),
        provenance: &provenance,
        threads: how.threads(),
        watch: &progress,
    };
    campaign.run(&pending, &mut journal).map_err(Failure::input)?;
    journal
        .settle(parts.iter().map(|(_, part)| part.key.as_str()))
        .map_err(Failure::input)?;
    Ok(shard
        .is_none()
        .then(|| journal.lines().iter().map(|line| line.row.clone()).collect()))
}

/// The keys of all chunks of a plan.
pub fn keys(plan: &Plan) -> Vec<String> {
    let families = Family::all(plan);
    families.iter().flat_map(Family::chunks).map(|part| part.key).collect()
}

/// Tells how far a campaign is.
struct Progress {
    of: usize,
    state: Mutex<State>,
}

struct State {
    chunks: usize,
    all: Tally,
    started: Instant,
    last_line: Option<Instant>,
}

impl Progress {
    fn new(of: usize) -> Self {
        let state = State {
            chunks: 0,
            all: Tally::default(),
            started: Instant::now(),
            last_line: None,
        };
        Self {
            of,
            state: Mutex::new(state),
        }
    }
}

impl Watch for Progress {
    fn chunk(&self, chunk: &Chunk) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        state.chunks += 1;
        chunk.tallies.iter().for_each(|tally| state.all.add(tally));
        for case in &chunk.uncertified {
            if matches!(case.verdict, Verdict::Panicked | Verdict::Hung | Verdict::Invalid) {
                say_aside(format_args!("{:?}: {}: {}", case.verdict, case.command, case.reason));
            }
        }
        if state.chunks == self.of || state.last_line.is_none_or(|last| last.elapsed() >= LINE_EVERY) {
            state.last_line = Some(Instant::now());
            let elapsed = state.started.elapsed().as_secs_f64();
            let left = elapsed * (self.of - state.chunks) as f64 / state.chunks as f64;
            let (done, certified) = (state.all.tried(), state.all.count(Verdict::Certified));
            say_aside(format_args!(
                "{} of {} chunks, about {left:.0} s left: {certified} of {done} cases certified",
                state.chunks, self.of
            ));
        }
    }
}
