"""The size field: by hand, and both ways of asking it against each other."""

import pathlib
import tempfile
import unittest

import numpy
from support import protocol, write_field, write_tree


def read(box, child, corners, scale=1.0):
    """A field of these cells, by way of a file."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "field"
        write_tree(path, box, child, corners)
        return protocol.Field(path, scale)


# a root over [2, 6] × [-1, 3], its right-below child split again; corners left below, right below, left above, right above
BOX = (2.0, -1.0, 4.0)
CHILD = [1, -1, 5, -1, -1, -1, -1, -1, -1]
CORNERS = [
    [9.0, 9.0, 9.0, 9.0],  # of cells that are split none is looked at
    [1.0, 2.0, 3.0, 4.0],
    [9.0, 9.0, 9.0, 9.0],
    [3.0, 4.0, 5.0, 6.0],
    [4.0, 8.0, 6.0, 7.0],
    [2.0, 3.0, 3.0, 5.0],
    [3.0, 4.0, 5.0, 6.0],
    [3.0, 5.0, 4.0, 6.0],
    [5.0, 6.0, 6.0, 8.0],
]


class FieldByHand(unittest.TestCase):
    def values(self, points, scale=1.0):
        field = read(BOX, CHILD, CORNERS, scale)
        at_point = field.pointwise()
        found = field.at(numpy.array(points, dtype=float))
        self.assertEqual(found.tolist(), [at_point(x, y) for x, y in points])
        return found.tolist()

    def test_corners_of_leaves(self):
        self.assertEqual(self.values([(2, -1), (2, 3), (6, 3), (6, -1)]), [1.0, 5.0, 7.0, 4.0])

    def test_bilinear_inside_a_leaf(self):
        # a quarter to the right and half up in the left-below leaf: (1 + 0.25) and (3 + 0.25), in the middle of them
        self.assertEqual(self.values([(2.5, 0.0)]), [2.25])
        # the middle of the smallest leaf right above: (5 + 6 + 6 + 8) / 4
        self.assertEqual(self.values([(5.5, 0.5)]), [6.25])

    def test_the_scale_multiplies(self):
        self.assertEqual(self.values([(2.5, 0.0)], scale=2.0), [4.5])

    def test_outside_the_root_the_nearest_point_counts(self):
        outside, nearest = [(-7, 0), (9, 9), (2.5, -4), (7, 1.5)], [(2, 0), (6, 3), (2.5, -1), (6, 1.5)]
        self.assertEqual(self.values(outside), self.values(nearest))

    def test_leaves_are_where_the_tree_has_them(self):
        x, y, side, values = read(BOX, CHILD, CORNERS).leaves()
        found = sorted(zip(x.tolist(), y.tolist(), side.tolist(), values[:, 0].tolist()))
        # in the order of CHILD: left below, left above, right above of the root, then the four right below
        self.assertEqual(
            found,
            sorted(
                [(2, -1, 2, 1), (2, 1, 2, 3), (4, 1, 2, 4), (4, -1, 1, 2), (5, -1, 1, 3), (4, 0, 1, 3), (5, 0, 1, 5)]
            ),
        )

    def test_a_root_alone(self):
        field = read((0.0, 0.0, 2.0), [-1], [[1.0, 2.0, 3.0, 8.0]])
        self.assertEqual(field.at(numpy.array([[1.0, 1.0], [2.0, 2.0]])).tolist(), [3.5, 8.0])
        self.assertEqual(field.pointwise()(1.0, 1.0), 3.5)

    def test_other_files_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "field"
            path.write_bytes(b"BITFJELD" + bytes(80))
            with self.assertRaisesRegex(ValueError, "not a size field"):
                protocol.Field(path, 1.0)


class SampledField(unittest.TestCase):
    def test_a_bilinear_function_is_met_and_both_ways_agree(self):
        def function(points):
            return 4.0 + points[:, 0] + 2.0 * points[:, 1] + 0.5 * points[:, 0] * points[:, 1]

        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "field"
            write_field(path, (-1.0, 0.0, 3.0), function, lambda values, sides: sides > 0.05 * values.min(axis=1))
            field = protocol.Field(path, 1.0)
        self.assertGreater(len(field.child), 100)
        points = numpy.random.default_rng(5).uniform(-1.0, 2.0, (2000, 2)) + [0.0, 1.0]
        numpy.testing.assert_allclose(field.at(points), function(points), rtol=1e-12)
        at_point = field.pointwise()
        anywhere = 2.0 * points
        self.assertEqual(field.at(anywhere).tolist(), [at_point(x, y) for x, y in anywhere.tolist()])


if __name__ == "__main__":
    unittest.main()
