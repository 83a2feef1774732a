"""A tree of nodes with meshes and animations, and the glTF 2.0 file it makes."""
import base64
import json
import math
import struct

from solids import unit


def turned(degrees, axis):
    """A quaternion x, y, z, w."""
    half = math.radians(degrees) / 2
    return tuple(round(p * math.sin(half), 9) for p in unit(axis)) + (round(math.cos(half), 9),)


X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


class Node:
    def __init__(self, name, suffix=""):
        self.name = name
        # Ends the names below: importers match channels to nodes by name, and repeated blocks
        # would otherwise hold several moving nodes of one name.
        self.suffix = suffix
        self.shape = None  # (mesh, material)
        self.placement = {}  # the glTF properties: translation, rotation, scale, or matrix
        self.children = {}
        self.channels = []  # (property, times, values, interpolation)

    def node(self, path):
        """The node at a path below this one; what is missing is made."""
        found = self
        for name in path.split("/"):
            found = found.children.setdefault(name, Node(name + found.suffix, found.suffix))
        return found

    def add(self, path, mesh=None, material=None, at=None, turn=None, scale=None, matrix=None):
        found = self.node(path)
        found.shape = mesh and (mesh, material)
        values = {"translation": at, "rotation": turn, "scale": scale, "matrix": matrix}
        found.placement = {key: value for key, value in values.items() if value is not None}
        return found

    def box(self, path, x0, x1, y0, y1, z0, z1, material):
        """A unit cube stretched to fill an interval on each axis."""
        intervals = ((x0, x1), (y0, y1), (z0, z1))
        middle = tuple(round((low + high) / 2, 9) for low, high in intervals)
        size = tuple(round(high - low, 9) for low, high in intervals)
        return self.add(path, "Cube", material, at=middle, scale=size)

    def boxes(self, table):
        for row in table:
            self.box(*row)

    def crate(self, path, x, y, z, size, degrees=0):
        """A crate that stands with the middle of its base on a point."""
        return self.add(path, "Cube", "crate", at=(x, round(y + size / 2, 9), z),
                        turn=turned(degrees, Y), scale=(size, size, size))

    def animate(self, target, times, values, interpolation="LINEAR"):
        self.channels.append((target, tuple(times), tuple(values), interpolation))


class Writer:
    """Gathers the lists of a glTF document. Data and descriptions that are equal go in once."""

    def __init__(self, meshes, materials):
        self.meshes = meshes  # by name, as in solids.py
        self.materials = materials  # base colours by name
        self.lists = {}
        self.data = bytearray()
        self.known = {}

    def put(self, kind, item):
        """The index of an item in one of the lists."""
        key = kind + json.dumps(item)
        if key not in self.known:
            self.lists.setdefault(kind, []).append(item)
            self.known[key] = len(self.lists[kind]) - 1
        return self.known[key]

    def accessor(self, values, size, code="f", target=None, bounds=False):
        """Numbers in groups of size; code as in struct: f or H (unsigned short)."""
        packed = struct.pack(f"<{len(values)}{code}", *values)
        if packed not in self.known:
            self.known[packed] = len(self.data)
            self.data += packed + bytes(-len(packed) % 4)
        view = {"buffer": 0, "byteOffset": self.known[packed], "byteLength": len(packed)}
        if target:
            view["target"] = target
        accessor = {"bufferView": self.put("bufferViews", view),
                    "componentType": {"f": 5126, "H": 5123}[code], "count": len(values) // size,
                    "type": {1: "SCALAR", 3: "VEC3", 4: "VEC4"}[size]}
        if bounds:
            stored = struct.unpack(f"<{len(values)}{code}", packed)
            accessor["min"] = [min(stored[i::size]) for i in range(size)]
            accessor["max"] = [max(stored[i::size]) for i in range(size)]
        return self.put("accessors", accessor)

    def mesh(self, name, material):
        positions, normals, triangles = ([number for item in part for number in item]
                                         for part in self.meshes[name])
        return self.put("meshes", {"name": f"{name}_{material}", "primitives": [{
            "attributes": {"POSITION": self.accessor(positions, 3, target=34962, bounds=True),
                           "NORMAL": self.accessor(normals, 3, target=34962)},
            "indices": self.accessor(triangles, 1, "H", target=34963),
            "material": list(self.materials).index(material)}]})

    def node(self, node):
        """Writes a tree; returns the index of its root."""
        written = {"name": node.name, **node.placement}
        nodes = self.lists.setdefault("nodes", [])
        nodes.append(written)
        index = len(nodes) - 1
        if node.shape:
            written["mesh"] = self.mesh(*node.shape)
        for target, times, values, interpolation in node.channels:
            numbers = [number for value in values for number in value]
            sampler = {"input": self.accessor(times, 1, bounds=True),
                       "output": self.accessor(numbers, len(values[0])),
                       "interpolation": interpolation}
            self.lists.setdefault("channels", []).append(
                {"sampler": self.put("samplers", sampler),
                 "target": {"node": index, "path": target}})
        if node.children:
            written["children"] = [self.node(child) for child in node.children.values()]
        return index

    def save(self, root, path):
        top = self.node(root)
        lists = dict(self.lists)
        play = {"name": "Play", **{key: lists.pop(key) for key in ("samplers", "channels")}}
        surfaces = [{"baseColorFactor": [*colour, 1], "metallicFactor": 0, "roughnessFactor": 0.9}
                    for colour in self.materials.values()]
        document = {
            "asset": {"version": "2.0", "generator": "abut scenes/make_level.py"},
            "scene": 0, "scenes": [{"nodes": [top]}], **lists, "animations": [play],
            "materials": [{"name": name, "pbrMetallicRoughness": surface}
                          for name, surface in zip(self.materials, surfaces)],
            "buffers": [{"byteLength": len(self.data)}]}
        if path.endswith(".glb"):
            text = json.dumps(document, separators=(",", ":")).encode()
            text += b" " * (-len(text) % 4)
            body = struct.pack("<I4s", len(text), b"JSON") + text
            body += struct.pack("<I4s", len(self.data), b"BIN\0") + self.data
            content = struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body
        else:
            data = base64.b64encode(self.data).decode()
            document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + data
            content = json.dumps(document, indent=1).encode() + b"\n"
        with open(path, "wb") as file:
            file.write(content)
