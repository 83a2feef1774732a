#include "tool/faults/facet_gap.hpp"

#include <abut/abut.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace abut::tool {

using namespace detail;

namespace {

// Tolerance of parallel facets, relative to the width.
constexpr double parallel_tolerance = 1e-4;

template <int D>
using Corners = std::vector<DVec<D>>;

// The support set of a facet in a direction, translated by `shift`.
template <int D>
Corners<D> support_set(const FacetShape<D>& facet, const DVec<D>& along, double tolerance, const DVec<D>& shift) {
    const auto all = corners<D>(facet);
    double max_height = dot(DVec<D>(all[0]), along);
    for (const Vec<D>& corner : all) max_height = std::max(max_height, dot(DVec<D>(corner), along));
    Corners<D> result;
    for (const Vec<D>& corner : all)
        if (dot(DVec<D>(corner), along) >= max_height - tolerance) result.push_back(DVec<D>(corner) + shift);
    return result;
}

// Clips a point, a segment or a convex polygon to the half-space dot(normal, p) <= offset.
template <int D>
Corners<D> clip(const Corners<D>& polygon, const DVec<D>& normal, double offset) {
    Corners<D> result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const DVec<D>&from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
        const double from_height = dot(normal, from) - offset, to_height = dot(normal, to) - offset;
        if (from_height <= 0) result.push_back(from);
        // A segment has a single edge, and a polygon as many as vertices.
        const bool is_side = polygon.size() > 2 || i == 0;
        if (is_side && polygon.size() > 1 && (from_height < 0) != (to_height < 0) && from_height != to_height &&
            from_height != 0 && to_height != 0)
            result.push_back(from + (to - from) * (from_height / (from_height - to_height)));
    }
    return result;
}

// The intersection of a set with a coplanar segment or triangle. If the latter is a point, the set is returned
// unchanged, since that point is in it.
template <int D>
Corners<D> intersect(Corners<D> polygon, const Corners<D>& with, const DVec<D>& out_of_plane, double tolerance) {
    if (with.size() == 2) {
        const DVec<D> along = normalized(with[1] - with[0]);
        polygon = clip(polygon, along, dot(along, with[1]) + tolerance);
        return clip(polygon, -along, -dot(along, with[0]) + tolerance);
    }
    if constexpr (D == 3)
        for (std::size_t i = 0; with.size() == 3 && i < 3; ++i) {
            const DVec<3>&a = with[i], &b = with[(i + 1) % 3], &c = with[(i + 2) % 3];
            DVec<3> outwards = normalized(cross(b - a, out_of_plane));
            if (dot(outwards, c - a) > 0) outwards = -outwards;
            polygon = clip(polygon, outwards, dot(outwards, a) + tolerance);
        }
    return polygon;
}

template <int D>
DVec<D> centroid_of(const Corners<D>& polygon) {
    DVec<D> weighted(0.0), sum(0.0);
    for (const DVec<D>& corner : polygon) sum += corner;
    double area = 0;
    if constexpr (D == 3)
        for (std::size_t i = 2; i < polygon.size(); ++i) {
            const double part = length(cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]));
            weighted += (polygon[0] + polygon[i - 1] + polygon[i]) * (part / 3);
            area += part;
        }
    return area > 0 ? weighted / area : sum / static_cast<double>(polygon.size());
}

}  // namespace

template <int D>
std::optional<FacetGap<D>> facet_gap(const FacetShape<D>& a, const FacetShape<D>& b, double min_width,
                                     double max_width) {
    const Closest<D> nearest = closest(a, b);
    const auto width = static_cast<double>(nearest.distance);
    if (!(width > 0) || !(width > min_width) || !(width < max_width)) return std::nullopt;
    FacetGap<D> result;
    result.width = width;
    result.across = normalized(DVec<D>(nearest.normal));
    const double tolerance = parallel_tolerance * result.width;
    const DVec<D> offset = result.across * result.width, half = offset * 0.5;
    Corners<D> on_a = support_set<D>(a, result.across, tolerance, DVec<D>(0.0));
    Corners<D> on_b = support_set<D>(b, -result.across, tolerance, -offset);
    // Two segments that aren't parallel, or a point, have a single shortest connection.
    DVec<D> along(0.0), beside(0.0);
    if (on_a.size() == 2) along = normalized(on_a[1] - on_a[0]);
    if (on_b.size() == 2) beside = normalized(on_b[1] - on_b[0]);
    const bool crossing = on_a.size() == 2 && on_b.size() == 2 &&
                          std::abs(dot(along, beside)) < 1 - 0.5 * parallel_tolerance * parallel_tolerance;
    if (!crossing && on_a.size() > 1 && on_b.size() > 1) {
        if (on_b.size() < on_a.size()) std::swap(on_a, on_b);
        result.midpoints = intersect<D>(on_a, on_b, result.across, tolerance);
    }
    if (result.midpoints.empty()) result.midpoints = {DVec<D>(nearest.on_a)};
    // Positions are measured from facet A, independent of which set was clipped.
    for (DVec<D>& middle : result.midpoints)
        middle += result.across * dot(DVec<D>(nearest.on_a) - middle, result.across) + half;
    result.centroid = centroid_of<D>(result.midpoints);
    return result;
}

template std::optional<FacetGap<2>> facet_gap<2>(const Segment<2>&, const Segment<2>&, double, double);
template std::optional<FacetGap<3>> facet_gap<3>(const Triangle<3>&, const Triangle<3>&, double, double);

}  // namespace abut::tool
