"""What the tests of the adapters share: a writer of size fields, domains, and running an adapter as the runner does."""

import dataclasses
import importlib.metadata
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy

BASELINES = pathlib.Path(__file__).resolve().parent.parent
sys.path.append(str(BASELINES))
import protocol  # noqa: E402


def write_tree(path, box, child, corners):
    """A size field as PROTOCOL.md lays it out: `box` is x, y and side of the root, the others have a row for every cell."""
    with open(path, "wb") as file:
        file.write(b"BITFIELD")
        numpy.array(box, dtype="<f8").tofile(file)
        numpy.array([len(child)], dtype="<u8").tofile(file)
        numpy.array(child, dtype="<i4").tofile(file)
        numpy.array(corners, dtype="<f8").tofile(file)


def write_field(path, box, function, too_coarse):
    """Samples `function` (of n × 2 points) on a quadtree split where `too_coarse(values, sides)` says so of n cells.

    Neither balanced nor continuous where cells of two sizes meet, which fields of the crate are: enough for tests.
    """
    x, y, side = box
    cells, child, corners = numpy.array([[x, y, side]]), [], []
    first = 1  # the number the first child of this level gets
    while len(cells):
        low, sides = cells[:, :2], cells[:, 2]
        values = [function(low + sides[:, None] * corner) for corner in ([0, 0], [1, 0], [0, 1], [1, 1])]
        values = numpy.stack(values, axis=1)
        if not (values > 0.0).all():
            raise ValueError("a size is positive: cells would be split for ever")
        split = too_coarse(values, sides)
        child.append(numpy.where(split, first + 4 * (numpy.cumsum(split) - 1), -1))
        corners.append(values)
        first += 4 * int(split.sum())
        halves = numpy.array([[0, 0], [1, 0], [0, 1], [1, 1]]) * 0.5
        low = (low[split, None, :] + sides[split, None, None] * halves).reshape(-1, 2)
        cells = numpy.column_stack([low, numpy.repeat(0.5 * sides[split], 4)])
    write_tree(path, box, numpy.concatenate(child), numpy.concatenate(corners))


def square(low, high):
    """The corners of a square, counter-clockwise."""
    return [(low, low), (high, low), (high, high), (low, high)]


@dataclasses.dataclass
class Domain:
    """A domain and its area."""

    poly: protocol.Poly
    area: float


SQUARE = square(0.0, 1.0)
PLATE = Domain(
    protocol.Poly(SQUARE + square(0.35, 0.65), [(k, k // 4 * 4 + (k + 1) % 4) for k in range(8)], [(0.5, 0.5)]), 1.0 - 0.3**2
)


@dataclasses.dataclass
class Run:
    """How an adapter ended; without an answer there is no mesh."""

    status: int
    said: str
    answer: dict | None = None
    points: numpy.ndarray | None = None
    triangles: numpy.ndarray | None = None

    def covered(self, start, end):
        """How much of the segment from `start` to `end` is covered by edges of the mesh."""
        corners = self.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
        edges = self.points[numpy.unique(numpy.sort(corners, axis=1), axis=0)] - start
        along = (end - start) / numpy.hypot(*(end - start))
        off = edges[:, :, 0] * along[1] - edges[:, :, 1] * along[0]
        on = edges[(numpy.abs(off) < 1e-12).all(axis=1)] @ along
        inside = numpy.clip(on, 0.0, numpy.hypot(*(end - start)))
        return float(numpy.abs(inside[:, 1] - inside[:, 0]).sum())


class Peer:
    """An adapter that can be run, by the Python that runs the tests."""

    def __init__(self, test, folder, package):
        try:
            self.version = importlib.metadata.version(package)
        except importlib.metadata.PackageNotFoundError:
            test.skipTest(f"{package} is not installed: pip install -r baselines/{folder}/requirements.txt")
        self.adapter = BASELINES / folder / "adapter.py"

    def run(self, poly, size, parameters):
        """Runs the adapter; `size` is as in a request, or a function and the scale of the field it is sampled on."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            poly.write(folder / "domain.poly")
            if isinstance(size, tuple):
                box = (*poly.points.min(axis=0), float(numpy.ptp(poly.points, axis=0).max()))
                write_field(folder / "field", box, size[0], lambda values, sides: sides > 0.5 * values.min(axis=1))
                size = {"field": "field", "scale": size[1]}
            request = {"protocol": 1, "domain": "domain.poly", "size": size, "parameters": parameters}
            request |= {"threads": 1, "seed": 1, "mesh": "mesh", "answer": "answer.json"}
            (folder / "request.json").write_text(json.dumps(request), encoding="utf-8")
            command = [sys.executable, str(self.adapter), "request.json"]
            ended = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=120, check=False)
            if not (folder / "answer.json").exists():
                return Run(ended.returncode, ended.stderr)
            answer = json.loads((folder / "answer.json").read_text(encoding="utf-8"))
            points = numpy.loadtxt(folder / "mesh.node", skiprows=1, usecols=(1, 2))
            triangles = numpy.loadtxt(folder / "mesh.ele", skiprows=1, usecols=(1, 2, 3), dtype=int)
            return Run(ended.returncode, ended.stderr, answer, points, triangles)


@dataclasses.dataclass
class Measured:
    """Figures of a mesh; the median edge is over the size at its middle."""

    area: float
    smallest_area: float
    smallest_angle: float
    shortest_edge: float
    longest_edge: float
    median_edge: float | None


def measure(points, triangles, size):
    """The figures the tests look at."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    doubled = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    angles = [numpy.arctan2(doubled, ((q - p) * (r - p)).sum(axis=1)) for p, q, r in [(a, b, c), (b, c, a), (c, a, b)]]
    edges = numpy.unique(numpy.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    start, end = points[edges[:, 0]], points[edges[:, 1]]
    lengths = numpy.hypot(*(end - start).T)
    return Measured(
        area=0.5 * float(doubled.sum()),
        smallest_area=0.5 * float(doubled.min()),
        smallest_angle=float(numpy.degrees(numpy.min(angles))),
        shortest_edge=float(lengths.min()),
        longest_edge=float(lengths.max()),
        median_edge=float(numpy.median(lengths / size(0.5 * (start + end)))) if size else None,
    )
