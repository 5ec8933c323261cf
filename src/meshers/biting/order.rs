//! The order of bites: which front vertex comes next.
//!
//! The paper leaves it open ("a sharpest nose", §5.1). Every bound holds for every order, but the quality of the meshes
//! differs.

use crate::meshers::biting::front::FrontVertex;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use std::cmp::Reverse;
use std::collections::{BinaryHeap, VecDeque};

/// The order in which front vertices are bitten.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Order {
    /// First come, first bitten: layer by layer from the boundary.
    Fifo,
    /// Last come, first bitten: depth first.
    Lifo,
    /// The front vertex where the uneaten wedge is narrowest.
    Sharpest,
    /// The front vertex where the uneaten wedge is widest.
    Flattest,
    /// The front vertex whose triangle with its two centres is nearest to equilateral, by area over squared edges.
    Equilateral,
    /// The front vertex with the smallest biting circle, that is, the smallest spacing.
    Smallest,
    /// The front vertex with the largest biting circle, that is, the largest spacing.
    #[default]
    Largest,
    /// In random order, by seed.
    Random,
}

impl Order {
    /// All orders, in the order of the docs.
    pub const ALL: [Self; 8] = [
        Self::Fifo,
        Self::Lifo,
        Self::Sharpest,
        Self::Flattest,
        Self::Equilateral,
        Self::Smallest,
        Self::Largest,
        Self::Random,
    ];
}

/// A front vertex in the queue: its slot in the front, and its serial number, by which to check that it is still there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Ticket {
    pub serial: u32,
    pub slot: u32,
}

/// Front vertices waiting to be bitten. Vertices bitten away by others stay until their turn and are then skipped.
pub(super) enum Queue {
    Fifo(VecDeque<Ticket>),
    Lifo(Vec<Ticket>),
    Random(Vec<Ticket>, Box<Pcg64>),
    Ranked(Order, BinaryHeap<Reverse<(i64, Ticket)>>),
}

impl Queue {
    pub fn new(order: Order, seed: u64) -> Self {
        match order {
            Order::Fifo => Self::Fifo(VecDeque::new()),
            Order::Lifo => Self::Lifo(Vec::new()),
            Order::Random => Self::Random(Vec::new(), Box::new(Pcg64::seed_from_u64(seed))),
            ranked => Self::Ranked(ranked, BinaryHeap::new()),
        }
    }

    /// Adds a front vertex and returns its rank, 0 if the order has none; `size` evaluates the spacing there, and is
    /// called only if the order ranks by it.
    pub fn push(&mut self, ticket: Ticket, vertex: &FrontVertex, size: impl FnOnce() -> f64) -> i64 {
        match self {
            Self::Fifo(queue) => queue.push_back(ticket),
            Self::Lifo(stack) | Self::Random(stack, _) => stack.push(ticket),
            Self::Ranked(order, heap) => {
                let rank = rank(*order, vertex, size);
                heap.push(Reverse((rank, ticket)));
                return rank;
            }
        }
        0
    }

    pub fn pop(&mut self) -> Option<Ticket> {
        match self {
            Self::Fifo(queue) => queue.pop_front(),
            Self::Lifo(stack) => stack.pop(),
            Self::Random(stack, random) => {
                (!stack.is_empty()).then(|| stack.swap_remove(random.random_range(0..stack.len())))
            }
            Self::Ranked(_, heap) => heap.pop().map(|Reverse((_, ticket))| ticket),
        }
    }
}

/// Ranks are whole multiples of this.
pub(super) const RANK_STEP: f64 = 1.0 / (1 << 30) as f64;

/// The smallest rank is bitten first. Ranks are rounded to 2⁻³⁰, so that rounding errors do not decide where spacing is
/// uniform: vertices of equal rank are bitten first come, first bitten.
fn rank(order: Order, vertex: &FrontVertex, size: impl FnOnce() -> f64) -> i64 {
    let value = match order {
        Order::Sharpest => vertex.cosine_at_front(),
        Order::Flattest => -vertex.cosine_at_front(),
        Order::Equilateral => -vertex.shape_with_centres(),
        Order::Smallest => size().log2(),
        Order::Largest => -size().log2(),
        Order::Fifo | Order::Lifo | Order::Random => 0.0,
    };
    (value / RANK_STEP).round() as i64
}
