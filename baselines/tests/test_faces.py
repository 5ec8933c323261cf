"""The faces of domains small enough to list."""

import unittest

from support import SQUARE, protocol, square

from faces import faces


def cycle(loop):
    """A loop told from its smallest vertex on, so that equal loops are equal lists."""
    start = loop.index(min(loop))
    return loop[start:] + loop[:start]


def told(points, segments, holes=()):
    """Every face as (loops, inner segments, inner vertices), all in order."""
    found = faces(protocol.Poly(points, segments, holes))
    return sorted(
        ([cycle(loop) for loop in face.loops], sorted(face.inner_segments), sorted(face.inner_vertices)) for face in found
    )


def ring(first, count):
    """Segments of a closed chain of `count` vertices from `first` on."""
    return [(first + k, first + (k + 1) % count) for k in range(count)]


class Faces(unittest.TestCase):
    def test_a_square_is_turned_counter_clockwise(self):
        clockwise = [(b, a) for a, b in ring(0, 4)]
        for segments in (ring(0, 4), clockwise, ring(0, 4) + clockwise, ring(0, 4) + [(2, 2)]):
            self.assertEqual(told(SQUARE, segments), [([[0, 1, 2, 3]], [], [])])

    def test_a_hole_is_left_out_and_gone_round_the_other_way(self):
        points, segments = SQUARE + square(0.25, 0.75), ring(0, 4) + ring(4, 4)
        around = ([[0, 1, 2, 3], [4, 7, 6, 5]], [], [])
        self.assertEqual(told(points, segments, [(0.5, 0.5)]), [around])
        self.assertEqual(told(points, segments), [around, ([[4, 5, 6, 7]], [], [])])
        self.assertEqual(told(points, segments, [(0.1, 0.5)]), [([[4, 5, 6, 7]], [], [])])

    def test_an_island_in_a_hole_is_inside_again(self):
        points = SQUARE + square(0.2, 0.8) + square(0.4, 0.6)
        segments = ring(0, 4) + ring(4, 4) + ring(8, 4)
        expected = [([[0, 1, 2, 3], [4, 7, 6, 5]], [], []), ([[8, 9, 10, 11]], [], [])]
        self.assertEqual(told(points, segments, [(0.3, 0.5)]), expected)

    def test_a_hanging_segment_is_inner(self):
        points = SQUARE + [(0.5, 0.5)]
        self.assertEqual(told(points, ring(0, 4) + [(0, 4)]), [([[0, 1, 2, 3]], [(0, 4)], [])])

    def test_a_bridge_to_a_hole_is_inner(self):
        points, segments = SQUARE + square(0.25, 0.75), ring(0, 4) + ring(4, 4) + [(0, 4)]
        self.assertEqual(told(points, segments, [(0.5, 0.5)]), [([[0, 1, 2, 3], [4, 7, 6, 5]], [(0, 4)], [])])

    def test_a_cutting_segment_makes_two_faces(self):
        self.assertEqual(told(SQUARE, ring(0, 4) + [(0, 2)]), [([[0, 1, 2]], [], []), ([[0, 2, 3]], [], [])])

    def test_free_cracks_and_points_belong_to_the_face_around_them(self):
        points = SQUARE + square(0.5, 0.9) + [(0.1, 0.2), (0.3, 0.2), (0.2, 0.7), (0.7, 0.7), (2.0, 0.5), (0.6, 0.6), (0.6, 0.7)]
        segments = ring(0, 4) + ring(4, 4) + [(8, 9), (13, 14)]
        outer, inner = ([[0, 1, 2, 3], [4, 7, 6, 5]], [(8, 9)], [10]), ([[4, 5, 6, 7]], [(13, 14)], [11])
        self.assertEqual(told(points, segments), [outer, inner])
        self.assertEqual(told(points, segments, [(0.8, 0.6)]), [outer])

    def test_a_loop_that_touches_itself_is_one_loop(self):
        points = SQUARE + [(0.6, 0.3), (0.3, 0.6)]
        segments = ring(0, 4) + [(0, 4), (4, 5), (5, 0)]
        self.assertEqual(told(points, segments, [(0.3, 0.3)]), [([[0, 1, 2, 3, 0, 5, 4]], [], [])])

    def test_components_beside_and_above_one_another(self):
        points = SQUARE + square(2.0, 3.0) + [(0.0, 2.0), (1.0, 2.0), (0.5, 3.0)]
        found = told(points, ring(0, 4) + ring(4, 4) + ring(8, 3))
        self.assertEqual(found, [([[0, 1, 2, 3]], [], []), ([[4, 5, 6, 7]], [], []), ([[8, 9, 10]], [], [])])

    def test_under_a_vertex_what_leaves_it_lowest_counts(self):
        # the hole point and the crack lie straight under vertices that several segments share
        points = SQUARE + [(0.2, 0.2), (0.8, 0.2), (0.5, 0.6), (0.5, 0.3), (0.5, 0.4), (0.2, 0.05), (0.2, 0.1)]
        segments = ring(0, 4) + [(4, 5), (5, 6), (6, 4), (7, 8), (9, 10)]
        outer, inner = ([[0, 1, 2, 3], [4, 6, 5]], [(9, 10)], []), ([[4, 5, 6]], [(7, 8)], [])
        self.assertEqual(told(points, segments), [outer, inner])
        self.assertEqual(told(points, segments, [(0.5, 0.5)]), [outer])

    def test_what_closes_nothing_has_no_face(self):
        self.assertEqual(told(SQUARE, [(0, 1), (1, 2)]), [])


if __name__ == "__main__":
    unittest.main()
