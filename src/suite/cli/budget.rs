//! Budgets of seconds and memory in stages that do not look at them themselves.
//!
//! The work runs on a thread of its own while the caller looks at clock and memory. What is given up ends with the process:
//! nothing is written by then.

use super::exit::Failure;
use crate::meshers::{Budget, resident_bytes};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

/// How often clock and memory are looked at.
const INTERVAL: Duration = Duration::from_millis(20);

/// Stack of the thread: what the main one has.
const STACK_BYTES: usize = 8 << 20;

/// Runs `work` within `budget`, which it may exceed for as long as `patience`: a mesher stops by itself, and knows better
/// where. `told` says what was going on and what to do.
///
/// # Errors
/// [`Failure::Declined`] with the budget and `told`.
pub fn within<T: Send + 'static>(
    budget: &Budget,
    patience: Duration,
    told: impl FnOnce() -> String,
    work: impl FnOnce() -> T + Send + 'static,
) -> Result<T, Failure> {
    if budget.max_seconds.is_none() && budget.max_memory.is_none() {
        return Ok(work());
    }
    let (sender, receiver) = mpsc::channel();
    let start = Instant::now();
    let worker = thread::Builder::new().stack_size(STACK_BYTES).spawn(move || {
        // Nobody listens any more where the caller has given up.
        let _ = sender.send(work());
    });
    let worker = worker.map_err(|error| Failure::Input(format!("no thread can be started: {error}; try again")))?;
    let mut exceeded: Option<Instant> = None;
    loop {
        match receiver.recv_timeout(INTERVAL) {
            Ok(done) => return Ok(done),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => match worker.join() {
                Err(panic) => std::panic::resume_unwind(panic),
                Ok(()) => return Err(Failure::Broken("the work ended without a result".into())),
            },
        }
        let Some(used_up) = used_up(budget, start) else {
            exceeded = None;
            continue;
        };
        if exceeded.get_or_insert_with(Instant::now).elapsed() >= patience {
            return Err(Failure::Declined(format!("stopped by {used_up} while {}", told())));
        }
    }
}

/// The budget that is used up, if one is.
fn used_up(budget: &Budget, start: Instant) -> Option<String> {
    match *budget {
        Budget {
            max_seconds: Some(most),
            ..
        } if start.elapsed().as_secs_f64() > most => Some(format!("max_seconds = {most}")),
        Budget {
            max_memory: Some(most), ..
        } if resident_bytes().is_some_and(|bytes| bytes > most) => Some(format!("max_memory = {most} bytes")),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_that_never_looks_is_given_up() {
        let budget = Budget {
            max_seconds: Some(0.05),
            ..Budget::default()
        };
        let sleep = |millis| move || thread::sleep(Duration::from_millis(millis));
        let stopped = within(&budget, Duration::ZERO, || "sleeping".into(), sleep(5000));
        assert!(
            matches!(&stopped, Err(Failure::Declined(text)) if text == "stopped by max_seconds = 0.05 while sleeping"),
            "{stopped:?}"
        );
        assert!(within(&budget, Duration::from_secs(5), || "sleeping".into(), sleep(200)).is_ok());
    }
}
