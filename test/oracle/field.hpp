#pragma once

// The true signed distance to a surface by brute force, in long double; and the samples that a field stores.
//
// Closest points by the regions of Ericson, "Real-Time Collision Detection" (2005), 5.1.5; solid angles by van Oosterom
// and Strackee, "The solid angle of a plane triangle" (1983).

#include "random.hpp"
#include <abut/field/field.hpp>
#include <abut/math/vec.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::oracle {

using detail::axis;
using detail::DVec;

template <int D>
using LongVec = glm::vec<D, long double>;

template <int D>
long double long_dot(const LongVec<D>& a, const LongVec<D>& b) {
    long double sum = 0;
    for (int i = 0; i < D; ++i) sum += a[i] * b[i];
    return sum;
}
template <int D>
long double long_length(const LongVec<D>& v) {
    return std::sqrt(long_dot<D>(v, v));
}
inline LongVec<3> long_cross(const LongVec<3>& a, const LongVec<3>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <int D>
long double squared_to_segment(const LongVec<D>& p, const LongVec<D>& a, const LongVec<D>& b) {
    const LongVec<D> along = b - a;
    const long double length_squared = long_dot<D>(along, along);
    const long double share =
        length_squared > 0 ? std::clamp(long_dot<D>(p - a, along) / length_squared, 0.0L, 1.0L) : 0.0L;
    const LongVec<D> offset = p - (a + along * share);
    return long_dot<D>(offset, offset);
}

/// The squared distance to a triangle, with or without area: to its face if the point projects into it, else to the
/// nearest edge.
inline long double squared_to_triangle(const LongVec<3>& p, const LongVec<3>& a, const LongVec<3>& b,
                                       const LongVec<3>& c) {
    const LongVec<3> normal = long_cross(b - a, c - a);
    const long double area_squared = long_dot<3>(normal, normal);
    const auto is_inside_edge = [&](const LongVec<3>& from, const LongVec<3>& to) {
        return long_dot<3>(long_cross(to - from, p - from), normal) >= 0;
    };
    if (area_squared > 0 && is_inside_edge(a, b) && is_inside_edge(b, c) && is_inside_edge(c, a)) {
        const long double height = long_dot<3>(p - a, normal);
        return height * height / area_squared;
    }
    return std::min({squared_to_segment<3>(p, a, b), squared_to_segment<3>(p, b, c), squared_to_segment<3>(p, c, a)});
}

/// The solid angle of a triangle seen from p, as a share of the sphere; above zero from behind the triangle.
inline long double solid_angle_share(const LongVec<3>& p, const LongVec<3>& first, const LongVec<3>& second,
                                     const LongVec<3>& third) {
    const LongVec<3> a = first - p, b = second - p, c = third - p;
    const long double la = long_length<3>(a), lb = long_length<3>(b), lc = long_length<3>(c);
    const long double volume = long_dot<3>(a, long_cross(b, c));
    const long double rest = la * lb * lc + long_dot<3>(a, b) * lc + long_dot<3>(b, c) * la + long_dot<3>(c, a) * lb;
    return std::atan2(volume, rest) / (2 * std::numbers::pi_v<long double>);
}

/// The angle of a segment seen from p, as a share of the circle; above zero if the segment goes counter-clockwise.
inline long double solid_angle_share(const LongVec<2>& p, const LongVec<2>& first, const LongVec<2>& second) {
    const LongVec<2> a = first - p, b = second - p;
    return std::atan2(a.x * b.y - a.y * b.x, long_dot<2>(a, b)) / (2 * std::numbers::pi_v<long double>);
}

/// The distance of a point from a surface, and the winding number of the surface around it.
struct FieldTruth {
    double distance = 0;  ///< unsigned
    double winding = 0;

    bool inside() const { return std::abs(winding) >= 0.5; }
    double signed_distance() const { return inside() ? -distance : distance; }
};

/// Measures triangles as they are: none is reoriented, no hole is closed.
class TriangleTruth {
public:
    TriangleTruth(std::span<const Vec3> points, std::span<const glm::uvec3> triangles) {
        for (const glm::uvec3& triangle : triangles) {
            const LongVec<3> a(points[triangle.x]), b(points[triangle.y]), c(points[triangle.z]);
            corners_.insert(corners_.end(), {a, b, c});
            // The factor is above all roundings.
            reaches_.push_back(1.000001L * std::max(long_length<3>(b - a), long_length<3>(c - a)));
        }
    }

    /// Tests all triangles. A triangle whose first corner is too far away for any of it to be nearest is skipped.
    double distance(const DVec<3>& point) const {
        const LongVec<3> p(point);
        long double least = std::numeric_limits<long double>::infinity(), nearest = least;
        for (std::size_t i = 0; i < reaches_.size(); ++i) {
            const LongVec<3>& a = corners_[3 * i];
            const long double reach = nearest + reaches_[i];
            if (long_dot<3>(p - a, p - a) > reach * reach) continue;
            const long double squared = squared_to_triangle(p, a, corners_[3 * i + 1], corners_[3 * i + 2]);
            if (squared >= least) continue;
            least = squared;
            nearest = std::sqrt(least);
        }
        return static_cast<double>(nearest);
    }
    double winding(const DVec<3>& point) const {
        long double sum = 0;
        const LongVec<3> p(point);
        for (std::size_t i = 0; i < corners_.size(); i += 3)
            sum += solid_angle_share(p, corners_[i], corners_[i + 1], corners_[i + 2]);
        return static_cast<double>(sum);
    }
    FieldTruth operator()(const DVec<3>& point) const { return {distance(point), winding(point)}; }

private:
    std::vector<LongVec<3>> corners_;   // three a triangle
    std::vector<long double> reaches_;  // the bounding radius of each about its first corner
};

/// An outline with holes. A point is inside if it is inside of the outline and of no hole.
class OutlineTruth {
public:
    explicit OutlineTruth(std::span<const Vec2> outline, std::span<const std::vector<Vec2>> holes = {}) {
        rings_.emplace_back(outline.begin(), outline.end());
        for (const std::vector<Vec2>& hole : holes) rings_.emplace_back(hole.begin(), hole.end());
    }

    FieldTruth operator()(const DVec<2>& point) const {
        const LongVec<2> p(point);
        long double least = std::numeric_limits<long double>::infinity();
        bool inside = false;
        for (const std::vector<LongVec<2>>& ring : rings_) {
            long double around = 0;
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const LongVec<2>&a = ring[i], &b = ring[(i + 1) % ring.size()];
                least = std::min(least, squared_to_segment<2>(p, a, b));
                around += solid_angle_share(p, a, b);
            }
            const bool in_ring = std::abs(around) >= 0.5L;
            inside = &ring == rings_.data() ? in_ring : inside && !in_ring;
        }
        return {static_cast<double>(std::sqrt(least)), inside ? 1.0 : 0.0};
    }

private:
    std::vector<std::vector<LongVec<2>>> rings_;
};

/// A sample that a field stores: its position and distance.
template <int D>
struct StoredSample {
    DVec<D> position{};
    double distance = 0;
};

/// All samples that a field stores. A sparse field has those of its bricks and of the corners of its blocks. A sample
/// on the side of several bricks is returned once for each.
template <int D>
std::vector<StoredSample<D>> stored_samples(const Field<D>& field) {
    using Index = glm::vec<D, std::uint32_t>;
    const detail::FieldData<D>& data = field.data();
    std::vector<StoredSample<D>> result;
    const auto position = [&](const Index& at) {
        DVec<D> place;
        for (int i = 0; i < D; ++i)
            place[i] = static_cast<double>(data.origin[i]) + static_cast<double>(data.cell) * at[i];
        return place;
    };
    const auto distance = [&](std::size_t i) {
        return data.steps.empty() ? static_cast<double>(data.distance[i])
                                  : static_cast<double>(data.steps[i]) * static_cast<double>(data.step);
    };
    // Visits counts.x * counts.y ... indices; the first axis is the fastest.
    const auto each = [](const Index& counts, auto visit) {
        Index at(0u);
        for (std::size_t number = 0;; ++number) {
            visit(number, at);
            int axis = 0;
            while (axis < D && ++at[axis] == counts[axis]) at[axis++] = 0;
            if (axis == D) return;
        }
    };
    if (data.store == FieldStore::dense) {
        each(data.cells + 1u, [&](std::size_t number, const Index& at) {
            result.push_back({position(at), distance(number)});
        });
        return result;
    }
    const Index blocks = data.cells / detail::brick_cells<D>;
    each(blocks, [&](std::size_t number, const Index& block) {
        if (data.brick[number] == detail::no_brick) return;
        const std::size_t first = std::size_t{data.brick[number]} * detail::brick_samples<D>;
        each(Index(detail::brick_cells<D> + 1), [&](std::size_t inner, const Index& at) {
            result.push_back({position(block * detail::brick_cells<D> + at), distance(first + inner)});
        });
    });
    each(blocks + 1u, [&](std::size_t number, const Index& corner) {
        result.push_back({position(corner * detail::brick_cells<D>), static_cast<double>(data.coarse[number])});
    });
    return result;
}

}  // namespace abut::oracle
