"""The faces of a domain, for meshers that want surfaces bounded by loops rather than segments and hole points.

The segments divide the plane; the domain is the faces that are bounded and hold no hole point. A segment with the same face on
both sides (a crack, or a bridge between two loops) bounds nothing: it is *inner*, as an isolated vertex is.
"""

import dataclasses

import numpy

OUTSIDE = -1


@dataclasses.dataclass
class Face:
    """A piece of the domain: it lies to the left of each of its loops, the outer one first."""

    loops: list  # of lists of vertices; a vertex where a loop touches itself stands in it more than once
    inner_segments: list  # of pairs of vertices, in no loop
    inner_vertices: list  # in no segment


class Subdivision:
    """The loops of a set of segments, and which of them is met first above a point."""

    def __init__(self, points, segments):
        self.points = points
        # half-edge 2 k goes along segment k, half-edge 2 k + 1 back
        self.origin = segments.reshape(-1)
        self.loop_of, self.loops = self._trace()
        self.doubled_areas = [self._doubled_area(loop) for loop in self.loops]
        self._left_to_right(segments)

    def _trace(self):
        """Each half-edge's loop, and each loop as its vertices in order; what it bounds is on its left."""
        origin = self.origin
        twin = numpy.arange(len(origin)) ^ 1
        along = self.points[origin[twin]] - self.points[origin]
        turn = numpy.arctan2(along[:, 1], along[:, 0])
        around = numpy.lexsort((turn, origin))  # by vertex, and there counter-clockwise
        first = numpy.searchsorted(origin[around], numpy.arange(len(self.points)))
        place = numpy.empty_like(around)
        place[around] = numpy.arange(len(around))
        last = numpy.searchsorted(origin[around], origin, side="right") - 1
        clockwise = around[numpy.where(place == first[origin], last, place - 1)]
        following = clockwise[twin].tolist()

        loop_of, loops = [None] * len(origin), []
        for start in range(len(origin)):
            edge, loop = start, []
            while loop_of[edge] is None:
                loop_of[edge] = len(loops)
                loop.append(int(origin[edge]))
                edge = following[edge]
            if loop:
                loops.append(loop)
        return numpy.array(loop_of, dtype=int), loops

    def _doubled_area(self, loop):
        """Twice the signed area; vertices relative to one of them, lest a far origin drowns it."""
        x, y = (self.points[loop] - self.points[loop[0]]).T
        return float(numpy.sum(x * numpy.roll(y, -1) - numpy.roll(x, -1) * y))

    def _left_to_right(self, segments):
        """Every segment that is not upright as its left end, its right end and the half-edge with what is below on its left."""
        forward = self.points[segments[:, 0], 0] < self.points[segments[:, 1], 0]
        left, right = (self.points[numpy.where(forward, segments[:, k], segments[:, 1 - k])] for k in range(2))
        keep = left[:, 0] < right[:, 0]
        self.left, self.right = left[keep], right[keep]
        self.slope = (self.right[:, 1] - self.left[:, 1]) / (self.right[:, 0] - self.left[:, 0])
        self.under = (2 * numpy.arange(len(segments)) + forward)[keep]

    def loop_above(self, point):
        """The loop that bounds from above what lies over `point`, or None where nothing is over it."""
        x, y = point
        across = numpy.flatnonzero((self.left[:, 0] <= x) & (x < self.right[:, 0]))
        left, right, slope = self.left[across], self.right[across], self.slope[across]
        height = numpy.clip(
            left[:, 1] + (x - left[:, 0]) * slope,
            numpy.minimum(left[:, 1], right[:, 1]),
            numpy.maximum(left[:, 1], right[:, 1]),
        )
        over = numpy.flatnonzero(height > y)
        if not over.size:
            return None
        lowest = over[numpy.lexsort((slope[over], height[over]))[0]]
        return int(self.loop_of[self.under[across[lowest]]])

    def outer_loop(self, loop):
        """The outer loop of the face that `loop` bounds, or None where that is the unbounded one."""
        while loop is not None and self.doubled_areas[loop] <= 0.0:
            # the outside of what hangs together: what is over its highest vertex is over all of it
            vertices = self.points[self.loops[loop]]
            loop = self.loop_above(vertices[numpy.argmax(vertices[:, 1])])
        return loop


def faces(domain):
    """The faces of the domain; segments and vertices outside it are in none of them."""
    segments = numpy.unique(numpy.sort(domain.segments, axis=1), axis=0)
    segments = segments[segments[:, 0] != segments[:, 1]]
    loop_of = Subdivision(domain.points, segments).loop_of
    inner = loop_of[0::2] == loop_of[1::2]
    plane = Subdivision(domain.points, segments[~inner])

    holes = {plane.outer_loop(plane.loop_above(point)) for point in domain.holes}
    outer = [k for k in range(len(plane.loops)) if plane.doubled_areas[k] > 0.0 and k not in holes]
    found = {k: Face([plane.loops[k]], [], []) for k in outer}
    for k in range(len(plane.loops)):
        if plane.doubled_areas[k] <= 0.0:
            face = found.get(plane.outer_loop(k))
            if face:
                face.loops.append(plane.loops[k])
    for segment in segments[inner]:
        face = found.get(plane.outer_loop(plane.loop_above(domain.points[segment].mean(axis=0))))
        if face:
            face.inner_segments.append(tuple(segment.tolist()))
    for vertex in numpy.setdiff1d(numpy.arange(len(domain.points)), domain.segments).tolist():
        face = found.get(plane.outer_loop(plane.loop_above(domain.points[vertex])))
        if face:
            face.inner_vertices.append(vertex)
    return list(found.values())
