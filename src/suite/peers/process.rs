//! Runs a program with limits on time and memory; at a limit all processes of its group are ended.

use rustix::process::{Pid, Signal, kill_process_group};
use std::ffi::OsString;
use std::fs::File;
use std::io;
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// What a run may take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// From its start.
    pub time: Duration,
    /// Resident memory of all its processes together.
    pub bytes: u64,
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// Exit status 0.
    Done,
    /// Exit status 4: it cannot take this input, and why.
    Declined(String),
    /// Any other status, or a signal, with the last it said.
    Failed(String),
    /// At a limit.
    Stopped(String),
}

/// The exit status of a peer that declines.
const DECLINED: i32 = 4;

/// The time between two looks at a running process: long enough not to disturb what is timed.
const PAUSE: Duration = Duration::from_millis(20);

/// The number of looks between two at memory, which reads the whole process table.
const LOOKS: u32 = 10;

/// At most this number of characters is kept of what a program says on failing.
const SAID: usize = 300;

const ERRORS: &str = "stderr.txt";

/// Runs `command` in `folder` with the request as its last argument.
///
/// # Errors
/// If it cannot be started or waited for.
pub fn run(command: &[OsString], folder: &Path, threads: usize, limits: Limits) -> io::Result<Ending> {
    let errors = folder.join(ERRORS);
    let Some((program, arguments)) = command.split_first() else {
        return Err(io::Error::other("no program"));
    };
    let mut start = tied(program);
    start
        .args(arguments)
        .arg(super::exchange::REQUEST)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(File::create(&errors)?)
        .process_group(0);
    for name in [
        "OMP_NUM_THREADS",
        "OPENBLAS_NUM_THREADS",
        "MKL_NUM_THREADS",
        "RAYON_NUM_THREADS",
    ] {
        start.env(name, threads.max(1).to_string());
    }
    let mut group = Group(start.spawn()?);
    let stopped = group.wait(limits)?;
    if let Some(limit) = stopped {
        return Ok(Ending::Stopped(limit));
    }
    let status = group.0.wait()?;
    let said = last_line(&String::from_utf8_lossy(&std::fs::read(&errors)?));
    Ok(ending(status, said))
}

/// Of util-linux: has a program killed when the process that started it dies, which nothing safe in Rust can ask for.
const SETPRIV: &str = "/usr/bin/setpriv";

/// A command that does not outlive this process, however that ends, where there is the tool for it.
fn tied(program: &OsString) -> Command {
    if !Path::new(SETPRIV).is_file() {
        return Command::new(program);
    }
    let mut command = Command::new(SETPRIV);
    command.args(["--pdeathsig", "KILL", "--"]).arg(program);
    command
}

fn ending(status: ExitStatus, said: String) -> Ending {
    match status.code() {
        Some(0) => Ending::Done,
        Some(DECLINED) => Ending::Declined(said),
        _ if said.is_empty() => Ending::Failed(status.to_string()),
        _ => Ending::Failed(format!("{status}: {said}")),
    }
}

/// The last line with something on it, cut where it is long.
fn last_line(text: &str) -> String {
    let line = text.lines().rev().map(str::trim).find(|line| !line.is_empty());
    line.unwrap_or_default().chars().take(SAID).collect()
}

/// A process that leads a group; nothing is left of the group when this is dropped.
struct Group(Child);

impl Group {
    /// Waits for the leader's end; at a limit says which.
    fn wait(&mut self, limits: Limits) -> io::Result<Option<String>> {
        let start = Instant::now();
        for look in 0u32.. {
            if self.0.try_wait()?.is_some() {
                return Ok(None);
            }
            if start.elapsed() > limits.time {
                return Ok(Some(format!("not done after {:.0} seconds", limits.time.as_secs_f64())));
            }
            if look % LOOKS == LOOKS - 1 {
                let bytes = group_bytes(self.0.id());
                if bytes > limits.bytes {
                    let (is, most) = (bytes as f64 / 1e9, limits.bytes as f64 / 1e9);
                    return Ok(Some(format!(
                        "took {is:.1} GB of memory, more than the {most:.1} GB it may use"
                    )));
                }
            }
            std::thread::sleep(PAUSE);
        }
        Ok(None)
    }
}

impl Drop for Group {
    fn drop(&mut self) {
        // Whatever the leader left behind goes with it; often nothing is there any more.
        if let Some(leader) = Pid::from_raw(self.0.id() as i32) {
            let _ = kill_process_group(leader, Signal::KILL);
        }
        let _ = self.0.wait();
    }
}

/// Resident memory of all processes of a group, if the system reports it (Linux).
fn group_bytes(leader: u32) -> u64 {
    let Ok(processes) = std::fs::read_dir("/proc") else {
        return 0;
    };
    let stats = processes
        .flatten()
        .filter_map(|entry| std::fs::read_to_string(entry.path().join("stat")).ok());
    stats.filter_map(|stat| resident_in(&stat, leader)).sum()
}

/// The resident bytes in a line of `/proc/PID/stat`, if the process belongs to the group.
fn resident_in(stat: &str, leader: u32) -> Option<u64> {
    // The name, in brackets, may hold anything: fields are counted from behind it.
    let fields: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    (fields.get(2)?.parse() == Ok(leader)).then_some(())?;
    let pages: u64 = fields.get(21)?.parse().ok()?;
    Some(pages * rustix::param::page_size() as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shell(script: &str, limits: Limits) -> (Ending, tempfile::TempDir) {
        let folder = tempfile::tempdir().expect("a folder");
        let command = ["sh", "-c", script].map(OsString::from);
        let ending = run(&command, folder.path(), 1, limits).expect("a shell");
        (ending, folder)
    }

    const AMPLE: Limits = Limits {
        time: Duration::from_secs(60),
        bytes: u64::MAX,
    };

    #[test]
    fn endings_are_told_apart() {
        assert_eq!(shell("exit 0", AMPLE).0, Ending::Done);
        let said = shell("echo first >&2; echo 'no size, no mesh' >&2; echo >&2; exit 4", AMPLE).0;
        assert_eq!(said, Ending::Declined("no size, no mesh".into()));
        let Ending::Failed(reason) = shell("echo boom >&2; exit 1", AMPLE).0 else {
            panic!("it failed");
        };
        assert!(reason.contains("1: boom"), "{reason}");
        let Ending::Failed(reason) = shell("kill -SEGV $$", AMPLE).0 else {
            panic!("it crashed");
        };
        assert!(reason.contains("signal"), "{reason}");
    }

    #[test]
    fn the_whole_group_ends_at_the_time_limit() {
        let limits = Limits {
            time: Duration::from_millis(300),
            ..AMPLE
        };
        let (ending, folder) = shell("sleep 100 & echo $! >child; wait", limits);
        assert!(
            matches!(&ending, Ending::Stopped(limit) if limit.contains("seconds")),
            "{ending:?}"
        );
        let child = std::fs::read_to_string(folder.path().join("child")).expect("the child's number");
        let is_there = || {
            let stat = std::fs::read_to_string(format!("/proc/{}/stat", child.trim()));
            // A zombie is one that init has yet to reap.
            stat.is_ok_and(|stat| !stat.contains(") Z "))
        };
        // A process that was killed needs a moment to go.
        let start = Instant::now();
        while is_there() {
            assert!(start.elapsed() < Duration::from_secs(10), "the child is still there");
            std::thread::sleep(PAUSE);
        }
    }

    #[test]
    fn memory_of_children_counts() {
        let limits = Limits {
            bytes: 60_000_000,
            ..AMPLE
        };
        let (ending, _folder) = shell(
            "(head -c 200000000 /dev/zero | tail -c 150000000 | sleep 50) & wait",
            limits,
        );
        assert!(
            matches!(&ending, Ending::Stopped(limit) if limit.contains("GB")),
            "{ending:?}"
        );
    }

    #[test]
    fn a_line_of_the_process_table_is_read_whatever_the_name() {
        let page = rustix::param::page_size() as u64;
        let stat = "12 (a) b 7 (c) S 1 77 77 0 -1 4194560 1 2 3 4 5 6 7 8 20 0 1 0 99 1000 25 184467";
        assert_eq!(resident_in(stat, 77), Some(25 * page));
        assert_eq!(resident_in(stat, 78), None);
        assert_eq!(resident_in("broken", 77), None);
    }
}
