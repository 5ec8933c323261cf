//! The tests: which reach which mutants, and which mutants they kill.

use crate::list::Mutant;
use crate::tree::{Program, RECORD};
use anyhow::{Context, Result};
use std::collections::{BTreeSet, HashMap};
use std::io::{BufRead, BufReader};
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Signals that end what works too long.
const SIGXCPU: i32 = 24;
const SIGKILL: i32 = 9;

/// A test, with what it took and what it reached while no mutant was on.
pub struct Test {
    /// Index of its program.
    pub program: usize,
    pub name: String,
    pub seconds: f64,
    pub reached: BTreeSet<usize>,
}

/// How a mutant ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// A test failed, or several, or their process died.
    Killed(String),
    /// Tests ran far beyond their time.
    TimedOut,
    /// Every test that reaches it passed; their number.
    Survived(usize),
    /// No test reaches it.
    Unreached,
}

pub struct Runner<'a> {
    pub place: &'a Path,
    pub programs: &'a [Program],
    pub jobs: usize,
    /// Seconds of work a test may take while no mutant is on; those that take more are left out.
    pub under: Option<f64>,
}

impl Runner<'_> {
    /// Runs each test that is `wanted`, by its program and name, by itself.
    pub fn record(&self, wanted: impl Fn(&str) -> bool) -> Result<Vec<Test>> {
        let mut names = Vec::new();
        for (index, program) in self.programs.iter().enumerate() {
            let output = self.command(program).args(["--list", "--format=terse"]).output()?;
            let listed = String::from_utf8(output.stdout)?;
            let of_program = listed.lines().filter_map(|line| line.strip_suffix(": test"));
            names.extend(of_program.map(|name| (index, name.to_owned())));
        }
        names.retain(|(index, name)| wanted(&format!("{}::{name}", self.programs[*index].name)));
        let folder = self.place.with_file_name("reached");
        std::fs::create_dir_all(&folder)?;
        let tests = self.parallel(&names, |k, (index, name)| -> Result<Option<Test>> {
            let path = folder.join(k.to_string());
            let _ = std::fs::remove_file(&path);
            let start = Instant::now();
            let output = limited(&self.programs[*index].path, self.under.unwrap_or(1e6))
                .args(["--exact", name])
                .current_dir(self.place)
                .envs(self.environment())
                .env("MUTANT", RECORD.to_string())
                .env("MUTANTS_REACHED", &path)
                .stdin(Stdio::null())
                .output()?;
            if !output.status.success() {
                let is_slow = matches!(output.status.signal(), Some(SIGXCPU | SIGKILL));
                let why = if is_slow {
                    "it takes too long"
                } else {
                    "it fails without a mutant"
                };
                eprintln!("left out, since {why}: {name}");
                return Ok(None);
            }
            let seconds = start.elapsed().as_secs_f64();
            let numbers = std::fs::read_to_string(&path).unwrap_or_default();
            let reached = numbers.lines().filter_map(|line| line.parse().ok()).collect();
            Ok(Some(Test {
                program: *index,
                name: name.clone(),
                seconds,
                reached,
            }))
        });
        tests.into_iter().filter_map(Result::transpose).collect()
    }

    /// Runs against the mutant `number` those `tests` that reach it: those beside it first, then the quick before the slow.
    pub fn judge(&self, number: usize, mutant: &Mutant, tests: &[Test]) -> Result<Outcome> {
        let mut reaching: Vec<&Test> = tests.iter().filter(|test| test.reached.contains(&number)).collect();
        if reaching.is_empty() {
            return Ok(Outcome::Unreached);
        }
        let module = module_of(&mutant.file);
        let folder = module.split("::").next().unwrap_or_default().to_owned() + "::";
        let far = |test: &Test| match test.program {
            0 if test.name.starts_with(&module) => 0,
            0 if test.name.starts_with(&folder) => 1,
            0 => 2,
            _ => 3,
        };
        reaching.sort_by(|a, b| {
            (a.program, far(a))
                .cmp(&(b.program, far(b)))
                .then(a.seconds.total_cmp(&b.seconds))
        });
        let mut rest = &reaching[..];
        let mut most = 0.3;
        while let Some(first) = rest.first() {
            let mut sum = 0.0;
            let together = rest
                .iter()
                .take_while(|test| {
                    sum += test.seconds;
                    test.program == first.program && sum <= most
                })
                .count()
                .max(1);
            let (now, later) = rest.split_at(together);
            if let Some(outcome) = self.run(number, now)? {
                return Ok(outcome);
            }
            rest = later;
            most *= 3.0;
        }
        Ok(Outcome::Survived(reaching.len()))
    }

    /// Runs tests of one program together; nothing if all pass.
    fn run(&self, number: usize, tests: &[&Test]) -> Result<Option<Outcome>> {
        let seconds: f64 = tests.iter().map(|test| test.seconds).sum();
        // Seconds of work, whatever else the machine does; a deadlock works for none of them.
        let most = 5.0 + 4.0 * seconds;
        let limit = Duration::from_secs_f64(20.0 * most);
        let mut child = limited(&self.programs[tests[0].program].path, most)
            // Several at once, so that one that hangs does not keep another from failing.
            .args(["--exact", "--test-threads=6"])
            .args(tests.iter().map(|test| &test.name))
            .current_dir(self.place)
            .envs(self.environment())
            .env("MUTANT", number.to_string())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()?;
        let output = child.stdout.take().context("a piped output")?;
        let (sender, receiver) = std::sync::mpsc::channel();
        let reader = std::thread::spawn(move || {
            for line in BufReader::new(output).lines().map_while(Result::ok) {
                if let Some(name) = line
                    .strip_suffix(" ... FAILED")
                    .and_then(|line| line.strip_prefix("test "))
                {
                    let _ = sender.send(name.to_owned());
                    return;
                }
            }
        });
        let outcome = match receiver.recv_timeout(limit) {
            Ok(name) => Some(Outcome::Killed(name)),
            Err(std::sync::mpsc::RecvTimeoutError::Timeout) => Some(Outcome::TimedOut),
            Err(std::sync::mpsc::RecvTimeoutError::Disconnected) => None,
        };
        if outcome.is_some() {
            let _ = child.kill();
        }
        let status = child.wait()?;
        let _ = reader.join();
        Ok(match outcome {
            None if matches!(status.signal(), Some(SIGXCPU | SIGKILL)) => Some(Outcome::TimedOut),
            None if !status.success() => Some(Outcome::Killed(format!("process of {}", tests[0].name))),
            outcome => outcome,
        })
    }

    fn command(&self, program: &Program) -> Command {
        let mut command = Command::new(&program.path);
        command
            .current_dir(self.place)
            .envs(self.environment())
            .stdin(Stdio::null());
        command
    }

    /// One thread a test, the same random cases every time, none of them shrunk or kept.
    fn environment(&self) -> [(&str, &std::ffi::OsStr); 5] {
        [
            ("CARGO_MANIFEST_DIR", self.place.as_os_str()),
            ("RAYON_NUM_THREADS", "1".as_ref()),
            ("PROPTEST_RNG_SEED", "1".as_ref()),
            ("PROPTEST_MAX_SHRINK_ITERS", "0".as_ref()),
            ("PROPTEST_DISABLE_FAILURE_PERSISTENCE", "true".as_ref()),
        ]
    }

    /// `work` on every item, with its index, by `jobs` threads; results in order.
    pub fn parallel<T: Sync, R: Send>(&self, items: &[T], work: impl Fn(usize, &T) -> R + Sync) -> Vec<R> {
        let next = AtomicUsize::new(0);
        let results = Mutex::new(HashMap::new());
        std::thread::scope(|scope| {
            for _ in 0..self.jobs {
                scope.spawn(|| {
                    while let Some((k, item)) = {
                        let k = next.fetch_add(1, Ordering::Relaxed);
                        items.get(k).map(|item| (k, item))
                    } {
                        let result = work(k, item);
                        if let Ok(mut results) = results.lock() {
                            results.insert(k, result);
                        }
                    }
                });
            }
        });
        let mut results = results.into_inner().unwrap_or_default();
        (0..items.len()).filter_map(|k| results.remove(&k)).collect()
    }
}

/// A command that ends after so many seconds of work, rounded up. What grows without end dies of the memory limit: killed,
/// as a test that fails is.
fn limited(program: &Path, seconds: f64) -> Command {
    let mut command = Command::new("sh");
    command
        .args([
            "-c",
            &format!("ulimit -v 6000000; ulimit -t {:.0}; exec \"$@\"", seconds.ceil()),
            "sh",
        ])
        .arg(program);
    command
}

/// `geometry::near` for `src/geometry/near.rs`.
fn module_of(file: &str) -> String {
    let path = file.trim_start_matches("src/").trim_end_matches(".rs");
    path.trim_end_matches("/mod").replace('/', "::") + "::"
}
