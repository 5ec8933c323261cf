//! Interior biting (§5.1 step 5).

use super::front::Front;
use crate::geometry::DVec2;
use crate::meshers::MeshError;

/// Bites at front vertices, in the order of bites, until the front is empty, and returns all centres in the order
/// they were bitten: input vertices, boundary, interior.
pub(super) fn interior_biting(mut front: Front) -> Result<Vec<DVec2>, MeshError> {
    front.open()?;
    while let Some(vertex) = front.next_vertex() {
        front.bite(vertex)?;
    }
    Ok(front.bitten.discs().map(|disc| disc.centre).collect())
}
