"""The protocol of PROTOCOL.md for adapters in Python: request, domain, size field, mesh, answer."""

import json
import math
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

    def pointwise(self):
        """A function of x and y that is s at one point, for callbacks: several times faster than `at` for one."""
        child, corners = self.child.tolist(), self.corners.tolist()
        x0, y0, side = self.x0, self.y0, self.side

        def at_point(x, y):
            x = min(max((x - x0) / side, 0.0), 1.0)
            y = min(max((y - y0) / side, 0.0), 1.0)
            cell, first = 0, child[0]
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
                first = child[cell]
            left_below, right_below, left_above, right_above = corners[cell]
            below = left_below + x * (right_below - left_below)
            above = left_above + x * (right_above - left_above)
            return below + y * (above - below)

        return at_point

    def leaves(self):
        """Lower left corners x and y, sides, and values at the corners of the leaves, an array of each."""
        boxes = numpy.empty((len(self.child), 3))
        boxes[0] = self.x0, self.y0, self.side
        level = numpy.flatnonzero(self.child[:1] >= 0)
        while level.size:
            first = self.child[level]
            x, y, side = boxes[level].T
            side = 0.5 * side
            for place, (right, above) in enumerate(((0, 0), (1, 0), (0, 1), (1, 1))):
                boxes[first + place] = numpy.column_stack([x + right * side, y + above * side, side])
            below = (first[:, None] + numpy.arange(4)).ravel()
            level = below[self.child[below] >= 0]
        leaf = self.child < 0
        return *boxes[leaf].T, self.corners[leaf]


class Uniform:
    """The same edge length everywhere."""

    def __init__(self, size):
        self.size = size

    def at(self, points):
        """s at `points`, an array of n × 2."""
        return numpy.full(len(points), self.size)

    def pointwise(self):
        """A function of x and y that is s at one point."""
        return lambda _x, _y: self.size


def equilateral_area(edge):
    """The area of an equilateral triangle: what meshers that bound areas are given for an edge length."""
    return math.sqrt(3.0) / 4.0 * edge**2


class Poly:
    """A domain: `points` (n × 2), `segments` (m × 2, indices), `holes` (k × 2, a point in each)."""

    def __init__(self, points, segments, holes=()):
        self.points = numpy.array(points, dtype=float).reshape(-1, 2)
        self.segments = numpy.array(segments, dtype=int).reshape(-1, 2)
        self.holes = numpy.array(holes, dtype=float).reshape(-1, 2)

    @classmethod
    def read(cls, path):
        """A .poly file counted from 0; attributes and markers are left out."""
        with open(path, encoding="ascii") as file:
            lines = [line.split("#")[0].split() for line in file]
        rows = iter([line for line in lines if line])

        def section(kind):
            count = int(next(rows)[0])
            return [[kind(word) for word in next(rows)[1:3]] for _ in range(count)]

        return cls(section(float), section(int), section(float))

    def write(self, path):
        """Writes a .poly file, counted from 0, every digit of every coordinate."""
        sections = [
            (f"{len(self.points)} 2 0 0", self.points),
            (f"{len(self.segments)} 0", self.segments),
            (f"{len(self.holes)}", self.holes),
        ]
        with open(path, "w", encoding="ascii") as file:
            for header, rows in sections:
                print(header, file=file)
                for number, row in enumerate(rows.tolist()):
                    print(number, *map(repr, row), file=file)


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
    """Peak resident memory of this process, and of the largest of its children beside it.

    Not `ru_maxrss` for this process: Linux hands the peak of the program that started it on through fork and exec, so a small
    peer of a large runner would seem large.
    """
    with open("/proc/self/status", encoding="ascii") as file:
        own = next(int(line.split()[1]) for line in file if line.startswith("VmHWM:"))
    return 1024 * (own + resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)


def serve(version, mesh):
    """Answers the request named on the command line.

    `mesh(domain, size, request)` gets a `Poly`, a `Field`, a `Uniform` or None, and the request; it is a generator: what it does
    before its first `yield` counts as set-up of the size field, what it does between that and the second, which yields
    (points, triangles, counts), as meshing. It may raise `Declined`.
    """
    seconds = {"imports": time.perf_counter() - STARTED}
    if len(sys.argv) != 2:
        sys.exit("usage: adapter.py REQUEST.json")
    start = time.perf_counter()
    with open(sys.argv[1], encoding="utf-8") as file:
        request = json.load(file)
    domain = Poly.read(request["domain"])
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
