//! Interior biting (§5.1 step 5).

use crate::geometry::DVec2;
use crate::meshers::MeshError;
use crate::meshers::biting::front::Front;

/// Bites at front vertices, in the order of bites, until the front is empty. Returns the mesh vertices: the input's,
/// then all other centres in the order in which they were bitten, boundary first.
pub(super) fn interior_biting(front: &mut Front) -> Result<Vec<DVec2>, MeshError> {
    front.open()?;
    while let Some(vertex) = front.next_vertex() {
        front.bite(vertex)?;
    }
    Ok(front.centres())
}
