"""Gmsh behind a process boundary. See README.md beside this file for its licence, parameters and how it is driven."""

import importlib.metadata
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
import protocol  # noqa: E402  (first: it starts the clock of the imports)
import faces  # noqa: E402
import gmsh  # noqa: E402
import numpy  # noqa: E402

ALGORITHMS = {"meshadapt": 1, "delaunay": 5, "frontal-delaunay": 6, "bamg": 7}


class Geometry:
    """Points and lines of Gmsh's built-in kernel, made when first used: what is outside the domain is never made."""

    def __init__(self, points):
        self.points = points.tolist()
        self.made = set()
        self.lines = {}

    def point(self, vertex):
        """The tag of a vertex."""
        if vertex not in self.made:
            gmsh.model.geo.addPoint(*self.points[vertex], 0.0, tag=vertex + 1)
            self.made.add(vertex)
        return vertex + 1

    def line(self, start, end):
        """The tag of a segment, negative against the direction it was made in."""
        if (end, start) in self.lines:
            return -self.lines[end, start]
        if (start, end) not in self.lines:
            self.lines[start, end] = gmsh.model.geo.addLine(self.point(start), self.point(end))
        return self.lines[start, end]

    def surface(self, face):
        """A plane surface inside the loops of a face, and what is to be embedded in it."""
        loops = []
        for loop in face.loops:
            lines = [self.line(*ends) for ends in zip(loop, loop[1:] + loop[:1])]
            loops.append(gmsh.model.geo.addCurveLoop(lines))
        surface = gmsh.model.geo.addPlaneSurface(loops)
        inner_lines = [abs(self.line(*ends)) for ends in face.inner_segments]
        inner_points = [self.point(vertex) for vertex in face.inner_vertices]
        return surface, inner_lines, inner_points


def build(domain):
    """One plane surface for every face of the domain."""
    geometry = Geometry(domain.points)
    surfaces = [geometry.surface(face) for face in faces.faces(domain)]
    gmsh.model.geo.synchronize()
    for surface, lines, points in surfaces:
        gmsh.model.mesh.embed(1, lines, 2, surface)
        gmsh.model.mesh.embed(0, points, 2, surface)
    return len(surfaces)


def set_up(size, request):
    """Options and the size function; everything else that could change a size is off."""
    options = {
        "General.NumThreads": request["threads"],
        "General.Verbosity": 2,
        "Mesh.Algorithm": ALGORITHMS[request["parameters"]["algorithm"]],
        "Mesh.MeshSizeExtendFromBoundary": 0,
        "Mesh.MeshSizeFromPoints": 0,
        "Mesh.MeshSizeFromCurvature": 0,
        "Mesh.LcIntegrationPrecision": 1e-4,
        "Mesh.RandomSeed": request["seed"],
    }
    gmsh.initialize()
    for name, value in options.items():
        gmsh.option.setNumber(name, value)
    if isinstance(size, protocol.Uniform):
        gmsh.option.setNumber("Mesh.MeshSizeMax", size.size)
    elif request["parameters"]["algorithm"] == "bamg":
        set_view(size)
    else:
        at_point = size.pointwise()
        gmsh.model.mesh.setSizeCallback(lambda _dim, _tag, x, y, _z, _size: at_point(x, y))


def set_view(size):
    """The leaves of the field as a view that gives sizes: BAMG asks a background field, and never the callback."""
    x, y, side, values = size.leaves()
    z = numpy.zeros_like(x)
    corners = [x, x + side, x + side, x, y, y, y + side, y + side, z, z, z, z]
    around = [values[:, 0], values[:, 1], values[:, 3], values[:, 2]]
    view = gmsh.view.add("size")
    gmsh.view.addListData(view, "SQ", len(x), numpy.column_stack(corners + around).ravel())
    field = gmsh.model.mesh.field.add("PostView")
    gmsh.model.mesh.field.setNumber(field, "ViewTag", view)
    gmsh.model.mesh.field.setAsBackgroundMesh(field)


def read_back():
    """Points and triangles; Gmsh's tags of nodes need not follow one another."""
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    index = numpy.zeros(int(tags.max()) + 1, dtype=numpy.int64)
    index[tags] = numpy.arange(len(tags))
    _, corners = gmsh.model.mesh.getElementsByType(gmsh.model.mesh.getElementType("Triangle", 1))
    return coordinates.reshape(-1, 3)[:, :2], index[corners].reshape(-1, 3)


def mesh(domain, size, request):
    """Surfaces, then Gmsh's mesh of them."""
    if size is None:
        raise protocol.Declined("Gmsh needs a size: it has no refinement by angles alone")
    set_up(size, request)
    yield
    surfaces = build(domain)
    gmsh.model.mesh.generate(2)
    points, triangles = read_back()
    yield points, triangles, {"surfaces": surfaces}


if __name__ == "__main__":
    protocol.serve(importlib.metadata.version("gmsh"), mesh)
