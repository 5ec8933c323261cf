"""The programs that are compiled, as the runner starts them; and the field in C++ against the one in Python.

They are looked for in the folder that BITING_PEERS names, or else in the user's cache, and skipped where they are not.
"""

import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy
from support import BASELINES, PLATE, SQUARE, Peer, measure, protocol, write_field
from test_adapters import RING, Contract, from_the_hole

CACHE = pathlib.Path(os.environ.get("BITING_PEERS") or pathlib.Path.home() / ".cache" / "biting" / "peers")
CROSSING = protocol.Poly(SQUARE, [*RING, (0, 2), (1, 3)])


class Program(Peer):
    """A program in the cache that can be run."""

    def __init__(self, test, name, version):
        self.path, self.version = CACHE / "bin" / name, version
        if not self.path.is_file():
            test.skipTest(f"{name} is not installed: bash baselines/{name}/install {CACHE}")
        # `Peer` starts an adapter by Python: this one becomes the program
        folder = tempfile.TemporaryDirectory()
        test.addCleanup(folder.cleanup)
        self.adapter = pathlib.Path(folder.name) / "adapter.py"
        self.adapter.write_text(f"import os, sys\nos.execv({str(self.path)!r}, sys.argv)\n", encoding="utf-8")


class Compiled(Contract):
    """What holds of every compiled peer."""

    version = ""

    def setUp(self):
        self.peer = Program(self, self.folder, self.version)

    def assert_declined(self, run, reason):
        self.assertEqual(run.status, protocol.DECLINED, run.said)
        self.assertRegex(run.said.splitlines()[-1], reason)
        self.assertIsNone(run.answer)

    def test_a_request_that_is_not_there_fails(self):
        ended = subprocess.run([self.peer.path, "no-such.json"], capture_output=True, text=True, check=False)
        self.assertNotIn(ended.returncode, (0, protocol.DECLINED))
        self.assertIn("no-such.json", ended.stderr)


class UniformOnly:
    """Takes no size function."""

    def test_a_graded_size(self):
        self.assert_declined(self.peer.run(PLATE.poly, (from_the_hole, 0.5), self.parameters), "no size function")


class Cgal(Compiled, unittest.TestCase):
    folder, version, parameters, median = "cgal", "5.5.1", {"aspect": 0.125, "lloyd": 0}, (0.5, 0.8)

    def test_no_edge_is_longer_than_asked_nor_an_angle_smaller(self):
        run = self.peer.run(PLATE.poly, {"uniform": 0.03}, self.parameters)
        found = measure(run.points, run.triangles, None)
        self.assertLessEqual(found.longest_edge, 0.03 * (1 + 1e-12))
        self.assertGreaterEqual(found.smallest_angle, 20.7)

    def test_a_smaller_bound_leaves_smaller_angles(self):
        angles = []
        near_a_side = protocol.Poly([*SQUARE, (0.5, 0.02)], RING)
        for aspect in (0.001, 0.03, 0.125):
            run = self.peer.run(near_a_side, None, {**self.parameters, "aspect": aspect})
            angles.append(measure(run.points, run.triangles, None).smallest_angle)
            self.assertGreaterEqual(numpy.sin(numpy.radians(angles[-1])) ** 2, aspect)
        self.assertLess(angles[0], angles[2])

    def test_lloyd_moves_points_and_adds_none(self):
        runs = [self.peer.run(PLATE.poly, {"uniform": 0.05}, {**self.parameters, "lloyd": steps}) for steps in (0, 5)]
        still, moved = [self.accept(run, PLATE, lambda points: numpy.full(len(points), 0.05)) for run in runs]
        self.assertEqual(len(runs[0].points), len(runs[1].points))
        self.assertNotEqual(still.smallest_angle, moved.smallest_angle)

    def test_crossing_segments_are_declined(self):
        self.assert_declined(self.peer.run(CROSSING, {"uniform": 0.1}, self.parameters), "cross")

    def test_its_field_is_that_of_python_to_the_last_bit(self):
        points = numpy.random.default_rng(7).uniform(-0.5, 1.5, (2000, 2))
        points[:100] = numpy.round(points[:100] * 16.0) / 16.0  # sides and corners of cells
        with tempfile.TemporaryDirectory() as name:
            path = pathlib.Path(name) / "field"
            write_field(path, (0.0, 0.0, 1.0), from_the_hole, lambda values, sides: sides > values.min(axis=1))
            expected = protocol.Field(path, 0.3).at(points).tolist()
            told = subprocess.run(
                [self.peer.path, "--evaluate", str(path), "0.3"],
                input="\n".join(f"{x!r} {y!r}" for x, y in points.tolist()),
                capture_output=True,
                text=True,
                check=True,
            )
        self.assertEqual([float(line) for line in told.stdout.split()], expected)


class Spade(UniformOnly, Compiled, unittest.TestCase):
    folder, version, parameters, median = "spade", "2.15.1", {"angle": 30, "size": "spacing"}, (0.5, 0.95)

    def test_the_angle_is_obeyed(self):
        for angle in (20, 30):
            run = self.peer.run(PLATE.poly, {"uniform": 0.05}, {"angle": angle})
            self.assertGreaterEqual(measure(run.points, run.triangles, None).smallest_angle, angle - 1e-9)

    def test_inner_segments_do_not_keep_it_from_refining(self):
        poly = protocol.Poly(
            [*PLATE.poly.points.tolist(), (0.1, 0.1), (0.2, 0.15)],
            [*PLATE.poly.segments.tolist(), (len(PLATE.poly.points), len(PLATE.poly.points) + 1)],
            PLATE.poly.holes,
        )
        run = self.peer.run(poly, {"uniform": 0.05}, self.parameters)
        self.assertEqual(run.answer["counts"]["outside_refined"], 1)
        self.assertAlmostEqual(measure(run.points, run.triangles, None).area, PLATE.area, places=12)
        plain = self.peer.run(PLATE.poly, {"uniform": 0.05}, self.parameters)
        self.assertEqual(plain.answer["counts"]["outside_refined"], 0)
        self.assertGreater(len(run.triangles), 0.9 * len(plain.triangles))

    def test_crossing_segments_and_equal_points_are_declined(self):
        self.assert_declined(self.peer.run(CROSSING, {"uniform": 0.1}, self.parameters), "cross")
        twice = protocol.Poly([*SQUARE, SQUARE[2]], RING)
        self.assert_declined(self.peer.run(twice, {"uniform": 0.1}, self.parameters), "coincide")


class Tritet(UniformOnly, Compiled, unittest.TestCase):
    folder, version, median = "tritet", "3.4.0 (Triangle 1.6)", (0.5, 0.95)
    parameters = {"angle": 30, "size": "spacing"}

    def test_what_it_cannot_express_is_declined(self):
        self.assert_declined(self.peer.run(PLATE.poly, {"uniform": 1e-5}, self.parameters), "small an area")
        self.assert_declined(self.peer.run(PLATE.poly, {"uniform": 0.1}, {"angle": 0}), "20 degrees")


class TritetsLicence(unittest.TestCase):
    def test_nothing_is_installed_unless_the_licence_is_accepted(self):
        environment = {name: value for name, value in os.environ.items() if name != "BITING_ACCEPT_TRIANGLE_LICENCE"}
        with tempfile.TemporaryDirectory() as cache:
            command = ["bash", str(BASELINES / "tritet" / "install"), cache]
            ended = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
            self.assertEqual(list(pathlib.Path(cache).iterdir()), [])
        self.assertEqual(ended.returncode, 1)
        self.assertRegex(ended.stderr, "^tritet .*BITING_ACCEPT_TRIANGLE_LICENCE=1.*\n$")


if __name__ == "__main__":
    unittest.main()
