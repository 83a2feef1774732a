#pragma once

// The true signed distance to a surface by looking at all of it, in long double, and what a field's samples say.
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
    const long double whole = long_dot<D>(along, along);
    const long double share = whole > 0 ? std::clamp(long_dot<D>(p - a, along) / whole, 0.0L, 1.0L) : 0.0L;
    const LongVec<D> way = p - (a + along * share);
    return long_dot<D>(way, way);
}

/// The square of the distance to a triangle with or without area: to its face where the point projects into it, else to
/// its sides.
inline long double squared_to_triangle(const LongVec<3>& p, const LongVec<3>& a, const LongVec<3>& b,
                                       const LongVec<3>& c) {
    const LongVec<3> normal = long_cross(b - a, c - a);
    const long double area_squared = long_dot<3>(normal, normal);
    const auto before = [&](const LongVec<3>& from, const LongVec<3>& to) {
        return long_dot<3>(long_cross(to - from, p - from), normal) >= 0;
    };
    if (area_squared > 0 && before(a, b) && before(b, c) && before(c, a)) {
        const long double height = long_dot<3>(p - a, normal);
        return height * height / area_squared;
    }
    return std::min({squared_to_segment<3>(p, a, b), squared_to_segment<3>(p, b, c), squared_to_segment<3>(p, c, a)});
}

/// As a share of the whole sphere: how much of what is seen from p the triangle covers, above zero from behind it.
inline long double covered_share(const LongVec<3>& p, const LongVec<3>& first, const LongVec<3>& second,
                                 const LongVec<3>& third) {
    const LongVec<3> a = first - p, b = second - p, c = third - p;
    const long double la = long_length<3>(a), lb = long_length<3>(b), lc = long_length<3>(c);
    const long double volume = long_dot<3>(a, long_cross(b, c));
    const long double rest = la * lb * lc + long_dot<3>(a, b) * lc + long_dot<3>(b, c) * la + long_dot<3>(c, a) * lb;
    return std::atan2(volume, rest) / (2 * std::numbers::pi_v<long double>);
}

/// The same of a segment and the circle, above zero where it goes round p from the first axis to the second.
inline long double covered_share(const LongVec<2>& p, const LongVec<2>& first, const LongVec<2>& second) {
    const LongVec<2> a = first - p, b = second - p;
    return std::atan2(a.x * b.y - a.y * b.x, long_dot<2>(a, b)) / (2 * std::numbers::pi_v<long double>);
}

/// How far from a surface a point is, and how often the surface goes round it.
struct FieldTruth {
    double distance = 0;  ///< without a sign
    double winding = 0;

    bool inside() const { return std::abs(winding) >= 0.5; }
    double signed_distance() const { return inside() ? -distance : distance; }
};

/// Triangles as they are: none is turned round, no hole is closed.
class TriangleTruth {
public:
    TriangleTruth(std::span<const Vec3> points, std::span<const glm::uvec3> triangles) {
        for (const glm::uvec3& triangle : triangles) {
            const LongVec<3> a(points[triangle.x]), b(points[triangle.y]), c(points[triangle.z]);
            corners_.insert(corners_.end(), {a, b, c});
            // With more than all roundings.
            reaches_.push_back(1.000001L * std::max(long_length<3>(b - a), long_length<3>(c - a)));
        }
    }

    /// All triangles are looked at; those whose first corner is too far away for the rest to be nearest only so far.
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
            sum += covered_share(p, corners_[i], corners_[i + 1], corners_[i + 2]);
        return static_cast<double>(sum);
    }
    FieldTruth operator()(const DVec<3>& point) const { return {distance(point), winding(point)}; }

private:
    std::vector<LongVec<3>> corners_;   // three a triangle
    std::vector<long double> reaches_;  // from the first corner of each
};

/// An outline and its holes: inside of the outline, and of none of them.
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
                around += covered_share(p, a, b);
            }
            const bool in_ring = std::abs(around) >= 0.5L;
            inside = &ring == rings_.data() ? in_ring : inside && !in_ring;
        }
        return {static_cast<double>(std::sqrt(least)), inside ? 1.0 : 0.0};
    }

private:
    std::vector<std::vector<LongVec<2>>> rings_;
};

/// A sample as it is kept: where it lies, and its distance.
template <int D>
struct KeptSample {
    DVec<D> position{};
    double distance = 0;
};

/// All that a field keeps: the samples of a dense one; of a sparse one those of its bricks, and those of the corners of
/// its blocks. Those on the sides of bricks come once a brick.
template <int D>
std::vector<KeptSample<D>> kept_samples(const Field<D>& field) {
    using Index = glm::vec<D, std::uint32_t>;
    const FieldData<D>& data = field.data();
    std::vector<KeptSample<D>> result;
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
    // Visits counts.x * counts.y ... places, the first axis the fastest.
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
    const Index blocks = data.cells / brick_cells<D>;
    each(blocks, [&](std::size_t number, const Index& block) {
        if (data.brick[number] == no_brick) return;
        const std::size_t first = std::size_t{data.brick[number]} * brick_samples<D>;
        each(Index(brick_cells<D> + 1), [&](std::size_t inner, const Index& at) {
            result.push_back({position(block * brick_cells<D> + at), distance(first + inner)});
        });
    });
    each(blocks + 1u, [&](std::size_t number, const Index& corner) {
        result.push_back({position(corner * brick_cells<D>), static_cast<double>(data.coarse[number])});
    });
    return result;
}

}  // namespace abut::oracle
