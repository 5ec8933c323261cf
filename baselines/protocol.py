"""The protocol of PROTOCOL.md for adapters in Python: request, domain, size field, mesh, answer."""

import json
import resource
import sys
import time

STARTED = time.perf_counter()

import numpy  # noqa: E402  (its import counts as the adapter's)

DECLINED = 4


class Declined(Exception):
    """The peer cannot take this input; the message says why."""


class Field:
    """The background quadtree with nodal values; `scale` times it is the edge length s."""

    def __init__(self, path, scale):
        with open(path, "rb") as file:
            if file.read(8) != b"BITFIELD":
                raise ValueError(f"{path}: not a size field")
            self.x0, self.y0, self.side = numpy.fromfile(file, "<f8", 3).tolist()
            count = int(numpy.fromfile(file, "<u8", 1)[0])
            self.child = numpy.fromfile(file, "<i4", count)
            self.corners = numpy.fromfile(file, "<f8", 4 * count).reshape(count, 4)
        self.corners *= scale
        self._child = self._corners = None

    def at(self, points):
        """s at `points`, an array of n × 2."""
        x = numpy.clip((points[:, 0] - self.x0) / self.side, 0.0, 1.0)
        y = numpy.clip((points[:, 1] - self.y0) / self.side, 0.0, 1.0)
        cell = numpy.zeros(len(points), dtype=numpy.int64)
        inner = numpy.flatnonzero(self.child[cell] >= 0)
        while inner.size:
            x[inner] *= 2.0
            y[inner] *= 2.0
            right, above = x[inner] >= 1.0, y[inner] >= 1.0
            x[inner] -= right
            y[inner] -= above
            cell[inner] = self.child[cell[inner]] + right + 2 * above
            inner = inner[self.child[cell[inner]] >= 0]
        values = self.corners[cell]
        below = values[:, 0] + x * (values[:, 1] - values[:, 0])
        above = values[:, 2] + x * (values[:, 3] - values[:, 2])
        return below + y * (above - below)

    def at_point(self, x, y):
        """s at one point: for callbacks, several times faster than `at` for one."""
        if self._child is None:
            self._child, self._corners = self.child.tolist(), self.corners.tolist()
        x = min(max((x - self.x0) / self.side, 0.0), 1.0)
        y = min(max((y - self.y0) / self.side, 0.0), 1.0)
        cell, first = 0, self._child[0]
        while first >= 0:
            x *= 2.0
            y *= 2.0
            cell = first
            if x >= 1.0:
                x -= 1.0
                cell += 1
            if y >= 1.0:
                y -= 1.0
                cell += 2
            first = self._child[cell]
        a, b, c, d = self._corners[cell]
        below = a + x * (b - a)
        return below + y * (c + x * (d - c) - below)


class Uniform:
    """The same edge length everywhere."""

    def __init__(self, size):
        self.size = size

    def at(self, points):
        """s at `points`, an array of n × 2."""
        return numpy.full(len(points), self.size)

    def at_point(self, _x, _y):
        """s at one point."""
        return self.size


class Poly:
    """A domain: `points` (n × 2), `segments` (m × 2, indices), `holes` (k × 2, a point in each)."""

    def __init__(self, path):
        with open(path, encoding="ascii") as file:
            lines = [line.split("#")[0].split() for line in file]
        rows = iter([line for line in lines if line])

        def section(width, kind):
            count = int(next(rows)[0])
            found = [[kind(word) for word in next(rows)[1 : 1 + width]] for _ in range(count)]
            return numpy.array(found, dtype=kind).reshape(count, width)

        self.points = section(2, float)
        self.segments = section(2, int)
        self.holes = section(2, float)


def write_mesh(stem, points, triangles):
    """Writes STEM.node and STEM.ele, counted from 0, every digit of every coordinate."""
    with open(f"{stem}.node", "w", encoding="ascii") as file:
        file.write(f"{len(points)} 2 0 0\n")
        file.writelines(f"{k} {x!r} {y!r}\n" for k, (x, y) in enumerate(numpy.asarray(points, dtype=float).tolist()))
    with open(f"{stem}.ele", "w", encoding="ascii") as file:
        file.write(f"{len(triangles)} 3 0\n")
        file.writelines(f"{k} {a} {b} {c}\n" for k, (a, b, c) in enumerate(numpy.asarray(triangles).tolist()))


def resident_bytes():
    """Resident memory of this process now."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


def peak_bytes():
    """Peak resident memory of this process, and of the largest of its children beside it."""
    kinds = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    return 1024 * sum(resource.getrusage(kind).ru_maxrss for kind in kinds)


def serve(version, mesh):
    """Answers the request named on the command line.

    `mesh(domain, size, request)` gets a `Poly`, a `Field`, `Uniform` or None, and the request; it is a generator: what it does
    before its first `yield` counts as set-up of the size field, what it does between that and the second, which yields
    (points, triangles, counts), as meshing. It may raise `Declined`.
    """
    seconds = {"imports": time.perf_counter() - STARTED}
    if len(sys.argv) != 2:
        sys.exit("usage: adapter.py REQUEST.json")
    start = time.perf_counter()
    with open(sys.argv[1], encoding="utf-8") as file:
        request = json.load(file)
    domain = Poly(request["domain"])
    seconds["read"] = time.perf_counter() - start
    try:
        start = time.perf_counter()
        asked = request["size"]
        if asked is None:
            size = None
        elif "uniform" in asked:
            size = Uniform(asked["uniform"])
        else:
            size = Field(asked["field"], asked["scale"])
        work = mesh(domain, size, request)
        next(work)
        seconds["size_field"] = time.perf_counter() - start
        before = resident_bytes()
        start = time.perf_counter()
        points, triangles, counts = next(work)
        seconds["mesh"] = time.perf_counter() - start
        work.close()
    except Declined as reason:
        print(reason, file=sys.stderr)
        sys.exit(DECLINED)
    answer = {
        "version": version,
        "seconds": seconds,
        "rss_before_bytes": before,
        "peak_rss_bytes": peak_bytes(),
        "counts": counts,
    }
    write_mesh(request["mesh"], points, triangles)
    with open(request["answer"], "w", encoding="utf-8") as file:
        json.dump(answer, file)
