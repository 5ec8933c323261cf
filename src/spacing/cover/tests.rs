use crate::spacing::cover::*;
use crate::spacing::testing::{gallery, points_inside};
use crate::spacing::{Expression, Uniform};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The cells so many levels below the root.
fn cells(domain: &Domain, depth: usize) -> Vec<Cell> {
    let mut level = vec![Cell::root(domain)];
    for _ in 0..depth {
        level = level
            .iter()
            .flat_map(|cell| cell.split(domain).collect::<Vec<_>>())
            .collect();
    }
    level
}

#[test]
fn cells_cover_the_domain_and_no_more_than_they_must() {
    for name in ["unit-square", "l-shape", "annulus", "comb"] {
        let domain = gallery(name);
        let bounds = domain.bounds();
        let root = Cell::root(&domain).rect;
        assert!(root.size().x == root.size().y && root.size().x == bounds.size().max_element());
        assert!(
            root.centre().distance(bounds.centre()) < 1e-12 && root.contains(bounds.min) && root.contains(bounds.max)
        );
        let cells = cells(&domain, 5);
        for x in points_inside(&domain, 300) {
            assert!(cells.iter().any(|cell| cell.rect.contains(x)), "{name}: {x}");
        }
        let (mut inside, mut crossed) = (0, 0);
        for cell in &cells {
            let size = cell.rect.size();
            let samples = (0..=8).flat_map(|i| (0..=8).map(move |j| DVec2::new(f64::from(i), f64::from(j)) / 8.0));
            let is_inside = |share: DVec2| domain.contains(cell.rect.min + share * size);
            if cell.crossing.is_empty() {
                inside += 1;
                assert!(samples.into_iter().all(is_inside), "{name}: {:?}", cell.rect);
            } else {
                crossed += 1;
                let expected = (0..domain.segments().len()).filter(|&s| meets_box(domain.ends(s), &cell.rect));
                assert!(expected.eq(cell.crossing.iter().map(|s| *s as usize)));
            }
            let point = cell.point(&domain);
            let slack = 1e-12 * root.size().x;
            assert!(
                cell.rect.distance(point) <= slack,
                "{name}: {point} is not in {:?}",
                cell.rect
            );
            let on_boundary = || {
                cell.crossing
                    .iter()
                    .any(|&s| distance(domain.ends(s as usize), point) <= slack)
            };
            assert!(domain.contains(point) || on_boundary(), "{name}: {point} is outside");
            if domain.contains(cell.rect.centre()) {
                assert_eq!(point, cell.rect.centre());
            }
        }
        assert!(inside > 0 && crossed > 0, "{name}");
    }
}

fn distance([a, b]: [DVec2; 2], x: DVec2) -> f64 {
    let share = (x - a).dot(b - a) / (b - a).length_squared();
    a.lerp(b, share.clamp(0.0, 1.0)).distance(x)
}

#[test]
fn the_middle_of_a_clipped_segment_is_halfway_between_where_it_enters_and_leaves() {
    let cell = Rect {
        min: DVec2::new(1.0, 0.0),
        max: DVec2::new(3.0, 1.0),
    };
    for (ends, middle) in [
        // Leaves by the top at (2, 1).
        ([(0.0, 0.0), (4.0, 2.0)], (1.5, 0.75)),
        ([(0.0, 0.5), (8.0, 0.5)], (2.0, 0.5)),
        ([(2.5, -3.0), (2.5, 5.0)], (2.5, 0.5)),
        // Starts and ends inside.
        ([(1.5, 0.25), (2.5, 0.75)], (2.0, 0.5)),
        ([(1.5, 0.25), (5.5, 0.25)], (2.25, 0.25)),
        // Enters by the right at (3, ½), leaves by the top at (2, 1).
        ([(5.0, -0.5), (0.0, 2.0)], (2.5, 0.75)),
    ] {
        let [a, b] = ends.map(DVec2::from);
        for ends in [[a, b], [b, a]] {
            assert!(
                clipped_middle(ends, cell).distance(DVec2::from(middle)) < 1e-15,
                "{ends:?}"
            );
        }
    }
}

#[test]
fn f_is_proved_positive_or_told_where_it_is_not() {
    let domain = gallery("l-shape");
    assert_eq!(check_positive(&Uniform(1e-300), &domain), Ok(()));
    for value in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        let told = check_positive(&Told::new(value, 0.0), &domain);
        let Err(SpacingError::NotPositive { value: found, x, y }) = told else {
            panic!("{value}: {told:?}");
        };
        assert!(found.to_bits() == value.to_bits() && domain.contains(DVec2::new(x, y)));
    }
    let falls = Expression::new("x-y+0.3", domain.bounds()).unwrap();
    let Err(SpacingError::NotPositive { value, x, y }) = check_positive(&falls, &domain) else {
        panic!("x - y + 0.3 is negative on the left");
    };
    assert!(value <= 0.0 && value == falls.at(DVec2::new(x, y)) && domain.contains(DVec2::new(x, y)));
}

/// The value everywhere, with a lower bound that is above 0 only on cells smaller than `proof`.
struct Told {
    value: f64,
    proof: f64,
    looked_at: AtomicUsize,
}

impl Told {
    fn new(value: f64, proof: f64) -> Self {
        let looked_at = AtomicUsize::new(0);
        Self {
            value,
            proof,
            looked_at,
        }
    }
}

impl Spacing for Told {
    fn at(&self, _: DVec2) -> f64 {
        self.value
    }

    fn lipschitz(&self) -> f64 {
        f64::INFINITY
    }

    fn lower_bound(&self, cell: Rect) -> f64 {
        self.looked_at.fetch_add(1, Ordering::Relaxed);
        if cell.size().x < self.proof { self.value } else { 0.0 }
    }
}

#[test]
fn a_proof_may_need_small_cells_but_neither_too_small_nor_too_many() {
    let domain = gallery("unit-square");
    let told = |proof: f64| {
        let f = Told::new(0.5, proof);
        (check_positive(&f, &domain), f.looked_at.into_inner())
    };
    // All of the cells down to 2^-7 of the square, and the square itself before.
    assert_eq!(
        told(2f64.powi(-6)),
        (Ok(()), 1 + (0..8).map(|depth| 4usize.pow(depth)).sum::<usize>())
    );
    // Cells of 2^-11 would be four million.
    let (many, cells) = told(2f64.powi(-10));
    assert!(matches!(many, Err(SpacingError::Unproved { value: 0.5, .. })));
    assert!((BUDGET..BUDGET + 8).contains(&cells), "{cells}");
    // The first cell that can be no smaller ends the search.
    let (small, cells) = told(0.0);
    assert!(
        matches!(small, Err(SpacingError::Unproved { value: 0.5, .. })) && cells < 100,
        "{cells}"
    );
}
