#include <abut/convex/farthest_point.hpp>
#include <abut/convex/point_soa.hpp>
#include <abut/convex/support.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/detail/round_outwards.hpp>
#include <abut/math/simd/square_root.hpp>

namespace abut::detail {
namespace {

/// From this count on SIMD is faster.
constexpr std::uint32_t min_simd_count = 32;

template <int D>
CorePoint<D> farthest_of(const Vec<D>* points, std::uint32_t count, const DVec<D>& direction) {
    if (count >= min_simd_count) {
        const std::uint32_t best = farthest_point(std::span<const Vec<D>>(points, count), direction);
        return {DVec<D>(points[best]), best};
    }
    std::uint32_t best = 0;
    double maximum = dot(DVec<D>(points[0]), direction);
    for (std::uint32_t i = 1; i < count; ++i) {
        const double along = dot(DVec<D>(points[i]), direction);
        if (along > maximum) {
            maximum = along;
            best = i;
        }
    }
    return {DVec<D>(points[best]), best};
}

template <int D>
CorePoint<D> farthest_corner(const Vec<D>& half, const DVec<D>& direction) {
    CorePoint<D> result;
    for (int i = 0; i < D; ++i) {
        const bool low = direction[i] < 0;
        result.position[i] = low ? -static_cast<double>(half[i]) : static_cast<double>(half[i]);
        result.index |= low ? 1u << i : 0u;
    }
    return result;
}

/// The support point of two discs across w = b - a. The rims are farthest along r, the component of d orthogonal to w:
///
///     r = d - w (w . d) / (w . w),    (a + r/|r| ra) . d = a . d + ra |r|
DVec<3> farthest_on_discs(const Convex<3>& convex, const DVec<3>& direction) {
    const DVec<3> a(convex.own[0]), b(convex.own[1]);
    const double radius_a = static_cast<double>(convex.disc_radius[0]),
                 radius_b = static_cast<double>(convex.disc_radius[1]);
    // Coincident discs are orthogonal to the third axis.
    const DVec<3> w = a == b ? axis<3>(2) : b - a;
    const double ww = dot(w, w);
    const double along = dot(w, direction);
    const DVec<3> r = direction - w * (along / ww);
    const double rr = dot(r, r), dd = dot(direction, direction);
    DVec<3> rim(0.0);
    double reach = 0;
    // A vector r that is nothing but rounding would lead off the disc. With few digits left it is orthogonalised once
    // more.
    if (rr > 1e-18 * dd) {
        reach = square_root(rr);
        rim = r / reach;
        if (rr < 1e-4 * dd) rim = normalized(rim - w * (dot(w, rim) / ww));
    }
    const double gain = dot(b - a, direction) + (radius_b - radius_a) * reach;
    return gain > 0 ? b + rim * radius_b : a + rim * radius_a;
}

template <int D>
CorePoint<D> local_support(const Convex<D>& convex, const DVec<D>& direction) {
    switch (convex.core) {
        case Core::points:
            if constexpr (D == 3)
                if (convex.lanes != nullptr) {
                    const std::uint32_t best = farthest_point(*convex.lanes, direction);
                    return {DVec<3>(convex.points[best]), best};
                }
            return farthest_of(convex.vertices(), convex.count, direction);
        case Core::box:
            return farthest_corner(convex.own[0], direction);
        case Core::discs:
            if constexpr (D == 3) return {farthest_on_discs(convex, direction), 0};
            break;
        case Core::function:
            return {DVec<D>(convex.function(convex.object, to_float(normalized(direction)))), 0};
    }
    return {};
}

/// The corners of the bounding box of the core with its inner ball.
template <int D>
void find_extent(const Convex<D>& convex, DVec<D>& low, DVec<D>& high) {
    if (convex.inner_radius == 0 && convex.core == Core::box) {
        // To the same bits as the corner that core_support finds.
        DVec<D> reach(0.0);
        for (int i = 0; i < D; ++i)
            for (int j = 0; j < D; ++j)
                reach[i] += std::abs(convex.place.column[static_cast<std::size_t>(j)][i]) *
                            static_cast<double>(convex.own[0][j]);
        low = convex.place.offset - reach;
        high = convex.place.offset + reach;
    } else if (convex.inner_radius == 0 && convex.core == Core::points && convex.points == nullptr) {
        // For so few points, placing all of them is cheaper than support queries.
        low = high = convex.place.point(DVec<D>(convex.own[0]));
        for (std::uint32_t i = 1; i < convex.count; ++i) {
            const DVec<D> corner = convex.place.point(DVec<D>(convex.own[i]));
            for (int j = 0; j < D; ++j) {
                low[j] = std::min(low[j], corner[j]);
                high[j] = std::max(high[j], corner[j]);
            }
        }
    } else {
        for (int i = 0; i < D; ++i) {
            low[i] = core_support(convex, axis<D>(i, -1)).position[i];
            high[i] = core_support(convex, axis<D>(i, 1)).position[i];
        }
    }
}

}  // namespace

template <int D>
Convex<D> round_points(std::initializer_list<Vec<D>> points, float radius) {
    Convex<D> result;
    result.count = static_cast<std::uint32_t>(points.size());
    std::copy(points.begin(), points.end(), result.own.begin());
    result.radius = static_cast<double>(radius);
    return result;
}

template <int D>
Placement<D> mapped(const Placement<D>& placement, const Affine<D>& map) {
    const double factor_squared = length_squared(map.column[0]);
    const double tolerance = 1e-12 * factor_squared;
    bool similar = true;
    DVec<D> least_squared;  // of the factors, by Gershgorin's circles of the columns' products
    for (int i = 0; i < D; ++i) least_squared[i] = length_squared(map.column[static_cast<std::size_t>(i)]);
    for (int i = 0; i < D; ++i) {
        const DVec<D>& column = map.column[static_cast<std::size_t>(i)];
        similar = similar && std::abs(length_squared(column) - factor_squared) <= tolerance;
        for (int j = 0; j < i; ++j) {
            const double product = std::abs(dot(column, map.column[static_cast<std::size_t>(j)]));
            similar = similar && product <= tolerance;
            least_squared[i] -= product;
            least_squared[j] -= product;
        }
    }
    Placement<D> result = placement;
    result.place = map * placement.place;
    if (similar) {
        const double factor = square_root(factor_squared);
        result.scale *= factor;
        result.radius *= factor;
        return result;
    }
    result.similar = false;
    if (placement.similar && placement.scale > 0) {
        result.inner_radius += placement.radius / placement.scale;
        result.radius = 0;
    } else {
        double least = least_squared[0];
        for (int i = 1; i < D; ++i) least = std::min(least, least_squared[i]);
        result.radius *= square_root(std::max(least, 0.0));
    }
    return result;
}

template <int D>
DVec<D> front(const Convex<D>& part) {
    const double side = determinant(part.place) < 0 ? -1 : 1;
    const auto corner = [&part](std::size_t i) { return part.place.point(DVec<D>(part.vertices()[i])); };
    const DVec<D> along = corner(1) - corner(0);
    if constexpr (D == 2)
        return DVec<2>(along.y, -along.x) * side;
    else
        return cross(along, corner(2) - corner(0)) * side;
}

template <int D>
Convex<D> placed(const Convex<D>& convex, const Placement<D>& placement) {
    Placement<D> own = convex;
    own.radius += placement.inner_radius;
    own = mapped(own, placement.place);
    own.radius += placement.radius;
    Convex<D> result = convex;
    static_cast<Placement<D>&>(result) = own;
    return result;
}

template <int D>
CorePoint<D> core_support(const Convex<D>& convex, const DVec<D>& direction) {
    const DVec<D> local = convex.place.transposed(direction);
    CorePoint<D> result = local_support(convex, local);
    if (convex.inner_radius > 0) result.position += normalized(local) * convex.inner_radius;
    result.position = convex.place.point(result.position);
    return result;
}

template <int D>
DVec<D> support(const Convex<D>& convex, const DVec<D>& direction) {
    return core_support(convex, direction).position + normalized(direction) * convex.radius;
}

template <int D>
Aabb<D> bounds(const Convex<D>& convex) {
    DVec<D> low, high;
    find_extent(convex, low, high);
    Aabb<D> result;
    for (int i = 0; i < D; ++i) {
        result.min[i] = float_at_most(low[i] - convex.radius);
        result.max[i] = float_at_least(high[i] + convex.radius);
    }
    return result;
}

template <int D>
DVec<D> reference_point(const Convex<D>& convex) {
    return convex.core == Core::box ? convex.place.offset : core_support(convex, axis<D>(0)).position;
}

template <int D>
double size(const Convex<D>& convex) {
    DVec<D> low, high;
    find_extent(convex, low, high);
    return length((high - low) * 0.5) + convex.radius;
}

#define ABUT_INSTANTIATE(D)                                                \
    template Convex<D> round_points(std::initializer_list<Vec<D>>, float); \
    template Placement<D> mapped(const Placement<D>&, const Affine<D>&);   \
    template DVec<D> front(const Convex<D>&);                              \
    template Convex<D> placed(const Convex<D>&, const Placement<D>&);      \
    template CorePoint<D> core_support(const Convex<D>&, const DVec<D>&);  \
    template DVec<D> support(const Convex<D>&, const DVec<D>&);            \
    template Aabb<D> bounds(const Convex<D>&);                             \
    template DVec<D> reference_point(const Convex<D>&);                    \
    template double size(const Convex<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
