#include "detour_mesh.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include <recastnavigation/DetourNavMeshBuilder.h>

namespace abut::bench {

namespace {

constexpr std::uint32_t max_columns = 120;  // per tile: 28,800 triangles
constexpr int max_polygons = 1 << 15, max_nodes = 65535;
constexpr float height_unit = 1.0f / 256, climb = 0.25f;
constexpr unsigned short border = 0xffff;

/// Aborts if Detour rejects the mesh: a comparison would be void.
void must(bool done) {
    if (done) return;
    std::fputs("abut_bench: Detour refuses the scene\n", stderr);
    std::abort();
}

/// A rectangle of the scene's squares.
struct Tile {
    const WalkScene& scene;
    std::uint32_t column, row, columns, rows;
    bool has_left, has_right, has_near, has_far;

    std::uint32_t triangle(std::uint32_t x, std::uint32_t z, std::uint32_t which) const {
        return 2 * ((row + z) * scene.columns + column + x) + which;
    }
    unsigned short polygon(std::uint32_t x, std::uint32_t z, std::uint32_t which) const {
        return static_cast<unsigned short>(2 * (z * columns + x) + which);
    }
    unsigned short corner(std::uint32_t x, std::uint32_t z) const {
        return static_cast<unsigned short>(z * (columns + 1) + x);
    }
    /// In another tile, or none.
    static unsigned short beyond(bool has, unsigned short direction) {
        return has ? static_cast<unsigned short>(0x8000 | direction) : border;
    }

    unsigned char* data(int x_number, int z_number, int* size) const {
        std::vector<unsigned short> corners, polygons;
        for (std::uint32_t z = 0; z <= rows; ++z)
            for (std::uint32_t x = 0; x <= columns; ++x) {
                const Vec3& point = scene.points[(row + z) * (scene.columns + 1) + column + x];
                corners.insert(corners.end(),
                               {static_cast<unsigned short>(x), static_cast<unsigned short>(point.y / height_unit),
                                static_cast<unsigned short>(z)});
            }
        for (std::uint32_t z = 0; z < rows; ++z)
            for (std::uint32_t x = 0; x < columns; ++x) {
                const unsigned short left = x > 0 ? polygon(x - 1, z, 1) : beyond(has_left, 0);
                const unsigned short right = x + 1 < columns ? polygon(x + 1, z, 0) : beyond(has_right, 2);
                const unsigned short near = z > 0 ? polygon(x, z - 1, 1) : beyond(has_near, 3);
                const unsigned short far = z + 1 < rows ? polygon(x, z + 1, 0) : beyond(has_far, 1);
                polygons.insert(polygons.end(), {corner(x, z), corner(x, z + 1), corner(x + 1, z)});
                polygons.insert(polygons.end(), {left, polygon(x, z, 1), near});
                polygons.insert(polygons.end(), {corner(x + 1, z), corner(x, z + 1), corner(x + 1, z + 1)});
                polygons.insert(polygons.end(), {polygon(x, z, 0), far, right});
            }
        const std::vector<unsigned short> flags(2 * rows * columns, 1);
        const std::vector<unsigned char> areas(flags.size(), 0);
        dtNavMeshCreateParams params{};
        params.verts = corners.data();
        params.vertCount = static_cast<int>(corners.size() / 3);
        params.polys = polygons.data();
        params.polyFlags = flags.data();
        params.polyAreas = areas.data();
        params.polyCount = static_cast<int>(flags.size());
        params.nvp = 3;
        params.tileX = x_number;
        params.tileY = z_number;
        params.bmin[0] = static_cast<float>(column);
        params.bmin[2] = static_cast<float>(row);
        params.bmax[0] = static_cast<float>(column + columns);
        params.bmax[1] = 65535 * height_unit;
        params.bmax[2] = static_cast<float>(row + rows);
        params.walkableHeight = 2;
        params.walkableClimb = climb;
        params.cs = 1;
        params.ch = height_unit;
        params.buildBvTree = true;
        unsigned char* result = nullptr;
        must(dtCreateNavMeshData(&params, &result, size));
        return result;
    }
};

}  // namespace

DetourMesh::DetourMesh(const WalkScene& scene)
    : mesh_(dtAllocNavMesh()), query_(dtAllocNavMeshQuery()), polygons_(scene.triangles.size()) {
    const std::uint32_t columns = scene.columns, tiles = (columns + max_columns - 1) / max_columns;
    const std::uint32_t width = (columns + tiles - 1) / tiles;
    dtNavMeshParams params{};
    params.tileWidth = params.tileHeight = static_cast<float>(width);
    params.maxTiles = static_cast<int>(tiles * tiles);
    params.maxPolys = max_polygons;
    must(dtStatusSucceed(mesh_->init(&params)));
    for (std::uint32_t z = 0; z < tiles; ++z)
        for (std::uint32_t x = 0; x < tiles; ++x) {
            const std::uint32_t column = x * width, row = z * width;
            const Tile tile{scene,
                            column,
                            row,
                            std::min(width, columns - column),
                            std::min(width, columns - row),
                            x > 0,
                            x + 1 < tiles,
                            z > 0,
                            z + 1 < tiles};
            int size = 0;
            unsigned char* data = tile.data(static_cast<int>(x), static_cast<int>(z), &size);
            dtTileRef reference = 0;
            must(dtStatusSucceed(mesh_->addTile(data, size, DT_TILE_FREE_DATA, 0, &reference)));
            const dtPolyRef first = mesh_->getPolyRefBase(mesh_->getTileByRef(reference));
            for (std::uint32_t k = 0; k < tile.rows; ++k)
                for (std::uint32_t i = 0; i < tile.columns; ++i)
                    for (const std::uint32_t which : {0u, 1u})
                        polygons_[tile.triangle(i, k, which)] = first | tile.polygon(i, k, which);
        }
    must(dtStatusSucceed(query_->init(mesh_.get(), max_nodes)));
}

}  // namespace abut::bench
