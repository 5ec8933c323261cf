//! The envelope where it has a closed form, and what ends it.

use crate::geometry::Rect;
use crate::spacing::limit::*;
use crate::spacing::testing::{gallery, points_inside};
use crate::spacing::{Expression, Uniform};
use std::sync::atomic::{AtomicUsize, Ordering};

fn expression(text: &str, domain: &Domain) -> Arc<dyn Spacing> {
    Arc::new(Expression::new(text, domain.bounds()).unwrap())
}

#[test]
fn the_envelope_is_near_its_closed_form() {
    let domain = gallery("unit-square");
    type Case = (&'static str, f64, fn(DVec2) -> f64);
    let cases: [Case; 6] = [
        // A valley in the middle, one between lines of cells, a point, a slope from a side, one from a corner, and a plateau.
        ("0.05+2*abs(x-0.5)", 0.5, |x| 0.05 + 0.5 * (x.x - 0.5).abs()),
        ("0.05+2*abs(y-0.3)", 0.25, |x| 0.05 + 0.25 * (x.y - 0.3).abs()),
        ("0.02+3*hypot(x-0.25,y-0.75)", 0.5, |x| {
            0.02 + 0.5 * x.distance(DVec2::new(0.25, 0.75))
        }),
        ("0.1+2*x", 0.25, |x| 0.1 + 0.25 * x.x),
        ("0.1+3*(x+y)", 0.5, |x| 0.1 + 0.5 * x.length()),
        // Outside the domain f falls to 0.1; inside it is 1.1 and more.
        ("0.1+2*abs(x-1.5)", 0.5, |x| 1.1 + 0.5 * (1.0 - x.x)),
    ];
    for (text, alpha, closed) in cases {
        let f = expression(text, &domain);
        let mut sizes = Vec::new();
        for factor in [0.5, 0.9, 0.95] {
            let limited = envelope(f.as_ref(), &domain, [alpha, factor], MAX_CELLS).unwrap();
            for x in points_inside(&domain, 200)
                .into_iter()
                .chain([DVec2::ZERO, DVec2::ONE, DVec2::new(0.25, 0.75)])
            {
                let (found, right) = (limited.at(x), closed(x));
                let slack = 1e-12 * right;
                assert!(
                    found <= right + slack && found >= factor * right - slack,
                    "{text}, {factor}: {found} at {x}, {right}"
                );
            }
            assert_eq!(limited.lipschitz(), alpha);
            sizes.push(limited.size().0);
        }
        // Few cells are enough: (length of valleys) / ((1 − k) f) or so.
        let most = sizes[1].max(sizes[2]);
        assert!(sizes[0] <= most && most < 2000, "{text}: {sizes:?}");
    }
}

/// α ≥ λ leaves f as it is, α a little below λ makes a multiple of it, and only a smaller one an envelope.
#[test]
fn the_cheapest_way_to_the_constant_is_taken() {
    let domain = gallery("unit-square");
    let f = expression("0.1+0.5*x", &domain);
    let own = f.lipschitz();
    for (alpha, share) in [(own, 1.0), (2.0 * own, 1.0), (0.95 * own, 0.95), (0.9 * own, 0.9)] {
        let limited = limit(f.clone(), &domain, alpha, 0.9).unwrap();
        for x in points_inside(&domain, 20) {
            assert!((limited.at(x) / f.at(x) - share).abs() < 1e-14, "{alpha}");
        }
        assert!((limited.lipschitz() / own - share).abs() < 1e-14, "{alpha}");
    }
    let limited = limit(f.clone(), &domain, 0.85 * own, 0.9).unwrap();
    let (low, high) = (limited.at(DVec2::ZERO), limited.at(DVec2::X));
    assert!((0.09..=0.1).contains(&low) && high - low > 0.4, "{low} {high}");
    // A constant has λ = 0, which any α is at least.
    assert_eq!(
        limit(Arc::new(Uniform(0.3)), &domain, 1e-9, 0.9).unwrap().lipschitz(),
        0.0
    );
}

/// A constant that claims to be steep, with lower bounds at a share of it on cells up to a size, and 0 on larger ones.
struct Steep {
    value: f64,
    share: f64,
    size: f64,
    looked_at: AtomicUsize,
}

impl Steep {
    fn new(value: f64, share: f64, size: f64) -> Self {
        let looked_at = AtomicUsize::new(0);
        Self {
            value,
            share,
            size,
            looked_at,
        }
    }
}

impl Spacing for Steep {
    fn at(&self, _: DVec2) -> f64 {
        self.value
    }

    fn lipschitz(&self) -> f64 {
        f64::INFINITY
    }

    fn lower_bound(&self, cell: Rect) -> f64 {
        self.looked_at.fetch_add(1, Ordering::Relaxed);
        if cell.size().x <= self.size {
            self.share * self.value
        } else {
            0.0
        }
    }
}

#[test]
fn as_many_cells_as_allowed_are_looked_at_and_no_more() {
    let domain = gallery("l-shape");
    let alpha = [0.01, 0.9];
    let steep = Steep::new(1.0, 0.97, domain.bounds().size().x / 16.0);
    assert!(envelope(&steep, &domain, alpha, MAX_CELLS).is_ok());
    let count = steep.looked_at.into_inner();
    let again = |most: usize| {
        envelope(
            &Steep::new(1.0, 0.97, domain.bounds().size().x / 16.0),
            &domain,
            alpha,
            most,
        )
    };
    assert!(again(count).is_ok());
    let Err(SpacingError::TooManyCells { cells, alpha, x, y }) = again(count - 1) else {
        panic!("{count} cells are more than {}", count - 1);
    };
    assert_eq!((cells, alpha), (count - 1, 0.01));
    assert!(Cell::root(&domain).rect.contains(DVec2::new(x, y)));
}

#[test]
fn cells_that_a_larger_one_can_stand_for_are_joined() {
    // Lower bounds tell only on small cells, and say the same on all: one cell will do.
    let domain = gallery("unit-square");
    let limited = envelope(&Steep::new(1.0, 0.97, 1.0 / 16.0), &domain, [0.01, 0.9], MAX_CELLS).unwrap();
    assert_eq!(limited.size(), (1, 0));
    assert!((0.96..=0.97).contains(&limited.at(DVec2::splat(0.5))));
    // With α so large that the radius of a cell counts, only cells up to a size may stand for others: v ≥ k (f + α r).
    let limited = envelope(&Steep::new(1.0, 0.97, 1.0 / 16.0), &domain, [1.0, 0.9], MAX_CELLS).unwrap();
    // r ≤ 0.97 / 0.9 − 1 is 0.077, half the diagonal of a cell of 1/16 is 0.044, of 1/8 0.088.
    assert_eq!(limited.size(), (256, 85));
}

#[test]
fn values_that_are_not_positive_are_told_from_those_that_are_not_proved() {
    let domain = gallery("unit-square");
    let told = |value: f64| {
        envelope(&Steep::new(value, 0.97, 0.0), &domain, [0.1, 0.9], MAX_CELLS)
            .err()
            .unwrap()
    };
    for value in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        let SpacingError::NotPositive { value: found, x, y } = told(value) else {
            panic!("{value}: {}", told(value));
        };
        assert!(found.to_bits() == value.to_bits() && domain.contains(DVec2::new(x, y)));
    }
    // Near one point nothing is ever proved: cells there are split to the end.
    let place = DVec2::new(0.3, 0.7);
    let cusp = |size: f64| envelope(&Cusp { place, size }, &domain, [0.1, 0.9], MAX_CELLS);
    for size in [0.0, 2f64.powi(-45)] {
        let told = cusp(size).err().unwrap();
        let SpacingError::Unresolved { value, x, y } = told else {
            panic!("{told}");
        };
        assert!(value == 1.0 && DVec2::new(x, y).distance(place) < 1e-12);
    }
    assert!(cusp(2f64.powi(-44)).is_ok());
}

/// 1 everywhere, with no lower bound on cells that hold a place unless they are no larger than a size.
struct Cusp {
    place: DVec2,
    size: f64,
}

impl Spacing for Cusp {
    fn at(&self, _: DVec2) -> f64 {
        1.0
    }

    fn lipschitz(&self) -> f64 {
        f64::INFINITY
    }

    fn lower_bound(&self, cell: Rect) -> f64 {
        if cell.contains(self.place) && cell.size().x > self.size {
            0.0
        } else {
            0.97
        }
    }
}

fn refinement<'a>(function: &'a dyn Spacing, domain: &'a Domain, alpha: f64, factor: f64) -> Refinement<'a> {
    Refinement {
        function,
        domain,
        alpha,
        factor,
        most: MAX_CELLS,
        slack: 0.125,
        samples: Samples::new(Cell::root(domain).rect, alpha),
        lowest: Vec::new(),
        fates: Vec::new(),
    }
}

#[test]
fn seeds_are_the_ends_and_the_middle_of_each_segment() {
    let domain = gallery("l-shape");
    let f = expression("1+x+3*y", &domain);
    let seeds = refinement(f.as_ref(), &domain, 0.5, 0.9).seeds();
    assert_eq!(seeds.len(), domain.segments().len());
    for (s, seeds) in seeds.iter().enumerate() {
        let [a, b] = domain.ends(s);
        let places = seeds.map(|seed| seed.at);
        assert_eq!(places, [a, a.midpoint(b), b]);
        assert!(seeds.iter().all(|seed| seed.value == f.at(seed.at)));
    }
}

#[test]
fn a_cell_offers_its_lowest_seed_if_that_is_below_its_own_point() {
    let domain = gallery("unit-square");
    let root = Cell::root(&domain);
    let cells: Vec<Cell> = root.split(&domain).collect();
    let look = |text: &str, cell: &Cell| {
        let f = expression(text, &domain);
        let refinement = refinement(f.as_ref(), &domain, 0.5, 0.9);
        let (seed, lowest) = refinement.look(cell, &refinement.seeds());
        assert!((seed.value - f.at(seed.at)).abs() == 0.0 && lowest == f.lower_bound(cell.rect) - 0.125);
        seed.at
    };
    assert_eq!(look("3-x-y", &root), DVec2::ONE);
    assert_eq!(look("3-x+2*abs(y-0.5)", &root), DVec2::new(1.0, 0.5));
    // In the lower left quarter seeds to its right and above do not count, and its centre is higher than its corner.
    assert_eq!(look("3-x-y", &cells[0]), DVec2::splat(0.25));
    assert_eq!(look("3-x+2*y", &cells[0]), DVec2::new(0.5, 0.0));
    assert_eq!(look("3+x+y", &cells[0]), DVec2::ZERO);
    // Of equals its own point.
    assert_eq!(look("3", &cells[0]), DVec2::splat(0.25));
}

/// Also where a cell's point is not its centre, f at which the bound may be taken from.
#[test]
fn a_cell_has_the_lower_bound_of_the_function() {
    let domain = gallery("star");
    let lfs = crate::spacing::lfs_of(&domain).unwrap();
    let refinement = refinement(&lfs, &domain, 0.5, 0.9);
    let seeds = refinement.seeds();
    let mut cells = vec![Cell::root(&domain)];
    let mut beside = 0;
    for _ in 0..5 {
        cells = cells.iter().flat_map(|cell| cell.split(&domain)).collect();
        for cell in &cells {
            let (_, lowest) = refinement.look(cell, &seeds);
            assert_eq!(lowest, lfs.lower_bound(cell.rect) - 0.125);
            beside += usize::from(cell.point(&domain) != cell.rect.centre());
        }
    }
    assert!(beside > 10, "{beside} of {}", cells.len());
}

/// A lower bound gives way by 16 ulp of the largest coordinate.
#[test]
fn rounding_is_granted_by_the_size_of_coordinates() {
    for size in [1.0, 1024.0] {
        let mut pslg = crate::domain::Pslg::new("square");
        pslg.add_ring([DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|x| size * x), 1);
        let domain = Domain::new(pslg).unwrap();
        let value = 1e-9;
        let limited = envelope(&Steep::new(value, 0.97, size), &domain, [1e-16, 0.9], MAX_CELLS).unwrap();
        let expected = 0.97 * value - 16.0 * f64::EPSILON * size;
        assert!(
            (limited.at(DVec2::splat(0.5 * size)) - expected).abs() < 1e-20,
            "{size}"
        );
    }
}

/// What becomes of a cell with lower bound v: kept from k (U + α r) on, and dropped in the end from U + α r on.
#[test]
fn cells_are_kept_split_and_dropped_by_what_samples_reach() {
    let domain = gallery("unit-square");
    let steep = Steep::new(1.0, 1.0, 1.0);
    let mut refinement = refinement(&steep, &domain, 0.5, 0.75);
    let at = DVec2::new(0.5, 0.25);
    refinement.samples.set(0, at, 2.0);
    // The sample is ¼ from the centre of the square, a corner half a diagonal.
    let reach = 2.0 + 0.5 * 0.25 + 0.5 * 0.5 * refinement.samples.cell(0).diagonal();
    assert!((reach - 2.125 - 0.5 * 0.5f64.sqrt()).abs() < 1e-15);
    for (lowest, fate, settled) in [
        (reach.next_up(), Fate::Kept, Fate::Dropped),
        (reach, Fate::Kept, Fate::Dropped),
        (reach.next_down(), Fate::Kept, Fate::Kept),
        (0.75 * reach, Fate::Kept, Fate::Kept),
        ((0.75 * reach).next_down(), Fate::Split, Fate::Dropped),
        (0.0, Fate::Split, Fate::Dropped),
    ] {
        refinement.lowest = vec![lowest];
        assert_eq!(refinement.fate(0), fate, "{lowest} of {reach}");
        refinement.fates = vec![fate];
        // A cell of no quarters at all has none that is kept.
        assert_eq!(refinement.judge(0).0, settled, "{lowest} of {reach}");
    }
}

/// A square whose four quarters have these fates and lower bounds, with a sample of 1 at its centre.
fn quartered<'a>(function: &'a dyn Spacing, domain: &'a Domain, quarters: [(Fate, f64); 4]) -> Refinement<'a> {
    let mut refinement = refinement(function, domain, 0.5, 0.75);
    let cells: Vec<Cell> = Cell::root(domain).split(domain).collect();
    refinement.samples.add_children(0, &cells);
    refinement.samples.set(0, DVec2::splat(0.5), 1.0);
    refinement.fates = [Fate::Split]
        .into_iter()
        .chain(quarters.map(|quarter| quarter.0))
        .collect();
    refinement.lowest = [0.0].into_iter().chain(quarters.map(|quarter| quarter.1)).collect();
    refinement
}

#[test]
fn quarters_are_joined_where_their_cell_may_be_kept() {
    let domain = gallery("unit-square");
    let steep = Steep::new(1.0, 1.0, 1.0);
    let judged = |quarters| quartered(&steep, &domain, quarters).judge(0);
    // The cell may be kept from ¾ (1 + ½ √½) on, 1.015.
    let kept = |lowest: f64| (Fate::Kept, lowest);
    let dropped = (Fate::Dropped, 0.1);
    assert_eq!(
        judged([kept(1.3), kept(1.2), kept(1.02), kept(1.1)]),
        (Fate::Kept, 1.02)
    );
    assert_eq!(
        judged([kept(1.3), kept(1.2), kept(1.01), kept(1.1)]),
        (Fate::Split, 0.0)
    );
    // Quarters that were dropped do not count, nor does a cell of such alone.
    assert_eq!(judged([kept(1.3), dropped, dropped, kept(1.1)]), (Fate::Kept, 1.1));
    assert_eq!(judged([dropped; 4]), (Fate::Dropped, f64::INFINITY));
    assert_eq!(
        judged([kept(1.3), (Fate::Split, 0.0), kept(1.2), kept(1.1)]),
        (Fate::Split, 0.0)
    );
    // A quarter that the sample dominates by now is dropped: its centre is √⅛ from it, and so is its corner from there.
    let reach = 1.0 + 0.5 * 0.125f64.sqrt() + 0.5 * 0.125f64.sqrt();
    let late = quartered(
        &steep,
        &domain,
        [kept(reach + 1e-9), kept(reach - 1e-9), dropped, dropped],
    );
    assert_eq!(late.judge(1), (Fate::Dropped, f64::INFINITY));
    assert_eq!(late.judge(2), kept(reach - 1e-9));
    assert_eq!(late.judge(3).0, Fate::Dropped);
}

#[test]
fn what_is_kept_is_packed_under_the_lowest_value_below() {
    let domain = gallery("unit-square");
    let steep = Steep::new(1.0, 1.0, 1.0);
    let kept = |lowest: f64| (Fate::Kept, lowest);
    let mut joined = quartered(&steep, &domain, [kept(1.3), kept(1.2), kept(1.1), kept(1.15)]);
    joined.join(&[0, 1]);
    assert_eq!(
        joined.fates,
        [Fate::Kept, Fate::Dropped, Fate::Dropped, Fate::Dropped, Fate::Dropped]
    );
    let one = Limited::new(0.5, joined.pack());
    assert_eq!((one.size(), one.at(DVec2::ONE)), ((1, 0), 1.1));
    let mut apart = quartered(
        &steep,
        &domain,
        [kept(1.3), (Fate::Dropped, 0.1), kept(1.0), kept(1.15)],
    );
    apart.join(&[0, 1]);
    assert_eq!(
        apart.fates,
        [Fate::Split, Fate::Kept, Fate::Dropped, Fate::Kept, Fate::Kept]
    );
    let three = Limited::new(0.5, apart.pack());
    assert_eq!(three.size(), (3, 1));
    // In the quarter at the upper left, in that at the lower left, and, from the upper left one too, at the lower right.
    assert_eq!((three.at(DVec2::Y), three.at(DVec2::splat(0.125))), (1.0, 1.1875));
    assert!((three.at(DVec2::X) - (1.0 + 0.5 * 0.5f64.sqrt())).abs() < 1e-15);
}
