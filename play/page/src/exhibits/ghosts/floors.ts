// Flat floors of many parts: as one shape of the library, and as its parts, each by itself.

import type { Abut } from "../../library";
import type { AnyShape } from "../../questions";

export interface Floor {
    readonly shape: AnyShape;
    readonly parts: readonly AnyShape[];
    /** In C++: lines for what the others use, the shape, and part number i. */
    readonly cppLines: readonly string[];
    readonly cpp: string;
    readonly cppPart: string;
}

/** Floors reach from minus this far to this far along x, and their surface is at height 0. */
export const halfLength = 6;
const halfWidth = 2;
/** The cells of the mesh: two to a unit. */
const cells = { x: 4 * halfLength, z: 4 * halfWidth, side: 0.5 } as const;

const meshLines = [
    "std::vector<abut::Vec3> points;",
    "std::vector<glm::uvec3> triangles;",
    `for (std::uint32_t i = 0; i < ${(cells.x + 1) * (cells.z + 1)}; ++i)`,
    `    points.push_back({${cells.side}f * static_cast<float>(i % ${cells.x + 1}) - ${halfLength}, 0, ${cells.side}f * static_cast<float>(i / ${cells.x + 1}) - ${halfWidth}});`,
    `for (std::uint32_t i = 0; i < ${cells.x * cells.z}; ++i) {`,
    `    const std::uint32_t corner = i / ${cells.x} * ${cells.x + 1} + i % ${cells.x}, across = corner + ${cells.x + 1};`,
    "    triangles.insert(triangles.end(), {{corner, across, corner + 1}, {corner + 1, across, across + 1}});",
    "}",
];

interface Kind {
    readonly name: string;
    make(abut: Abut): Floor;
}

export const floors2: Readonly<Record<string, Kind>> = {
    tiles: {
        name: "tile map",
        make: (abut) => ({
            shape: abut.at(abut.TileMap(new Array<number>(2 * halfLength).fill(1), 2 * halfLength, [1, 1]), {
                position: [-halfLength, -1],
            }),
            parts: each(2 * halfLength, (i) => abut.Box2([i - halfLength + 0.5, -0.5], [0.5, 0.5])),
            cppLines: [`const std::vector<abut::Tile> row(${2 * halfLength}, abut::Tile::full);`],
            cpp: `abut::at(*abut::TileMap::build(row, ${2 * halfLength}, 1.0f), abut::Pose2{{-${halfLength}, -1}})`,
            cppPart: `abut::Box2{{static_cast<float>(i) - ${halfLength - 0.5}f, -0.5f}, {0.5f, 0.5f}}`,
        }),
    },
    chain: {
        name: "chain",
        make: (abut) => ({
            shape: abut.Chain(each(2 * halfLength + 1, (i) => [i - halfLength, 0])),
            parts: each(2 * halfLength, (i) => abut.Segment2([i - halfLength, 0], [i - halfLength + 1, 0])),
            cppLines: [
                "std::vector<abut::Vec2> points;",
                `for (int x = -${halfLength}; x <= ${halfLength}; ++x) points.push_back({static_cast<float>(x), 0});`,
            ],
            cpp: "*abut::Chain::build(points, false)",
            cppPart: `abut::Segment2{points[i], points[i + 1]}`,
        }),
    },
};

export const floors3: Readonly<Record<string, Kind>> = {
    mesh: {
        name: "mesh of triangles",
        make: (abut) => {
            const points = grid();
            const triangles = Array.from({ length: cells.x * cells.z }, (_, i) => {
                const corner = Math.floor(i / cells.x) * (cells.x + 1) + (i % cells.x);
                const across = corner + cells.x + 1;
                return [
                    [corner, across, corner + 1],
                    [corner + 1, across, across + 1],
                ];
            }).flat();
            const at = (i: number | undefined): number[] => points[i ?? 0] ?? [];
            return {
                shape: abut.Mesh(points, triangles.flat()),
                parts: triangles.map(([a, b, c]) => abut.Triangle3(at(a), at(b), at(c))),
                cppLines: meshLines,
                cpp: "*abut::Mesh::build(points, triangles)",
                cppPart: "abut::Triangle3{points[triangles[i].x], points[triangles[i].y], points[triangles[i].z]}",
            };
        },
    },
    voxels: {
        name: "voxels",
        make: (abut) => {
            const [nx, nz] = [2 * halfLength, 2 * halfWidth];
            return {
                shape: abut.at(abut.VoxelMap(new Array<number>(nx * nz).fill(1), nx, 1, nz, [1, 1, 1]), {
                    position: [-halfLength, -1, -halfWidth],
                }),
                parts: each(nx * nz, (i) =>
                    abut.Box3([(i % nx) - halfLength + 0.5, -0.5, Math.floor(i / nx) - halfWidth + 0.5], [0.5, 0.5, 0.5]),
                ),
                cppLines: [`const std::vector<std::uint64_t> solid{(std::uint64_t{1} << ${nx * nz}) - 1};`],
                cpp: `abut::at(*abut::VoxelMap::build(solid, {${nx}, 1, ${nz}}, 1.0f), abut::Pose3{{-${halfLength}, -1, -${halfWidth}}})`,
                cppPart: `abut::Box3{{static_cast<float>(i % ${nx}) - ${halfLength - 0.5}f, -0.5f, static_cast<float>(i / ${nx}) - ${halfWidth - 0.5}f}, {0.5f, 0.5f, 0.5f}}`,
            };
        },
    },
};

/** Choices for `Panel.choice`. */
export function floorChoices(dimension: 2 | 3): Record<string, string> {
    return Object.fromEntries(Object.entries(dimension === 2 ? floors2 : floors3).map(([id, { name }]) => [id, name]));
}
export function floorOf(abut: Abut, dimension: 2 | 3, id: string): Floor {
    const kinds = dimension === 2 ? floors2 : floors3;
    return ((kinds[id] ?? Object.values(kinds)[0]) as Kind).make(abut);
}

function each<T>(count: number, make: (i: number) => T): T[] {
    return Array.from({ length: count }, (_, i) => make(i));
}
/** The corners of the cells, row by row along x. */
function grid(): number[][] {
    const columns = cells.x + 1;
    return each(columns * (cells.z + 1), (i) => [
        (i % columns) * cells.side - halfLength,
        0,
        Math.floor(i / columns) * cells.side - halfWidth,
    ]);
}
