//! Files appear complete or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::Path;
use tempfile::NamedTempFile;

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
pub fn write_together<P: AsRef<Path>, B: AsRef<[u8]>>(files: &[(P, B)]) -> Result<(), (&Path, io::Error)> {
    let mut written = Vec::new();
    for (path, bytes) in files {
        let path = path.as_ref();
        written.push((path, beside(path, bytes.as_ref()).map_err(|error| (path, error))?));
    }
    for (path, file) in written {
        file.persist(path).map_err(|refused| (path, refused.error))?;
    }
    Ok(())
}

/// A temporary file of these bytes in the folder of `path`, which is made if it is missing.
fn beside(path: &Path, bytes: &[u8]) -> io::Result<NamedTempFile> {
    path.file_name().ok_or(io::ErrorKind::InvalidInput)?;
    let folder = match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    fs::create_dir_all(folder)?;
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // Those of any new file, from which the umask takes what it takes: a temporary file is otherwise its owner's alone.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.prefix(".").suffix(".part").tempfile_in(folder)?;
    file.write_all(bytes)?;
    Ok(file)
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
        let together = [(&good, b"new"), (&below, b"new")];
        let (path, _) = write_together(&together).unwrap_err();
        assert_eq!(path, below);
        assert_eq!(fs::read(&good).unwrap(), b"old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }

    #[test]
    fn a_folder_is_no_file_name() {
        assert!(write_whole(Path::new("/"), b"x").is_err());
    }

    #[cfg(unix)]
    #[test]
    fn who_may_read_it_is_as_for_any_new_file() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let (one, other) = (folder.path().join("one"), folder.path().join("other"));
        write_whole(&one, b"x").unwrap();
        fs::write(&other, b"x").unwrap();
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&one), mode(&other));
    }
}
