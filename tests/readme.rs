//! Every command of README.md is run as written, sweeps as dry runs.

use assert_cmd::Command;
use std::ffi::OsStr;
use std::path::Path;

/// The `cargo run` commands of the README's shell blocks, as arguments.
fn commands(readme: &str) -> Vec<Vec<String>> {
    let mut is_shell = false;
    let mut found = Vec::new();
    for line in readme.lines() {
        match line.trim() {
            "```sh" => is_shell = true,
            "```" => is_shell = false,
            command if is_shell => found.extend(command.strip_prefix("cargo run --release -- ").map(words)),
            _ => {}
        }
    }
    found
}

/// Splits at blanks outside double quotes.
fn words(command: &str) -> Vec<String> {
    let quoted = command
        .split('"')
        .enumerate()
        .flat_map(|(place, part)| match place % 2 {
            1 => vec![part.to_owned()],
            _ => part.split_whitespace().map(str::to_owned).collect(),
        });
    quoted.collect()
}

#[test]
fn commands_run_as_written() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme = std::fs::read_to_string(root.join("README.md")).expect("README.md");
    let folder = tempfile::tempdir().expect("a folder");
    let commands = commands(&readme);
    assert!(commands.len() >= 5, "{commands:?}");
    // Sweeps are planned and figures drawn from the rows of this checkout; the others follow one another in a folder.
    let (here, there): (Vec<_>, Vec<_>) = commands
        .into_iter()
        .partition(|arguments| ["sweep", "compare", "figures"].contains(&arguments[0].as_str()));
    let run = |arguments: &[String], place: &Path, more: &[&OsStr]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_biting"));
        command.current_dir(place).args(arguments).args(more);
        command.assert().success();
    };
    std::thread::scope(|scope| {
        scope.spawn(|| {
            for arguments in here {
                match arguments[0].as_str() {
                    // The pictures of this checkout are to stay.
                    "figures" => run(&arguments, root, &["--out".as_ref(), folder.path().as_ref()]),
                    _ => run(&arguments, root, &["--dry-run".as_ref()]),
                }
            }
        });
        there.iter().for_each(|arguments| run(arguments, folder.path(), &[]));
    });
}

#[test]
fn links_lead_somewhere() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for page in ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md"] {
        let text = std::fs::read_to_string(root.join(page)).expect("a page");
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            assert!(
                link.starts_with("http") || root.join(link).exists(),
                "{page} links to {link}"
            );
        }
    }
}
