//! Shards of a sweep: the files of their rows, and joining them.

use super::exit::Failure;
use super::output::say;
use crate::suite::rows::journal::{Journal, Record};
use crate::suite::run::work::Shard;
use std::path::{Path, PathBuf};

/// Says that a shard has run.
pub fn say_done(shard: Shard) {
    say(format_args!(
        "shard {} of {} is done; `sweep merge` joins the shards",
        shard.number, shard.of
    ));
}

/// The file of a shard's rows or chunks, where `whole` is the file of all.
pub fn file_name(whole: &str, shard: Option<Shard>) -> String {
    let stem = whole.trim_end_matches(".jsonl");
    match shard {
        Some(shard) => format!("{stem}.{}-of-{}.jsonl", shard.number, shard.of),
        None => whole.into(),
    }
}

/// Joins the rows, or chunks, of shards. Those of the file of all are kept where no shard has them.
pub fn join<R: Record>(folder: &Path, whole: &str, keys: &[String]) -> Result<Vec<R>, Failure> {
    if keys.is_empty() {
        return Ok(Vec::new());
    }
    let shards = shard_files(folder, whole)?;
    if shards.is_empty() {
        return Err(Failure::Input(format!(
            "{}: no rows of shards there; run `sweep --shard I/N`",
            folder.display()
        )));
    }
    let mut journal: Journal<R> = Journal::open(&folder.join(whole)).map_err(Failure::input)?;
    for file in &shards {
        // Opening takes the lock: a shard that is still running is not merged half.
        let shard = Journal::open(file).map_err(Failure::input)?;
        for line in shard.lines() {
            journal.append(line.clone()).map_err(Failure::input)?;
        }
        say(format_args!("{}: {} rows", file.display(), shard.lines().len()));
    }
    journal
        .settle(keys.iter().map(String::as_str))
        .map_err(Failure::input)?;
    let missing: Vec<&String> = keys.iter().filter(|key| journal.get(key).is_none()).collect();
    if let Some(first) = missing.first() {
        let many = missing.len();
        return Err(Failure::Input(format!(
            "{many} of them have no row yet, such as {first}; run the missing shards, or `sweep` to run what is left"
        )));
    }
    Ok(journal.lines().iter().map(|line| line.row.clone()).collect())
}

/// Removes the journal of all and those of the shards, whose rows are in tables now.
pub fn remove(folder: &Path, whole: &str) -> Result<(), Failure> {
    let files = shard_files(folder, whole)?.into_iter().chain([folder.join(whole)]);
    for file in files.filter(|file| file.exists()) {
        std::fs::remove_file(&file).map_err(|cause| Failure::Input(format!("{}: {cause}", file.display())))?;
    }
    Ok(())
}

/// The rows of shards in a folder, by name.
fn shard_files(folder: &Path, whole: &str) -> Result<Vec<PathBuf>, Failure> {
    let stem = format!("{}.", whole.trim_end_matches(".jsonl"));
    let listed = folder
        .read_dir()
        .map_err(|cause| Failure::Input(format!("{}: {cause}", folder.display())))?;
    let is_shard = |path: &PathBuf| {
        let name = path
            .file_name()
            .map(|name| name.to_string_lossy().into_owned())
            .unwrap_or_default();
        let middle = name.strip_prefix(&stem).and_then(|rest| rest.strip_suffix(".jsonl"));
        middle
            .and_then(|middle| middle.replace("-of-", "/").parse::<Shard>().ok())
            .is_some()
    };
    let mut files: Vec<PathBuf> = listed.flatten().map(|entry| entry.path()).filter(is_shard).collect();
    files.sort();
    Ok(files)
}
