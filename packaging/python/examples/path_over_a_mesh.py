"""Walks and paths over a surface, and an outline in convex parts. No numpy is needed."""

import abut

# A floor with a step up, and a wall that the floor ends at.
points = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (4, 0, 1), (4, 4, 1), (8, 0, 1), (8, 4, 1)]
triangles = [(0, 1, 2), (0, 2, 3), (1, 4, 5), (1, 5, 2), (4, 6, 7), (4, 7, 5)]
mesh = abut.WalkMesh(points, triangles)
here = mesh.nearest((1, 1, 0.5))
walked = mesh.walk(here, (5, 0, 0))
print(f"walked {walked.length} to {tuple(walked.position)}, over {walked.crossings} edges")
assert walked.met == 0 and tuple(walked.position) == (5, 1, 1)

path, bends, places = mesh.path(here, mesh.nearest((7, 3, 1)))
print(f"a path of {path.length:.3f} with {len(bends)} points")
assert path and path.reached and len(bends) >= 3 and len(places) == len(bends)

parts = abut.decompose_outline([(0, 0), (4, 0), (4, 4), (0, 4)], holes=[[(1, 1), (3, 1), (3, 3), (1, 3)]])
print(f"{len(parts)} convex parts of an area of {sum(part.measures().area for part in parts)}")
assert sum(part.measures().area for part in parts) == 12
room = parts.compound()
assert not room.contains((2, 2)) and room.contains((0.5, 2))
