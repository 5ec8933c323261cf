//! The journal of a run in progress: appended line by line so that a kill at any moment loses at most the running cell. It goes
//! when the run is finished and its tables are written ([`super::tables`]).
//!
//! A line is written at once, with its line feed, and forced to disk. A last line without line feed is what a kill
//! left, and is cut off. A later line with the key of an earlier one replaces it: so do repeats of a timed cell. When
//! all is done the file is rewritten in the plan's order, byte for byte the same lines, by an atomic rename.

use crate::suite::files::write_whole;
use crate::suite::rows::record::Row;
use serde::Serialize;
use serde::de::DeserializeOwned;
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

/// What a journal keeps, a line each.
pub trait Record: Clone + Serialize + DeserializeOwned {
    /// Identifies it: a later line with an equal key replaces an earlier one.
    fn key(&self) -> &str;
}

impl Record for Row {
    fn key(&self) -> &str {
        &self.key
    }
}

/// A row with the very text it was read from or written as: rewriting must not change a digit.
#[derive(Clone, Debug, PartialEq)]
pub struct Line<R = Row> {
    /// The row.
    pub row: R,
    /// Its JSON, without line feed.
    pub text: String,
}

impl<R: Record> Line<R> {
    /// The line of `row`.
    ///
    /// # Errors
    /// If the row could not be read back, as when a number is not finite: JSON has no such numbers.
    pub fn new(row: R) -> Result<Self, serde_json::Error> {
        let text = serde_json::to_string(&row)?;
        serde_json::from_str::<R>(&text)?;
        Ok(Self { row, text })
    }
}

/// An open file of rows, locked against other processes.
#[derive(Debug)]
pub struct Journal<R = Row> {
    path: PathBuf,
    file: File,
    lines: Vec<Line<R>>,
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

impl<R: Record> Journal<R> {
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
        let lines: Vec<Line<R>> = parse(path, &text[..whole])?;
        let index = lines
            .iter()
            .enumerate()
            .map(|(at, line)| (line.row.key().to_owned(), at))
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
    pub fn lines(&self) -> &[Line<R>] {
        &self.lines
    }

    /// The row of `key`, if there is one.
    pub fn get(&self, key: &str) -> Option<&R> {
        self.index.get(key).map(|&at| &self.lines[at].row)
    }

    /// Adds a row, or replaces the one of its key, and returns once it is on disk.
    ///
    /// # Errors
    /// [`JournalError::Io`].
    pub fn append(&mut self, line: Line<R>) -> Result<(), JournalError> {
        let mut bytes = line.text.clone().into_bytes();
        bytes.push(b'\n');
        self.file
            .write_all(&bytes)
            .and_then(|()| self.file.sync_data())
            .map_err(io_error(&self.path))?;
        insert(&mut self.lines, &mut self.index, line);
        Ok(())
    }

    /// Moves the rows so far to `journal.before-STAMP.jsonl` beside the file and starts with none. Returns where they
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

    /// Removes the file, whose rows are kept elsewhere now.
    ///
    /// # Errors
    /// [`JournalError::Io`].
    pub fn remove(self) -> Result<(), JournalError> {
        std::fs::remove_file(&self.path).map_err(io_error(&self.path))
    }

    /// Rewrites the file with the rows of `keys`, in that order; rows of other keys, such as cells the plan no longer
    /// has, are left out. The file is complete at every moment.
    ///
    /// # Errors
    /// [`JournalError::Io`].
    pub fn settle<'a>(&mut self, keys: impl IntoIterator<Item = &'a str>) -> Result<(), JournalError> {
        let ordered: Vec<Line<R>> = keys
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
            .map(|(at, line)| (line.row.key().to_owned(), at))
            .collect();
        self.lines = ordered;
        Ok(())
    }
}

/// The journal in an experiment's folder.
pub const JOURNAL: &str = "journal.jsonl";

/// The rows of a file that may be in use or cut off at its end: the last one of each key.
///
/// # Errors
/// [`JournalError`], naming file and line.
pub fn read_rows<R: Record>(path: &Path) -> Result<Vec<R>, JournalError> {
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

fn parse<R: Record>(path: &Path, text: &[u8]) -> Result<Vec<Line<R>>, JournalError> {
    let mut lines = Vec::new();
    let mut index = HashMap::new();
    for (at, bytes) in text.split(|&byte| byte == b'\n').enumerate() {
        if bytes.iter().all(u8::is_ascii_whitespace) {
            continue;
        }
        let row: R = serde_json::from_slice(bytes).map_err(|cause| JournalError::Line {
            path: path.to_owned(),
            line: at + 1,
            cause,
        })?;
        let text = String::from_utf8_lossy(bytes).into_owned();
        insert(&mut lines, &mut index, Line { row, text });
    }
    Ok(lines)
}

fn insert<R: Record>(lines: &mut Vec<Line<R>>, index: &mut HashMap<String, usize>, line: Line<R>) {
    match index.get(line.row.key()) {
        Some(&at) => lines[at] = line,
        None => {
            index.insert(line.row.key().to_owned(), lines.len());
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
mod tests;
