"""PyMeshLab behind a process boundary. See README.md beside this file for its licence, parameters and how it is driven."""

import importlib.metadata
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
import protocol  # noqa: E402  (first: it starts the clock of the imports)
import numpy  # noqa: E402
import pymeshlab  # noqa: E402
import start  # noqa: E402


def mesh(domain, size, request):
    """Isotropic remeshing of the domain, lying flat in space, to one edge length."""
    if size is None:
        raise protocol.Declined("PyMeshLab needs a size: it has no refinement by angles alone")
    if isinstance(size, protocol.Field):
        raise protocol.Declined("PyMeshLab remeshes to one length: its adaptive mode takes no size at a vertex")
    points, triangles, _ = start.triangulate(domain)
    flat = numpy.column_stack([points, numpy.zeros(len(points))])
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(vertex_matrix=flat, face_matrix=triangles.astype(numpy.int32)))
    yield
    meshes.meshing_isotropic_explicit_remeshing(
        iterations=request["parameters"]["iterations"],
        targetlen=pymeshlab.PureValue(size.size),
        checksurfdist=False,  # the surface is flat: only the boundary could leave it, and that this does not look at
        reprojectflag=False,
    )
    found = meshes.current_mesh()
    yield found.vertex_matrix()[:, :2], found.face_matrix(), {"start_triangles": len(triangles)}


if __name__ == "__main__":
    protocol.serve(importlib.metadata.version("pymeshlab"), mesh)
