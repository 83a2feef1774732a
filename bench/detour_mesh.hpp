#pragma once

// A scene of walkers as Detour has it: one polygon a triangle.

#include "walk.hpp"

#include <memory>

#include <recastnavigation/DetourNavMesh.h>
#include <recastnavigation/DetourNavMeshQuery.h>

namespace abut::bench {

/// In tiles, as many as it needs: Detour has 15 bits for the numbers of neighbours in a tile.
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
    std::vector<dtPolyRef> polygons_;  ///< of triangles
};

}  // namespace abut::bench
