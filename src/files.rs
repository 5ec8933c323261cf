//! Files appear complete or not at all.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Writes `bytes` to `path` by way of a temporary file beside it, which then takes the name: a reader, or a kill at
/// any moment, meets the old file or the new one, never half of one. Makes missing folders.
///
/// # Errors
/// Whatever the file system says.
pub fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    write_together(&[(path, bytes)]).map_err(|(_, error)| error)
}

/// As [`write_whole`], for files that belong together: none takes its name before all are written.
///
/// # Errors
/// Whatever the file system says, and which file it says it of.
pub fn write_together<'a>(files: &[(&'a Path, &[u8])]) -> Result<(), (&'a Path, io::Error)> {
    let mut parts = Vec::new();
    let mut put = || {
        for &(path, bytes) in files {
            let part = part_name(path).map_err(|error| (path, error))?;
            parts.push(part.clone());
            fs::write(&part, bytes).map_err(|error| (path, error))?;
        }
        for ((path, _), part) in files.iter().zip(&parts) {
            fs::rename(part, path).map_err(|error| (*path, error))?;
        }
        Ok(())
    };
    put().inspect_err(|_| {
        for part in &parts {
            // The error told is the one that matters; a left-over part is only untidy.
            let _ = fs::remove_file(part);
        }
    })
}

/// The temporary name beside `path`, whose folder is made if it is missing.
fn part_name(path: &Path) -> io::Result<PathBuf> {
    let mut name = path.file_name().ok_or(io::ErrorKind::InvalidInput)?.to_os_string();
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    name.push(format!(".{}.part", std::process::id()));
    Ok(path.with_file_name(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replaces_and_leaves_nothing_beside() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep").join("page.md");
        write_whole(&path, b"first").unwrap();
        write_whole(&path, b"second").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
    }

    #[test]
    fn of_files_that_belong_together_none_changes_if_one_cannot() {
        let folder = tempfile::tempdir().unwrap();
        let (good, bad) = (folder.path().join("good"), folder.path().join("bad"));
        write_whole(&good, b"old").unwrap();
        write_whole(&bad, b"no folder").unwrap();
        let below = bad.join("below");
        let (path, _) = write_together(&[(&good, b"new"), (&below, b"new")]).unwrap_err();
        assert_eq!(path, below);
        assert_eq!(fs::read(&good).unwrap(), b"old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }

    #[test]
    fn a_folder_is_no_file_name() {
        assert!(write_whole(Path::new("/"), b"x").is_err());
    }
}
