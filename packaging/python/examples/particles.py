"""A distance field of a mesh, for particles and shadows."""

import sys

import abut

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is missing")
    sys.exit(77)

corners = np.array([(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)], np.float32)
cube = np.array([(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2),
                 (2, 4, 6), (1, 3, 5), (3, 7, 5)], np.uint32)
field = abut.Field3.bake(abut.Mesh(corners, cube), cell=0.1)

# Particles fall, and leave the solid along the field's direction.
rng = np.random.default_rng(2)
particles = rng.uniform(-1.5, 1.5, (5000, 3)).astype(np.float32)
particles[:, 2] += 3
for _ in range(60):
    particles[:, 2] -= 0.05
    samples = field.sample_many(particles)
    inside = samples["distance"] < 0
    particles[inside] -= samples["normal"][inside] * samples["distance"][inside, None]
lowest = field.distance_many(particles).min()
print(f"{len(particles)} particles, the deepest {-lowest:.4f} inside")
assert lowest > -0.02

light = field.shadow_many(particles, (0, 0, 10), 0.05)
print(f"{(light < 0.5).mean():.0%} of them lie in the shadow")
same = abut.Field3.load(field.save())
assert same.distance((0.5, 0.25, 2)) == field.distance((0.5, 0.25, 2))
