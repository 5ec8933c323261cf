//! Which peers are installed, how each is started, and how they are installed: all in one cache folder, with no global
//! change.
//!
//! The folder is what the environment variable `BITING_PEERS` names, else `biting/peers` in the user's cache. `venv` there
//! is the one virtual environment of all peers in Python, `bin` has the programs of the others, `installed/NAME` says by
//! a digest what of `baselines/NAME` an installation was made from.

use super::PEERS;
use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Where the peers' folders stand in a checkout.
pub const BASELINES: &str = "baselines";

const ADAPTER: &str = "adapter.py";
const REQUIREMENTS: &str = "requirements.txt";
const SCRIPT: &str = "install";

/// Endings of the sources that folders share.
const SHARED: [&str; 2] = ["hpp", "rs"];

/// Files that may change without the installation growing old.
const NOT_INSTALLED: [&str; 2] = [ADAPTER, "README.md"];

/// The cache folder of the peers.
///
/// # Errors
/// If there is no place for it; the message has the remedy.
pub fn cache() -> Result<PathBuf, String> {
    let set = |name: &str| {
        std::env::var_os(name)
            .filter(|value| !value.is_empty())
            .map(PathBuf::from)
    };
    if let Some(folder) = set("BITING_PEERS") {
        // Peers run in folders of their own.
        return std::path::absolute(&folder).map_err(|cause| format!("{}: {cause}", folder.display()));
    }
    let caches = set("XDG_CACHE_HOME").or_else(|| Some(set("HOME")?.join(".cache")));
    caches
        .map(|folder| folder.join("biting").join("peers"))
        .ok_or_else(|| "no HOME to keep peers in; set BITING_PEERS to a folder for them".into())
}

/// How to start a peer, without its last argument, the request.
///
/// # Errors
/// If it is not installed; the message has the remedy.
pub fn command(name: &str) -> Result<Vec<OsString>, String> {
    command_in(&cache()?, Path::new(BASELINES), name)
}

fn command_in(cache: &Path, baselines: &Path, name: &str) -> Result<Vec<OsString>, String> {
    let folder = baselines.join(name);
    let remedy = || format!("not installed; `biting compare --install --only {name}` installs it");
    if !folder.is_dir() {
        return Err(format!("{} is not there; run in a checkout", folder.display()));
    }
    let stamp = fs::read_to_string(cache.join("installed").join(name)).map_err(|_| remedy())?;
    if stamp != digest(&folder).map_err(|cause| format!("{}: {cause}", folder.display()))? {
        return Err(format!(
            "installed from other pins; `biting compare --install --only {name}` renews it"
        ));
    }
    let adapter = folder.join(ADAPTER);
    let words = if adapter.is_file() {
        let adapter = std::path::absolute(&adapter).map_err(|cause| cause.to_string())?;
        vec![python(cache), adapter]
    } else {
        vec![cache.join("bin").join(name)]
    };
    if !words[0].is_file() {
        return Err(remedy());
    }
    Ok(words.into_iter().map(OsString::from).collect())
}

fn python(cache: &Path) -> PathBuf {
    cache.join("venv").join("bin").join("python")
}

/// Installs a peer into the cache folder.
///
/// # Errors
/// What went wrong, or what its script says must be there first.
pub fn install(name: &str) -> Result<(), String> {
    let (cache, folder) = (cache()?, Path::new(BASELINES).join(name));
    let io = |cause: io::Error| format!("{}: {cause}", cache.display());
    fs::create_dir_all(cache.join("installed")).map_err(io)?;
    fs::create_dir_all(cache.join("bin")).map_err(io)?;
    if folder.join(REQUIREMENTS).is_file() {
        if !python(&cache).is_file() {
            output(Command::new("python3").args(["-m", "venv"]).arg(cache.join("venv")))?;
        }
        let pip = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r"];
        output(Command::new(python(&cache)).args(pip).arg(folder.join(REQUIREMENTS)))?;
    }
    if folder.join(SCRIPT).is_file() {
        output(Command::new("bash").arg(folder.join(SCRIPT)).arg(&cache))?;
    }
    let stamp = digest(&folder).map_err(|cause| format!("{}: {cause}", folder.display()))?;
    fs::write(cache.join("installed").join(name), stamp).map_err(io)
}

/// Which peers are installed, each with why not.
pub fn survey() -> Vec<(&'static str, Result<(), String>)> {
    let state = |name: &'static str| (name, command(name).map(|_| ()));
    PEERS.iter().map(|entry| state(entry.name)).collect()
}

/// Runs a command to its end; the error is what it said, the last lines of it.
fn output(command: &mut Command) -> Result<(), String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|cause| format!("{name}: {cause}"))?;
    if output.status.success() {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    let lines: Vec<&str> = said.lines().filter(|line| !line.trim().is_empty()).collect();
    Err(lines[lines.len().saturating_sub(3)..].join("; "))
}

/// A digest of what an installation is made from: FNV-1a over names and bytes of the folder's files and, where there is
/// something to compile, the sources that folders share, in order of names.
fn digest(folder: &Path) -> io::Result<String> {
    let mut hash = 0xcbf2_9ce4_8422_2325u64;
    let mut files = files_of(folder)?;
    if let Some(shared) = folder.parent().filter(|_| folder.join(SCRIPT).is_file()) {
        for entry in fs::read_dir(shared)? {
            let path = entry?.path();
            if path
                .extension()
                .is_some_and(|ending| SHARED.iter().any(|kind| ending == *kind))
            {
                files.push(path);
            }
        }
    }
    files.sort();
    for file in files {
        let name = file
            .strip_prefix(folder)
            .unwrap_or(&file)
            .to_string_lossy()
            .into_owned();
        for byte in name.into_bytes().into_iter().chain(fs::read(&file)?) {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
    Ok(format!("{hash:016x}"))
}

/// The files of a folder and its folders, but for those that an installation does not depend on and what builds leave.
fn files_of(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() {
            if !["target", "__pycache__"].contains(&name.as_str()) {
                files.extend(files_of(&path)?);
            }
        } else if !NOT_INSTALLED.contains(&name.as_str()) {
            files.push(path);
        }
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cache and a checkout with one peer in Python and one program.
    fn folders() -> (tempfile::TempDir, PathBuf, PathBuf) {
        let folder = tempfile::tempdir().expect("a folder");
        let (cache, baselines) = (folder.path().join("cache"), folder.path().join("baselines"));
        for path in [cache.join("installed"), cache.join("bin"), cache.join("venv/bin")] {
            fs::create_dir_all(path).expect("a folder");
        }
        for (file, text) in [
            ("snake/adapter.py", "print()"),
            ("snake/requirements.txt", "snake==1"),
            ("stone/install", "exit 1"),
        ] {
            let path = baselines.join(file);
            fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
            fs::write(path, text).expect("a file");
        }
        (folder, cache, baselines)
    }

    fn stamp(cache: &Path, baselines: &Path, name: &str) {
        let digest = digest(&baselines.join(name)).expect("a digest");
        fs::write(cache.join("installed").join(name), digest).expect("a stamp");
    }

    #[test]
    fn what_is_not_installed_says_how_to_install_it() {
        let (_kept, cache, baselines) = folders();
        for name in ["snake", "stone"] {
            let told = command_in(&cache, &baselines, name).expect_err("not installed");
            assert!(told.contains("compare --install --only"), "{told}");
        }
        let told = command_in(&cache, &baselines, "wind").expect_err("no such folder");
        assert!(told.contains("run in a checkout"), "{told}");
    }

    #[test]
    fn an_installation_starts_until_its_pins_change() {
        let (_kept, cache, baselines) = folders();
        for (program, name) in [("venv/bin/python", "snake"), ("bin/stone", "stone")] {
            fs::write(cache.join(program), "").expect("a program");
            stamp(&cache, &baselines, name);
        }
        let words = command_in(&cache, &baselines, "snake").expect("installed");
        assert_eq!(words[0], cache.join("venv/bin/python").into_os_string());
        assert_eq!(words[1], baselines.join("snake/adapter.py").into_os_string());
        assert_eq!(command_in(&cache, &baselines, "stone").expect("installed").len(), 1);
        // An adapter is read at every run; requirements were read at the installation.
        fs::write(baselines.join("snake/adapter.py"), "print(2)").expect("a file");
        assert!(command_in(&cache, &baselines, "snake").is_ok());
        fs::write(baselines.join("snake/requirements.txt"), "snake==2").expect("a file");
        let told = command_in(&cache, &baselines, "snake").expect_err("old");
        assert!(told.contains("renews"), "{told}");
        // Sources that folders share are compiled in.
        fs::write(baselines.join("shared.hpp"), "int x;").expect("a file");
        assert!(command_in(&cache, &baselines, "stone").is_err());
    }
}
