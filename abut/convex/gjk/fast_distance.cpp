#include <abut/convex/gjk/fast_distance.hpp>
#include <abut/convex/gjk/gjk_fast.hpp>

namespace abut::detail {
namespace {

/// Loads the vertices of the cache up to the first invalid index.
void load(const Convex<3>& a, const Convex<3>& b, const Cache& cache, GjkFastSimplex& simplex) {
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

void store(const GjkFastSimplex& simplex, const DVec<3>& axis, Cache& cache) {
    cache.count = simplex.count;
    for (std::size_t i = 0; i < simplex.count; ++i) {
        cache.corner_a[i] = simplex.corner_a[i];
        cache.corner_b[i] = simplex.corner_b[i];
    }
    for (int i = 0; i < 3; ++i) cache.axis[static_cast<std::size_t>(i)] = static_cast<float>(axis[i]);
}

}  // namespace

bool fast_distance(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options, SignedDistance<3>& result,
                   Cache& inside) {
    if (!gjk_fast_applies(a, b)) return false;
    GjkFastSimplex fast;
    if (options.cache != nullptr) load(a, b, *options.cache, fast);
    GjkFastDistance gap;
    const GjkFastExit exit = gjk_fast_distance(a, b, fast, gap, options.trace);
    if (exit == GjkFastExit::overlapping) store(fast, DVec<3>(0.0), inside);
    if (exit != GjkFastExit::converged || !(gap.upper_bound - gap.lower_bound <= 1e-9 * gap.upper_bound)) return false;
    result.distance = gap.upper_bound - a.radius - b.radius;
    result.normal = fast.toward / length(fast.toward);
    result.on_a = gap.on_a + result.normal * a.radius;
    result.corners.count = fast.count;
    for (std::size_t i = 0; i < fast.count; ++i) {
        result.corners.a[i] = fast.corner_a[i];
        result.corners.b[i] = fast.corner_b[i];
    }
    if (options.cache != nullptr) store(fast, result.normal, *options.cache);
    return true;
}

std::optional<bool> fast_overlap(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options) {
    if (!gjk_fast_applies(a, b)) return std::nullopt;
    GjkFastSimplex fast;
    if (options.cache != nullptr) {
        if (options.cache->count == 4) load(a, b, *options.cache, fast);
        fast.toward = axis_of(*options.cache);
    }
    const GjkFastExit exit = gjk_fast_overlap(a, b, a.radius + b.radius, fast, options.trace);
    if (exit != GjkFastExit::separated && exit != GjkFastExit::overlapping) return std::nullopt;
    const bool overlapping = exit == GjkFastExit::overlapping;
    if (options.cache != nullptr) store(fast, overlapping ? DVec<3>(0.0) : normalized(fast.toward), *options.cache);
    return overlapping;
}

}  // namespace abut::detail
