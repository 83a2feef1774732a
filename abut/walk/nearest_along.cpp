// Ray casts against both sides of the triangles, by the tree's own ray search. Rays that graze a triangle, start on one
// or cross a sliver are decided here, so that shared edges leave no gap.

#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/mesh/rays.hpp>
#include <abut/walk/data.hpp>
#include <abut/walk/frame.hpp>
#include <abut/walk/nearest_on.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

using namespace detail;

namespace {

/// Points this near to a triangle lie on it, relative to the largest coordinate from the ray's origin; it exceeds all
/// rounding.
constexpr double relative_tolerance = 1e-12;

/// An interval of the ray's parameter.
struct Interval {
    double from, to;

    /// Clips the interval to slope * t + start >= 0.
    void clip(double start, double slope) {
        if (slope > 0)
            from = std::max(from, -start / slope);
        else if (slope < 0)
            to = std::min(to, start / -slope);
        else if (start < 0)
            to = -1;
    }
};

/// The parameter at which a ray enters a triangle, a closed set; negative if it misses. First the interval above or
/// below the triangle is found, then where in it the height is 0.
double entry_along(const DVec<3>& direction, const DVec<3>& a, const DVec<3>& b, const DVec<3>& c) {
    const DVec<3> normal = normalized(cross(b - a, c - a));
    const double tolerance = relative_tolerance * std::max({largest(a), largest(b), largest(c)});
    Interval above{0, std::numeric_limits<double>::infinity()};
    const auto clip_to_side = [&](const DVec<3>& start, const DVec<3>& end) {
        const DVec<3> inwards = normalized(cross(normal, end - start));
        above.clip(tolerance - dot(inwards, start), dot(inwards, direction));
    };
    clip_to_side(a, b);
    clip_to_side(b, c);
    clip_to_side(c, a);
    const double height = -dot(normal, a), rise = dot(normal, direction);
    if (above.to >= above.from && std::abs(height + rise * above.from) <= tolerance) return above.from;
    Interval within = above;
    within.clip(tolerance - height, -rise);
    within.clip(tolerance + height, rise);
    if (!(within.to >= within.from)) return -1;
    return std::clamp(-height / rise, within.from, within.to);
}

/// The nearest hit so far.
struct FirstHit {
    double along;
    std::uint32_t triangle = detail::bvh_none;

    void update(double entry, std::uint32_t number) {
        if (!(entry >= 0 && entry <= along)) return;
        if (entry == along && number >= triangle) return;
        along = entry;
        triangle = number;
    }
};

/// Searches in double if the coordinates exceed the range of float.
void find_first_hit_in_double(const WalkMeshData& data, const DRay<3>& beam, FirstHit& first) {
    const auto test_triangle = [&](std::uint32_t number) {
        const Vec3* const corner = data.walk[number].corner;
        const auto relative = [&](int k) { return DVec<3>(corner[k]) - beam.origin; };
        first.update(entry_along(beam.direction, relative(0), relative(1), relative(2)), number);
        return first.along < 3e38 ? static_cast<float>(first.along) : std::numeric_limits<float>::infinity();
    };
    find_within(data.tree, RayReach<3>::of_box({beam.origin, DVec<3>(0.0), beam.direction, beam.length}),
                ReachCall(test_triangle));
}

[[gnu::noinline]] std::optional<WalkPoint> first_along(const WalkMeshData& data, const Vec3& point,
                                                       const Vec3& direction, float reach) {
    const bool usable = is_finite(point) && is_finite(direction) && direction != Vec3(0.0f);
    ABUT_ASSERT(usable);
    if (!usable || !(reach >= 0)) return std::nullopt;
    const DRay<3> beam{DVec<3>(point), normalized(DVec<3>(direction)), static_cast<double>(reach)};
    const auto undecided = [&](const Triangle3& triangle, double limit, RayEntry<3>& entry) {
        const auto relative = [&](const Vec3& corner) { return DVec<3>(corner) - beam.origin; };
        entry.along = entry_along(beam.direction, relative(triangle.a), relative(triangle.b), relative(triangle.c));
        return entry.along >= 0 && entry.along <= limit;
    };
    MeshHit hit;
    FirstHit first{beam.length};
    const Ray3 rounded{point, to_float(beam.direction), reach};
    if (!find_first_hit(data.tree, MeshRay{beam, {rounded}}, RobustTriangleTest(undecided), hit)) {
        find_first_hit_in_double(data, beam, first);
    } else if (hit.triangle != nullptr) {
        first = {hit.entry.along, *hit.triangle};
    }
    if (first.triangle == detail::bvh_none) return std::nullopt;
    const Vec3* const corner = data.walk[first.triangle].corner;
    const NearestOnTriangle on = nearest_on({corner[0], corner[1], corner[2]}, beam.at(first.along));
    return WalkPoint{first.triangle, quantised_weights(on.second, on.third)};
}

}  // namespace

std::optional<WalkPoint> WalkMesh::nearest_along(const Vec3& point, const Vec3& direction, float reach) const {
    detail::enter_library();
    return first_along(*data_, point, direction, reach);
}

}  // namespace abut
