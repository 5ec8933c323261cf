//! Why a check that does not hold is no fault: what the tables say of its hypotheses.

use super::read::method;
use crate::quality::Check;
use crate::suite::rows::record::{Report, Row};
use crate::theory::Hypotheses;

/// The hypotheses of a broken claim that a cell does not meet, as far as its line shows them; `corners` where it is none of these:
/// what the claim needs of corners is seen in the domain alone. Empty where the check applies, absent where the method promises
/// nothing of the claim.
pub(super) fn cause(row: &Row, report: &Report, check: &Check) -> Option<String> {
    if check.applies {
        return Some(String::new());
    }
    let method = method(&row.cell);
    let promises = method.as_ref().map(|method| method.guarantees()).unwrap_or_default();
    let promise = promises.iter().find(|promise| promise.claim == check.claim)?;
    let seen = Hypotheses {
        t: report.t_effective,
        c_b: report.c_b,
        rule: method.map(|method| method.rule()).unwrap_or_default(),
        lfs_cap: report.lfs_cap,
        smallest_segment_angle_deg: report.smallest_segment_angle_deg,
        low_head_on: report.certificate.low_head_on,
        single_corners: true,
        is_geodesic: row.cell.spacing.contains("geodesic"),
        corners_hide: false,
    };
    let mut unmet = seen.unmet(check.claim);
    if promise.plain {
        unmet.extend(seen.not_plain());
    }
    unmet.dedup();
    Some(if unmet.is_empty() {
        "corners".into()
    } else {
        unmet.join("; ")
    })
}
