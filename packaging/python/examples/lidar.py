"""Ten thousand rays at once from a numpy array into one."""

import sys

import abut

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is missing")
    sys.exit(77)

rng = np.random.default_rng(1)
world = abut.World3()
crate = abut.Box3((0, 0, 0), (0.5, 0.5, 0.5))
options = np.zeros(1000, dtype=abut.dtype(abut.ItemOptions3))
options[:] = np.frombuffer(bytes(abut.ItemOptions3()), dtype=options.dtype)  # the defaults
options["pose"][:, :3] = rng.uniform(-20, 20, (1000, 3))
ids = world.add_many(crate, options)

count = 10_000
rays = np.empty((count, 7), np.float32)  # origin, direction, length
rays[:, :3] = 0
directions = rng.normal(size=(count, 3))
rays[:, 3:6] = directions / np.linalg.norm(directions, axis=1, keepdims=True)
rays[:, 6] = 50
hits = world.raycast_many(rays, pool=abut.ThreadPool(2))

found = hits["hit"]["found"] == 1
points = hits["hit"]["point"][found]
print(f"{found.sum()} of {count} rays hit, the nearest after {hits['hit']['distance'][found].min():.3f}")
assert 0.3 < found.mean() < 0.9
# The points lie at the distance that the rays report.
assert np.allclose(np.linalg.norm(points, axis=1), hits["hit"]["distance"][found], atol=1e-4)
# One by one the answers are the same.
one = world.raycast(tuple((rays[7, :3], rays[7, 3:6], rays[7, 6])))
assert one.hit.distance == hits["hit"]["distance"][7]

# All crates move at once: an array with gaps between its rows is used as it is.
state = np.zeros((1000, 10), np.float32)
state[:, :3] = rng.uniform(-5, 5, (1000, 3))
state[:, 6] = 1
world.move_many(ids, state[:, :7])
print(f"{len(world.update().began)} pairs touch")
