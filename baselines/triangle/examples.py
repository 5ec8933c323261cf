"""Triangle by hand, for .ci/check_refinement: its example inputs, and meshes by its own switches. See README.md."""

import json
import pathlib
import sys

import numpy
import triangle
from adapter import pslg

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from protocol import Poly  # noqa: E402


def smallest_angle(points, triangles):
    """The smallest angle of all triangles in degrees."""
    corners = points[triangles]
    smallest = 180.0
    for k in range(3):
        u = corners[:, (k + 1) % 3] - corners[:, k]
        v = corners[:, (k + 2) % 3] - corners[:, k]
        cross = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
        smallest = min(smallest, numpy.degrees(numpy.arctan2(cross, (u * v).sum(axis=1))).min())
    return smallest


def main(arguments):
    """One of the two commands of README.md."""
    if len(arguments) == 3 and arguments[0] == "input":
        data = triangle.get_data(arguments[1])
        Poly(data["vertices"], data["segments"], data.get("holes", [])).write(arguments[2])
        return
    if len(arguments) == 3 and arguments[0] == "mesh":
        mesh = triangle.triangulate(pslg(Poly.read(arguments[1])), arguments[2])
        answer = {
            "triangles": len(mesh["triangles"]),
            "vertices": len(mesh["vertices"]),
            "min_angle_deg": smallest_angle(mesh["vertices"], mesh["triangles"]),
        }
        print(json.dumps(answer))
        return
    sys.exit("usage: examples.py input NAME OUT.poly | examples.py mesh IN.poly SWITCHES")


if __name__ == "__main__":
    main(sys.argv[1:])
