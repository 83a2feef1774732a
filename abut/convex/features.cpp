#include <abut/convex/features.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>

namespace abut::detail {
namespace {

/// A smaller distance, relative to the coordinates, may be rounding, and has no direction.
constexpr double relative_rounding = 0x1p-30;

/// Sets the feature of a box at which the axes in `fixed` are at one end, and those in `low` at the low end.
template <int D>
void set_box_feature(ClosestFeature<D>& result, std::uint32_t fixed, std::uint32_t low) {
    std::uint32_t free_count = 0, free = 0, first_fixed = D;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(D); ++i) {
        if ((fixed >> i & 1u) == 0) {
            ++free_count;
            free |= 1u << i;
        } else {
            first_fixed = std::min(first_fixed, i);
        }
    }
    if (free_count == 0) {
        result.kind = FeatureKind::vertex;
        result.index = low;
    } else if (free_count == 1) {
        result.kind = FeatureKind::edge;
        result.index = edge_index(low, low | free);
    } else {
        result.kind = FeatureKind::face;
        result.index = 2 * first_fixed + (low != 0 ? 1u : 0u);
    }
}

ClosestFeature<3> closest_on_placed_box(const Vec3& half, const DVec<3>& point, const Affine<3>& place) {
    static constexpr std::array<Vec3, 6> normals{Vec3{1, 0, 0},  Vec3{-1, 0, 0}, Vec3{0, 1, 0},
                                                 Vec3{0, -1, 0}, Vec3{0, 0, 1},  Vec3{0, 0, -1}};
    static constexpr std::array<std::uint32_t, 24> loops{0, 2, 6, 4, 1, 5, 7, 3, 0, 4, 5, 1,
                                                         2, 3, 7, 6, 0, 1, 3, 2, 4, 6, 7, 5};
    static constexpr std::array<std::uint32_t, 6> loop_ends{4, 8, 12, 16, 20, 24};
    std::array<Vec3, 8> corners;
    for (std::uint32_t i = 0; i < 8; ++i)
        for (int k = 0; k < 3; ++k) corners[i][k] = (i >> k & 1) != 0 ? -half[k] : half[k];
    return closest_on_polyhedron(corners, Facets{normals, loops, loop_ends, {}}, point, place);
}

ClosestFeature<2> closest_on_placed_box(const Vec2& half, const DVec<2>& point, const Affine<2>& place) {
    static constexpr std::array<std::uint32_t, 4> corner_of{0, 1, 3, 2};
    const std::array<Vec2, 4> loop{half, Vec2(-half.x, half.y), -half, Vec2(half.x, -half.y)};
    ClosestFeature<2> result = closest_on_polygon(loop, point, place);
    result.index = result.kind == FeatureKind::vertex
                       ? corner_of[result.index]
                       : edge_index(corner_of[result.index & 0xffffu], corner_of[result.index >> 16]);
    return result;
}

ClosestFeature<2> closest_on_many(const Convex<2>& core, const DVec<2>& point, const Affine<2>& place) {
    return closest_on_polygon({core.vertices(), core.count}, point, place);
}
ClosestFeature<3> closest_on_many(const Convex<3>& core, const DVec<3>& point, const Affine<3>& place) {
    return closest_on_polyhedron({core.vertices(), core.count}, *core.facets, point, place);
}

template <int D>
ClosestFeature<D> closest_on_points(const Convex<D>& core, const DVec<D>& point, const Affine<D>& place) {
    if (core.facets != nullptr || core.count > 3) return closest_on_many(core, point, place);
    Affine<D> relative = place;
    relative.offset -= point;
    const auto corner = [&](std::uint32_t i) { return relative.point(DVec<D>(core.vertices()[i])); };
    const DVec<D> origin(0.0);
    ClosestFeature<D> result = core.count == 3 ? closest_on_triangle(corner(0), corner(1), corner(2), origin)
                                               : closest_on_segment(corner(0), corner(core.count - 1), origin);
    result.point += point;
    return result;
}

}  // namespace

template <int D>
ClosestFeature<D> closest_on_segment(const DVec<D>& a, const DVec<D>& b, const DVec<D>& point) {
    detail::enter_library();
    const DVec<D> along = b - a;
    ClosestFeature<D> result = closest_on_segment(a, b, point, DVec<D>(0.0));
    if (result.normal != DVec<D>(0.0)) return result;
    if (result.kind == FeatureKind::edge)
        result.normal = perpendicular(along);
    else
        result.normal = normalized(result.index == 0 ? -along : along);
    return result;
}

template <int D>
ClosestFeature<D> closest_on_segment(const DVec<D>& a, const DVec<D>& b, const DVec<D>& point,
                                     const DVec<D>& otherwise) {
    detail::enter_library();
    const DVec<D> from = a - point, to = b - point, along = b - a;
    const double part = -dot(from, along), whole = dot(along, along);
    ClosestFeature<D> result;
    DVec<D> nearest = from;
    if (part > 0 && part < whole) {
        result.kind = FeatureKind::edge;
        result.index = edge_index(0, 1);
        nearest += along * (part / whole);
        nearest -= along * (dot(nearest, along) / whole);
    } else if (part > 0) {
        result.index = 1;
        nearest = to;
    }
    result.point = point + nearest;
    result.distance = length(nearest);
    const bool outside = result.distance > relative_rounding * std::max(largest(from), largest(to));
    result.normal = outside ? normalized(-nearest) : otherwise;
    return result;
}

template <int D>
ClosestFeature<D> closest_on_box(const DVec<D>& half, const DVec<D>& point) {
    detail::enter_library();
    ClosestFeature<D> result;
    result.point = point;
    std::uint32_t outside = 0, low = 0;
    int nearest_side = 0;
    double largest_distance = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < D; ++i) {
        const double beyond = std::abs(point[i]) - half[i];
        if (beyond > largest_distance) {
            largest_distance = beyond;
            nearest_side = i;
        }
        if (!(beyond > 0)) continue;
        outside |= 1u << i;
        low |= point[i] < 0 ? 1u << i : 0u;
        result.point[i] = std::copysign(half[i], point[i]);
    }
    if (outside != 0) {
        set_box_feature(result, outside, low);
        result.distance = length(point - result.point);
        result.normal = normalized(point - result.point);
        return result;
    }
    const bool at_low_end = point[nearest_side] < 0;
    set_box_feature(result, 1u << nearest_side, at_low_end ? 1u << nearest_side : 0u);
    result.point[nearest_side] = at_low_end ? -half[nearest_side] : half[nearest_side];
    result.distance = largest_distance;
    result.normal = axis<D>(nearest_side, at_low_end ? -1 : 1);
    return result;
}

template <int D>
ClosestFeature<D> closest_feature(const Convex<D>& core, const DVec<D>& point) {
    detail::enter_library();
    ABUT_ASSERT(has_features(core));
    const bool stretched = !core.similar || !(core.scale > 0);
    if (stretched)
        return core.core == Core::box ? closest_on_placed_box(core.own[0], point, core.place)
                                      : closest_on_points(core, point, core.place);
    const DVec<D> local = core.place.transposed(point - core.place.offset) / (core.scale * core.scale);
    ClosestFeature<D> result = core.core == Core::box ? closest_on_box(DVec<D>(core.own[0]), local)
                                                      : closest_on_points(core, local, Affine<D>());
    result.point = core.place.point(result.point);
    result.normal = normalized(core.place.vector(result.normal));
    result.distance *= core.scale;
    return result;
}

#define ABUT_INSTANTIATE(D)                                                                                        \
    template ClosestFeature<D> closest_on_segment(const DVec<D>&, const DVec<D>&, const DVec<D>&);                 \
    template ClosestFeature<D> closest_on_segment(const DVec<D>&, const DVec<D>&, const DVec<D>&, const DVec<D>&); \
    template ClosestFeature<D> closest_on_box(const DVec<D>&, const DVec<D>&);                                     \
    template ClosestFeature<D> closest_feature(const Convex<D>&, const DVec<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
