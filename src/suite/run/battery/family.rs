//! Which domains a family has, and what each of its cases asks for.

use crate::suite::rows::record::{Cell, parameter_text, quoted};
use crate::suite::run::plan::{Battery, CellBudget, Method};
use crate::suite::run::runner;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use std::fmt::Write;
use std::path::Path;

/// One domain in so many has its ∫ dA / f² found: on small domains that takes longer than all else together.
const INTEGRAL_EVERY: usize = 10;

/// Cases that are written as one line.
const CASES_PER_CHUNK: usize = 500;

/// A case: a domain, a method, and what is asked of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Case {
    /// What is asked for.
    pub cell: Cell,
    /// Its limits.
    pub budget: Limits,
    /// Whether ∫ dA / f² is found, and with it the bounds on the number of vertices and the number of triangles to expect.
    pub integral: bool,
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
            let _ = write!(command, " --param {name}={}", parameter_text(value));
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
            format!("{text} {name}={}", parameter_text(value))
        })
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

    /// What is wrong with a method that the plan names, if something is.
    pub fn check(&self) -> Result<(), String> {
        let methods = 0..self.battery.methods.len().min(self.cases());
        methods
            .map(|number| runner::mesher(&self.case(number).cell))
            .try_for_each(|mesher| mesher.map(|_| ()))
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
        let spacing = &spacings[random.random_range(0..spacings.len())];
        let t = t[random.random_range(0..t.len())].get();
        let c_b = c_b[random.random_range(0..c_b.len())].get();
        let domain = match &self.domains {
            Domains::Drawn(pattern, _) => &pattern.replace("{seed}", &seed.to_string()),
            Domains::Files(files) => &files[seed],
        };
        Case {
            cell: Cell {
                params: params.clone(),
                ..Cell::new(domain, mesher, spacing, t, c_b)
            },
            budget: self.limits,
            integral: seed.is_multiple_of(INTEGRAL_EVERY),
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
pub(crate) fn fingerprint(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn battery(text: &str) -> Battery {
        let common = r#"
            families = ["fan"]
            methods = [{ mesher = "biting", params = { order = "fifo" } }, { mesher = "quadtree-mis" }]
            spacings = ["lfs", "expr:0.1*({w} + {h})"]
            t = [0.25, "1/3"]
            c_b = [0.5, 0.75]
        "#;
        toml::from_str(&format!("{common}{text}")).expect("a battery")
    }

    #[test]
    fn a_case_is_a_function_of_family_and_number() {
        let drawn = battery("domain = \"random-pslg:kind={family},seed={seed}\"\ndomains = 600");
        let family = &Family::all(&[drawn], CellBudget::default())[0];
        assert_eq!((family.cases(), family.chunks().len()), (1200, 3));
        assert_eq!(family.chunks()[2].end, 1200);
        let (first, fifth) = (family.case(0), family.case(5));
        assert_eq!((&first, &fifth), (&family.case(0), &family.case(5)));
        assert_eq!(first.method(), "biting order=fifo");
        assert_eq!(
            (fifth.method(), fifth.cell.domain),
            ("quadtree-mis".into(), "random-pslg:kind=fan,seed=2".into())
        );
        let drawn: Vec<Cell> = (0..60).map(|number| family.case(number).cell).collect();
        for t in [0.25, 1.0 / 3.0] {
            for c_b in [0.5, 0.75] {
                for spacing in ["lfs", "expr:0.1*({w} + {h})"] {
                    let is_so = |cell: &&Cell| cell.t == t && cell.c_b == c_b && cell.spacing == spacing;
                    assert!(drawn.iter().any(|cell| is_so(&cell)), "{t} {c_b} {spacing}");
                }
            }
        }
    }

    #[test]
    fn a_command_is_quoted_for_a_shell() {
        let drawn = battery("domain = \"random-pslg:kind={family},seed={seed}\"\ndomains = 1");
        let mut case = Family::all(&[drawn], CellBudget::default())[0].case(0);
        case.cell.domain = "it's.poly".into();
        case.cell.spacing = "expr:0.1*({w} + {h})".into();
        let Cell { t, c_b, .. } = case.cell;
        let wanted = format!(
            "biting mesh 'it'\\''s.poly' --mesher biting --param order=fifo --spacing 'expr:0.1*({{w}} + {{h}})' --t {t} --c-b {c_b} \
             --max-seconds 120"
        );
        assert_eq!(case.command(), wanted);
    }

    #[test]
    fn a_folder_is_listed_by_name_and_missed_where_it_is_not_there() {
        let folder = tempfile::tempdir().expect("a folder");
        for name in ["b.poly", "a.geojson", "c.txt"] {
            std::fs::write(folder.path().join(name), "").expect("written");
        }
        let place = folder.path().display();
        let families = Family::all(&[battery(&format!("folder = \"{place}\""))], CellBudget::default());
        assert_eq!((families[0].domains(), &families[0].missing), (2, &None));
        assert!(families[0].case(0).cell.domain.ends_with("a.geojson"));
        let missing = battery("folder = \"no/such/{family}\"\nfetch = \"get it\"");
        let families = Family::all(&[missing], CellBudget::default());
        assert!(
            families[0]
                .missing
                .as_deref()
                .is_some_and(|told| told.contains("get it"))
        );
        assert_eq!((families[0].cases(), families[0].chunks().len()), (0, 1));
    }
}
