"""The independent checker finds nothing wrong with a good mesh, and each fault in a bad one."""

import os
import tempfile
import unittest

import check_mesh

# A square of side 4 with a square hole of side 2, and the eight triangles between the two.
POINTS = [(0, 0), (4, 0), (4, 4), (0, 4), (1, 1), (3, 1), (3, 3), (1, 3)]
SEGMENTS = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)]
TRIANGLES = [(0, 1, 5), (0, 5, 4), (1, 2, 6), (1, 6, 5), (2, 3, 7), (2, 7, 6), (3, 0, 4), (3, 4, 7)]


def numbered(rows):
    return [" ".join(str(word) for word in (k, *row)) for k, row in enumerate(rows)]


def checked(points=POINTS, triangles=TRIANGLES, domain=POINTS, segments=SEGMENTS, hole=(2, 2), min_angle=None):
    poly = [f"{len(domain)} 2 0 0", *numbered(domain), f"{len(segments)} 0", *numbered(segments), "1", f"0 {hole[0]} {hole[1]}"]
    node = [f"{len(points)} 2 0 0", *numbered(points)]
    ele = [f"{len(triangles)} 3 0", *numbered(triangles)]
    with tempfile.TemporaryDirectory() as folder:
        stem = os.path.join(folder, "m")
        for ending, lines in ((".poly", poly), (".node", node), (".ele", ele)):
            with open(stem + ending, "w") as file:
                file.write("\n".join([*lines, "# end"]))
        return check_mesh.check(stem + ".poly", stem, min_angle)


class Checker(unittest.TestCase):
    def found(self, fault, **parts):
        bad = checked(**parts)["bad"]
        self.assertTrue(any(fault in told for told in bad), f"{fault!r} is not among {bad}")

    def test_a_good_mesh(self):
        numbers = checked(min_angle=18)
        self.assertEqual(numbers["bad"], [])
        self.assertEqual((numbers["area"], numbers["boundary_edges"], numbers["euler"]), (12.0, 8, 0))
        self.assertAlmostEqual(numbers["min_angle"], 18.4349488)
        self.assertAlmostEqual(numbers["max_angle"], 135.0)
        self.assertEqual((numbers["excused"], numbers["acute_vertices"]), (0, 0))

    def test_triangles(self):
        self.found("1 triangles not positively oriented", triangles=[(1, 0, 5), *TRIANGLES[1:]])
        self.found("a triangle is there twice", triangles=[*TRIANGLES, (1, 5, 0)])
        self.found("used twice in one direction", triangles=[*TRIANGLES, (0, 1, 4)])
        self.found("area 11.0 where the domain has 12.0", triangles=TRIANGLES[:-1])
        self.found("area 12.0 where the domain has 16.0", hole=(9, 9))
        self.found("1 mesh vertices in no triangle", points=[*POINTS, (2, 0.5)])

    def test_the_boundary(self):
        self.found("1 input vertices are no mesh vertices (first: 8)", domain=[*POINTS, (2, 0.5)])
        self.found("1 input segments are no chain of mesh edges (first: (1, 4))", segments=[*SEGMENTS, (1, 4)])
        self.found("2 boundary edges lie on no input segment (first: (0, 4))", triangles=TRIANGLES[:1] + TRIANGLES[2:])

    def test_a_segment_of_two_edges_is_a_chain(self):
        points = [*POINTS, (2, 0)]
        triangles = [(0, 8, 5), (8, 1, 5), *TRIANGLES[1:]]
        self.assertEqual(checked(points=points, triangles=triangles)["bad"], [])
        bent = [*POINTS, (2, 1e-3)]
        self.found("input segments are no chain of mesh edges (first: (0, 1))", points=bent, triangles=triangles)

    def test_angles(self):
        self.found("8 triangles below 20 degrees (smallest 18.435)", min_angle=20)

    def test_a_triangle_at_an_acute_corner_is_excused(self):
        wedge = [(0, 0), (4, 0), (4, 1)]
        numbers = checked(wedge, [(0, 1, 2)], wedge, [(0, 1), (1, 2), (0, 2)], hole=(9, 9), min_angle=20)
        self.assertEqual((numbers["bad"], numbers["excused"], numbers["acute_vertices"]), ([], 1, 1))
        self.assertIsNone(numbers["min_angle_free"])


if __name__ == "__main__":
    unittest.main()
