//! Kinds that turn, scale and move a domain of another kind.

use super::draft::Draft;
use super::{KINDS, PLAIN_KINDS};
use crate::domain::{Fill, Pslg};
use crate::geometry::DVec2;

/// Another kind, turned.
pub(super) fn turned(draft: &mut Draft) {
    another(draft);
    let turn = draft.direction();
    map(&mut draft.pslg, |p| turn.rotate(p));
}

/// Another kind, 1e-9 to 1e9 times as large.
pub(super) fn scaled(draft: &mut Draft) {
    another(draft);
    let scale = draft.power(-9.0, 9.0);
    map(&mut draft.pslg, |p| scale * p);
}

/// Another kind, 1 to 1e9 of its sizes from the origin.
pub(super) fn moved(draft: &mut Draft) {
    another(draft);
    let away = draft.power(0.0, 9.0) * draft.direction();
    map(&mut draft.pslg, |p| p + away);
}

fn another(draft: &mut Draft) {
    let kind = draft.count(0, PLAIN_KINDS - 1);
    (KINDS[kind].draw)(draft);
}

fn map(pslg: &mut Pslg, by: impl Fn(DVec2) -> DVec2) {
    pslg.vertices.iter_mut().for_each(|p| *p = by(*p));
    if let Fill::HolePoints(points) = &mut pslg.fill {
        points.iter_mut().for_each(|p| *p = by(*p));
    }
}
