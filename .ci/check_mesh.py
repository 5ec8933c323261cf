#!/usr/bin/env python3
"""Independent check of a triangle mesh (.node and .ele) against its domain (.poly).

    "$(.ci/python)" .ci/check_mesh.py DOMAIN.poly MESH_STEM [--min-angle DEGREES]

It is written from the definitions alone, apart from the meshers and the certificate that it checks:
 - every triangle is positively oriented and none is there twice; an edge is used at most once in each direction;
 - the mesh covers the domain and nothing else: its area is that of the bounded faces of the input segments that hold no
   hole point (relative 1e-9);
 - every input vertex in the domain is a mesh vertex; every input segment is a chain of mesh edges;
 - boundary edges (used once) all lie on input segments; every mesh vertex is in a triangle;
 - angles and radius-edge ratios. An input angle under 60 degrees that opens into the domain makes its vertex acute:
   min_angle_free leaves out the triangles that touch an acute vertex, and `excused` counts them.
It prints one JSON object. The exit status is 1 where `bad` lists anything.
"""

import argparse
import json
import math
import sys

import numpy as np
import shapely
from scipy.spatial import cKDTree
from shapely.ops import polygonize

ACUTE_DEG = 60.0


def lines(path):
    """The words of each line that has any, comments left out."""
    with open(path) as file:
        for line in file:
            words = line.split("#")[0].split()
            if words:
                yield words


def read_points(rows, count):
    """Row of each point by its number in the file, and the points as an array of two columns."""
    row_of, points = {}, np.empty((count, 2))
    for k in range(count):
        words = next(rows)
        row_of[int(words[0])] = k
        points[k] = float(words[1]), float(words[2])
    return row_of, points


def read_node(path):
    rows = lines(path)
    return read_points(rows, int(next(rows)[0]))


def read_poly(path):
    """Points, segments as sorted pairs of rows, hole points."""
    rows = lines(path)
    count = int(next(rows)[0])
    row_of, points = read_points(rows, count) if count else read_node(path.removesuffix(".poly") + ".node")
    segments = set()
    for _ in range(int(next(rows)[0])):
        words = next(rows)
        ends = row_of[int(words[1])], row_of[int(words[2])]
        if ends[0] != ends[1]:
            segments.add((min(ends), max(ends)))
    holes = []
    for _ in range(int(next(rows, ["0"])[0])):
        words = next(rows)
        holes.append((float(words[1]), float(words[2])))
    return points, sorted(segments), np.array(holes).reshape(-1, 2)


def read_mesh(stem):
    row_of, points = read_node(stem + ".node")
    rows = lines(stem + ".ele")
    count = int(next(rows)[0])
    triangles = [[row_of[int(word)] for word in next(rows)[1:4]] for _ in range(count)]
    return points, np.array(triangles, int).reshape(-1, 3)


def cross(u, v):
    return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]


def angles_deg(u, v):
    return np.degrees(np.arctan2(np.abs(cross(u, v)), (u * v).sum(1)))


def domain_of(points, segments, holes):
    """The domain as one region: the bounded faces of the segments that hold no hole point; and its area."""
    faces = polygonize(shapely.linestrings(points[np.array(segments)]))
    holes = shapely.points(holes)
    faces = [face for face in faces if not any(shapely.contains(face, hole) for hole in holes)]
    region = shapely.unary_union(faces)
    shapely.prepare(region)
    return region, float(sum(face.area for face in faces))


class Edges:
    """The mesh's edges, each with its number of uses, and the neighbours of each vertex."""

    def __init__(self, triangles, vertices):
        self.directed = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
        self.edges, self.uses = np.unique(np.sort(self.directed, 1), axis=0, return_counts=True)
        first, second = self.edges[:, 0], self.edges[:, 1]
        ends = np.concatenate([first, second])
        self.others = np.concatenate([second, first])[np.argsort(ends, kind="stable")]
        self.start = np.searchsorted(np.sort(ends), np.arange(vertices + 1))

    def around(self, vertex):
        return self.others[self.start[vertex] : self.start[vertex + 1]]


def chain(edges, points, start, end, ulp):
    """The mesh edges along the segment from vertex `start` to vertex `end`; None where there is a gap."""
    found, at, goal = [], start, points[end]
    direction = (goal - points[start]) / np.linalg.norm(goal - points[start])
    while at != end:
        others = edges.around(at)
        away = points[others] - points[at]
        along, off = away @ direction, np.abs(away[:, 0] * direction[1] - away[:, 1] * direction[0])
        left = float((goal - points[at]) @ direction)
        fits = (along > 0) & (along <= left * (1 + 1e-12) + ulp) & (off <= 1e-9 * along + ulp)
        if not fits.any():
            return None
        following = int(others[fits][np.argmin(off[fits] / along[fits])])
        found.append((min(at, following), max(at, following)))
        at = following
    return found


def acute_vertices(points, segments, region):
    """Rows of the input vertices at which an angle under 60 degrees opens into the domain."""
    around = {}
    for i, j in segments:
        around.setdefault(i, []).append(j)
        around.setdefault(j, []).append(i)
    acute = set()
    for vertex, others in around.items():
        arms = [points[other] - points[vertex] for other in others]
        arms = sorted((math.atan2(arm[1], arm[0]), float(np.linalg.norm(arm))) for arm in arms)
        if len(arms) < 2:
            continue
        for (low, one), (high, other) in zip(arms, arms[1:] + arms[:1]):
            angle = (high - low) % (2 * math.pi)
            if 1e-12 < angle < math.radians(ACUTE_DEG) - 1e-9:
                middle, near = low + angle / 2, 1e-4 * min(one, other)
                if shapely.contains_xy(region, *(points[vertex] + near * np.array([math.cos(middle), math.sin(middle)]))):
                    acute.add(vertex)
    return acute


def check(domain, mesh, min_angle=None):
    """The numbers of a mesh; what is wrong with it is in `bad`."""
    points, segments, holes = read_poly(domain)
    vertices, triangles = read_mesh(mesh)
    ulp = 4 * np.spacing(max(np.abs(points).max(), np.abs(vertices).max()))
    origin = points.mean(0)
    points, vertices, holes = points - origin, vertices - origin, holes - origin
    region, area_wanted = domain_of(points, segments, holes)
    edges = Edges(triangles, len(vertices))
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    doubled = cross(b - a, c - a)
    area = float(doubled.sum() / 2)
    bad = []

    # triangles
    if (doubled <= 0).any():
        bad.append(f"{int((doubled <= 0).sum())} triangles not positively oriented")
    if len(np.unique(np.sort(triangles, 1), axis=0)) != len(triangles):
        bad.append("a triangle is there twice")
    if len(np.unique(edges.directed, axis=0)) != len(edges.directed):
        bad.append("an edge is used twice in one direction")
    if abs(area - area_wanted) > 1e-9 * area_wanted:
        bad.append(f"area {area!r} where the domain has {area_wanted!r}")
    used = len(np.unique(triangles))
    if used < len(vertices):
        bad.append(f"{len(vertices) - used} mesh vertices in no triangle")

    # input vertices
    distance, nearest = cKDTree(vertices).query(points)
    is_wanted = shapely.contains_properly(region, shapely.points(points))
    is_wanted[np.unique(np.array(segments))] = True
    lost = is_wanted & (distance > ulp)
    if lost.any():
        bad.append(f"{int(lost.sum())} input vertices are no mesh vertices (first: {int(np.flatnonzero(lost)[0])})")

    # input segments
    on_segments, broken = set(), []
    for i, j in segments:
        if not (lost[i] or lost[j]):
            found = chain(edges, vertices, int(nearest[i]), int(nearest[j]), ulp)
            broken += [(i, j)] if found is None else []
            on_segments.update(found or [])
    if broken:
        bad.append(f"{len(broken)} input segments are no chain of mesh edges (first: {broken[0]})")
    boundary = [tuple(edge) for edge in edges.edges[edges.uses == 1].tolist()]
    stray = [edge for edge in boundary if edge not in on_segments]
    if stray:
        bad.append(f"{len(stray)} boundary edges lie on no input segment (first: {stray[0]})")

    # angles
    angles = np.stack([angles_deg(b - a, c - a), angles_deg(c - b, a - b), angles_deg(a - c, b - c)], 1)
    smallest = angles.min(1)
    lengths = np.stack([np.linalg.norm(side, axis=1) for side in (b - c, c - a, a - b)])
    radius_edge = lengths.prod(0) / (2 * np.maximum(np.abs(doubled), 1e-300)) / lengths.min(0)
    acute = sorted({int(nearest[vertex]) for vertex in acute_vertices(points, segments, region)})
    excused = np.isin(triangles, acute).any(1)
    free = smallest[~excused]
    if min_angle is not None and len(free) and free.min() < min_angle:
        bad.append(f"{int((free < min_angle).sum())} triangles below {min_angle} degrees (smallest {free.min():.3f})")
    return {
        "vertices": len(vertices),
        "triangles": len(triangles),
        "area": area,
        "boundary_edges": len(boundary),
        "euler": used - len(edges.edges) + len(triangles),
        "min_angle": float(smallest.min()),
        "min_angle_free": float(free.min()) if len(free) else None,
        "excused": int(excused.sum()),
        "acute_vertices": len(acute),
        "max_angle": float(angles.max()),
        "mean_min_angle": float(smallest.mean()),
        "p05_min_angle": float(np.percentile(smallest, 5)),
        "max_radius_edge": float(radius_edge.max()),
        "bad": bad,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("domain", metavar="DOMAIN.poly")
    parser.add_argument("mesh", metavar="MESH_STEM")
    parser.add_argument("--min-angle", type=float, metavar="DEGREES")
    given = parser.parse_args()
    numbers = check(given.domain, given.mesh, given.min_angle)
    print(json.dumps(numbers))
    return 1 if numbers["bad"] else 0


if __name__ == "__main__":
    sys.exit(main())
