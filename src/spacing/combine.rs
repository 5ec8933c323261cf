//! Spacings made of spacings: the smallest of several, and a multiple (Lemma 2.3).

use super::Spacing;
use crate::geometry::{DVec2, Rect};
use std::sync::Arc;

/// `min(A, B)`: f(x) = min(A(x), B(x)), Lipschitz with the larger of the two constants (Lemma 2.3).
#[derive(Clone)]
pub struct Min {
    parts: Vec<Arc<dyn Spacing>>,
}

impl Min {
    /// The smallest of `parts` on `bounds`. A part proved nowhere below another one there is left out, so that it does
    /// not raise the Lipschitz constant; what is left may be a single part.
    pub fn of(parts: Vec<Arc<dyn Spacing>>, bounds: Rect) -> Arc<dyn Spacing> {
        let mut kept: Vec<Arc<dyn Spacing>> = Vec::with_capacity(parts.len());
        for part in parts {
            let lowest = part.lower_bound(bounds);
            if kept.iter().any(|other| other.upper_bound(bounds) <= lowest) {
                continue;
            }
            let highest = part.upper_bound(bounds);
            kept.retain(|other| other.lower_bound(bounds) < highest);
            kept.push(part);
        }
        if kept.len() == 1 {
            kept.swap_remove(0)
        } else {
            Arc::new(Self { parts: kept })
        }
    }

    fn lowest(&self, value: impl Fn(&dyn Spacing) -> f64) -> f64 {
        self.parts
            .iter()
            .map(|part| value(part.as_ref()))
            .fold(f64::INFINITY, smaller)
    }
}

/// The smaller of two values, not a number if one of them is not.
fn smaller(a: f64, b: f64) -> f64 {
    if a.is_nan() || a < b { a } else { b }
}

impl Spacing for Min {
    fn at(&self, x: DVec2) -> f64 {
        self.lowest(|part| part.at(x))
    }

    fn lipschitz(&self) -> f64 {
        self.parts.iter().map(|part| part.lipschitz()).fold(0.0, f64::max)
    }

    fn lower_bound(&self, cell: Rect) -> f64 {
        self.lowest(|part| part.lower_bound(cell))
    }

    fn upper_bound(&self, cell: Rect) -> f64 {
        self.lowest(|part| part.upper_bound(cell))
    }
}

/// f(x) = factor · g(x): the cheapest way to a smaller Lipschitz constant.
#[derive(Clone)]
pub struct Scaled {
    factor: f64,
    inner: Arc<dyn Spacing>,
}

impl Scaled {
    /// `factor` in (0, 1].
    pub fn new(factor: f64, inner: Arc<dyn Spacing>) -> Self {
        Self { factor, inner }
    }
}

impl Spacing for Scaled {
    fn at(&self, x: DVec2) -> f64 {
        self.factor * self.inner.at(x)
    }

    fn lipschitz(&self) -> f64 {
        self.factor * self.inner.lipschitz()
    }

    fn lower_bound(&self, cell: Rect) -> f64 {
        self.factor * self.inner.lower_bound(cell)
    }

    fn upper_bound(&self, cell: Rect) -> f64 {
        self.factor * self.inner.upper_bound(cell)
    }
}
