//! Which face of the front comes next.
//!
//! Element at a time: clefts first, then the shortest edge, first come first served among equals. Row by row: clefts
//! first, then the edges of the row in order. Edges that could not be closed wait until all others are done.

use super::Advance;
use super::front::Edge;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A face that was picked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Ticket {
    key: u64,
    pub serial: u32,
    pub edge: u32,
}

/// A bit above the order within an attempt: set unless the edge was queued as one side of a cleft.
const IS_BASE: u64 = 1 << 40;
/// The attempt is in the highest bits, so it counts most.
const ATTEMPT_SHIFT: u32 = 41;
/// Lengths that agree to 8 bits of their mantissa are equal, so that rounding does not decide where all edges are alike.
const LENGTH_SHIFT: u32 = 44;

impl Ticket {
    pub fn is_cleft(self) -> bool {
        self.key & IS_BASE == 0
    }

    pub fn attempts(self) -> u8 {
        (self.key >> ATTEMPT_SHIFT) as u8
    }
}

/// The faces of the front that wait. Those that are gone stay until their turn and are then skipped.
pub(super) struct Queue {
    advance: Advance,
    heap: BinaryHeap<Reverse<Ticket>>,
    /// How many edges were queued in rows so far.
    in_row: u64,
}

impl Queue {
    pub fn new(advance: Advance) -> Self {
        Self {
            advance,
            heap: BinaryHeap::new(),
            in_row: 0,
        }
    }

    /// Queues an edge as a base. Row by row, an edge of a coming row waits for [`Self::push_in_row`], unless it was tried.
    pub fn push_base(&mut self, edge: &Edge, slot: u32, length: f64) {
        if self.advance == Advance::Element || edge.attempts > 0 {
            self.push(IS_BASE | rounded(length), edge, slot);
        }
    }

    /// Queues an edge as the next of the row.
    pub fn push_in_row(&mut self, edge: &Edge, slot: u32) {
        self.push(IS_BASE | self.in_row, edge, slot);
        self.in_row += 1;
    }

    pub fn push_cleft(&mut self, edge: &Edge, slot: u32, length: f64) {
        self.push(rounded(length), edge, slot);
    }

    fn push(&mut self, order: u64, edge: &Edge, slot: u32) {
        self.heap.push(Reverse(Ticket {
            key: order | u64::from(edge.attempts) << ATTEMPT_SHIFT,
            serial: edge.serial,
            edge: slot,
        }));
    }

    pub fn pop(&mut self) -> Option<Ticket> {
        self.heap.pop().map(|Reverse(ticket)| ticket)
    }
}

/// The order of a positive length: its exponent and the first bits of its mantissa, rounded.
fn rounded(length: f64) -> u64 {
    (length.to_bits() + (1 << (LENGTH_SHIFT - 1))) >> LENGTH_SHIFT
}
