// The first triangle along a ray, from either side: the tree's own search for rays. What that leaves undecided, as it
// skims, starts at a triangle or meets a sliver, is decided here, and so that edges that are shared have no gap.

#include <abut/math/assert.hpp>
#include <abut/shape/mesh_rays.hpp>
#include <abut/walk/walk_data.hpp>
#include <abut/walk/walk_frame.hpp>
#include <abut/walk/walk_nearest_on.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {
namespace {

/// As part of the numbers seen from the ray's origin, far more than rounding: what is so near to a triangle is on it.
constexpr double on_triangle = 1e-12;

/// The part of a way for which something holds.
struct Span {
    double from, to;

    /// Where slope * way + start >= 0.
    void keep(double start, double slope) {
        if (slope > 0)
            from = std::max(from, -start / slope);
        else if (slope < 0)
            to = std::min(to, start / -slope);
        else if (start < 0)
            to = -1;
    }
};

/// How far along a ray from the origin a triangle with an area begins, as a closed set; below 0: it isn't met. First
/// the part of the way that is above or below the triangle, then where on this the height is 0.
double met_along(const DVec<3>& direction, const DVec<3>& a, const DVec<3>& b, const DVec<3>& c) {
    const DVec<3> normal = normalized(cross(b - a, c - a));
    const double near = on_triangle * std::max({largest(a), largest(b), largest(c)});
    Span above{0, std::numeric_limits<double>::infinity()};
    const auto stay_inside = [&](const DVec<3>& start, const DVec<3>& end) {
        const DVec<3> inwards = normalized(cross(normal, end - start));
        above.keep(near - dot(inwards, start), dot(inwards, direction));
    };
    stay_inside(a, b);
    stay_inside(b, c);
    stay_inside(c, a);
    const double height = -dot(normal, a), rise = dot(normal, direction);
    if (above.to >= above.from && std::abs(height + rise * above.from) <= near) return above.from;
    Span within = above;
    within.keep(near - height, -rise);
    within.keep(near + height, rise);
    if (!(within.to >= within.from)) return -1;
    return std::clamp(-height / rise, within.from, within.to);
}

/// The first so far.
struct FirstMet {
    double along;
    std::uint32_t triangle = bvh_none;

    void offer(double met, std::uint32_t number) {
        if (!(met >= 0 && met <= along)) return;
        if (met == along && number >= triangle) return;
        along = met;
        triangle = number;
    }
};

/// Box by box in double, where floats can't hold the numbers.
void find_first_met(const WalkMeshData& data, const Beam<3>& beam, FirstMet& first) {
    const auto look_at = [&](std::uint32_t number) {
        const Vec3* const corner = data.walk[number].corner;
        const auto seen = [&](int k) { return DVec<3>(corner[k]) - beam.origin; };
        first.offer(met_along(beam.direction, seen(0), seen(1), seen(2)), number);
        return first.along < 3e38 ? static_cast<float>(first.along) : std::numeric_limits<float>::infinity();
    };
    find_within(data.tree, RayReach<3>::of_box({beam.origin, DVec<3>(0.0), beam.direction, beam.length}),
                ReachCall(look_at));
}

}  // namespace

std::optional<WalkPoint> WalkMesh::nearest_along(const Vec3& point, const Vec3& direction, float reach) const {
    const bool usable = is_finite(point) && is_finite(direction) && direction != Vec3(0.0f);
    ABUT_ASSERT(usable);
    if (!usable || !(reach >= 0)) return std::nullopt;
    const Beam<3> beam{DVec<3>(point), normalized(DVec<3>(direction)), static_cast<double>(reach)};
    const auto undecided = [&](const Triangle3& triangle, double most, RayEntry<3>& entry) {
        const auto seen = [&](const Vec3& corner) { return DVec<3>(corner) - beam.origin; };
        entry.along = met_along(beam.direction, seen(triangle.a), seen(triangle.b), seen(triangle.c));
        return entry.along >= 0 && entry.along <= most;
    };
    MeshHit hit;
    FirstMet first{beam.length};
    if (!find_first_hit(data_->tree, MeshBeam{beam, beam}, UndecidedTriangle(undecided), hit)) {
        find_first_met(*data_, beam, first);
    } else if (hit.triangle != nullptr) {
        first = {hit.entry.along, *hit.triangle};
    }
    if (first.triangle == bvh_none) return std::nullopt;
    const Vec3* const corner = data_->walk[first.triangle].corner;
    const NearestOnTriangle on = nearest_on({corner[0], corner[1], corner[2]}, beam.at(first.along));
    return WalkPoint{first.triangle, in_grains(on.second, on.third)};
}

}  // namespace abut
