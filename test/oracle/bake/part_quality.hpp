#pragma once

// The errors of convex parts as an approximation of a mesh, measured at random points.

#include "../random.hpp"
#include <abut/bake/solid.hpp>
#include <abut/math/aabb.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/contains.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/polyhedron.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace abut::oracle {

using detail::cross;
using detail::dot;
using detail::DVec;
using detail::length;
using detail::to_float;

struct PartQuality {
    double extra = 0;      ///< volume of the parts outside of the mesh, as a share of the mesh's; 0 if the mesh is open
    double missing = 0;    ///< volume of the mesh in no part, as a share of the mesh's; 0 if the mesh is open
    double uncovered = 0;  ///< the share of the surface that is more than 0.1 % of the diagonal outside of all parts
    double farthest = 0;   ///< the largest distance of a surface point outside of all parts, as a share of the diagonal
    double samples_inside = 0;  ///< the number of sampled points inside of the mesh
    std::size_t corners = 0;    ///< the largest number of corners of a part
    std::size_t all_corners = 0;
};

/// Convex parts with their bounding boxes.
class ConvexParts {
public:
    explicit ConvexParts(std::span<const Polyhedron> parts) : parts_(parts) {
        for (const Polyhedron& part : parts) boxes_.push_back(bounds(View<3>(view(part))));
    }

    Aabb3 box() const {
        Aabb3 result = Aabb3::empty();
        for (const Aabb3& box : boxes_) result = merged(result, box);
        return result;
    }

    bool contain(const Vec3& point) const {
        for (std::size_t i = 0; i < parts_.size(); ++i)
            if (overlaps(boxes_[i], Aabb3{point, point}) && contains_point(parts_[i], point)) return true;
        return false;
    }

    /// The distance to the nearest part; 0 inside of one.
    double distance(const Vec3& point) const {
        if (contain(point)) return 0;
        double result = std::numeric_limits<double>::infinity();
        for (const Polyhedron& part : parts_)
            result = std::min(result, static_cast<double>(closest(part, point).distance));
        return std::max(result, 0.0);
    }

private:
    static bool contains_point(const Polyhedron& part, const Vec3& point) {
        const detail::Facets& facets = part.facets();
        if (facets.normals.empty()) return false;
        for (std::size_t i = 0; i < facets.normals.size(); ++i)
            if (dot(DVec<3>(facets.normals[i]), DVec<3>(point)) > part.offsets()[i]) return false;
        return true;
    }

    std::span<const Polyhedron> parts_;
    std::vector<Aabb3> boxes_;
};

/// Random points, uniform over the surface.
class SurfacePoints {
public:
    SurfacePoints(std::span<const Vec3> points, std::span<const glm::uvec3> triangles)
        : points_(points), triangles_(triangles) {
        double sum = 0;
        for (const glm::uvec3& t : triangles) {
            const DVec<3> a(points[t.x]), b(points[t.y]), c(points[t.z]);
            cumulative_area_.push_back(sum += length(cross(b - a, c - a)));
        }
    }

    Vec3 next(Random& random) const {
        const double at = random.uniform(0, cumulative_area_.back());
        const auto found =
            std::upper_bound(cumulative_area_.begin(), cumulative_area_.end() - 1, at) - cumulative_area_.begin();
        const glm::uvec3& t = triangles_[static_cast<std::size_t>(found)];
        const DVec<3> a(points_[t.x]), b(points_[t.y]), c(points_[t.z]);
        const double root = std::sqrt(random.unit()), along = random.unit();
        const DVec<3> p = a * (1 - root) + b * (root * (1 - along)) + c * (root * along);
        return to_float(p);
    }

private:
    std::span<const Vec3> points_;
    std::span<const glm::uvec3> triangles_;
    std::vector<double> cumulative_area_;
};

/// Samples `samples` points in the box around the mesh and all parts, and as many on the surface. The standard error is
/// about 1 / sqrt(samples in the mesh); that of `extra` is sqrt(extra) times this.
inline PartQuality quality_of(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                              std::span<const Polyhedron> polyhedra, std::uint32_t samples, std::uint64_t seed) {
    PartQuality result;
    for (const Polyhedron& part : polyhedra) {
        result.corners = std::max(result.corners, part.points().size());
        result.all_corners += part.points().size();
    }
    Random random(seed);
    const ConvexParts parts(polyhedra);
    const Mesh mesh = *Mesh::build(points, triangles);
    const Aabb3 box = merged(bounds(mesh), parts.box());
    const DVec<3> low(box.min), size = DVec<3>(box.max) - low;
    const double diagonal = length(DVec<3>(bounds(mesh).max) - DVec<3>(bounds(mesh).min));

    if (mesh.closed()) {
        std::uint32_t inside = 0, extra = 0, missing = 0;
        for (std::uint32_t i = 0; i < samples; ++i) {
            const DVec<3> at = low + size * (0.5 * (random.in_cube<3>() + DVec<3>(1.0)));
            const Vec3 point = to_float(at);
            const bool in_mesh = contains(mesh, point), in_parts = parts.contain(point);
            inside += in_mesh;
            extra += in_parts && !in_mesh;
            missing += in_mesh && !in_parts;
        }
        result.samples_inside = inside;
        result.extra = extra / std::max(1.0, static_cast<double>(inside));
        result.missing = missing / std::max(1.0, static_cast<double>(inside));
    }

    const SurfacePoints surface(points, triangles);
    std::uint32_t uncovered = 0;
    for (std::uint32_t i = 0; i < samples; ++i) {
        const double outside = parts.distance(surface.next(random)) / diagonal;
        uncovered += outside > 1e-3;
        result.farthest = std::max(result.farthest, outside);
    }
    result.uncovered = uncovered / static_cast<double>(samples);
    return result;
}

}  // namespace abut::oracle
