"""Triangle behind a process boundary. See README.md beside this file for its licence, parameters and how it is driven."""

import importlib.metadata
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
import protocol  # noqa: E402  (first: it starts the clock of the imports)
import numpy  # noqa: E402
import triangle  # noqa: E402


def pslg(domain):
    """The domain as the package takes it, which refuses empty lists."""
    data = {"vertices": domain.points, "segments": domain.segments, "holes": domain.holes}
    return {name: rows for name, rows in data.items() if len(rows)}


def decimal(number):
    """A number without an exponent: Triangle reads `a1.9e-05` as nothing."""
    return numpy.format_float_positional(number, trim="-")


def quality(angle):
    """The switch for a smallest angle in degrees; 0 asks for none."""
    return f"q{decimal(angle)}" if angle > 0 else ""


def areas_and_centroids(mesh):
    """Of every triangle."""
    a, b, c = (mesh["vertices"][mesh["triangles"][:, k]] for k in range(3))
    u, v = b - a, c - a
    return 0.5 * (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]), (a + b + c) / 3.0


def refine(mesh, angle, size, most):
    """Passes until no triangle is larger than the equilateral one of edge s at its centroid; at most `most` of them."""
    for passes in range(most + 1):
        areas, centroids = areas_and_centroids(mesh)
        wanted = protocol.equilateral_area(size.at(centroids))
        too_large = int((areas > wanted).sum())
        if too_large == 0 or passes == most:
            return mesh, {"passes": passes, "too_large": too_large}
        mesh["triangle_max_area"] = numpy.maximum(wanted, areas / 4.0).reshape(-1, 1)
        mesh = triangle.triangulate(mesh, f"pr{quality(angle)}a")


def mesh(domain, size, request):
    """Angles alone, one area, or passes of areas."""
    angle, most = request["parameters"]["angle"], request["parameters"]["passes"]
    yield
    uniform = isinstance(size, protocol.Uniform)
    largest = f"a{decimal(protocol.equilateral_area(size.size))}" if uniform else ""
    found = triangle.triangulate(pslg(domain), f"p{quality(angle)}{largest}")
    counts = {"passes": 0}
    if isinstance(size, protocol.Field):
        found, counts = refine(found, angle, size, most)
    yield found["vertices"], found["triangles"], counts


if __name__ == "__main__":
    protocol.serve(importlib.metadata.version("triangle"), mesh)
