//! The commands of README.md and docs/ run as written, sweeps as dry runs; links on all pages lead somewhere.

use assert_cmd::Command;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

/// The `cargo run` commands of a page's shell blocks and of the table under "Reproduce", as arguments.
fn commands(page: &str) -> Vec<Vec<String>> {
    let (mut is_shell, mut is_table) = (false, false);
    let mut found = Vec::new();
    for line in page.lines() {
        match line.trim() {
            "```sh" => is_shell = true,
            "```" => is_shell = false,
            command if is_shell => found.extend(command.strip_prefix("cargo run --release -- ").map(words)),
            title if title.starts_with("## ") => is_table = title == "## Reproduce",
            row if is_table && row.contains(" | `") => found.extend(row.split('`').nth(1).map(words)),
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

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The pages of a folder, and of the folders in it if `deep`, by path.
fn pages(folder: &Path, deep: bool) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        if deep && path.is_dir() {
            found.extend(pages(&path, deep));
        } else if path.extension().is_some_and(|ending| ending == "md") {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// Runs the commands of a page. Sweeps are planned, one statement is judged and figures are drawn in this checkout,
/// whose files stay as they are. The other commands run one after another in a folder that has the input files of
/// `examples/`.
fn run_all(page: &Path) -> usize {
    let text = fs::read_to_string(page).expect("a page");
    let folder = tempfile::tempdir().expect("a folder");
    copy_inputs(folder.path());
    let run = |arguments: &[String], place: &Path, more: &[&OsStr]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_biting"));
        command.current_dir(place).args(arguments).args(more);
        command.assert().success();
    };
    let commands = commands(&text);
    for arguments in &commands {
        match arguments[0].as_str() {
            "sweep" | "compare" => run(arguments, root(), &["--dry-run".as_ref(), "--quick".as_ref()]),
            "lemmas" => run(arguments, root(), &["--only".as_ref(), "equation-10".as_ref()]),
            "figures" => run(arguments, root(), &["--out".as_ref(), folder.path().as_ref()]),
            _ => run(arguments, folder.path(), &[]),
        }
    }
    commands.len()
}

fn copy_inputs(folder: &Path) {
    let Ok(examples) = fs::read_dir(root().join("examples")) else {
        return;
    };
    fs::create_dir(folder.join("examples")).expect("a folder");
    for path in examples.flatten().map(|entry| entry.path()) {
        if path.extension().is_some_and(|ending| ending == "geojson") {
            let name = path.file_name().expect("a file's name");
            fs::copy(&path, folder.join("examples").join(name)).expect("a copy");
        }
    }
}

#[test]
fn commands_run_as_written() {
    let readme = root().join("README.md");
    let docs = pages(&root().join("docs"), false);
    std::thread::scope(|scope| {
        scope.spawn(|| assert!(run_all(&readme) >= 3));
        let commands: usize = docs.iter().map(|page| run_all(page)).sum();
        assert!(commands >= 5);
    });
}

/// The lines of the first block of `text` between a fence that begins with `open` and its end.
fn block(text: &str, open: &str) -> Vec<String> {
    let lines = text.lines().skip_while(|line| *line != open).skip(1);
    lines.take_while(|line| *line != "```").map(str::to_owned).collect()
}

#[test]
fn the_readme_has_the_example_of_the_crate_page() {
    let read = |name: &str| fs::read_to_string(root().join(name)).expect("a file");
    let page = read("src/lib.rs");
    let docs = page.lines().map_while(|line| line.strip_prefix("//!"));
    let docs: Vec<&str> = docs.map(|line| line.strip_prefix(' ').unwrap_or(line)).collect();
    let mut tested = block(&docs.join("\n"), "```");
    tested.retain(|line| !line.starts_with("# "));
    assert!(tested.len() >= 8, "{tested:?}");
    assert_eq!(block(&read("README.md"), "```rust"), tested);
}

#[test]
fn the_readme_is_short() {
    let readme = fs::read_to_string(root().join("README.md")).expect("README.md");
    let lines = readme.lines().count();
    assert!(lines <= 120, "README.md has {lines} lines; docs/ has room");
}

/// Words of a page in backquotes that are paths: a folder of this repository, or something in one.
fn paths(page: &str) -> Vec<&str> {
    let words = page.split('`').skip(1).step_by(2);
    let is_path = |word: &&str| {
        let (folder, rest) = word.split_once('/').unwrap_or_default();
        !rest.contains(' ') && !folder.is_empty() && root().join(folder).is_dir()
    };
    words.filter(is_path).collect()
}

#[test]
fn the_readme_has_five_short_findings() {
    let readme = fs::read_to_string(root().join("README.md")).expect("README.md");
    let section = readme.split("\n## ").find(|part| part.starts_with("What came out"));
    let findings: Vec<&str> = section
        .expect("a section")
        .lines()
        .filter_map(|line| line.strip_prefix("* "))
        .collect();
    assert_eq!(findings.len(), 5, "{findings:?}");
    for finding in findings {
        let (sentence, link) = finding.split_once(" [").expect("a link to its page");
        assert!(link.ends_with("/README.md)"), "{finding}");
        let words = sentence.split_whitespace().count();
        assert!(words <= 25, "{words} words: {sentence}");
    }
}

/// Seconds from `date` to `until` of the runs that made some results, by their provenance.
fn seconds_of(run: &str) -> u32 {
    let times = |name: &str| -> Vec<u32> {
        let values = run
            .lines()
            .filter_map(|line| line.strip_prefix(name)?.strip_prefix(" = \""));
        let clock = |value: &str| {
            let part = |from: usize| value[from..from + 2].parse::<u32>().expect("two digits");
            86_400 * part(8) + 3600 * part(11) + 60 * part(14) + part(17)
        };
        values.map(clock).collect()
    };
    let (starts, ends) = (times("date"), times("until"));
    assert!(!starts.is_empty() && starts.len() == ends.len());
    ends.iter().sum::<u32>() - starts.iter().sum::<u32>()
}

#[test]
fn the_readme_has_the_minutes_of_the_runs() {
    let readme = fs::read_to_string(root().join("README.md")).expect("README.md");
    let mut checked = 0;
    for row in readme.lines().filter(|line| line.starts_with("| ")) {
        let cells: Vec<&str> = row.split(" | ").collect();
        let page = cells.last().and_then(|cell| cell.split("](results/").nth(1));
        let folder = page.and_then(|page| page.split('/').next()).unwrap_or_default();
        if let Ok(run) = fs::read_to_string(root().join("results").join(folder).join("run.toml"))
            && cells.len() == 4
        {
            assert_eq!(cells[2], seconds_of(&run).div_ceil(60).to_string(), "{row}");
            checked += 1;
        }
    }
    assert!(checked >= 8, "{checked}");
}

#[test]
fn the_architecture_names_what_is_there() {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).expect("a page");
    let tree = block(&page, "```");
    let folders = tree.iter().filter_map(|line| line.split(' ').next());
    let text: String = page.split("```").step_by(2).collect();
    let named: Vec<&str> = folders.chain(paths(&text)).collect();
    assert!(named.len() > 40, "{named:?}");
    for name in named {
        let path = root().join(name);
        assert!(
            path.exists() || path.with_extension("rs").exists(),
            "ARCHITECTURE.md names {name}"
        );
    }
}

#[test]
fn links_lead_somewhere() {
    let mut all = pages(root(), false);
    for folder in ["docs", "baselines", "paper", "results"] {
        all.extend(pages(&root().join(folder), true));
    }
    for page in all {
        let text = fs::read_to_string(&page).expect("a page");
        let folder = page.parent().expect("a folder");
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let target = link.split('#').next().unwrap_or_default();
            assert!(
                link.starts_with("http") || folder.join(target).exists(),
                "{} links to {link}",
                page.display()
            );
        }
    }
}
