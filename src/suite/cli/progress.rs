//! How far a sweep is: a bar with the time left on a terminal, plain lines elsewhere.

use super::output::say_aside;
use crate::suite::rows::record::{Outcome, Row};
use crate::suite::run::runner::Watch;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Elsewhere than on a terminal a line at most this often, besides those about failures.
const LINE_EVERY: Duration = Duration::from_secs(5);

/// Shows rows as they come.
pub struct Progress {
    bar: ProgressBar,
    state: Mutex<State>,
}

struct State {
    rows: usize,
    of: usize,
    weight: f64,
    total_weight: f64,
    started: Instant,
    last_line: Option<Instant>,
}

impl Progress {
    /// Progress over `cells` rows which are `total_weight` of work.
    pub fn new(cells: usize, total_weight: f64) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let target = if terminal {
            ProgressDrawTarget::stderr()
        } else {
            ProgressDrawTarget::hidden()
        };
        let bar = ProgressBar::with_draw_target(Some(total_weight as u64), target);
        if let Ok(style) = ProgressStyle::with_template("[{elapsed_precise}] {bar:40} {percent}%, {eta} left  {msg}") {
            bar.set_style(style);
        }
        if terminal {
            bar.enable_steady_tick(Duration::from_millis(500));
        }
        let state = State {
            rows: 0,
            of: cells,
            weight: 0.0,
            total_weight,
            started: Instant::now(),
            last_line: None,
        };
        Self {
            bar,
            state: Mutex::new(state),
        }
    }

    /// Ends the bar.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl State {
    fn line(&self, row: &Row) -> String {
        let share = (self.weight / self.total_weight.max(1.0)).min(1.0);
        let elapsed = self.started.elapsed().as_secs_f64();
        // Too early nothing can be said: the first cells are the smallest.
        let left = if share < 0.01 {
            String::new()
        } else {
            format!(", about {:.0} s left", elapsed * (1.0 - share) / share)
        };
        format!("{} of {} cells{left}: {} {}", self.rows, self.of, row.key, ending(row))
    }
}

/// How a row ended, in a few words.
fn ending(row: &Row) -> String {
    match (&row.outcome, &row.report, &row.reason) {
        (Outcome::Measured, Some(report), _) => {
            let broken = if report.certificate.holds {
                ""
            } else {
                ", CERTIFICATE BROKEN"
            };
            let (triangles, angle) = (report.statistics.triangles, report.statistics.min_angle_deg);
            format!("{triangles} triangles, {angle:.1}°{broken}")
        }
        (Outcome::Skipped, _, _) => "skipped".into(),
        (outcome, _, reason) => format!("{outcome:?}: {}", reason.as_deref().unwrap_or("no reason given")),
    }
}

impl Watch for Progress {
    fn row(&self, row: &Row, weight: f64) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        // A repeat of a timed cell writes its row again; the cell counts once.
        state.rows += usize::from(row.repeats() <= 1);
        state.weight += weight;
        self.bar.set_position(state.weight as u64);
        self.bar.set_message(row.key.clone());
        let matters = match row.outcome {
            Outcome::Measured => row.report.as_ref().is_some_and(|report| !report.certificate.holds),
            Outcome::Skipped => false,
            Outcome::Declined | Outcome::Failed => true,
        };
        if !self.bar.is_hidden() {
            if matters {
                self.bar.println(format!("{} {}", row.key, ending(row)));
            }
        } else if matters || state.last_line.is_none_or(|last| last.elapsed() >= LINE_EVERY) {
            state.last_line = Some(Instant::now());
            say_aside(state.line(row));
        }
    }
}
