#!/usr/bin/env python3
"""Writes a long animated scene, a crowd of dancers, as one self-contained glTF 2.0 file.

    make_crowd.py OUTPUT.gltf|OUTPUT.glb

It has 135 objects and 901 frames, 30 a second: 40 dancers of a body, an arm and a hoop, and 15 tiles that they dance on. They walk in
circles that cross, and turn; arms and hoops turn on them. So most pairs that are close move, and some collide. The bytes
are the same on every machine.
"""
import argparse
import math

from gltf import Node, Writer, X, Y, turned
from solids import lathe, mesh_of, prism, rectangle, torus

FRAMES = 901
DANCERS = 40

MESHES = {
    "Cube": mesh_of(prism(rectangle(-0.5, 0.5, -0.5, 0.5), -0.5, 0.5)),
    "Body": mesh_of(lathe([(0.2, 0), (0.35, 0.5), (0.3, 1.2), (0.15, 1.7)], 24)),
    "Hoop": mesh_of(torus(0.5, 0.06), smooth=True),
}
MATERIALS = {"tile": (0.52, 0.16, 0.10), "player": (0.10, 0.34, 0.70), "gold": (0.95, 0.66, 0.12)}
TIMES = [round(frame / 30, 6) for frame in range(FRAMES)]


def dancer(root, number):
    """Walks around a point of a grid of 8 x 5, in 12 to 20 seconds, alternately to the left and to the right."""
    middle = (2 * (number % 8) - 7, 2 * (number // 8) - 4)
    speed = (1 if number % 2 else -1) * 2 * math.pi / (12 + number % 9)
    group = root.node(f"Dancer_{number}")
    places, turns = [], []
    for time in TIMES:
        angle = speed * time + number
        places.append((round(middle[0] + 1.1 * math.cos(angle), 5), 0.0, round(middle[1] + 1.1 * math.sin(angle), 5)))
        turns.append(turned(-math.degrees(angle), Y))
    group.animate("translation", TIMES, places)
    group.animate("rotation", TIMES, turns)
    group.add("Body", "Body", "player")
    arm = group.add("Arm", "Cube", "player", at=(0, 1.3, 0.5), scale=(0.1, 0.1, 0.6))
    arm.animate("rotation", TIMES, [turned(40 * math.sin(3 * time + number), X) for time in TIMES])
    hoop = group.add("Hoop", "Hoop", "gold", at=(0, 0.9, 0))
    hoop.animate("rotation", TIMES, [turned(20 * math.sin(2 * time + number), X) for time in TIMES])


def main():
    parser = argparse.ArgumentParser(description="Writes a crowd of dancers as glTF 2.0.")
    parser.add_argument("output", help="a name that ends in .gltf or .glb")
    options = parser.parse_args()
    root = Node("Crowd")
    for number in range(15):
        x, z = 4 * (number % 5) - 10, 4 * (number // 5) - 6
        root.box(f"Tile_{number}", x, x + 4, -0.2, 0, z, z + 4, "tile")
    for number in range(DANCERS):
        dancer(root, number)
    Writer(MESHES, MATERIALS).save(root, options.output)


main()
