"""The triangulation that remeshers begin with: constrained Delaunay by the package `pythoncdt`, no point added."""

import protocol
import numpy
import pythoncdt


def triangulate(domain):
    """Points, triangles and edges on segments; outside and holes are cut away, and the points that are left alone.

    Counter-clockwise triangles; a segment that runs through points of the domain comes as several edges.
    """
    cdt = pythoncdt.Triangulation(
        pythoncdt.VertexInsertionOrder.AUTO, pythoncdt.IntersectingConstraintEdges.NOT_ALLOWED, 0.0
    )
    cdt.insert_vertices(numpy.ascontiguousarray(domain.points))
    try:
        cdt.insert_edges(numpy.ascontiguousarray(domain.segments, dtype=numpy.uint32))
    except RuntimeError as error:
        raise protocol.Declined(f"no constrained triangulation to start from: {error}") from error
    cdt.erase_super_triangle()
    found = cdt.triangles_array()
    triangles = found["vertices"].astype(numpy.int64)
    fixed = {tuple(sorted((edge.v1, edge.v2))) for edge in cdt.fixed_edges_iter()}
    inside = ~_outside(domain, triangles, found["neighbors"].tolist(), fixed)
    triangles = triangles[inside]

    used = numpy.unique(triangles)
    index = numpy.full(len(domain.points), -1)
    index[used] = numpy.arange(len(used))
    edges = index[numpy.array(sorted(fixed)).reshape(-1, 2)]
    return domain.points[used], index[triangles], edges[(edges >= 0).all(axis=1)]


def _outside(domain, triangles, neighbours, fixed):
    """Which triangles a path from infinity or from a hole's point reaches without crossing a segment.

    The neighbour k of a triangle is over its edge from corner k to the next.
    """
    corners = triangles.tolist()

    def open_sides(t):
        for k, neighbour in enumerate(neighbours[t]):
            if tuple(sorted((corners[t][k], corners[t][(k + 1) % 3]))) not in fixed:
                yield neighbour

    within = range(len(corners))
    to_visit = [t for t in within if any(neighbour not in within for neighbour in open_sides(t))]
    to_visit += [t for hole in domain.holes for t in _holding(domain.points[triangles], hole)]
    outside = numpy.zeros(len(corners), dtype=bool)
    while to_visit:
        t = to_visit.pop()
        if not outside[t]:
            outside[t] = True
            to_visit.extend(neighbour for neighbour in open_sides(t) if neighbour in within)
    return outside


def _holding(corners, point):
    """The triangles (n × 3 × 2, counter-clockwise) that have `point` inside or on an edge."""
    along = numpy.roll(corners, -1, axis=1) - corners
    towards = point - corners
    left = along[:, :, 0] * towards[:, :, 1] >= along[:, :, 1] * towards[:, :, 0]
    return numpy.flatnonzero(left.all(axis=1)).tolist()
