"""Triangle behind a process boundary. See README.md beside this file for its licence and use."""

import json
import sys

import numpy
import triangle


def write_poly(path, data):
    """Vertices, segments and holes as a .poly file counted from 0."""
    sections = [
        (f"{len(data['vertices'])} 2 0 0", data["vertices"]),
        (f"{len(data['segments'])} 0", data["segments"]),
        (f"{len(data.get('holes', []))}", data.get("holes", [])),
    ]
    with open(path, "w", encoding="ascii") as file:
        for header, rows in sections:
            print(header, file=file)
            for number, row in enumerate(numpy.asarray(rows).tolist()):
                print(number, *map(repr, row), file=file)


def read_poly(path):
    """Vertices, segments and holes of a .poly file counted from 0, attributes and markers left out."""
    with open(path, encoding="ascii") as file:
        lines = [line.split("#")[0].split() for line in file]
    rows = iter([line for line in lines if line])
    data = {}
    for name, width, kind in [("vertices", 2, float), ("segments", 2, int), ("holes", 2, float)]:
        count = int(next(rows)[0])
        found = [[kind(word) for word in next(rows)[1 : 1 + width]] for _ in range(count)]
        if found:
            data[name] = numpy.array(found)
    return data


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
        write_poly(arguments[2], triangle.get_data(arguments[1]))
        return
    if len(arguments) == 3 and arguments[0] == "mesh":
        mesh = triangle.triangulate(read_poly(arguments[1]), arguments[2])
        answer = {
            "triangles": len(mesh["triangles"]),
            "vertices": len(mesh["vertices"]),
            "min_angle_deg": smallest_angle(mesh["vertices"], mesh["triangles"]),
        }
        print(json.dumps(answer))
        return
    sys.exit("usage: adapter.py input NAME OUT.poly | adapter.py mesh IN.poly SWITCHES")


if __name__ == "__main__":
    main(sys.argv[1:])
