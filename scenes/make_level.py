#!/usr/bin/env python3
"""Writes the demo level, a storehouse with a yard, as one self-contained glTF 2.0 file.

    make_level.py OUTPUT.gltf|OUTPUT.glb [--blocks N] [--faults FAULTS.json]

Everything in it touches face to face except for the faults of the table FAULTS, planted so that
a collision check has something to find. Metres, seconds, Y up. The bytes are the same on every
machine: what comes from sin and cos is rounded far above their error before it is written.
"""
import argparse
import itertools
import json
import math

from gltf import Node, Writer, X, Y, Z, turned
from solids import band, circle, lathe, mesh_of, prism, rectangle, sphere, torus

FRAME = 1 / 16  # seconds; every key lies on a multiple, which a float holds exactly
FRAMES = 64
END = FRAMES * FRAME

# a, b (paths under Level), from, to (seconds), deepest (metres)
FAULTS = (
    # the level as it stands
    ("Storehouse/Crate_Sunk", "Storehouse/Walls/East", 0, END, 0.15),
    ("Yard/Porch/Pillar_2", "Yard/Porch/Roof", 0, END, 0.20),
    ("Storehouse/Lamp_3", "Storehouse/Beam_1", 0, END, 0.20),
    ("Storehouse/Table/Leg_3", "Storehouse/Floor/South", 0, END, 0.03),
) + tuple(
    (f"Storehouse/Chair_3/{part}", f"Storehouse/Chair_3_Copy/{part}", 0, END, 0.04)
    for part in ("Seat", "Back", "Leg_1", "Leg_2", "Leg_3", "Leg_4")
) + (
    # what moves
    ("Storehouse/Door", "Storehouse/Crate_By_Door", 0.5625, 0.75, 0.135),
    ("Storehouse/Faller_4", "Storehouse/Shelf/Board_2", 2.5, END, 0.20),
    ("Player", "Storehouse/Walls/Partition", 2.875, 3.125, 0.4125),
    ("Player", "Storehouse/Barrel_In_Way", 3.375, 3.75, 0.49),
    ("Storehouse/Lift/Platform", "Storehouse/Ceiling/North", 3.5, END, 0.02),
)

MATERIALS = {  # base colour, linear
    "stone": (0.42, 0.41, 0.38), "plaster": (0.80, 0.74, 0.62), "timber": (0.30, 0.17, 0.09),
    "plank": (0.55, 0.36, 0.18), "tile": (0.52, 0.16, 0.10), "crate": (0.68, 0.47, 0.22),
    "barrel": (0.36, 0.20, 0.12), "iron": (0.22, 0.24, 0.27), "rubber": (0.05, 0.05, 0.06),
    "grass": (0.22, 0.38, 0.14), "sky": (0.45, 0.66, 0.88), "glow": (1.00, 0.86, 0.50),
    "gold": (0.95, 0.66, 0.12), "player": (0.10, 0.34, 0.70), "red": (0.75, 0.08, 0.08),
}


def yard_ground():
    """An open grid of 12 x 12 cells, flat where things stand, uneven to the south and west."""
    def point(row, column):
        x, z = -9 + 1.5 * column, 0.25 + 1.25 * row
        if (row, column) == (10, 9):
            return (x, 1.0, z)  # the peak that carries the flag pole
        wave = round(400 * math.sin(1.3 * column) * math.cos(0.9 * row)) / 1000
        return (x, 0.0 if z <= 9 and x >= -7.5 else wave, z)

    faces = []
    for row, column in itertools.product(range(12), repeat=2):
        a, b = point(row, column), point(row + 1, column)
        c, d = point(row + 1, column + 1), point(row, column + 1)
        faces += [[a, b, c], [a, c, d]]
    return faces


HALF_CIRCLE = circle(12)[:7]
CUBE = prism(rectangle(-0.5, 0.5, -0.5, 0.5), -0.5, 0.5)
MESHES = {
    "Cube": mesh_of(CUBE),
    "Sky": mesh_of([face[::-1] for face in CUBE]),  # seen from inside
    "Sphere": mesh_of(sphere(), smooth=True),
    "Barrel": mesh_of(lathe([(0.3, 0), (0.3, 0.9)])),
    "Pillar": mesh_of(lathe([(0.12, 0), (0.12, 1)])),
    "Player": mesh_of(lathe([(1 / 8, 0), (1 / 4, 1 / 16), (5 / 16, 3 / 16),
                             (5 / 16, 25 / 16), (1 / 4, 27 / 16), (1 / 8, 28 / 16)])),
    "Wedge": mesh_of(prism([(0, 0), (1, 0), (1, 1)], -0.5, 0.5)),
    "Gable": mesh_of(prism([(-0.5, 0), (0.5, 0), (0, 1)], -0.5, 0.5)),
    "Door": mesh_of(prism(rectangle(0, 1.18, 0, 2.08), 0, 0.06)),  # its hinge is the Y axis
    "Corner": mesh_of(band([(0, 3), (0, 0), (3, 0)],
                           [(0.3, 3), (0.3, 0.3), (3, 0.3)], 0, 1.2, upright=True)),
    "Bin": mesh_of(band([(2, 1.5), (0, 1.5), (0, 0), (2, 0)],
                        [(2, 1.3), (0.2, 1.3), (0.2, 0.2), (2, 0.2)], 0, 0.8, upright=True)),
    "Arch": mesh_of(band(*([(r, 0)] + [(r * x, 1.4 + r * y) for x, y in HALF_CIRCLE] + [(-r, 0)]
                           for r in (1.6, 1.2)), -0.2, 0.2)),
    "Tyre": mesh_of(torus(0.45, 0.15), smooth=True),
    "Ground": mesh_of(yard_ground(), smooth=True),
    "Tank": mesh_of(lathe([(0.5, 0), (0.5, 1.2)], 24)[:-1]),  # one of its faces is missing
}


HOUSE_BOXES = (
    # path              x0     x1     y0     y1    z0     z1     material
    ("Floor/South",     -6.25, 6.25,  -0.25, 0,    -4,    0.25,  "stone"),
    ("Floor/North",     -6.25, 6.25,  -0.25, 0,    -8.25, -4,    "stone"),
    ("Walls/West",      -6.25, -6,    0,     3,    -8.25, 0.25,  "plaster"),
    ("Walls/East",      6,     6.25,  0,     3,    -8.25, 0.25,  "plaster"),
    ("Walls/North",     -6,    6,     0,     3,    -8.25, -8,    "plaster"),
    ("Walls/South_West", -6,   -1,    0,     3,    0,     0.25,  "plaster"),
    ("Walls/Lintel",    -1,    0.2,   2.1,   3,    0,     0.25,  "plaster"),
    ("Walls/South",     0.2,   2,     0,     3,    0,     0.25,  "plaster"),
    ("Walls/Window_Sill", 2,   4,     0,     1,    0,     0.25,  "plaster"),
    ("Walls/Window_Head", 2,   4,     2,     3,    0,     0.25,  "plaster"),
    ("Walls/South_East", 4,    6,     0,     3,    0,     0.25,  "plaster"),
    ("Walls/Partition", -6,    3,     0,     3,    -4.1,  -3.9,  "plaster"),
    ("Ceiling/South",   -6.25, 6.25,  3,     3.2,  -4,    0.25,  "plank"),
    ("Ceiling/North",   -6.25, 6.25,  3,     3.2,  -8.25, -4,    "plank"),
    ("Beam_1",          -6,    6,     2.8,   3,    -2.1,  -1.9,  "timber"),
    ("Beam_2",          -6,    6,     2.8,   3,    -6.1,  -5.9,  "timber"),
    ("Loft",            -6,    -3.5,  1.36,  1.5,  -8,    -5.5,  "plank"),
    ("Lift_Rail_1",     3.85,  3.95,  0,     3,    -7.15, -7.05, "iron"),
    ("Lift_Rail_2",     5.65,  5.75,  0,     3,    -7.15, -7.05, "iron"),
    ("Lamp_1_Cord",     -3.01, -2.99, 2.5,   3,    -1.21, -1.19, "iron"),
    ("Lamp_2_Cord",     2.99,  3.01,  2.5,   3,    -5.01, -4.99, "iron"),
    ("Crate_Sunk",      5.55,  6.15,  0,     0.6,  -1.5,  -0.9,  "crate"),
    ("Crate_By_Door",   0.02,  0.52,  0,     0.5,  -0.6,  -0.1,  "crate"),
)
SHELF_BOXES = (  # about its own origin, at the base of the wall behind
    ("Upright_1", 0, 0.5, 0, 1.16, -1, -0.95, "plank"),
    ("Upright_2", 0, 0.5, 0, 1.16, 0.95, 1, "plank"),
    ("Board_1", 0, 0.5, 0.56, 0.6, -0.95, 0.95, "plank"),
    ("Board_2", 0, 0.5, 1.16, 1.2, -1, 1, "plank"),
    ("Box_1", 0.1, 0.4, 0.6, 0.8, 0.2, 0.6, "red"),
    ("Box_2", 0.1, 0.3, 1.2, 1.5, 0.4, 0.8, "iron"),
)


def fall(crate, start, rest, drop_at, duration, tilt, axis):
    """A thrown crate: held, let go on a parabola, at rest from drop_at + duration. It rights
    itself on the way, slower than it drops, so no corner goes below the face it lands on."""
    steps = round(duration / FRAME)
    shares = [i / steps for i in range(steps + 1)]
    path = [tuple(round(r + (s - r) * (1 - (f * f if k == 1 else f)), 9)
                  for k, (s, r) in enumerate(zip(start, rest))) for f in shares]
    turns = [turned(tilt * (1 - f), axis) for f in shares]
    times = [0.0] + [drop_at + i * FRAME for i in range(steps + 1)] + [END]
    crate.animate("translation", times, [path[0]] + path + [path[-1]])
    crate.animate("rotation", times, [turns[0]] + turns + [turns[-1]])
    crate.placement.update(translation=path[0], rotation=turns[0])


def stand(group, parts, x, z, height):
    """A table or chair: boxes, and four legs with their outer corners at x and z."""
    group.boxes(parts)
    for i, (p, q) in enumerate(((-x, -z), (x - 0.04, -z), (x - 0.04, z - 0.04), (-x, z - 0.04))):
        group.box(f"Leg_{i + 1}", p, p + 0.04, 0, height, q, q + 0.04, "timber")


def storehouse(house):
    house.boxes(HOUSE_BOXES)
    house.add("Gable", "Gable", "tile", at=(0, 3.2, -4), turn=turned(90, Y), scale=(8.5, 1.5, 12.5))
    for i, x in enumerate((-5.85, -3.65), 1):
        house.add(f"Loft_Post_{i}", "Pillar", "timber", at=(x, 0, -5.65), scale=(1, 1.36, 1))
    for i in range(1, 6):
        x = -2 - 0.3 * i
        house.box(f"Stairs/Step_{i}", x, x + 0.3, 0, 0.3 * i, -8, -7, "plank")

    house.add("Shelf", at=(-6, 0, -2)).boxes(SHELF_BOXES)
    table = house.add("Table", at=(-3, 0, -2), turn=turned(20, Y))
    stand(table, [("Top", -0.7, 0.7, 0.7, 0.75, -0.4, 0.4, "plank")], 0.68, 0.38, 0.7)
    table.box("Leg_3", 0.64, 0.68, -0.03, 0.7, 0.34, 0.38, "timber")  # too long
    table.add("Mug", "Barrel", "iron", at=(0.3, 0.75, 0.1), scale=(0.15, 0.15, 0.15))
    table.add("Globe", "Sphere", "grass", at=(-0.3, 0.9, -0.1), scale=(0.15, 0.15, 0.15))
    for name, x, z, degrees in (("Chair_1", -3, -3.3, 10), ("Chair_2", -2.8, -0.8, 200),
                                ("Chair_3", -4.8, -0.6, 45), ("Chair_3_Copy", -4.8, -0.6, 45)):
        chair = house.add(name, at=(x, 0, z), turn=turned(degrees, Y))
        stand(chair, [("Seat", -0.2, 0.2, 0.41, 0.45, -0.2, 0.2, "plank"),
                      ("Back", -0.2, 0.2, 0.45, 0.9, -0.2, -0.16, "plank")], 0.2, 0.2, 0.41)
    for name, at in (("Lamp_1", (-3, 2.35, -1.2)), ("Lamp_2", (3, 2.35, -5)),
                     ("Lamp_3", (-4.5, 2.85, -2))):
        house.add(name, "Sphere", "glow", at=at, scale=(0.15, 0.15, 0.15))

    for name, at in (("Barrel_In_Way", (-0.3, 0, -5.375)), ("Barrel_1", (1.2, 0, -7.4)),
                     ("Barrel_2", (1.9, 0, -7.4)), ("Barrel_On_Barrel", (1.2, 0.9, -7.4)),
                     ("Barrel_3", (5.3, 0, -3.2)), ("Barrel_4", (4.6, 0, -3.4)),
                     ("Barrel_On_Loft", (-5.2, 1.5, -6.8))):
        house.add(name, "Barrel", "barrel", at=at)
    house.add("Barrel_Lying", "Barrel", "barrel", at=(2, 0.3, -6.5), turn=turned(90, Z))
    house.crate("Crate_1", 1.2, 0, -3.4, 0.7)
    house.crate("Crate_On_Crate", 1.2, 0.7, -3.4, 0.5, 30)
    house.crate("Crate_On_Loft", -4.2, 1.5, -6.3, 0.5, 15)
    house.add("Ball", "Sphere", "red", at=(4.6, 0.2, -1), scale=(0.2, 0.2, 0.2))

    door = house.add("Door", "Door", "timber", at=(-1, 0.01, 0))
    door.box("Handle", 1.05, 1.1, 0.95, 1.1, -0.06, 0, "iron")
    door.animate("rotation", (0, 0.5, 1.25, END), [turned(a, Y) for a in (0, 0, 90, 90)])

    lift = house.add("Lift", at=(4.8, 0, -7.1))
    lift.box("Platform", -0.8, 0.8, 0, 0.15, -0.7, 0.7, "iron")
    lift.animate("translation", (0, 1, 3.5, END), [(4.8, y, -7.1) for y in (0, 0, 2.87, 2.87)])
    signal = house.box("Lift_Signal", 3.35, 3.45, 1.35, 1.45, -8, -7.9, "red")
    signal.animate("translation", (0, 3.5), [(3.4, y, -7.95) for y in (1.4, 2.2)], "STEP")

    pickup = house.add("Pickup", "Sphere", "gold", at=(-0.4, 1.1, -7.2), scale=(0.15, 0.15, 0.15))
    pickup.animate("scale", (0, 3.5, END), [(s, s, s) for s in (0.15, 0.15, 0)])
    pickup.animate("rotation", (0, 1, 2, 3, END), [turned(90 * i, Y) for i in range(5)])

    for name, size, start, rest, drop_at, duration, tilt, axis in (
            ("Faller_1", 0.6, (3, 2.21, -2.8), (3, 0.3, -2.8), 0.25, 0.625, 15, (1, 0, 1)),
            ("Faller_2", 0.6, (1.5, 2.125, -2.8), (3, 0.9, -2.8), 1, 0.5, 25, (0, 1, 1)),
            ("Faller_3", 0.6, (3.7, 2.21, -2.8), (3.7, 0.3, -2.8), 1.5, 0.625, -12, (1, 0, 0.5)),
            ("Faller_4", 0.4, (-5.75, 2.425, -2.5), (-5.75, 1.2, -2.5), 2, 0.5, 15, X)):
        faller = house.add(name, "Cube", "crate", scale=(size, size, size))
        fall(faller, start, rest, drop_at, duration, tilt, axis)


def yard(ground):
    ground.add("Ground", "Ground", "grass")
    ground.box("Porch/Roof", -2.5, 1.5, 2.6, 2.75, 0.25, 2.25, "tile")
    ground.add("Porch/Pillar_1", "Pillar", "timber", at=(-2.2, 0, 2), scale=(1, 2.6, 1))
    ground.add("Porch/Pillar_2", "Pillar", "timber", at=(1.2, 0, 2), scale=(1, 2.8, 1))
    ground.box("Dock", 4, 6.5, 0, 0.6, 0.25, 2.25, "stone")
    ground.add("Ramp_West", "Wedge", "plank", at=(2.4, 0, 1.25), scale=(1.6, 0.6, 2))
    ground.add("Ramp_East", "Wedge", "plank", at=(8.1, 0, 1.25), scale=(-1.6, 0.6, 2))  # mirrored
    ground.crate("Crate_On_Dock_1", 4.9, 0.6, 1.2, 0.5)
    ground.crate("Crate_On_Dock_2", 5.8, 0.6, 1.1, 0.6, 40)

    ground.add("Corner_Wall", "Corner", "stone", at=(-6, 0, 4))
    ground.crate("Crate_In_Corner", -5.4, 0, 4.6, 0.6)  # touches both wings from inside
    coal_bin = ground.add("Coal_Bin", "Bin", "stone", at=(3, 0, 5), turn=turned(15, Y))
    coal_bin.add("Coal", "Sphere", "rubber", at=(0.75, 0.3, 1), scale=(0.4, 0.3, 0.5))
    ground.add("Gate", "Arch", "stone", at=(-0.4, 0, 8.4))
    for i in range(4):
        x = 2 + 1.5 * i
        ground.box(f"Fence/Post_{i + 1}", x - 0.06, x + 0.06, 0, 1, 8.34, 8.46, "timber")
        if i < 3:
            ground.box(f"Fence/Rail_{i + 1}", x + 0.06, x + 1.44, 0.7, 0.8, 8.37, 8.43, "timber")
    ground.add("Tyre", "Tyre", "rubber", at=(3.2, 0.15, 3.6))
    ground.add("Bollard", "Pillar", "iron", at=(3.2, 0, 3.6), scale=(1, 0.9, 1))  # in the tyre
    ground.add("Boulder", "Sphere", "stone", at=(-6.4, 0.5, 2.2), turn=turned(35, Y),
               scale=(0.8, 0.5, 0.6))
    ground.crate("Crate_1", -4, 0, 2, 0.6, 20)
    ground.add("Barrel_1", "Barrel", "barrel", at=(-3.4, 0, 5.4))

    # a turned child of a stretched parent: sheared
    ground.add("Skewed", at=(6, 0, 5.5), scale=(2, 1, 1)).crate("Skewed_Crate", 0, 0, 0, 0.5, 30)
    ground.crate("Crate_On_Skewed", 6, 0.5, 5.5, 0.3)
    ground.add("Flag_Pole", "Pillar", "iron", at=(4.5, 1, 12.75), scale=(0.4, 3, 0.4))
    flag = ground.add("Flag", at=(5.25, 3.6, 12.75), scale=(2, 1, 1))
    flag.add("Cloth", "Cube", "red", turn=turned(30, Z), scale=(0.5, 0.4, 0.02))
    cosine, sine = round(0.6 * math.cos(0.4), 9), round(0.6 * math.sin(0.4), 9)
    ground.add("Crate_By_Matrix", "Cube", "crate", matrix=(
        cosine, 0, -sine, 0, 0, 0.6, 0, 0, sine, 0, cosine, 0, 6.5, 0.3, 3.6, 1))

    ground.add("Tank", "Tank", "iron", at=(7.8, 0, 7))
    balloon = ground.add("Balloon", "Sphere", "red", at=(-4, 2.5, 11), scale=(0.4, 0.4, 0.4))
    places = ((-4, 2.5, 11), (-1, 4.5, 12), (2, 5, 10))
    tangents = ((0, 0, 0), (1.5, 0.6, 0), (0, 0, 0))
    balloon.animate("translation", (0, 2, END),
                    [v for p, t in zip(places, tangents) for v in (t, p, t)], "CUBICSPLINE")


def fill(root):
    """One storehouse with its yard and player."""
    storehouse(root.node("Storehouse"))
    yard(root.node("Yard"))
    starts = root.node("Player_Starts")
    starts.add("Player_Start_1", at=(-2.5, 0, 7))
    starts.add("Player_Start_2", at=(-6.4, 0.25, 2.2))  # in a boulder
    player = root.add("Player", "Player", "player", at=(-0.4, 0, 3.5))
    times = [i * FRAME for i in range(FRAMES + 1)]
    player.animate("translation", times, [(-0.4, 0, 3.5 - 2.5 * t) for t in times])


def level(count):
    """The root of the level, and what a check should find in it."""
    root, faults = Node("Level"), []
    for i, j in itertools.product(range(count), repeat=2):
        holder, prefix = root, "Level/"
        if count > 1:
            middle = (count - 1) / 2
            holder = root.add(f"Block_{i}_{j}", at=(22 * (i - middle), 0, 28 * (j - middle)))
            holder.suffix = f".{i * count + j:03}"
            prefix += holder.name + "/"
        fill(holder)
        for a, b, start, end, depth in FAULTS:
            a, b = (prefix + path.replace("/", holder.suffix + "/") + holder.suffix
                    for path in (a, b))
            faults.append({"a": a, "b": b, "from": start, "to": end, "depth": depth})
    size = 30 + 30 * count
    root.add("Sky_Box", "Sky", "sky", at=(0, 0, 4), scale=(size, 40, size))
    return root, faults


def main():
    parser = argparse.ArgumentParser(description="Writes the demo level as glTF 2.0.")
    parser.add_argument("output", help="a name that ends in .gltf or .glb")
    parser.add_argument("--blocks", type=int, default=1, metavar="N",
                        help="repeat the storehouse N x N times (default 1)")
    parser.add_argument("--faults", metavar="FILE", help="write the expected faults as JSON")
    options = parser.parse_args()
    if options.blocks < 1 or not options.output.endswith((".gltf", ".glb")):
        parser.error("--blocks is at least 1, and the output ends in .gltf or .glb")
    root, faults = level(options.blocks)
    Writer(MESHES, MATERIALS).save(root, options.output)
    if options.faults:
        with open(options.faults, "w", encoding="utf-8") as file:
            file.write("[\n" + ",\n".join(map(json.dumps, faults)) + "\n]\n")


if __name__ == "__main__":
    main()
