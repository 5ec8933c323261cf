"""The adapters that begin with a triangulation and remesh it, as the runner starts them; and that triangulation."""

import importlib.util
import shutil
import unittest

import numpy
from support import PLATE, SQUARE, Domain, Peer, measure, protocol
from test_adapters import RING, Contract, from_the_hole



def plate_with_round_hole(corners, moved=0.0):
    """The square with a hole of many corners, which those who take a polygon for a curve round, and its area."""
    angles = 2.0 * numpy.pi * numpy.arange(corners) / corners
    hole = zip(0.5 + 0.2 * numpy.cos(angles), 0.5 + 0.2 * numpy.sin(angles))
    ring = [(4 + k, 4 + (k + 1) % corners) for k in range(corners)]
    poly = protocol.Poly(numpy.array([*SQUARE, *hole]) + moved, RING + ring, [(0.5 + moved, 0.5 + moved)])
    return Domain(poly, 1.0 - corners / 2 * 0.2**2 * float(numpy.sin(2.0 * numpy.pi / corners)))


ROUND = plate_with_round_hole(64)


class KeepsThePolygon:
    """Takes a metric, divides the boundary and rounds nothing."""

    needs_size = True
    median = (0.85, 1.2)

    def test_a_polygon_is_divided_and_not_rounded(self):
        for size in (0.1, 0.01):  # sides are 0.0196 long
            self.check(ROUND, size)

    def test_nor_where_it_turns_by_half_a_degree(self):
        self.check(plate_with_round_hole(720), 0.05)

    def test_nor_far_from_the_origin(self):
        self.check(plate_with_round_hole(64, moved=189.85), 0.05)

    def check(self, domain, size):
        run = self.peer.run(domain.poly, {"uniform": size}, self.parameters)
        self.assertEqual(run.status, 0, run.said)
        found = measure(run.points, run.triangles, None)
        self.assertAlmostEqual(found.area, domain.area, places=10)
        distances = [numpy.hypot(*(run.points - vertex).T).min() for vertex in domain.poly.points]
        self.assertEqual(max(distances), 0.0)


class Mmg(KeepsThePolygon, Contract, unittest.TestCase):
    package, folder, parameters = "mmgpy", "mmg", {"passes": 5}

    def test_an_inner_segment_is_cut_to_size(self):
        poly = protocol.Poly(SQUARE + [(0.2, 0.5), (0.8, 0.5)], RING + [(4, 5)])
        run = self.peer.run(poly, {"uniform": 0.1}, self.parameters)
        on = run.points[(run.points[:, 1] == 0.5) & (run.points[:, 0] >= 0.2) & (run.points[:, 0] <= 0.8)]
        numpy.testing.assert_allclose(numpy.sort(on[:, 0]), numpy.linspace(0.2, 0.8, 7), atol=1e-9)


class Bamg(KeepsThePolygon, Contract, unittest.TestCase):
    folder, parameters = "bamg", {"passes": 6}

    def setUp(self):
        if shutil.which("FreeFem++") is None:
            self.skipTest("FreeFem++ is not on the path: apt-get install --no-install-recommends freefem++")
        self.peer = Peer(self, self.folder, "pythoncdt")
        self.peer.version = "4.9"

    def test_its_time_leaves_the_talk_out(self):
        run = self.peer.run(PLATE.poly, {"uniform": 0.05}, self.parameters)
        counts = run.answer["counts"]
        self.assertEqual(run.answer["seconds"]["mesh"], counts["seconds_adaptmesh"] + counts["seconds_sizes"])


class Pymeshlab(Contract, unittest.TestCase):
    package, folder, parameters, needs_size = "pymeshlab", "pymeshlab", {"iterations": 10}, True

    def test_a_graded_size(self):
        run = self.peer.run(PLATE.poly, (from_the_hole, 0.5), self.parameters)
        self.assertEqual(run.status, protocol.DECLINED)
        self.assertRegex(run.said.splitlines()[-1], "one length")

    def test_what_cuts_and_what_hangs(self):
        """It knows nothing of segments inside: the mesh of the square is as if they were not there."""
        poly = protocol.Poly(SQUARE + [(0.3, 0.5), (0.7, 0.6)], RING + [(4, 5)])
        run = self.peer.run(poly, {"uniform": 0.1}, self.parameters)
        self.assertEqual(run.status, 0, run.said)
        self.assertAlmostEqual(measure(run.points, run.triangles, None).area, 1.0, places=12)

    def test_a_polygon_loses_corners(self):
        run = self.peer.run(ROUND.poly, {"uniform": 0.1}, self.parameters)
        found = measure(run.points, run.triangles, None)
        self.assertGreater(found.smallest_area, 0.0)
        self.assertGreater(abs(found.area - ROUND.area), 1e-4)


@unittest.skipUnless(importlib.util.find_spec("pythoncdt"), "pythoncdt is not installed")
class Start(unittest.TestCase):
    def check(self, poly, triangles, area, edges):
        import start

        points, found, on_segments = start.triangulate(poly)
        a, b, c = (points[found[:, k]] for k in range(3))
        doubled = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
        self.assertGreater(doubled.min(), 0.0)
        self.assertAlmostEqual(0.5 * doubled.sum(), area, places=12)
        self.assertEqual((len(found), len(on_segments)), (triangles, edges))
        return points

    def test_holes_and_pockets_are_cut_away(self):
        self.check(PLATE.poly, 8, PLATE.area, 8)
        pocket = protocol.Poly([(0, 0), (2, 0), (2, 2), (1, 1), (0, 2)], [(k, (k + 1) % 5) for k in range(5)])
        self.check(pocket, 3, 3.0, 5)

    def test_a_hole_in_a_hole_is_an_island(self):
        inner = [(0.45, 0.45), (0.55, 0.45), (0.55, 0.55), (0.45, 0.55)]
        first = len(PLATE.poly.points)
        poly = protocol.Poly(
            [*PLATE.poly.points.tolist(), *inner],
            [*PLATE.poly.segments.tolist(), *[(first + k, first + (k + 1) % 4) for k in range(4)]],
            [(0.4, 0.4)],
        )
        self.check(poly, 10, PLATE.area + 0.01, 12)

    def test_a_segment_through_a_point_is_two_edges_and_points_outside_are_left_out(self):
        poly = protocol.Poly([*SQUARE, (0.5, 0.5), (3.0, 3.0)], [*RING, (0, 2)])
        points = self.check(poly, 4, 1.0, 6)
        self.assertEqual(len(points), 5)

    def test_crossing_segments_are_declined(self):
        import start

        with self.assertRaisesRegex(protocol.Declined, "no constrained triangulation"):
            start.triangulate(protocol.Poly(SQUARE, [*RING, (0, 2), (1, 3)]))


if __name__ == "__main__":
    unittest.main()
