"""The package: that it has every function of the C API, what it does with wrong arguments, and who owns what."""

import gc
import hashlib
import math
import unittest

import abut
from abut import _arrays, _names
from abut._library import api, library, python_name


class TestPackage(unittest.TestCase):
    def test_each_function_has_a_place(self):
        places = 0
        for function in api["functions"]:
            self.assertTrue(hasattr(library, function["name"]), function["name"])
            place = _names.place_of(function)
            if place is None:
                continue
            owner, name, kind = place
            if kind == "constructor":
                continue
            self.assertTrue(hasattr(getattr(abut, python_name(owner)) if owner else abut, name), function["name"])
            places += 1
        self.assertGreater(places, 200)

    def test_wrong_arguments_are_named(self):
        ball = abut.Sphere((0, 0, 0), 1)
        with self.assertRaises(abut.Error) as caught:
            ball.closest((0, math.nan, 0))
        self.assertEqual((caught.exception.code, str(caught.exception)), ("NOT_FINITE", "point is not finite"))
        with self.assertRaises(abut.Error) as caught:
            ball.contains_many([(0, 0, 0), (0, math.inf, 0)])
        self.assertEqual(caught.exception.index, 1)
        with self.assertRaisesRegex(TypeError, "Shape3"):
            ball.overlaps(abut.Circle((0, 0), 1))
        with self.assertRaisesRegex(TypeError, "needs b"):
            ball.overlaps()
        with self.assertRaises(TypeError):
            ball.at(((1, 2),))
        with self.assertRaises(ValueError):
            abut.World3().move_many([(1, 1)], [(0, 0, 0, 0, 0, 0, 1), (0, 0, 0, 0, 0, 0, 1)])
        with self.assertRaises(abut.Error) as caught:
            abut.World3().remove((1, 1))
        self.assertEqual(caught.exception.code, "STALE_ID")
        ball.release()
        ball.release()
        with self.assertRaisesRegex(ValueError, "was released"):
            ball.bounds()

    def test_a_world_keeps_its_shapes_and_callbacks(self):
        world = abut.World2()
        a = world.add(abut.Circle((0, 0), 1))
        b = world.add(abut.Circle((1, 0), 1))
        pairs = []
        world.set_pair_filter(lambda x, y: pairs.append((x, y)) or False)
        copy = world.copy()
        gc.collect()
        self.assertEqual(len(world.update().began), 0)
        del world
        gc.collect()
        self.assertEqual(len(copy.update().began), 0)
        self.assertEqual([tuple(map(tuple, pair)) for pair in pairs][0], (tuple(a), tuple(b)))

    def test_lists_longer_than_the_first_try(self):
        world = abut.World3()
        ball = abut.Sphere((0, 0, 0), 1)
        for _ in range(200):
            world.add(ball)
        self.assertEqual(len(world.overlapping(ball)), 200)
        self.assertEqual(len(world.k_nearest(ball, 3)), 3)
        self.assertEqual(len(world.k_nearest(ball, k=300)), 200)
        ends, ids = world.overlapping_many(ball, [(0, 0, 0, 0, 0, 0, 1), (9, 0, 0, 0, 0, 0, 1)])
        self.assertEqual((list(ends), len(ids)), ([200, 200], 200))

    @unittest.skipIf(_arrays.numpy is None, "numpy is missing")
    def test_arrays_with_gaps_and_other_types(self):
        numpy = _arrays.numpy
        ball = abut.Sphere((0, 0, 0), 1)
        points = numpy.zeros((4, 5), numpy.float32)
        points[:, 0] = numpy.arange(4)
        distances = [-1, 0, 1, 2]
        for given in (points[:, :3], points[:, :3].copy(), points[:, :3].astype(float), points[:, :3].tolist(),
                      numpy.asfortranarray(points[:, :3]), points[::-1, :3][::-1]):
            self.assertEqual(ball.closest_to_points(given)["distance"].tolist(), distances)
        self.assertEqual(ball.closest_to_points(points[::2, :3])["distance"].tolist(), distances[::2])
        self.assertEqual(len(ball.closest_to_points(points[:0, :3])), 0)
        with self.assertRaisesRegex(ValueError, "3 numbers a row"):
            ball.closest_to_points(points)

    @unittest.skipIf(_arrays.numpy is None, "numpy is missing")
    def test_same_bits(self):
        """The answers are those of other machines, bit by bit: npm/test/same_bits.js has the same hash."""
        numpy = _arrays.numpy
        seed = 7

        def random():
            nonlocal seed
            seed = (seed * 1664525 + 1013904223) & 0xFFFFFFFF
            return float(numpy.float32(seed / 2**32 * 4 - 2))

        def vector():
            return random(), random(), random()

        shapes = [abut.Sphere(vector(), 0.5), abut.Box3(vector(), (0.5, 0.75, 0.25), (0.5, 0.5, -0.5, 0.5)),
                  abut.Capsule3(vector(), vector(), 0.25), abut.Cylinder((0, 0, 0), (0.5, 0.25, 1), 0.5),
                  abut.Cone((0, 0, 0), (0, 0.5, 1), 0.5),
                  abut.Polyhedron(numpy.array([random() for _ in range(60)], "f4").reshape(-1, 3))]
        poses = numpy.array([random() for _ in range(7 * 200)], "f4").reshape(-1, 7)
        digest = hashlib.sha256()

        def add(*arrays):
            for array in arrays:
                digest.update(numpy.ascontiguousarray(array).tobytes())

        for a in shapes:
            for b in shapes:
                closest, contact = a.closest_many(b, poses), a.contact_many(b, poses)
                add(closest["distance"], closest["normal"], closest["on_a"], contact["depth"], contact["normal"])
        world = abut.World3()
        for i in range(200):
            world.add(shapes[i % 6], pose=poses[i])
        digest.update(f"{len(world.update().began)} {len(world.contacts())}".encode())
        rays = poses.copy()
        rays[:, 3:] = 1, 0, 0, 50
        hit = world.raycast_many(rays)["hit"]
        add(hit["distance"], hit["point"], hit["normal"])
        self.assertEqual(digest.hexdigest(), "6a594f3b7fbc04e9b2c06b3c6ae42c28e600ca91a47479e58b861286bb5862f4")


if __name__ == "__main__":
    unittest.main()
