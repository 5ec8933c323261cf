//! Cases in a process of their own: one that dies or hangs is a verdict, and costs no other case.
//!
//! A line of JSON for each case goes in, a line of JSON for each trial comes out.

use crate::suite::rows::tally::Verdict;
use crate::suite::run::tally::family::Trial;
use crate::suite::run::tally::trial::{self, Tried};
use std::io::{self, BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

/// A case hangs when it has taken so many times the seconds that its mesher may take, …
const HUNG_AFTER: f64 = 5.0;

/// … and so long for domain, spacing and certificate, which have no budget.
const PATIENCE: Duration = Duration::from_secs(30);

/// Runs the cases that come in, one a line, until there are no more.
///
/// # Errors
/// What the streams say, and lines that are no cases.
pub fn serve(input: impl BufRead, mut output: impl Write) -> io::Result<()> {
    for line in input.lines() {
        let case: Trial = serde_json::from_str(&line?)?;
        serde_json::to_writer(&mut output, &trial::run(&case))?;
        output.write_all(b"\n")?;
        output.flush()?;
    }
    Ok(())
}

/// Has cases run by a process, which is replaced when it dies or hangs.
#[derive(Debug)]
pub struct Worker {
    command: (PathBuf, Vec<String>),
    patience: Duration,
    process: Option<Process>,
}

#[derive(Debug)]
struct Process {
    child: Child,
    cases: ChildStdin,
    answers: Receiver<String>,
}

impl Drop for Process {
    fn drop(&mut self) {
        // It may have ended by itself; either way nothing is left of it.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Worker {
    /// A worker whose processes are `program` with `arguments`: something that calls [`serve`].
    pub fn new(program: PathBuf, arguments: &[&str]) -> Self {
        let arguments = arguments.iter().map(|&argument| argument.to_owned()).collect();
        Self {
            command: (program, arguments),
            patience: PATIENCE,
            process: None,
        }
    }

    /// Runs a case.
    ///
    /// # Errors
    /// If no process can be started.
    pub fn run(&mut self, case: &Trial) -> io::Result<Tried> {
        let most = Duration::from_secs_f64(HUNG_AFTER * case.budget.seconds) + self.patience;
        let mut process = match self.process.take() {
            Some(process) => process,
            None => self.start()?,
        };
        let mut line = serde_json::to_vec(case)?;
        line.push(b'\n');
        // Where the process is gone already, the answer tells.
        let _ = process.cases.write_all(&line);
        Ok(match process.answers.recv_timeout(most) {
            Ok(answer) => {
                let trial = serde_json::from_str(&answer)?;
                self.process = Some(process);
                trial
            }
            Err(RecvTimeoutError::Timeout) => {
                let reason = format!("not done after {} seconds", most.as_secs_f64());
                Tried::without_mesh(Verdict::Hung, reason)
            }
            Err(RecvTimeoutError::Disconnected) => {
                let reason = format!("its process ended: {}", process.child.wait()?);
                Tried::without_mesh(Verdict::Panicked, reason)
            }
        })
    }

    fn start(&self) -> io::Result<Process> {
        let mut child = Command::new(&self.command.0)
            .args(&self.command.1)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            // What a panic says comes with the answer.
            .stderr(Stdio::null())
            .spawn()?;
        let (Some(cases), Some(output)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(io::Error::other("a process without streams"));
        };
        let (sender, answers) = channel();
        std::thread::spawn(move || {
            for line in BufReader::new(output).lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    break;
                }
            }
        });
        Ok(Process { child, cases, answers })
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use crate::suite::rows::record::Cell;
    use crate::suite::run::plan::CellBudget;

    fn case() -> Trial {
        Trial {
            cell: Cell::new("random-pslg:kind=fan,seed=1", "biting", "lfs", 0.25, 0.75),
            budget: CellBudget {
                triangles: 1e4,
                seconds: 0.01,
            },
            integral: true,
        }
    }

    fn shell(script: &str) -> Worker {
        Worker {
            patience: Duration::from_millis(500),
            ..Worker::new("sh".into(), &["-c", script])
        }
    }

    #[test]
    fn a_case_that_is_served_is_certified_and_repeats() {
        let line = serde_json::to_string(&case()).expect("JSON") + "\n";
        let mut answers = Vec::new();
        serve(line.repeat(2).as_bytes(), &mut answers).expect("served");
        let trials: Vec<Tried> = String::from_utf8_lossy(&answers)
            .lines()
            .map(|line| serde_json::from_str(line).expect("a trial"))
            .collect();
        assert_eq!((trials.len(), trials[0].verdict), (2, Verdict::Certified), "{trials:?}");
        assert!(trials[0].triangles > 0 && trials[0].fingerprint == trials[1].fingerprint);
        assert!(serve(&b"no case\n"[..], &mut answers).is_err());
    }

    #[test]
    fn a_process_that_dies_is_a_panic_and_is_replaced() {
        let mut worker = shell("read case; kill -ABRT $$");
        for _ in 0..2 {
            let trial = worker.run(&case()).expect("a process");
            let reason = trial.reason.unwrap_or_default();
            assert_eq!(trial.verdict, Verdict::Panicked);
            assert!(reason.contains("signal: 6"), "{reason}");
        }
    }

    #[test]
    fn a_process_that_never_answers_hangs_and_is_replaced() {
        let mut worker = shell("read case; while :; do sleep 1; done");
        for _ in 0..2 {
            let trial = worker.run(&case()).expect("a process");
            assert_eq!(trial.verdict, Verdict::Hung, "{trial:?}");
        }
    }

    #[test]
    fn a_program_that_is_not_there_is_an_error() {
        assert!(Worker::new("no/such/program".into(), &[]).run(&case()).is_err());
    }
}
