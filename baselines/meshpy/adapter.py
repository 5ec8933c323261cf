"""MeshPy behind a process boundary. See README.md beside this file for its licence, parameters and how it is driven."""

import importlib.metadata
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
import protocol  # noqa: E402  (first: it starts the clock of the imports)
import meshpy.triangle  # noqa: E402
import numpy  # noqa: E402

SMALLEST_MAX_VOLUME = 1e-14  # MeshPy hands `max_volume` on with twenty decimals: six digits of this are left


def too_large(size):
    """Whether a triangle is larger than the equilateral one with edge s at its centroid, for every triangle MeshPy asks of."""
    at_point = size.pointwise()

    def ask(vertices, area):
        a, b, c = vertices
        return area > protocol.equilateral_area(at_point((a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0))

    return ask


def mesh(domain, size, request):
    """Angles alone, one area, or a question for every triangle."""
    angle = request["parameters"]["angle"]
    options = {"quality_meshing": angle > 0, "min_angle": angle}
    if isinstance(size, protocol.Uniform):
        options["max_volume"] = protocol.equilateral_area(size.size)
        if options["max_volume"] < SMALLEST_MAX_VOLUME:
            raise protocol.Declined(f"largest areas under {SMALLEST_MAX_VOLUME} lose their digits in MeshPy")
    elif size is not None:
        options["refinement_func"] = too_large(size)
    yield
    info = meshpy.triangle.MeshInfo()
    info.set_points(domain.points.tolist())
    info.set_facets(domain.segments.tolist())
    info.set_holes(domain.holes.tolist())
    found = meshpy.triangle.build(info, **options)
    yield numpy.array(found.points), numpy.array(found.elements), {}


if __name__ == "__main__":
    protocol.serve(importlib.metadata.version("meshpy"), mesh)
