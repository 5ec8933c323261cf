//! The file of rows: appended line by line so that a kill at any moment loses at most the running cell.
//!
//! A line is written at once, with its line feed, and forced to disk. A last line without line feed is what a kill
//! left, and is cut off. A later line with the key of an earlier one replaces it: so do repeats of a timed cell. When
//! all is done the file is rewritten in the plan's order, byte for byte the same lines, by an atomic rename.

use super::record::Row;
use crate::files::write_whole;
use std::collections::HashMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};

/// Why rows cannot be read or written.
#[derive(Debug, thiserror::Error)]
pub enum JournalError {
    /// The operating system refuses.
    #[error("{}: {cause}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
    /// A line other than a cut-off last one is no row.
    #[error("{}:{line}: not a row ({cause}); remove that line, or start anew with --fresh", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// What the parser says.
        cause: serde_json::Error,
    },
    /// Another process writes there.
    #[error("{}: another sweep ({holder}) is writing here; wait for it, or give this one a --shard", path.display())]
    Locked {
        /// The lock file.
        path: PathBuf,
        /// What the other process wrote into it.
        holder: String,
    },
}

fn io_error(path: &Path) -> impl FnOnce(io::Error) -> JournalError {
    let path = path.to_owned();
    |cause| JournalError::Io { path, cause }
}

/// A row with the very text it was read from or written as: rewriting must not change a digit.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// The row.
    pub row: Row,
    /// Its JSON, without line feed.
    pub text: String,
}

impl Line {
    /// The line of `row`.
    ///
    /// # Errors
    /// If the row could not be read back, as when a number is not finite: JSON has no such numbers.
    pub fn new(row: Row) -> Result<Self, serde_json::Error> {
        let text = serde_json::to_string(&row)?;
        serde_json::from_str::<Row>(&text)?;
        Ok(Self { row, text })
    }
}

/// An open file of rows, locked against other processes.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
    lines: Vec<Line>,
    index: HashMap<String, usize>,
    /// Bytes of an unfinished last line that were cut off on opening.
    pub cut_off: usize,
    // Holds the lock until the journal is dropped or the process dies, however it dies.
    _lock: Lock,
}

/// A locked file. Closing it is not enough to give the lock back: a process that another thread is just starting holds
/// a copy of the open file until it runs its own program.
#[derive(Debug)]
struct Lock(File);

impl Drop for Lock {
    fn drop(&mut self) {
        // Where it cannot be given back now, the system gives it back when the last copy is closed.
        let _ = self.0.unlock();
    }
}

impl Journal {
    /// Opens or makes the file of rows at `path`, with its folder; cuts off what a kill left unfinished.
    ///
    /// # Errors
    /// [`JournalError`], naming file and line.
    pub fn open(path: &Path) -> Result<Self, JournalError> {
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(io_error(folder))?;
        }
        let lock = lock(&path.with_extension("lock"))?;
        let mut file = OpenOptions::new()
            .create(true)
            .read(true)
            .append(true)
            .open(path)
            .map_err(io_error(path))?;
        let mut text = Vec::new();
        file.read_to_end(&mut text).map_err(io_error(path))?;
        let whole = whole_lines(&text);
        if whole < text.len() {
            file.set_len(whole as u64).map_err(io_error(path))?;
            file.seek(io::SeekFrom::End(0)).map_err(io_error(path))?;
        }
        let lines = parse(path, &text[..whole])?;
        let index = lines
            .iter()
            .enumerate()
            .map(|(at, line)| (line.row.key.clone(), at))
            .collect();
        Ok(Self {
            path: path.to_owned(),
            file,
            lines,
            index,
            cut_off: text.len() - whole,
            _lock: lock,
        })
    }

    /// The rows so far: the last one of each key, in the order in which the keys came.
    pub fn lines(&self) -> &[Line] {
        &self.lines
    }

    /// The row of `key`, if there is one.
    pub fn get(&self, key: &str) -> Option<&Row> {
        self.index.get(key).map(|&at| &self.lines[at].row)
    }

    /// Adds a row, or replaces the one of its key, and returns once it is on disk.
    ///
    /// # Errors
    /// [`JournalError::Io`].
    pub fn append(&mut self, line: Line) -> Result<(), JournalError> {
        let mut bytes = line.text.clone().into_bytes();
        bytes.push(b'\n');
        self.file
            .write_all(&bytes)
            .and_then(|()| self.file.sync_data())
            .map_err(io_error(&self.path))?;
        insert(&mut self.lines, &mut self.index, line);
        Ok(())
    }

    /// Moves the rows so far to `rows.before-STAMP.jsonl` beside the file and starts with none. Returns where they
    /// went, if there were any.
    ///
    /// # Errors
    /// [`JournalError::Io`].
    pub fn set_aside(&mut self, stamp: &str) -> Result<Option<PathBuf>, JournalError> {
        if self.lines.is_empty() {
            return Ok(None);
        }
        let safe: String = stamp
            .chars()
            .map(|c| if c.is_ascii_alphanumeric() { c } else { '-' })
            .collect();
        let backup = self.path.with_extension(format!("before-{safe}.jsonl"));
        std::fs::copy(&self.path, &backup).map_err(io_error(&backup))?;
        self.file.set_len(0).map_err(io_error(&self.path))?;
        self.lines.clear();
        self.index.clear();
        Ok(Some(backup))
    }

    /// Rewrites the file with the rows of `keys`, in that order; rows of other keys, such as cells the plan no longer
    /// has, are left out. The file is complete at every moment.
    ///
    /// # Errors
    /// [`JournalError::Io`].
    pub fn settle<'a>(&mut self, keys: impl IntoIterator<Item = &'a str>) -> Result<(), JournalError> {
        let ordered: Vec<Line> = keys
            .into_iter()
            .filter_map(|key| self.index.get(key))
            .map(|&at| self.lines[at].clone())
            .collect();
        let mut text = String::new();
        for line in &ordered {
            text.push_str(&line.text);
            text.push('\n');
        }
        write_whole(&self.path, text.as_bytes()).map_err(io_error(&self.path))?;
        self.file = OpenOptions::new()
            .append(true)
            .open(&self.path)
            .map_err(io_error(&self.path))?;
        self.index = ordered
            .iter()
            .enumerate()
            .map(|(at, line)| (line.row.key.clone(), at))
            .collect();
        self.lines = ordered;
        Ok(())
    }
}

/// The rows of a file that may be in use or cut off at its end: the last one of each key.
///
/// # Errors
/// [`JournalError`], naming file and line.
pub fn read_rows(path: &Path) -> Result<Vec<Row>, JournalError> {
    let text = std::fs::read(path).map_err(io_error(path))?;
    Ok(parse(path, &text[..whole_lines(&text)])?
        .into_iter()
        .map(|line| line.row)
        .collect())
}

/// Length of `text` up to its last line feed.
fn whole_lines(text: &[u8]) -> usize {
    text.iter().rposition(|&byte| byte == b'\n').map_or(0, |at| at + 1)
}

fn parse(path: &Path, text: &[u8]) -> Result<Vec<Line>, JournalError> {
    let mut lines = Vec::new();
    let mut index = HashMap::new();
    for (at, bytes) in text.split(|&byte| byte == b'\n').enumerate() {
        if bytes.iter().all(u8::is_ascii_whitespace) {
            continue;
        }
        let row = serde_json::from_slice(bytes).map_err(|cause| JournalError::Line {
            path: path.to_owned(),
            line: at + 1,
            cause,
        })?;
        let text = String::from_utf8_lossy(bytes).into_owned();
        insert(&mut lines, &mut index, Line { row, text });
    }
    Ok(lines)
}

fn insert(lines: &mut Vec<Line>, index: &mut HashMap<String, usize>, line: Line) {
    match index.get(&line.row.key) {
        Some(&at) => lines[at] = line,
        None => {
            index.insert(line.row.key.clone(), lines.len());
            lines.push(line);
        }
    }
}

/// Takes the lock at `path`. The system gives it back when the process ends, so no stale lock can be left.
fn lock(path: &Path) -> Result<Lock, JournalError> {
    let mut file = OpenOptions::new()
        .create(true)
        .truncate(false)
        .read(true)
        .write(true)
        .open(path)
        .map_err(io_error(path))?;
    match file.try_lock() {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => {
            let mut holder = String::new();
            // Only for the message: if it cannot be read, the lock is held all the same.
            let _ = file.read_to_string(&mut holder);
            return Err(JournalError::Locked {
                path: path.to_owned(),
                holder: holder.trim().to_owned(),
            });
        }
        // File systems without locks: a second sweep there cannot be told, and that is no reason to refuse the first.
        Err(TryLockError::Error(_)) => {}
    }
    file.set_len(0)
        .and_then(|()| write!(file, "process {}", std::process::id()))
        .map_err(io_error(path))?;
    Ok(Lock(file))
}

#[cfg(test)]
mod tests {
    use super::super::record::{Cell, Outcome};
    use super::*;

    fn row(key: &str, samples: &[f64]) -> Line {
        Line::new(Row {
            key: key.into(),
            group: "grid".into(),
            outcome: Outcome::Skipped,
            reason: Some("too large".into()),
            estimated_triangles: 0.1 + 0.2,
            cell: Cell {
                domain: "l-shape".into(),
                mesher: "biting".into(),
                params: serde_json::Map::new(),
                spacing: "lfs".into(),
                t: 1.0 / 3.0,
                c_b: 0.1,
                seed: 0,
                lfs_cap: true,
                timed: false,
            },
            samples: samples.to_vec(),
            same_as: None,
            report: None,
        })
        .expect("finite numbers")
    }

    fn keys(journal: &Journal) -> Vec<&str> {
        journal.lines().iter().map(|line| line.row.key.as_str()).collect()
    }

    #[test]
    fn rows_survive_a_kill_in_the_middle_of_a_line() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("deep/rows.jsonl");
        let mut journal = Journal::open(&path).expect("new");
        journal.append(row("a", &[])).expect("append");
        journal.append(row("b", &[])).expect("append");
        drop(journal);
        let whole = std::fs::read(&path).expect("read");
        for kept in 0..whole.len() {
            std::fs::write(&path, &whole[..kept]).expect("cut");
            let mut journal = Journal::open(&path).expect("a cut-off file opens");
            let expected = whole[..kept].iter().filter(|&&byte| byte == b'\n').count();
            assert_eq!(journal.lines().len(), expected, "{kept} bytes kept");
            journal.append(row("c", &[])).expect("append");
            assert_eq!(read_rows(&path).expect("whole again").len(), expected + 1);
        }
    }

    #[test]
    fn a_later_row_replaces_an_earlier_one_and_settling_orders_them() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("rows.jsonl");
        let mut journal = Journal::open(&path).expect("new");
        for line in [
            row("b", &[1.0]),
            row("gone", &[]),
            row("a", &[]),
            row("b", &[1.0, 0.1 + 0.2]),
        ] {
            journal.append(line).expect("append");
        }
        assert_eq!(keys(&journal), ["b", "gone", "a"]);
        journal.settle(["a", "b", "never run"]).expect("settle");
        journal.append(row("c", &[])).expect("append after settling");
        drop(journal);
        let journal = Journal::open(&path).expect("again");
        assert_eq!(keys(&journal), ["a", "b", "c"]);
        assert_eq!(journal.get("b").expect("there").samples, [1.0, 0.1 + 0.2]);
        assert_eq!(journal.lines()[1].text, row("b", &[1.0, 0.1 + 0.2]).text);
    }

    #[test]
    fn setting_aside_keeps_the_old_rows() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("rows.jsonl");
        let mut journal = Journal::open(&path).expect("new");
        assert_eq!(journal.set_aside("now").expect("nothing to keep"), None);
        journal.append(row("a", &[])).expect("append");
        let backup = journal
            .set_aside("2026-01-02T03:04:05Z")
            .expect("moved")
            .expect("there was a row");
        assert!(
            backup.ends_with("rows.before-2026-01-02T03-04-05Z.jsonl"),
            "{}",
            backup.display()
        );
        assert_eq!(read_rows(&backup).expect("readable").len(), 1);
        journal.append(row("b", &[])).expect("append");
        assert_eq!(read_rows(&path).expect("readable").len(), 1);
    }

    #[test]
    fn a_second_writer_is_told_and_a_broken_line_is_named() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("rows.jsonl");
        let journal = Journal::open(&path).expect("new");
        let message = Journal::open(&path).expect_err("locked").to_string();
        assert!(message.contains("another sweep (process "), "{message}");
        drop(journal);
        std::fs::write(&path, format!("{}\n{{\n", row("a", &[]).text)).expect("write");
        let message = Journal::open(&path).expect_err("broken").to_string();
        assert!(message.contains("rows.jsonl:2: not a row"), "{message}");
    }

    #[test]
    fn numbers_that_json_lacks_are_refused() {
        let mut bad = row("a", &[]).row;
        bad.samples = vec![f64::NAN];
        assert!(Line::new(bad).is_err());
    }
}
