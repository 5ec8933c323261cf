//! What is tried for a face of the front, and what comes next when it fails.
//!
//! 1. the best apex nearby, if it ranks [`AdvancingFront::accept`] degrees;
//! 2. once all other faces are done: the same, for half of that;
//! 3. the search is widened, without new nodes ([`Tally::widened`]), for a quarter of that;
//! 4. the elements around it are deleted and made anew ([`Front::open_up`]), a bounded number of times at one place;
//! 5. the widest search, for a triangle of any angle that is more than a rounding error.
//!
//! What is then left of the front is closed by force. A triangle never needs more than half of the angles that the
//! front has at the ends of the face: in a narrow input angle no triangle is better.
//!
//! [`AdvancingFront::accept`]: super::AdvancingFront::accept
//! [`Tally::widened`]: super::Tally::widened

use super::candidates::Apex;
use super::front::Front;
use super::ideal_point::Base;
use super::queue::Ticket;

/// The number of attempts at a face. If all fail, the face is closed by force in the end.
pub(super) const ATTEMPTS: u8 = 4;

/// The search radius grows by this factor when it is widened, which happens at most twice.
const WIDER: f64 = 4.0;

/// The last attempt takes what ranks this share of [`AdvancingFront::accept`]: by default one degree, since where a
/// front runs along collinear nodes of the boundary, a smaller share would accept slivers made by rounding errors.
///
/// [`AdvancingFront::accept`]: super::AdvancingFront::accept
const LAST: f64 = 1.0 / 30.0;

/// A face that was picked.
#[derive(Clone, Copy, Debug)]
pub(super) struct Picked {
    pub base: Base,
    ticket: Ticket,
}

#[cfg(test)]
impl Picked {
    pub fn is_cleft(&self) -> bool {
        self.ticket.is_cleft()
    }
}

impl Front<'_> {
    /// The next face of the front to be a base; none if all are done or were tried in vain.
    pub fn pick_face(&mut self) -> Option<Picked> {
        loop {
            let Some(ticket) = self.queue.pop() else {
                if self.begin_row() {
                    continue;
                }
                return None;
            };
            if !self.stands(ticket.edge, ticket.serial) {
                continue;
            }
            let is_due = ticket.is_cleft() || ticket.attempts() == self.edge(ticket.edge).attempts;
            if is_due {
                let base = self.ideal_point(ticket.edge);
                return Some(Picked { base, ticket });
            }
        }
    }

    /// The apex for a face, by the attempt it is at; none if that fails.
    pub fn find_apex(&mut self, picked: &Picked) -> Option<Apex> {
        let (base, accept) = (&picked.base, self.method.accept);
        let reach = self.method.search;
        if picked.ticket.is_cleft() {
            let wedge = base.wedges[1].to_degrees();
            return self.closes_cleft(base, accept.min(0.5 * wedge));
        }
        let wedge = base.wedges[0].min(base.wedges[1]).to_degrees();
        let least = |share: f64| (share * accept).min(0.5 * wedge);
        match picked.ticket.attempts() {
            0 => self.candidates(base, reach, least(1.0), true),
            1 => self.candidates(base, reach, least(0.5), true),
            2 => {
                self.tally.widened += 1;
                self.candidates(base, WIDER * reach, least(0.25), false)
            }
            _ => self.candidates(base, WIDER * WIDER * reach, least(LAST), false),
        }
    }

    /// Notes that an attempt failed and queues the next one.
    pub fn failed(&mut self, picked: &Picked) {
        if picked.ticket.is_cleft() {
            return;
        }
        let edge = picked.base.edge;
        let attempts = self.edge(edge).attempts + 1;
        self.edges[edge as usize].attempts = attempts;
        if attempts + 1 == ATTEMPTS && self.open_up(&picked.base) {
            if self.stands(edge, picked.ticket.serial) {
                self.requeue_untried(edge);
            }
        } else if attempts < ATTEMPTS {
            self.enqueue(edge);
        }
    }
}
