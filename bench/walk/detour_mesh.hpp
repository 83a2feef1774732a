#pragma once

// A scene of walkers for Detour: one polygon per triangle.

#include "walk.hpp"

#include <memory>

#include <recastnavigation/DetourNavMesh.h>
#include <recastnavigation/DetourNavMeshQuery.h>

namespace abut::bench {

/// In several tiles: Detour has 15 bits for neighbour indices within a tile.
class DetourMesh {
public:
    explicit DetourMesh(const WalkScene& scene);

    dtPolyRef polygon(std::uint32_t triangle) const { return polygons_[triangle]; }
    const dtNavMeshQuery& query() const { return *query_; }
    const dtQueryFilter& filter() const { return filter_; }

private:
    struct Free {
        void operator()(dtNavMesh* mesh) const { dtFreeNavMesh(mesh); }
        void operator()(dtNavMeshQuery* query) const { dtFreeNavMeshQuery(query); }
    };

    std::unique_ptr<dtNavMesh, Free> mesh_;
    std::unique_ptr<dtNavMeshQuery, Free> query_;
    dtQueryFilter filter_;
    std::vector<dtPolyRef> polygons_;  ///< per triangle
};

}  // namespace abut::bench
