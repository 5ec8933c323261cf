"""Every adapter as the runner starts it: a process, a request, files back. Skipped where the peer is not installed."""

import math
import unittest

import numpy
from support import PLATE, SQUARE, Domain, Peer, measure, protocol, square

RING = [(k, (k + 1) % 4) for k in range(4)]


def from_the_hole(points):
    """A size that grows away from the hole of `PLATE`."""
    away = numpy.maximum(numpy.abs(points - 0.5) - 0.15, 0.0)
    return 0.02 + 0.2 * numpy.hypot(away[:, 0], away[:, 1])


class Contract:
    """What holds of every peer; a subclass names it, its parameters and how long its edges are in sizes, at the median."""

    package = folder = ""
    parameters = {}
    median = (0.6, 1.2)
    needs_size = False

    def setUp(self):
        self.peer = Peer(self, self.folder, self.package)

    def accept(self, run, domain, size):
        """The answer is whole and the mesh one of the domain, with edges about as long as asked."""
        self.assertEqual(run.status, 0, run.said)
        self.assertEqual(run.answer["version"], self.peer.version)
        self.assertEqual(sorted(run.answer["seconds"]), ["imports", "mesh", "read", "size_field"])
        self.assertTrue(all(seconds >= 0.0 for seconds in run.answer["seconds"].values()))
        self.assertGreaterEqual(run.answer["peak_rss_bytes"], run.answer["rss_before_bytes"])
        self.assertIsInstance(run.answer["counts"], dict)
        found = measure(run.points, run.triangles, size)
        self.assertGreater(found.smallest_area, 0.0)
        self.assertAlmostEqual(found.area, domain.area, places=12)
        vertices = {tuple(point) for point in run.points.tolist()}
        self.assertEqual([point for point in domain.poly.points.tolist() if tuple(point) not in vertices], [])
        if size:
            low, high = self.median
            self.assertGreater(found.median_edge, low)
            self.assertLess(found.median_edge, high)
        return found

    def test_one_size(self):
        run = self.peer.run(PLATE.poly, {"uniform": 0.05}, self.parameters)
        self.accept(run, PLATE, lambda points: numpy.full(len(points), 0.05))

    def test_a_graded_size(self):
        run = self.peer.run(PLATE.poly, (from_the_hole, 0.5), self.parameters)
        found = self.accept(run, PLATE, lambda points: 0.5 * from_the_hole(points))
        self.assertGreater(found.longest_edge, 3.0 * found.shortest_edge)

    def test_the_same_request_twice(self):
        runs = [self.peer.run(PLATE.poly, {"uniform": 0.1}, self.parameters) for _ in range(2)]
        self.assertEqual(runs[0].points.tolist(), runs[1].points.tolist())
        self.assertEqual(runs[0].triangles.tolist(), runs[1].triangles.tolist())

    def test_no_size(self):
        run = self.peer.run(PLATE.poly, None, self.parameters)
        if self.needs_size:
            self.assertEqual(run.status, protocol.DECLINED)
            self.assertRegex(run.said.splitlines()[-1], "needs a size")
            self.assertIsNone(run.answer)
        else:
            self.accept(run, PLATE, None)

    def test_what_cuts_and_what_hangs(self):
        points = [(0.0, 0.0), (1.0, 0.0), (0.6, 0.5), (1.0, 1.0), (0.0, 1.0), (0.1, 0.5), (0.3, 0.7)]
        poly = protocol.Poly(points, [(0, 1), (1, 2), (2, 3), (3, 4), (4, 0), (0, 2), (5, 6)])
        run = self.peer.run(poly, {"uniform": 0.1}, self.parameters)
        self.accept(run, Domain(poly, 0.8), lambda points: numpy.full(len(points), 0.1))
        for start, end in [(0, 2), (5, 6)]:
            covered = run.covered(poly.points[start], poly.points[end])
            self.assertAlmostEqual(covered, math.dist(poly.points[start], poly.points[end]), places=9)


class OfTriangle:
    """What Triangle and what wraps it have beyond the contract."""

    median = (0.5, 0.95)  # they keep areas under that of an equilateral triangle, so edges are shorter than asked

    def test_the_angle_is_obeyed(self):
        hole = protocol.Poly(SQUARE + square(0.1, 0.2), PLATE.poly.segments, [(0.15, 0.15)])
        triangles = []
        for angle in (0, 20, 33):
            run = self.peer.run(hole, None, {**self.parameters, "angle": angle})
            smallest = self.accept(run, Domain(hole, 0.99), None).smallest_angle
            self.assertGreaterEqual(smallest, angle - 1e-9)
            triangles.append(len(run.triangles))
            if angle == 0:
                self.assertLess(smallest, 20.0)
        self.assertEqual(triangles, sorted(set(triangles)))

    def test_no_triangle_is_larger_than_asked(self):
        for size, scale in [({"uniform": 0.03}, None), ((from_the_hole, 0.5), 0.5)]:
            run = self.peer.run(PLATE.poly, size, self.parameters)
            corners = run.points[run.triangles]
            sizes = scale * from_the_hole(corners.mean(axis=1)) if scale else numpy.full(len(corners), 0.03)
            u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
            areas = 0.5 * (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
            self.assertLess((areas / (math.sqrt(3.0) / 4.0 * sizes**2)).max(), 1.05)


class Triangle(OfTriangle, Contract, unittest.TestCase):
    package, folder, parameters = "triangle", "triangle", {"angle": 30, "passes": 40}

    def test_too_few_passes_are_told(self):
        run = self.peer.run(PLATE.poly, (from_the_hole, 0.1), {**self.parameters, "passes": 2})
        self.assertEqual(run.answer["counts"]["passes"], 2)
        self.assertGreater(run.answer["counts"]["too_large"], 0)
        enough = self.peer.run(PLATE.poly, (from_the_hole, 0.1), self.parameters)
        self.assertGreater(enough.answer["counts"]["passes"], 2)
        self.assertEqual(enough.answer["counts"]["too_large"], 0)


class MeshPy(OfTriangle, Contract, unittest.TestCase):
    package, folder, parameters = "meshpy", "meshpy", {"angle": 30}

    def test_areas_that_lose_their_digits_are_declined(self):
        run = self.peer.run(PLATE.poly, {"uniform": 1e-8}, self.parameters)
        self.assertEqual(run.status, protocol.DECLINED)


class Gmsh(Contract, unittest.TestCase):
    package, folder, parameters, needs_size = "gmsh", "gmsh", {"algorithm": "frontal-delaunay"}, True

    def test_every_algorithm_makes_its_own_mesh(self):
        meshes = set()
        for algorithm in ("delaunay", "frontal-delaunay", "meshadapt", "bamg"):
            run = self.peer.run(PLATE.poly, {"uniform": 0.05}, {"algorithm": algorithm})
            self.accept(run, PLATE, lambda points: numpy.full(len(points), 0.05))
            meshes.add(run.points.tobytes())
        self.assertEqual(len(meshes), 4)

    def test_every_algorithm_keeps_a_size_that_varies(self):
        for algorithm in ("delaunay", "meshadapt", "bamg"):
            run = self.peer.run(PLATE.poly, (from_the_hole, 0.5), {"algorithm": algorithm})
            self.accept(run, PLATE, lambda points: 0.5 * from_the_hole(points))

    def test_an_isolated_vertex_is_a_corner_of_triangles(self):
        run = self.peer.run(protocol.Poly(SQUARE + [(0.37, 0.41)], RING), {"uniform": 0.2}, self.parameters)
        corners = run.points[run.triangles.reshape(-1)].tolist()
        self.assertIn([0.37, 0.41], corners)


class Netgen(Contract, unittest.TestCase):
    package, folder, needs_size = "netgen-mesher", "netgen", True
    parameters = {"optimise": 3, "density": 1, "grading": 0.3}

    def test_restrictions_are_as_dense_as_asked(self):
        def restrictions(density):
            run = self.peer.run(PLATE.poly, (from_the_hole, 0.5), {**self.parameters, "density": density})
            return run.answer["counts"]["restrictions"]

        self.assertAlmostEqual(restrictions(4) / restrictions(2), 4.0, delta=0.5)

    def test_isolated_vertices_are_declined(self):
        run = self.peer.run(protocol.Poly(SQUARE + [(0.37, 0.41)], RING), {"uniform": 0.2}, self.parameters)
        self.assertEqual(run.status, protocol.DECLINED)


if __name__ == "__main__":
    unittest.main()
