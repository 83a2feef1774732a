"""Distances, contacts and rays of single shapes."""

import math

import abut

ball = abut.Sphere((0, 0, 0), 1)
crate = abut.Box3((3, 0, 0), (0.5, 0.5, 0.5))

print("they touch" if abut.overlaps(ball, crate) else "they are apart")
gap = abut.closest(ball, crate)
print(f"the gap is {gap.distance} from {tuple(gap.on_a)} to {tuple(gap.on_b)}")
assert abut.certify(ball, crate, gap).holds

moved = crate.at(((-1.75, 0, 0),))  # a pose: position, and optionally rotation
contact = abut.contact(ball, moved)
if contact:
    for point in contact.points[: contact.count]:
        print(f"{point.depth} deep at {tuple(point.position)}")

hit = ball.raycast(abut.Ray3((-5, 0, 0), (1, 0, 0), math.inf))
print(f"a ray hits after {hit.distance}")
assert (gap.distance, contact.depth, hit.distance) == (1.5, 0.25, 4)
