//! How long a mesh took and how much memory, and whether that can be believed.

use super::numbers::{median, quantile};
use super::record::Report;
use serde::{Deserialize, Serialize};

/// Repeats that lie farther apart than this share of their median are of a machine that did other work beside.
pub const BELIEVABLE_SPREAD: f64 = 0.1;

/// Seconds, in all and by the paper's step names, in the order they ran.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Seconds {
    /// From domain and spacing in memory to mesh in memory.
    pub total: f64,
    /// By step.
    pub steps: serde_json::Map<String, serde_json::Value>,
}

/// Time and memory of a mesh that was made alone.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// Of the mesh; of repeats the median, and the steps of the repeat nearest to it.
    pub seconds: Seconds,
    /// Seconds of each repeat of a timed cell.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub samples: Vec<f64>,
    /// Resident memory of the process just before meshing, bytes; 0 where the system does not say.
    pub rss_before_bytes: u64,
    /// Peak resident memory of the process, bytes; 0 where the system does not say.
    pub peak_rss_bytes: u64,
}

impl Times {
    /// Largest minus smallest repeat, over their median; absent for fewer than two.
    pub fn spread(&self) -> Option<f64> {
        if self.samples.len() < 2 {
            return None;
        }
        let end = |q| quantile(self.samples.clone(), q);
        let spread = (end(1.0)? - end(0.0)?) / median(self.samples.clone())?;
        spread.is_finite().then_some(spread)
    }

    /// Whether a page may quote them: at least two repeats, which spread by less than [`BELIEVABLE_SPREAD`].
    pub fn is_believable(&self) -> bool {
        self.spread().is_some_and(|spread| spread < BELIEVABLE_SPREAD)
    }

    /// Why a page does not quote them, in two words.
    pub fn doubt(&self) -> Option<&'static str> {
        match self.samples.len() {
            _ if self.is_believable() => None,
            0 | 1 => Some("run once"),
            _ => Some("busy machine"),
        }
    }
}

impl Report {
    /// Its times, where they can be believed: what pages and charts quote.
    pub fn believable(&self) -> Option<&Times> {
        self.times.as_ref().filter(|times| times.is_believable())
    }

    /// Seconds in all, where they can be believed.
    pub fn believable_seconds(&self) -> Option<f64> {
        Some(self.believable()?.seconds.total)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(samples: &[f64]) -> Times {
        Times {
            samples: samples.to_vec(),
            ..Times::default()
        }
    }

    #[test]
    fn spread_by_hand() {
        assert_eq!(of(&[2.0, 1.0, 4.0]).spread(), Some(1.5));
        assert_eq!(of(&[1.0]).spread(), None);
        assert_eq!(of(&[0.0, 0.0]).spread(), None);
    }

    #[test]
    fn believed_are_two_repeats_near_each_other() {
        assert_eq!(of(&[1.0, 1.09, 1.02]).doubt(), None);
        // Of four the median is 1.05, so that 0.105 is the limit.
        assert_eq!(of(&[1.0, 1.104, 1.05, 1.05]).doubt(), None);
        assert_eq!(of(&[1.0, 1.106, 1.05, 1.05]).doubt(), Some("busy machine"));
        assert_eq!(of(&[1.0]).doubt(), Some("run once"));
        assert!(!of(&[]).is_believable());
    }
}
