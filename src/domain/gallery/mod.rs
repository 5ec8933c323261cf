//! Named domains: every one is a valid PSLG, made without input.

use super::{Domain, DomainError, Pslg};

mod shapes;

/// A named domain.
#[derive(Clone, Copy)]
pub struct Entry {
    /// Its name on the command line.
    pub name: &'static str,
    /// What it shows, in a line.
    pub about: &'static str,
    make: fn() -> Pslg,
}

/// Every named domain, in the order of `list`.
pub const ENTRIES: &[Entry] = &[
    Entry {
        name: "unit-square",
        about: "the unit square",
        make: shapes::unit_square,
    },
    Entry {
        name: "l-shape",
        about: "an L, with one reflex corner",
        make: shapes::l_shape,
    },
    Entry {
        name: "plate-hole",
        about: "a square plate with a hole of 64 sides",
        make: shapes::plate_hole,
    },
    Entry {
        name: "annulus",
        about: "a ring of 96 sides",
        make: shapes::annulus,
    },
    Entry {
        name: "comb",
        about: "a comb: narrow teeth and narrow gaps, all corners right",
        make: shapes::comb,
    },
    Entry {
        name: "two-arms",
        about: "two arms close together in the plane and far apart along the domain (footnote 1)",
        make: shapes::two_arms,
    },
];

/// The gallery domain of that name, `None` where there is none.
///
/// # Errors
/// [`DomainError`] never, as long as the gallery's own test passes.
pub fn domain(name: &str) -> Option<Result<Domain, DomainError>> {
    pslg(name).map(Domain::new)
}

/// The PSLG of that name, `None` where there is none.
pub fn pslg(name: &str) -> Option<Pslg> {
    ENTRIES
        .iter()
        .find(|entry| entry.name == name)
        .map(|entry| (entry.make)())
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
        }
    }
}
