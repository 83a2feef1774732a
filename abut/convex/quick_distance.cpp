#include <abut/convex/quick_distance.hpp>
#include <abut/convex/quick_walk.hpp>

namespace abut {
namespace {

/// The corners of the cache, up to the first that isn't there.
void recall(const Convex<3>& a, const Convex<3>& b, const Cache& cache, QuickSimplex& simplex) {
    const std::uint32_t count = std::min(cache.count, 4u);
    std::uint32_t i = 0;
    for (; i < count && has_corner(a, cache.corner_a[i]) && has_corner(b, cache.corner_b[i]); ++i) {
        simplex.corner_a[i] = cache.corner_a[i];
        simplex.corner_b[i] = cache.corner_b[i];
    }
    simplex.count = i;
}

DVec<3> axis_of(const Cache& cache) {
    return {static_cast<double>(cache.axis[0]), static_cast<double>(cache.axis[1]), static_cast<double>(cache.axis[2])};
}

void remember(const QuickSimplex& simplex, const DVec<3>& axis, Cache& cache) {
    cache.count = simplex.count;
    for (std::size_t i = 0; i < simplex.count; ++i) {
        cache.corner_a[i] = simplex.corner_a[i];
        cache.corner_b[i] = simplex.corner_b[i];
    }
    for (int i = 0; i < 3; ++i) cache.axis[static_cast<std::size_t>(i)] = static_cast<float>(axis[i]);
}

}  // namespace

bool quick_distance(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options, SignedDistance<3>& result,
                    Cache& inside) {
    if (!quick_to_walk(a, b)) return false;
    QuickSimplex quick;
    if (options.cache != nullptr) recall(a, b, *options.cache, quick);
    QuickGap gap;
    const QuickExit exit = quick_gap(a, b, quick, gap, options.trace);
    if (exit == QuickExit::overlapping) remember(quick, DVec<3>(0.0), inside);
    if (exit != QuickExit::stopped || !(gap.reached - gap.proven <= 1e-9 * gap.reached)) return false;
    result.distance = gap.reached - a.radius - b.radius;
    result.normal = quick.toward / length(quick.toward);
    result.on_a = gap.on_a + result.normal * a.radius;
    result.corners.count = quick.count;
    for (std::size_t i = 0; i < quick.count; ++i) {
        result.corners.a[i] = quick.corner_a[i];
        result.corners.b[i] = quick.corner_b[i];
    }
    if (options.cache != nullptr) remember(quick, result.normal, *options.cache);
    return true;
}

std::optional<bool> quick_overlap(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options) {
    if (!quick_to_walk(a, b)) return std::nullopt;
    QuickSimplex quick;
    if (options.cache != nullptr) {
        if (options.cache->count == 4) recall(a, b, *options.cache, quick);
        quick.toward = axis_of(*options.cache);
    }
    const QuickExit exit = quick_decision(a, b, a.radius + b.radius, quick, options.trace);
    if (exit != QuickExit::apart && exit != QuickExit::overlapping) return std::nullopt;
    const bool overlapping = exit == QuickExit::overlapping;
    if (options.cache != nullptr)
        remember(quick, overlapping ? DVec<3>(0.0) : normalized(quick.toward), *options.cache);
    return overlapping;
}

}  // namespace abut
