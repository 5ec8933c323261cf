"""mmg2d behind a process boundary. See README.md beside this file for its licence, parameters and how it is driven."""

import importlib.metadata
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
import protocol  # noqa: E402  (first: it starts the clock of the imports)
import mmgpy  # noqa: E402
import numpy  # noqa: E402
import start  # noqa: E402

SAMPLES = 1000  # of the size along a segment
OFF = -1.0  # for a gradation: the sizes are as they shall be
ROUNDING = 1e-14  # of the domain's box: by how much mmg, which works in a unit box, may return a required vertex off its place


def two_sided(triangles, edges):
    """Which of the edges have a triangle on both sides."""
    sides = numpy.sort(numpy.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    code = triangles.max() + 1
    numbers, uses = numpy.unique(sides[:, 0] * code + sides[:, 1], return_counts=True)
    low, high = numpy.sort(edges, axis=1).T
    return numpy.isin(low * code + high, numbers[uses == 2])


def pieces(begin, end, size):
    """The points that cut the segment into pieces of length about s, their number rounded."""
    fraction = numpy.linspace(0.0, 1.0, SAMPLES + 1)
    middles = begin + 0.5 * (fraction[1:] + fraction[:-1])[:, None] * (end - begin)
    in_sizes = numpy.linalg.norm(end - begin) / SAMPLES / size.at(middles)
    lengths = numpy.concatenate([[0.0], numpy.cumsum(in_sizes)])
    count = max(1, round(lengths[-1]))
    cuts = numpy.interp(numpy.arange(1, count) / count * lengths[-1], lengths, fraction)
    return begin + cuts[:, None] * (end - begin)


def set_up(domain, size):
    """The start with all segments cut to size, which of its edges are inner, and how many points are the domain's: the first."""
    points, _, edges = start.triangulate(domain)
    corners = len(points)
    chains = []
    for begin, end in edges.tolist():
        cuts = pieces(points[begin], points[end], size)
        chain = [begin, *range(len(points), len(points) + len(cuts)), end]
        points = numpy.concatenate([points, cuts])
        chains.append(numpy.column_stack([chain[:-1], chain[1:]]))
    points, triangles, edges = start.triangulate(protocol.Poly(points, numpy.concatenate(chains), domain.holes))
    return points, triangles, edges, two_sided(triangles, edges), corners


def remesh(points, triangles, edges, inner, corners, size):
    """One pass: points, triangles and edges on segments, from those and the sizes at `points`."""
    mesh = mmgpy.MmgMesh2D()
    mesh.set_mesh_size(len(points), len(triangles), 0, len(edges))
    mesh.set_vertices(points)
    mesh.set_triangles(triangles.astype(numpy.int32))
    mesh.set_edges(edges.astype(numpy.int32))
    mesh.set_corners(corners)
    mesh.set_required_vertices(corners)
    mesh.set_required_edges(numpy.flatnonzero(inner).astype(numpy.int32))
    mesh["metric"] = size.at(points).reshape(-1, 1)
    mesh.remesh(hgrad=OFF, hgradreq=OFF, verbose=-1)
    return mesh.get_vertices(), mesh.get_triangles(), mesh.get_edges()


def put_back(points, required):
    """Undoes the rounding of required vertices, which are the first points; one that moved by more stays where mmg put it."""
    allowed = ROUNDING * numpy.ptp(required, axis=0).max()
    off = numpy.abs(points[: len(required)] - required).max(axis=1)
    points[: len(required)][off <= allowed] = required[off <= allowed]


def mesh(domain, size, request):
    """Passes of remeshing, each to the sizes at the points that the one before left."""
    if size is None:
        raise protocol.Declined("mmg needs a size: it has no refinement by angles alone")
    points, triangles, edges, inner, count = set_up(domain, size)
    corners = numpy.arange(count, dtype=numpy.int32)  # which stay the first points of every pass
    required = points[:count].copy()
    counts = {"start_triangles": len(triangles)}
    yield
    for _ in range(request["parameters"]["passes"]):
        points, triangles, edges = remesh(points, triangles, edges, inner, corners, size)
        put_back(points, required)
        inner = two_sided(triangles, edges)
    yield points, triangles, counts


if __name__ == "__main__":
    protocol.serve(importlib.metadata.version("mmgpy"), mesh)
