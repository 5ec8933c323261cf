//! The mutated copy of the crate: made, compiled, mutants that do not compile taken out.

use crate::list::Mutant;
use crate::schema::{Owned, schema};
use anyhow::{Context, Result, bail, ensure};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The switch that every mutant asks: the mutant that is on, or a file that takes the numbers of those reached.
const SWITCH: &str = r#"#![allow(missing_docs)]
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{LazyLock, Mutex};
static ON: LazyLock<u32> = LazyLock::new(|| std::env::var("MUTANT").ok().and_then(|n| n.parse().ok()).unwrap_or(0));
static REACHED: LazyLock<Option<(Vec<AtomicBool>, Mutex<std::fs::File>)>> = LazyLock::new(|| {
    let path = std::env::var("MUTANTS_REACHED").ok()?;
    let file = std::fs::OpenOptions::new().append(true).create(true).open(path).ok()?;
    Some(((0..MUTANTS).map(|_| AtomicBool::new(false)).collect(), Mutex::new(file)))
});
#[inline]
pub fn is(mutant: u32) -> bool {
    let on = *ON;
    if on == RECORD {
        reach(mutant);
    }
    on == mutant
}
#[inline(never)]
fn reach(mutant: u32) {
    use std::io::Write;
    // Looked at before it is set: that is far cheaper, and nearly always enough.
    if let Some((seen, file)) = &*REACHED
        && !seen[mutant as usize].load(Ordering::Relaxed)
        && !seen[mutant as usize].swap(true, Ordering::Relaxed)
    {
        let mut file = file.lock().unwrap();
        file.write_all(format!("{mutant}\n").as_bytes()).unwrap();
    }
}
"#;

/// The number that stands for "none is on, record which are reached".
pub const RECORD: u32 = u32::MAX;

/// A program of tests.
pub struct Program {
    /// `lib` for the unit tests, else the name of the integration test.
    pub name: String,
    pub path: PathBuf,
}

/// The copy at `place` of the crate at `root`, with the mutants in it; numbers of those that are not.
pub struct Tree<'a> {
    root: &'a Path,
    pub place: PathBuf,
    mutants: &'a [Mutant],
    /// Mutants that no schema can hold, or that do not compile in one.
    pub left_out: BTreeSet<usize>,
    /// By file, the code of mutants and the expressions that hold them.
    owned: BTreeMap<String, [Vec<Owned>; 2]>,
}

#[derive(Deserialize)]
struct Message {
    reason: String,
    message: Option<Diagnostic>,
    executable: Option<PathBuf>,
    target: Option<Target>,
}

#[derive(Deserialize)]
struct Target {
    name: String,
    kind: Vec<String>,
}

#[derive(Deserialize)]
struct Diagnostic {
    level: String,
    message: String,
    spans: Vec<DiagnosticSpan>,
}

#[derive(Deserialize)]
struct DiagnosticSpan {
    file_name: String,
    byte_start: usize,
    byte_end: usize,
    is_primary: bool,
}

impl<'a> Tree<'a> {
    /// Copies what git tracks.
    pub fn new(root: &'a Path, place: PathBuf, mutants: &'a [Mutant]) -> Result<Self> {
        let tracked = Command::new("git")
            .args(["ls-files", "-z"])
            .current_dir(root)
            .output()?;
        for file in String::from_utf8(tracked.stdout)?.split_terminator('\0') {
            let (from, to) = (root.join(file), place.join(file));
            if !from.exists() || file.starts_with("fuzz/") || file.starts_with("mutants/") {
                continue;
            }
            std::fs::create_dir_all(to.parent().context("a file has a folder")?)?;
            put(&to, &std::fs::read(&from)?)?;
        }
        Ok(Self {
            root,
            place,
            mutants,
            left_out: BTreeSet::new(),
            owned: BTreeMap::new(),
        })
    }

    /// Writes the mutated files and compiles the tests, taking out mutants until they compile: of a few modules, those of
    /// the library alone.
    pub fn build(&mut self, modules: Option<&[String]>) -> Result<Vec<Program>> {
        let manifest = std::fs::read_to_string(self.root.join("Cargo.toml"))?;
        let manifest = format!("{manifest}\n[profile.dev.package.biting]\ndebug = false\n");
        put(&self.place.join("Cargo.toml"), manifest.as_bytes())?;
        let whole = std::fs::read_to_string(self.root.join("src/lib.rs"))?;
        let wanted = |line: &&str| match (line.strip_prefix("pub mod "), modules) {
            (Some(name), Some(modules)) => modules.iter().any(|module| name.trim_end_matches(';') == module),
            _ => true,
        };
        let declared: Vec<&str> = whole.lines().filter(wanted).collect();
        // Mutated code warns; nobody reads it.
        let text = format!(
            "#![allow(warnings)]\n{}\npub mod mutants_switch;\n",
            declared.join("\n")
        );
        put(&self.place.join("src/lib.rs"), text.as_bytes())?;
        let constants = format!(
            "const MUTANTS: usize = {};\nconst RECORD: u32 = {RECORD};\n",
            self.mutants.len() + 1
        );
        put(
            &self.place.join("src/mutants_switch.rs"),
            (SWITCH.to_owned() + &constants).as_bytes(),
        )?;
        for _ in 0..30 {
            self.write()?;
            let (messages, done) = self.cargo(&["check", "--lib"])?;
            if done {
                let all: &[&str] = &["test", "--no-run", "--lib", "--tests", "--bins"];
                let (messages, done) = self.cargo(if modules.is_some() { &all[..3] } else { all })?;
                ensure!(done, "the mutated tests do not compile");
                return Ok(programs(messages));
            }
            let before = self.left_out.len();
            self.take_out(&messages)?;
            eprintln!("{} mutants do not compile in a schema", self.left_out.len());
            if self.left_out.len() == before {
                bail!("the schema does not compile, and no mutant is at fault");
            }
        }
        bail!("the schema does not compile after 30 tries")
    }

    fn write(&mut self) -> Result<()> {
        let mut by_file: BTreeMap<&str, Vec<(usize, &Mutant)>> = BTreeMap::new();
        for (k, mutant) in self.mutants.iter().enumerate() {
            let of_file = by_file.entry(&mutant.file).or_default();
            if !self.left_out.contains(&(k + 1)) {
                of_file.push((k + 1, mutant));
            }
        }
        for (file, mutants) in by_file {
            let source = std::fs::read_to_string(self.root.join(file))?;
            let made = schema(&source, &mutants).with_context(|| file.to_owned())?;
            self.left_out.extend(made.left_out);
            put(&self.place.join(file), made.text.as_bytes())?;
            self.owned.insert(file.to_owned(), [made.owned, made.choices]);
        }
        Ok(())
    }

    fn cargo(&self, arguments: &[&str]) -> Result<(Vec<Message>, bool)> {
        let output = Command::new("cargo")
            .args(arguments)
            .args(["--locked", "--message-format=json", "--quiet"])
            .current_dir(&self.place)
            .env("CARGO_TARGET_DIR", self.place.with_file_name("build"))
            .stderr(Stdio::inherit())
            .output()?;
        let messages = String::from_utf8_lossy(&output.stdout)
            .lines()
            .filter_map(|line| serde_json::from_str(line).ok())
            .collect();
        Ok((messages, output.status.success()))
    }

    /// Leaves out the mutants whose code the compiler's errors point at.
    fn take_out(&mut self, messages: &[Message]) -> Result<()> {
        for diagnostic in messages.iter().filter_map(|message| message.message.as_ref()) {
            if diagnostic.level != "error" {
                continue;
            }
            let culprit = |only_primary: bool, kind: usize| {
                let spans = diagnostic.spans.iter().filter(|span| span.is_primary || !only_primary);
                spans.flat_map(|span| self.owner(span, kind)).next()
            };
            match culprit(true, 0)
                .or_else(|| culprit(false, 0))
                .or_else(|| culprit(false, 1))
            {
                Some(number) => {
                    self.left_out.insert(number);
                }
                None if diagnostic.spans.is_empty() => {}
                None => eprintln!(
                    "no mutant owns: {} in {}",
                    diagnostic.message, diagnostic.spans[0].file_name
                ),
            }
        }
        Ok(())
    }

    fn owner(&self, span: &DiagnosticSpan, kind: usize) -> Option<usize> {
        let owned = &self.owned.get(&span.file_name)?[kind];
        let holds = |range: &std::ops::Range<usize>| range.start <= span.byte_start && span.byte_end <= range.end;
        // Of an expression's mutants any: what is left shows whether it was that one.
        owned
            .iter()
            .find(|(range, number)| holds(range) && !self.left_out.contains(number))
            .map(|(_, number)| *number)
    }
}

/// Writes a file where it would change: cargo looks at times.
fn put(path: &Path, bytes: &[u8]) -> Result<()> {
    if std::fs::read(path).ok().as_deref() != Some(bytes) {
        std::fs::write(path, bytes)?;
    }
    Ok(())
}

/// The programs of tests that cargo made.
fn programs(messages: Vec<Message>) -> Vec<Program> {
    let made = messages
        .into_iter()
        .filter(|message| message.reason == "compiler-artifact");
    let mut programs: Vec<Program> = made
        .filter_map(|message| {
            let (path, target) = (message.executable?, message.target?);
            let name = match target.kind.first()?.as_str() {
                "lib" => "lib".to_owned(),
                "test" => target.name,
                _ => return None,
            };
            Some(Program { name, path })
        })
        .collect();
    programs.sort_by_key(|program| (program.name != "lib", program.name.clone()));
    programs
}
