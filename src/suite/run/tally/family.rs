//! Which domains a family has, and what each of its cases asks for.

use crate::suite::rows::hash::fnv;
use crate::suite::rows::record::{Cell, parameter_text, quoted};
use crate::suite::run::plan::{CellBudget, Group, Method, Number, Plan, Tallied};
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

/// A trial to be made: a domain, a method, and what is asked of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// What is asked for.
    pub cell: Cell,
    /// Its limits.
    pub budget: CellBudget,
    /// Whether ∫ dA / f² is found, and with it the bounds on the number of vertices and the number of triangles to expect.
    pub integral: bool,
}

impl Trial {
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

/// A family of domains of a group that is tallied.
#[derive(Clone, Debug)]
pub struct Family {
    /// Its name.
    pub name: String,
    /// How to get its files, where they are not there.
    pub missing: Option<String>,
    domains: Vec<String>,
    methods: Vec<Method>,
    spacings: Vec<String>,
    t: Vec<Number>,
    c_b: Vec<Number>,
    budget: CellBudget,
}

impl Family {
    /// All families of a plan. A folder that is missing, or has no domain in it, makes a family of no cases.
    pub fn all(plan: &Plan) -> Vec<Self> {
        let of = |(group, tallied): (&Group, &Tallied)| {
            let one = |name: &String| Self::new(name, group, tallied, plan.budget);
            tallied.families.iter().map(one).collect::<Vec<_>>()
        };
        plan.tallied().flat_map(of).collect()
    }

    fn new(name: &str, group: &Group, tallied: &Tallied, budget: CellBudget) -> Self {
        let of = |pattern: &String| {
            let pattern = pattern.replace("{family}", name);
            match pattern.contains("{seed}") {
                true => (0..tallied.draws)
                    .map(|seed| pattern.replace("{seed}", &seed.to_string()))
                    .collect(),
                false => files(Path::new(&pattern)),
            }
        };
        let domains: Vec<String> = group.domains.iter().flat_map(of).collect();
        let missing = domains.is_empty().then(|| {
            let fetch = tallied.fetch.as_deref().unwrap_or("fetch them");
            format!("its domains are not there; get them by `{fetch}`")
        });
        Self {
            name: name.to_owned(),
            missing,
            domains,
            // A plan that was read has methods.
            methods: group.methods().unwrap_or_default(),
            spacings: group.spacings.clone(),
            t: group.t.clone(),
            c_b: group.c_b.clone(),
            budget: group.budget.unwrap_or(budget),
        }
    }

    /// How many cases it has: each domain by every method.
    pub fn cases(&self) -> usize {
        self.domains.len() * self.methods.len()
    }

    /// The methods, as [`Trial::method`] writes them.
    pub fn methods(&self) -> Vec<String> {
        (0..self.methods.len().min(self.cases()))
            .map(|number| self.case(number).method())
            .collect()
    }

    /// What is wrong with a method that the plan names, if something is.
    pub fn check(&self) -> Result<(), String> {
        let methods = 0..self.methods.len().min(self.cases());
        methods
            .map(|number| runner::mesher(&self.case(number).cell))
            .try_for_each(|mesher| mesher.map(|_| ()))
    }

    /// The case of that number. Spacing, t and c_b are drawn, each from its list, by family and number.
    pub fn case(&self, number: usize) -> Trial {
        let Method { mesher, params } = &self.methods[number % self.methods.len()];
        let place = number / self.methods.len();
        let mut random = Pcg64::seed_from_u64(fnv(&self.name) ^ number as u64);
        let spacing = &self.spacings[random.random_range(0..self.spacings.len())];
        let t = self.t[random.random_range(0..self.t.len())].get();
        let c_b = self.c_b[random.random_range(0..self.c_b.len())].get();
        Trial {
            cell: Cell {
                params: params.clone(),
                ..Cell::new(&self.domains[place], mesher, spacing, t, c_b)
            },
            budget: self.budget,
            integral: place.is_multiple_of(INTEGRAL_EVERY),
        }
    }

    /// Its chunks, one at least: of no cases where its files are missing.
    pub fn chunks(&self) -> Vec<Part> {
        let asked = fnv(&format!("{self:?}"));
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The families of a plan with one group.
    fn families(domains: &str, tally: &str) -> Vec<Family> {
        let text = format!(
            r#"
            question = "What breaks?"
            [[group]]
            name = "hard"
            tally = {{ families = ["fan"], {tally} }}
            domains = ["{domains}"]
            methods = [{{ mesher = "biting", params = {{ order = "fifo" }} }}, {{ mesher = "quadtree-mis" }}]
            spacings = ["lfs", "expr:0.1*({{w}} + {{h}})"]
            t = [0.25, "1/3"]
            c_b = [0.5, 0.75]
        "#
        );
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("try.toml");
        std::fs::write(&file, text).expect("written");
        Family::all(&Plan::read(&file).expect("a plan"))
    }

    const DRAWN: &str = "random-pslg:kind={family},seed={seed}";

    #[test]
    fn a_case_is_a_function_of_family_and_number() {
        let family = &families(DRAWN, "draws = 600")[0];
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
        let mut case = families(DRAWN, "draws = 1")[0].case(0);
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
        let place = folder.path().display().to_string();
        let there = families(&place, "draws = 0");
        assert_eq!((there[0].domains.len(), &there[0].missing), (2, &None));
        assert!(there[0].case(0).cell.domain.ends_with("a.geojson"));
        let families = families("no/such/{family}", "fetch = \"get it\"");
        assert!(
            families[0]
                .missing
                .as_deref()
                .is_some_and(|told| told.contains("get it"))
        );
        assert_eq!((families[0].cases(), families[0].chunks().len()), (0, 1));
    }
}
