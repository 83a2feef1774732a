"""Writes small meshes and a list of them: make_meshes.py COUNT FOLDER"""

import random
import sys
from pathlib import Path

count, folder = int(sys.argv[1]), Path(sys.argv[2])
folder.mkdir(parents=True, exist_ok=True)
rng = random.Random(1)
faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
names = []
for number in range(count):
    lines, points = [], 0
    for box in range(rng.randint(1, 3)):  # boxes that overlap: not convex together
        low = [rng.uniform(-1, 0) + 0.8 * box * (axis == 0) for axis in range(3)]
        high = [rng.uniform(0.5, 1.5) + 0.8 * box * (axis == 0) for axis in range(3)]
        for corner in range(8):
            xyz = [high[axis] if corner >> axis & 1 else low[axis] for axis in range(3)]
            lines.append("v %.4f %.4f %.4f" % tuple(xyz))
        for a, b, c, d in faces:
            lines.append("f %d %d %d" % (points + a + 1, points + b + 1, points + c + 1))
            lines.append("f %d %d %d" % (points + a + 1, points + c + 1, points + d + 1))
        points += 8
    file = folder / f"mesh_{number:05}.obj"
    file.write_text("\n".join(lines) + "\n")
    names.append(str(file))
(folder / "list.txt").write_text("\n".join(names) + "\n")
