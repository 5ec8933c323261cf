//! Random PSLGs in kinds, each of which is hard in one way: `random-pslg:kind=fan,seed=7`.
//!
//! They are valid by construction, since a part that would meet another is left out ([`draft::Draft`]). If rounding makes one
//! invalid all the same, as in a domain moved far from the origin, another is drawn; [`discarded`] returns how many were thrown
//! away.

mod details;
mod draft;
mod outlines;
mod transforms;

use crate::domain::{Domain, Pslg};
use draft::Draft;
use rand::SeedableRng;
use rand_pcg::Pcg64;

/// A way to draw.
type Drawing = fn(&mut Draft);

/// A kind: its name, what is hard about it, and how it is drawn.
pub(super) struct Kind {
    pub name: &'static str,
    pub about: &'static str,
    draw: Drawing,
}

const fn kind(name: &'static str, about: &'static str, draw: Drawing) -> Kind {
    Kind { name, about, draw }
}

/// Every kind, in the order of the experiment's table.
pub(super) const KINDS: &[Kind] = &[
    kind("polygon", "random points untangled, 3 to 16", outlines::polygon),
    kind("convex", "convex, 3 to 20 vertices", outlines::convex),
    kind("holes", "up to five small holes, some near each other", details::holes),
    kind(
        "islands",
        "rings within rings, holes and land by turns",
        details::islands,
    ),
    kind("chords", "inner segments and hanging ends", details::chords),
    kind("fan", "segments from one vertex, 1° to 20° apart", details::fan),
    kind("points", "isolated points, down to 1e-4 from others", details::points),
    kind("slits", "cracks, from the boundary or free", details::slits),
    kind(
        "wedge",
        "a triangle or quadrilateral with a corner of 1° to 30°",
        outlines::wedge,
    ),
    kind("needles", "a star with tips of 1° to 40°", outlines::needles),
    kind("comb", "teeth and gaps of widths from 0.01 to 0.3", outlines::comb),
    kind("touch", "features 1e-9 to 1e-3 apart", details::touch),
    kind("grid", "cells of a grid, every grid point a vertex", outlines::grid),
    kind(
        "cocircular",
        "regular polygons around one centre, spokes",
        outlines::cocircular,
    ),
    kind(
        "divided",
        "vertices along sides, collinear but for 1e-13 to 1e-3",
        outlines::divided,
    ),
    kind("network", "a graph of random segments", details::network),
    kind("lattice", "a graph of segments between grid points", details::lattice),
    kind("mixed", "a little of everything", details::mixed),
    kind("turned", "another kind, turned", transforms::turned),
    kind("scaled", "another kind, 1e-9 to 1e9 times as large", transforms::scaled),
    kind(
        "moved",
        "another kind, 1 to 1e9 of its sizes from the origin",
        transforms::moved,
    ),
];

/// Number of kinds before those that move another.
const PLAIN_KINDS: usize = KINDS.len() - 3;

/// Most draws for one domain: if a kind needs more, the kind is at fault and not bad luck.
const MOST_DRAWS: usize = 1000;

/// The PSLG of that kind and seed, and how many draws were thrown away before it.
///
/// # Errors
/// An unknown kind.
pub(super) fn draw(name: &str, seed: u64) -> Result<(Pslg, usize), String> {
    let Some(kind) = KINDS.iter().find(|kind| kind.name == name) else {
        let names: Vec<&str> = KINDS.iter().map(|kind| kind.name).collect();
        return Err(format!("kind={name}: there are {}", names.join(", ")));
    };
    let mut random = Pcg64::seed_from_u64(seed ^ hash(name));
    for discarded in 0..MOST_DRAWS {
        let mut draft = Draft::new(random);
        (kind.draw)(&mut draft);
        let (pslg, used) = draft.into_parts();
        if Domain::new(pslg.clone()).is_ok() {
            return Ok((pslg, discarded));
        }
        random = used;
    }
    Err(format!("kind={name},seed={seed}: none of {MOST_DRAWS} draws is valid"))
}

/// FNV-1a: equal seeds of different kinds are to have different numbers.
fn hash(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_draws_valid_domains_and_hardly_ever_anew() {
        for kind in KINDS {
            let mut discarded = 0;
            for seed in 0..40 {
                let (pslg, thrown_away) = draw(kind.name, seed).expect(kind.name);
                assert_eq!(draw(kind.name, seed).expect("again").0, pslg, "{} {seed}", kind.name);
                assert!(pslg.vertices.len() <= 200, "{} {seed} is no small domain", kind.name);
                discarded += thrown_away;
            }
            assert!(discarded <= 20, "{}: {discarded} of 40 thrown away", kind.name);
        }
    }

    #[test]
    fn unknown_kinds_are_told() {
        assert!(draw("circle", 0).expect_err("unknown").contains("polygon"));
    }
}
