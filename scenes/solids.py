"""Meshes as (positions, normals, triangles), made of faces. A face is a list of points,
counter-clockwise seen from outside, convex and flat. Vectors are tuples."""
import itertools
import math


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def plus(a, b):
    return tuple(p + q for p, q in zip(a, b))


def minus(a, b):
    return tuple(p - q for p, q in zip(a, b))


def unit(a):
    length = math.sqrt(sum(p * p for p in a))
    return tuple(p / length for p in a)


def mesh_of(faces, smooth=False):
    """Each face has vertices of its own, as exporters write hard edges, or (smooth) shares them."""
    positions, normals, triangles, known = [], [], [], {}
    for number, face in enumerate(faces):
        normal = cross(minus(face[1], face[0]), minus(face[2], face[1]))
        corners = []
        for point in face:
            corners.append(known.setdefault(point if smooth else (point, number), len(positions)))
            if corners[-1] == len(positions):
                positions.append(point)
                normals.append((0.0, 0.0, 0.0))
            normals[corners[-1]] = plus(normals[corners[-1]], normal)
        triangles += [(corners[0], *corners[i:i + 2]) for i in range(1, len(face) - 1)]
    return positions, [unit(normal) for normal in normals], triangles


def circle(count):
    """Points of the unit circle, counter-clockwise, in multiples of 1/1024: short enough that
    their products with short radii are exact floats, and what should be flat is."""
    angles = [2 * math.pi * i / count for i in range(count)]
    return [tuple(round(1024 * f(a)) / 1024 for f in (math.cos, math.sin)) for a in angles]


def prism(outline, low, high, upright=False, caps=None):
    """The faces of an outline extruded from low to high. It runs counter-clockwise in (x, y) and
    is extruded along Z; upright, in (z, x) and along Y. A concave outline needs its caps cut
    into convex pieces: lists of indices."""
    bottom, top = ([(v, w, u) if upright else (u, v, w) for u, v in outline] for w in (low, high))
    faces = []
    for cap in caps or [range(len(outline))]:
        faces += [[top[i] for i in cap], [bottom[i] for i in reversed(cap)]]
    return faces + [[bottom[i - 1], bottom[i], top[i], top[i - 1]] for i in range(len(outline))]


def band(outer, inner, low, high, upright=False):
    """The strip between two lines of equally many points, extruded: an L, a U, an arch."""
    last = 2 * len(outer) - 1
    caps = [(i, i + 1, last - 1 - i, last - i) for i in range(len(outer) - 1)]
    return prism(outer + inner[::-1], low, high, upright, caps)


def lathe(profile, count=12):
    """A convex profile of (radius, y), from below, turned about Y, closed by flat caps."""
    rings = [[(r * x, y, r * z) for z, x in circle(count)] for r, y in profile]
    faces = [rings[0][::-1], rings[-1]]
    for low, high in zip(rings, rings[1:]):
        faces += [[low[i - 1], low[i], high[i], high[i - 1]] for i in range(count)]
    return faces


def sphere():
    """128 triangles about the unit sphere, a vertex on each axis to stand or hang by."""
    faces = []
    for x, y, z in itertools.product((-1.0, 1.0), repeat=3):
        corners = [(x, 0.0, 0.0), (0.0, y, 0.0), (0.0, 0.0, z)]
        faces.append(corners if x * y * z > 0 else corners[::-1])
    for _ in range(2):
        finer = []
        for a, b, c in faces:
            ab, bc, ca = unit(plus(a, b)), unit(plus(b, c)), unit(plus(c, a))
            finer += [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        faces = finer
    return faces


def torus(radius, tube):
    """A ring about Y."""
    rings = [[((radius + tube * c) * x, tube * s, (radius + tube * c) * z) for c, s in circle(8)]
             for z, x in circle(16)]
    return [[rings[i - 1][j - 1], rings[i][j - 1], rings[i][j], rings[i - 1][j]]
            for i in range(16) for j in range(8)]


def rectangle(x0, x1, y0, y1):
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
