//! Bad triangles, shortest edge first, in buckets as in the classical programs: constant time per triangle.

use super::triangles::Flaw;
use std::collections::VecDeque;

/// A triangle in the queue: its number, its corners, which show whether it is still there, and what is wrong with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Ticket {
    pub triangle: u32,
    pub corners: [u32; 3],
    pub flaw: Flaw,
}

/// Buckets are numbered by the exponent and the first bit of the mantissa of a squared length, so there are two per
/// factor of √2 in length.
const BUCKETS: usize = 1 << 12;

/// Tickets by shortest edge; first come, first served within a bucket.
pub(super) struct Queue {
    buckets: Vec<VecDeque<Ticket>>,
    /// One bit per bucket: whether it holds something.
    occupied: [u64; BUCKETS / 64],
}

impl Queue {
    pub fn new() -> Self {
        Self {
            buckets: vec![VecDeque::new(); BUCKETS],
            occupied: [0; BUCKETS / 64],
        }
    }

    /// Adds a triangle whose shortest edge has this length, squared.
    pub fn push(&mut self, ticket: Ticket, length_squared: f64) {
        let bucket = (length_squared.to_bits() >> 51) as usize % BUCKETS;
        self.buckets[bucket].push_back(ticket);
        self.occupied[bucket / 64] |= 1 << (bucket % 64);
    }

    pub fn pop(&mut self) -> Option<Ticket> {
        let word = self.occupied.iter().position(|&word| word != 0)?;
        let bit = self.occupied[word].trailing_zeros();
        let bucket = &mut self.buckets[64 * word + bit as usize];
        let ticket = bucket.pop_front();
        if bucket.is_empty() {
            self.occupied[word] &= !(1 << bit);
        }
        ticket
    }
}
