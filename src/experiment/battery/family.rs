//! Which domains a family has, and what each of its cases asks for.

use crate::experiment::plan::{Battery, CellBudget, Method};
use crate::experiment::record::Cell;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use std::fmt::Write;
use std::path::Path;

/// Cases that are written as one line.
const CASES_PER_CHUNK: usize = 500;

/// A case: a domain, a method, and what is asked of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Case {
    /// What is asked for.
    pub cell: Cell,
    /// Its limits.
    pub budget: Limits,
}

/// Limits of a case.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Limits {
    /// A mesh expected to have more triangles is not begun.
    pub triangles: f64,
    /// A mesher is stopped after this many seconds.
    pub seconds: f64,
}

impl Case {
    /// The command that runs it again.
    pub fn command(&self) -> String {
        let Cell {
            domain,
            mesher,
            params,
            spacing,
            t,
            c_b,
            ..
        } = &self.cell;
        let mut command = format!("biting mesh {} --mesher {mesher}", quoted(domain));
        for (name, value) in params {
            // Writing into a string cannot fail.
            let _ = write!(command, " --param {name}={}", plain(value));
        }
        let seconds = self.budget.seconds;
        let _ = write!(
            command,
            " --spacing {} --t {t} --c-b {c_b} --max-seconds {seconds}",
            quoted(spacing)
        );
        command
    }

    /// Mesher and parameters.
    pub fn method(&self) -> String {
        let parameters = self.cell.params.iter();
        parameters.fold(self.cell.mesher.clone(), |text, (name, value)| {
            format!("{text} {name}={}", plain(value))
        })
    }
}

/// A parameter's value as the command line takes it.
fn plain(value: &serde_json::Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

/// Quoted where a shell would take it for more than a word.
fn quoted(text: &str) -> String {
    let is_word = |c: char| c.is_ascii_alphanumeric() || "-_.,:=/".contains(c);
    if text.chars().all(is_word) {
        text.to_owned()
    } else {
        format!("'{}'", text.replace('\'', "'\\''"))
    }
}

/// A family of a plan's battery.
#[derive(Clone, Debug)]
pub struct Family {
    /// Its name.
    pub name: String,
    /// How to get its files, where they are not there.
    pub missing: Option<String>,
    domains: Domains,
    battery: Battery,
    limits: Limits,
}

#[derive(Clone, Debug)]
enum Domains {
    /// Gallery names, but for the seed.
    Drawn(String, usize),
    /// Files.
    Files(Vec<String>),
}

impl Family {
    /// The families of a plan's batteries. A folder that is missing, or has no domain in it, makes a family of no cases.
    pub fn all(batteries: &[Battery], budget: CellBudget) -> Vec<Self> {
        let of = |battery: &Battery| {
            let one = |name: &String| Self::new(name, battery, battery.budget.unwrap_or(budget));
            battery.families.iter().map(one).collect::<Vec<_>>()
        };
        batteries.iter().flat_map(of).collect()
    }

    fn new(name: &str, battery: &Battery, budget: CellBudget) -> Self {
        let domains = match (&battery.domain, &battery.folder) {
            (Some(pattern), _) => Domains::Drawn(pattern.replace("{family}", name), battery.domains.unwrap_or(0)),
            (None, folder) => {
                let folder = folder.as_deref().unwrap_or_default().replace("{family}", name);
                let mut files = files(Path::new(&folder));
                files.truncate(battery.domains.unwrap_or(usize::MAX));
                Domains::Files(files)
            }
        };
        let missing = matches!(&domains, Domains::Files(files) if files.is_empty()).then(|| {
            let fetch = battery.fetch.as_deref().unwrap_or("fetch them");
            format!("its domains are not there; get them by `{fetch}`")
        });
        Self {
            name: name.to_owned(),
            missing,
            domains,
            battery: battery.clone(),
            limits: Limits {
                triangles: budget.triangles,
                seconds: budget.seconds,
            },
        }
    }

    /// How many domains it has.
    pub fn domains(&self) -> usize {
        match &self.domains {
            Domains::Drawn(_, count) => *count,
            Domains::Files(files) => files.len(),
        }
    }

    /// How many cases it has: each domain by every method.
    pub fn cases(&self) -> usize {
        self.domains() * self.battery.methods.len()
    }

    /// The methods, as [`Case::method`] writes them.
    pub fn methods(&self) -> Vec<String> {
        (0..self.battery.methods.len().min(self.cases()))
            .map(|number| self.case(number).method())
            .collect()
    }

    /// The case of that number. Spacing, t and c_b are drawn, each from its list, by family and number.
    pub fn case(&self, number: usize) -> Case {
        let Battery {
            methods,
            spacings,
            t,
            c_b,
            ..
        } = &self.battery;
        let Method { mesher, params } = &methods[number % methods.len()];
        let seed = number / methods.len();
        let mut random = Pcg64::seed_from_u64(fingerprint(&self.name) ^ number as u64);
        Case {
            cell: Cell {
                domain: match &self.domains {
                    Domains::Drawn(pattern, _) => pattern.replace("{seed}", &seed.to_string()),
                    Domains::Files(files) => files[seed].clone(),
                },
                mesher: mesher.clone(),
                params: params.clone(),
                spacing: spacings[random.random_range(0..spacings.len())].clone(),
                t: t[random.random_range(0..t.len())].get(),
                c_b: c_b[random.random_range(0..c_b.len())].get(),
                seed: 0,
                lfs_cap: true,
                triangles: None,
                timed: false,
            },
            budget: self.limits,
        }
    }

    /// Its chunks, one at least: of no cases where its files are missing.
    pub fn chunks(&self) -> Vec<Part> {
        let asked = fingerprint(&format!("{:?}{:?}{:?}", self.domains, self.battery, self.limits));
        let part = |first: usize| {
            let end = self.cases().min(first + CASES_PER_CHUNK);
            Part {
                key: format!("{}/{first}-{end}/{:08x}", self.name, asked as u32),
                first,
                end,
            }
        };
        let firsts = (0..self.cases().max(1)).step_by(CASES_PER_CHUNK);
        firsts.map(part).collect()
    }
}

/// A run of cases of a family that is written as one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Family, numbers, and a hash of what is asked, so that a changed plan is run anew.
    pub key: String,
    /// The first case.
    pub first: usize,
    /// One past the last case.
    pub end: usize,
}

/// The domain files of a folder, by name; none where it cannot be read.
fn files(folder: &Path) -> Vec<String> {
    let Ok(listed) = folder.read_dir() else {
        return Vec::new();
    };
    let paths = listed.flatten().map(|entry| entry.path());
    let is_domain = |path: &std::path::PathBuf| {
        let ending = path.extension().and_then(|ending| ending.to_str());
        matches!(ending, Some("poly" | "geojson"))
    };
    let mut files: Vec<String> = paths.filter(is_domain).map(|path| path.display().to_string()).collect();
    files.sort();
    files
}

/// FNV-1a of 64 bits.
fn fingerprint(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}
