"""Netgen behind a process boundary. See README.md beside this file for its licence, parameters and how it is driven."""

import importlib.metadata
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
import protocol  # noqa: E402  (first: it starts the clock of the imports)
import faces  # noqa: E402
import numpy  # noqa: E402
from netgen.geom2d import SplineGeometry  # noqa: E402
from netgen.meshing import MeshingParameters  # noqa: E402


def sample(size, domain, density):
    """Points that cover the domain's box, `density` of them an edge length s in each direction or a little more, and s there.

    They are the middles of the leaves of a quadtree that is split where a leaf is larger than s / density.
    """
    low, high = domain.points.min(axis=0), domain.points.max(axis=0)
    side = float((high - low).max())
    middles, found = numpy.array([low + 0.5 * side]), []
    while len(middles):
        s = size.at(middles)
        split = side > s / density
        found.append(numpy.column_stack([middles, s])[~split])
        side *= 0.5
        steps = 0.5 * side * numpy.array([[-1, -1], [1, -1], [-1, 1], [1, 1]])
        middles = (middles[split, None, :] + steps).reshape(-1, 2)
        middles = middles[(middles - 0.5 * side <= high).all(axis=1)]
    return numpy.concatenate(found)


def build(domain):
    """The domain as Netgen's splines: every segment with the number of the face on either side of it, 0 outside."""
    found = faces.faces(domain)
    if any(face.inner_vertices for face in found):
        raise protocol.Declined("Netgen meshes no isolated vertex: it leaves out those that are on no spline")
    sides = {}
    for number, face in enumerate(found, start=1):
        for loop in face.loops:
            for start, end in zip(loop, loop[1:] + loop[:1]):
                sides[start, end] = number
        for start, end in face.inner_segments:
            sides[start, end] = sides[end, start] = number
    geometry = SplineGeometry()
    used = sorted({vertex for ends in sides for vertex in ends})
    index = {vertex: geometry.AppendPoint(*domain.points[vertex].tolist()) for vertex in used}
    for (start, end), left in sides.items():
        right = sides.get((end, start), 0)
        if right == 0 or start < end:
            geometry.Append(["line", index[start], index[end]], leftdomain=left, rightdomain=right)
    return geometry, len(found)


def mesh(domain, size, request):
    """The largest edge or restrictions at points, then Netgen's mesh and its optimisation."""
    if size is None:
        raise protocol.Declined("Netgen needs a size: it has no refinement by angles alone")
    asked = request["parameters"]
    given = {"maxh": size.size} if isinstance(size, protocol.Uniform) else {}
    options = MeshingParameters(grading=asked["grading"], optsteps2d=asked["optimise"], **given)
    samples = [] if given else sample(size, domain, asked["density"]).tolist()
    for x, y, s in samples:
        options.RestrictH(x, y, 0.0, s)
    yield
    geometry, count = build(domain)
    found = geometry.GenerateMesh(mp=options)
    triangles = found.Elements2D().NumPy()["nodes"][:, :3] - 1
    points = found.Coordinates()[:, :2].copy()  # a view into the mesh, which ends with this function
    yield points, triangles, {"faces": count, "restrictions": len(samples)}


if __name__ == "__main__":
    protocol.serve(importlib.metadata.version("netgen-mesher"), mesh)
