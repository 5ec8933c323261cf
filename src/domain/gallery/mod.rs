//! Named domains: drawn by rule, random by seed, and real outlines.
//!
//! `random-convex` and `random-simple` take parameters: `random-simple:n=40,seed=7`. So does `random-pslg`, each of whose kinds is
//! hard in one way: `random-pslg:kind=fan,seed=7`.

use super::{Domain, DomainError, Pslg};

mod outlines;
mod random;
mod random_pslg;
mod shapes;

/// How a named domain is made.
#[derive(Clone, Copy)]
enum Make {
    /// By a rule without parameters.
    Rule(fn() -> Pslg),
    /// At random: from a number of vertices (with default and largest) and a seed.
    Random(fn(usize, u64) -> Pslg, usize, usize),
    /// At random: from a kind and a seed.
    Kind,
    /// From the text of a `.poly` file.
    Outline(&'static str),
}

/// A named domain.
#[derive(Clone, Copy)]
pub struct Entry {
    /// Its name on the command line.
    pub name: &'static str,
    /// What it shows, in one line.
    pub about: &'static str,
    make: Make,
}

impl Entry {
    /// Whether it is a real outline.
    pub fn is_real(&self) -> bool {
        matches!(self.make, Make::Outline(_))
    }
}

const fn entry(name: &'static str, about: &'static str, make: Make) -> Entry {
    Entry { name, about, make }
}

/// Every named domain, in the order of `list`.
pub const ENTRIES: &[Entry] = &[
    entry("unit-square", "the unit square", Make::Rule(shapes::unit_square)),
    entry("l-shape", "an L, with one reflex corner", Make::Rule(shapes::l_shape)),
    entry(
        "plate-hole",
        "a square plate with a hole of 64 sides",
        Make::Rule(shapes::plate_hole),
    ),
    entry("annulus", "a ring of 96 sides", Make::Rule(shapes::annulus)),
    entry(
        "comb",
        "narrow teeth and narrow gaps, all corners right",
        Make::Rule(shapes::comb),
    ),
    entry(
        "star",
        "five points of 36°: acute input angles",
        Make::Rule(shapes::star),
    ),
    entry("gear", "twenty tapered teeth and a bore", Make::Rule(shapes::gear)),
    entry(
        "two-arms",
        "near in the plane, far along the domain (the paper's footnote 1)",
        Make::Rule(shapes::two_arms),
    ),
    entry(
        "naca0012",
        "a box around an airfoil, from its formula",
        Make::Rule(shapes::naca0012),
    ),
    entry(
        "koch",
        "Koch's snowflake after four steps, corners of 60° and 240°",
        Make::Rule(shapes::koch),
    ),
    entry(
        "interface",
        "two regions, cracks, an isolated vertex",
        Make::Rule(shapes::interface),
    ),
    entry(
        "random-convex",
        "Valtr's random convex polygon (:n=24,seed=0)",
        Make::Random(random::convex, 24, 10_000),
    ),
    entry(
        "random-simple",
        "random points untangled (:n=40,seed=0)",
        Make::Random(random::simple, 40, 1000),
    ),
    entry(
        "random-pslg",
        "one of the hard kinds of experiments/robustness.toml (:kind=polygon,seed=0)",
        Make::Kind,
    ),
    entry(
        "aegean",
        "the Aegean sea with its islands as holes (km)",
        Make::Outline(outlines::AEGEAN),
    ),
    entry(
        "british-isles",
        "islands in many parts, one cut by a border (km)",
        Make::Outline(outlines::BRITISH_ISLES),
    ),
    entry(
        "iceland",
        "fjords and peninsulas (km)",
        Make::Outline(outlines::ICELAND),
    ),
    entry(
        "italy",
        "a peninsula, islands, an enclave as a hole (km)",
        Make::Outline(outlines::ITALY),
    ),
    entry(
        "norway",
        "a fjord coast of more than 10⁴ segments, in many parts (km)",
        Make::Outline(outlines::NORWAY),
    ),
];

/// The gallery domain that `spec` names, `None` if the gallery has none of that name.
///
/// # Errors
/// [`DomainError::Unknown`] if its parameters are wrong.
pub fn domain(spec: &str) -> Option<Result<Domain, DomainError>> {
    let unknown = |message| DomainError::Unknown {
        name: spec.to_owned(),
        message,
    };
    pslg(spec).map(|made| made.map_err(unknown).and_then(Domain::new))
}

/// The PSLG that `spec` names, `None` if the gallery has none of that name.
///
/// # Errors
/// A message that says which parameter is wrong.
pub fn pslg(spec: &str) -> Option<Result<Pslg, String>> {
    let (name, parameters) = spec
        .split_once(':')
        .map_or((spec, None), |(name, rest)| (name, Some(rest)));
    let entry = ENTRIES.iter().find(|entry| entry.name == name)?;
    let plain = || {
        parameters.map_or(Ok(()), |rest| {
            Err(format!("takes no parameters, but \"{rest}\" is given"))
        })
    };
    let made = match entry.make {
        Make::Rule(make) => plain().map(|()| make()),
        Make::Outline(text) => plain().and_then(|()| outlines::read(entry.name, text)),
        Make::Kind => kind_parameters(parameters.unwrap_or(""))
            .and_then(|(kind, seed)| random_pslg::draw(kind, seed))
            .map(|(pslg, _)| pslg),
        Make::Random(make, count, largest) => {
            random_parameters(parameters.unwrap_or(""), count, largest).map(|(count, seed)| make(count, seed))
        }
    };
    Some(made.map(|mut pslg| {
        spec.clone_into(&mut pslg.name);
        spec.clone_into(&mut pslg.source.file);
        pslg
    }))
}

/// Reads `n=COUNT,seed=SEED`, both optional.
fn random_parameters(text: &str, count: usize, largest: usize) -> Result<(usize, u64), String> {
    let (mut count, mut seed) = (count, 0);
    for part in text.split(',').filter(|part| !part.is_empty()) {
        match part.split_once('=') {
            Some(("n", value)) => {
                count = value
                    .parse()
                    .ok()
                    .filter(|count| (3..=largest).contains(count))
                    .ok_or_else(|| format!("n={value}: give a number of vertices from 3 to {largest}"))?;
            }
            Some(("seed", value)) => {
                seed = whole_seed(value)?;
            }
            _ => {
                return Err(format!(
                    "\"{part}\" is not a parameter; give n=COUNT and seed=SEED, joined by a comma"
                ));
            }
        }
    }
    Ok((count, seed))
}

/// Kinds of `random-pslg`, each with what is hard about it.
pub fn kinds() -> impl Iterator<Item = (&'static str, &'static str)> {
    random_pslg::KINDS.iter().map(|kind| (kind.name, kind.about))
}

/// How many draws of a `random-pslg` were thrown away, because they were not valid, before the one that `spec` names.
pub fn discarded(spec: &str) -> usize {
    let parameters = spec
        .strip_prefix("random-pslg")
        .map(|rest| rest.trim_start_matches(':'));
    parameters
        .and_then(|text| kind_parameters(text).ok())
        .and_then(|(kind, seed)| random_pslg::draw(kind, seed).ok())
        .map_or(0, |(_, discarded)| discarded)
}

/// Reads `kind=KIND,seed=SEED`, both optional.
fn kind_parameters(text: &str) -> Result<(&str, u64), String> {
    let (mut kind, mut seed) = ("polygon", 0);
    for part in text.split(',').filter(|part| !part.is_empty()) {
        match part.split_once('=') {
            Some(("kind", value)) => kind = value,
            Some(("seed", value)) => seed = whole_seed(value)?,
            _ => {
                return Err(format!(
                    "\"{part}\" is not a parameter; give kind=KIND and seed=SEED, joined by a comma"
                ));
            }
        }
    }
    Ok((kind, seed))
}

fn whole_seed(value: &str) -> Result<u64, String> {
    value
        .parse()
        .map_err(|_| format!("seed={value}: give a whole number from 0"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_is_a_valid_domain() {
        for entry in ENTRIES {
            let domain = domain(entry.name).unwrap().unwrap();
            assert!(domain.area() > 0.0, "{}", entry.name);
            assert!(domain.notes().is_empty(), "{}: {:?}", entry.name, domain.notes());
            assert_eq!(domain.name(), entry.name);
        }
    }

    #[test]
    fn most_synthetic_entries_meet_the_papers_hypothesis() {
        let synthetic = || ENTRIES.iter().filter(|entry| !entry.is_real());
        let angle = |entry: &&Entry| domain(entry.name).unwrap().unwrap().smallest_input_angle_deg();
        let met: Vec<&str> = synthetic()
            .filter(|entry| angle(entry) >= 90.0)
            .map(|entry| entry.name)
            .collect();
        assert!(3 * met.len() >= 2 * synthetic().count(), "only {met:?}");
    }

    #[test]
    fn random_domains_follow_their_parameters() {
        for seed in 0..8 {
            for name in ["random-convex", "random-simple"] {
                let spec = format!("{name}:n=30,seed={seed}");
                let first = domain(&spec).unwrap().unwrap();
                assert_eq!(first.vertices().len(), 30);
                assert_eq!(first.vertices(), domain(&spec).unwrap().unwrap().vertices());
            }
        }
        for bad in [
            "random-simple:n=2",
            "random-simple:m=4",
            "random-convex:seed=x",
            "koch:n=3",
            "random-pslg:kind=circle",
            "random-pslg:n=3",
        ] {
            assert!(domain(bad).unwrap().is_err(), "{bad}");
        }
        assert!(domain("no-such-domain").is_none());
    }
}
