#include "openvdb_field.hpp"

#include <vector>

#include <oneapi/tbb/task_arena.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>

namespace abut::bench {
namespace {

// The mesh in OpenVDB's interface: points in index space.
class Triangles {
public:
    Triangles(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
              const openvdb::math::Transform& transform)
        : triangles_(triangles) {
        points_.reserve(points.size());
        for (const Vec3& p : points) points_.push_back(transform.worldToIndex(openvdb::Vec3d(p.x, p.y, p.z)));
    }

    std::size_t polygonCount() const { return triangles_.size(); }
    std::size_t pointCount() const { return points_.size(); }
    std::size_t vertexCount(std::size_t) const { return 3; }
    void getIndexSpacePoint(std::size_t triangle, std::size_t corner, openvdb::Vec3d& point) const {
        point = points_[triangles_[triangle][static_cast<int>(corner)]];
    }

private:
    std::vector<openvdb::Vec3d> points_;
    std::span<const glm::uvec3> triangles_;
};

}  // namespace

struct OpenvdbField::Grid {
    openvdb::FloatGrid::Ptr grid;
    openvdb::Vec3d origin;
    double per_cell = 0;
};

OpenvdbField::OpenvdbField(std::span<const Vec3> points, std::span<const glm::uvec3> triangles, const Vec3& origin,
                           float cell, float band, OpenvdbDistances distances) {
    openvdb::initialize();
    const auto transform = openvdb::math::Transform::createLinearTransform(static_cast<double>(cell));
    transform->postTranslate(openvdb::Vec3d(origin.x, origin.y, origin.z));
    const Triangles mesh(points, triangles, *transform);
    const int flags = distances == OpenvdbDistances::cleaned ? 0
                                                             : openvdb::tools::DISABLE_INTERSECTING_VOXEL_REMOVAL |
                                                                   openvdb::tools::DISABLE_RENORMALIZATION;
    oneapi::tbb::task_arena one_thread(1);
    grid_ = one_thread.execute([&] {
        return std::make_shared<Grid>(
            Grid{openvdb::tools::meshToVolume<openvdb::FloatGrid>(mesh, *transform, band, band, flags),
                 openvdb::Vec3d(origin.x, origin.y, origin.z), 1 / static_cast<double>(cell)});
    });
}

void OpenvdbField::distance(std::span<const Vec3> points, std::span<double> out) const {
    const openvdb::FloatGrid::ConstAccessor accessor = grid_->grid->getConstAccessor();
    // GridSampler is not used: it applies the transform through a virtual function per point.
    for (std::size_t i = 0; i < points.size(); ++i) {
        const openvdb::Vec3d place(points[i].x, points[i].y, points[i].z);
        out[i] = static_cast<double>(
            openvdb::tools::BoxSampler::sample(accessor, (place - grid_->origin) * grid_->per_cell));
    }
}

std::size_t OpenvdbField::bytes() const {
    return grid_->grid->memUsage();
}

}  // namespace abut::bench
