"""FreeFEM's BAMG behind a process boundary. See README.md beside this file for its licence, parameters and how it is driven."""

import itertools
import json
import math
import pathlib
import shutil
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
import protocol  # noqa: E402  (first: it starts the clock of the imports)
import numpy  # noqa: E402
import start  # noqa: E402

PROGRAM = "FreeFem++"
THETAMAX = 0.001  # degrees: where segments turn by more there is a corner, where by less BAMG rounds it
RATIO = 0.0  # no smoothing of the metric: the sizes are as they shall be
ROOM = 3.0  # adaptmesh is given room for so many times the points expected, and clears all of it in every pass


def version():
    """As the program tells of itself, which Debian's 4.11 gives as 4.9."""
    told = subprocess.run([PROGRAM, "-nw", "-v", "1", "/dev/null"], capture_output=True, text=True, check=False).stdout
    return next((word[1:] for word in told.split() if word.startswith("v") and word[1:2].isdigit()), "unknown")


class FreeFem:
    """The program at work on passes.edp, and its answers as they come."""

    def __init__(self):
        command = [PROGRAM, "-nw", "-v", "0", str(HERE / "passes.edp")]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def tell(self, words):
        """Sends words, a line each."""
        try:
            self.process.stdin.write("\n".join(map(repr, words)) + "\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            pass  # it ended: what it said is read next

    def expect(self, name):
        """The word after `name` on the next line, if any."""
        line = self.process.stdout.readline()
        words = line.split()
        if words[:1] != [name]:
            rest = self.process.stdout.read().strip()
            raise RuntimeError(f"FreeFEM was to say {name!r} and said: {line.strip()} {rest[-500:]}")
        return words[1] if len(words) > 1 else None

    def rows(self, name, kind):
        """The rows announced by `name`."""
        count = int(self.expect(name))
        lines = itertools.islice(self.process.stdout, count)
        return numpy.loadtxt(lines, dtype=kind, ndmin=2)


def expected_points(domain, size):
    """How many points a mesh of equilateral triangles of these sizes has in the domain's box."""
    low, high = domain.points.min(axis=0), domain.points.max(axis=0)
    if isinstance(size, protocol.Uniform):
        squares = numpy.prod(high - low) / size.size**2
    else:
        side = numpy.full(len(size.child), size.side)
        inner = numpy.array([0])[size.child[:1] >= 0]
        while inner.size:
            children = (size.child[inner, None] + numpy.arange(4)).ravel()
            side[children] = numpy.repeat(0.5 * side[inner], 4)
            inner = children[size.child[children] >= 0]
        leaf = size.child < 0
        squares = numpy.sum((side[leaf] / size.corners[leaf].min(axis=1)) ** 2)
    return len(domain.points) + int(squares * 2.0 / math.sqrt(3.0))


def write_start(domain):
    """The constrained Delaunay triangulation of the domain as FreeFEM reads it, counted from 1."""
    points, triangles, edges = start.triangulate(domain)
    with open("start.msh", "w", encoding="ascii") as file:
        print(len(points), len(triangles), len(edges), file=file)
        file.writelines(f"{x!r} {y!r} 0\n" for x, y in points.tolist())
        file.writelines(f"{a} {b} {c} 0\n" for a, b, c in (triangles + 1).tolist())
        file.writelines(f"{a} {b} 1\n" for a, b in (edges + 1).tolist())
    return len(triangles)


def mesh(domain, size, request):
    """Passes of adaptmesh, each to the sizes at the points that the one before left."""
    if shutil.which(PROGRAM) is None:
        raise RuntimeError("FreeFem++ is not on the path: apt-get install freefem++")
    if size is None:
        raise protocol.Declined("BAMG needs a size: it has no refinement by angles alone")
    passes = request["parameters"]["passes"]
    counts = {"start_triangles": write_start(domain)}
    freefem = FreeFem()
    room = 10_000 + int(ROOM * expected_points(domain, size))
    freefem.tell([passes, THETAMAX, RATIO, room])
    freefem.expect("ready")
    yield
    evaluation = 0.0
    for _ in range(passes):
        points = freefem.rows("points", float)
        freefem.expect("sizes")
        begin = time.perf_counter()
        metric = size.at(points) ** -2.0
        evaluation += time.perf_counter() - begin
        freefem.tell(metric.tolist())
    points, triangles = freefem.rows("points", float), freefem.rows("triangles", int)
    counts["seconds_adaptmesh"], counts["seconds_sizes"] = float(freefem.expect("seconds")), evaluation
    if freefem.process.wait() != 0:
        raise RuntimeError(f"FreeFEM ended with status {freefem.process.returncode}")
    yield points, triangles, counts


def without_the_pipe():
    """Takes the talk between the two programs, which a program that held both would not need, out of the answer's time."""
    with open(sys.argv[1], encoding="utf-8") as file:
        path = pathlib.Path(json.load(file)["answer"])
    answer = json.loads(path.read_text(encoding="utf-8"))
    answer["seconds"]["mesh"] = answer["counts"]["seconds_adaptmesh"] + answer["counts"]["seconds_sizes"]
    path.write_text(json.dumps(answer), encoding="utf-8")


if __name__ == "__main__":
    protocol.serve(version(), mesh)
    without_the_pipe()
