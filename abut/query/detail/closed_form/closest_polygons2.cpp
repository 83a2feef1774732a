#include <abut/query/detail/closed_form/polygon_cores2.hpp>
#include <abut/query/detail/closed_form/polygons2.hpp>

namespace abut::detail {
namespace {

using namespace polygon_cores;

template <class Core>
inline void write(const EdgeVertexPair<Core>& found, const Placed<Core>& reference, const Placed<Core>& other,
                  std::uint32_t side, std::uint32_t corner, bool reference_is_a, Closest<2>& result) {
    const Double2 out = found.normal * reference.place.scale, on_other = other.place.position + found.offset;
    static constexpr double towards_b[2] = {-1, 1};
    result.distance = static_cast<float>(found.gap);
    lanes::store(out * lanes::double2(towards_b[reference_is_a ? 1 : 0]), &result.normal.x);
    lanes::store(on_other - out * lanes::double2(found.gap), reference_is_a ? &result.on_a.x : &result.on_b.x);
    lanes::store(on_other, reference_is_a ? &result.on_b.x : &result.on_a.x);
    name_edge(reference.core, side, reference_is_a ? result.feature_a : result.feature_b);
    name_vertex(other.core.number(corner), reference_is_a ? result.feature_b : result.feature_a);
}

/// The distance of two vertices. Returns false unless they are apart, and each is farthest in the direction of the
/// other.
template <class Core>
[[gnu::always_inline]] inline bool closest_corners(const Placed<Core>& a, const Placed<Core>& b, std::uint32_t corner_a,
                                                   std::uint32_t corner_b, Closest<2>& result) {
    const Double2 offset_a = a.place.vector(a.core.corner(corner_a)) * a.place.scale;
    const Double2 offset_b = b.place.vector(b.core.corner(corner_b)) * b.place.scale;
    const Double2 between = (b.place.position - a.place.position) + (offset_b - offset_a);
    const double square = lanes::dot(between, between)[0];
    if (!(square > 0 && square < infinity && a.core.is_farthest(corner_a, a.place.back(between)) &&
          b.core.is_farthest(corner_b, -b.place.back(between))))
        return false;
    // The root and the quotient run in parallel.
    const double gap = std::sqrt(square), per_gap = gap * (1 / square);
    result.distance = static_cast<float>(gap);
    lanes::store(between * lanes::double2(per_gap), &result.normal.x);
    lanes::store(a.place.position + offset_a, &result.on_a.x);
    lanes::store(b.place.position + offset_b, &result.on_b.x);
    name_vertex(a.core.number(corner_a), result.feature_a);
    name_vertex(b.core.number(corner_b), result.feature_b);
    return true;
}

/// The distance of the cached vertex from the cached edge, if they are still the closest features.
template <class Core>
inline bool edge_from_cache(const Placed<Core>& reference, const Placed<Core>& other, std::uint32_t side,
                            std::uint32_t corner, bool reference_is_a, Closest<2>& result) {
    const EdgeVertexPair<Core> found(reference, other, side, corner);
    if (!(found.region == EdgeRegion::within && found.gap > 0 && found.gap < infinity &&
          other.core.is_farthest(corner, -other.place.back(found.normal))))
        return false;
    write(found, reference, other, side, corner, reference_is_a, result);
    return true;
}

inline void cache_axis(const Closest<2>& result, Cache& cache) {
    cache.axis = {result.normal.x, result.normal.y, 0};
}

// The cached path and the other one place the shapes each for itself: shared, they would be spilled to memory.

/// Warm start: the closest features of the last query, if they are still closest: a vertex and an edge, or two
/// vertices.
template <class Core>
inline bool closest_from_cache(const ShapeRef<2>& given_a, const ShapeRef<2>& given_b, Cache& cache,
                               Closest<2>& result) {
    if (cache.count == 0 || cache.count > 2) return false;
    Placed<Core> a(given_a), b(given_b);
    const std::uint32_t number_a = cache.corner_a[0], number_b = cache.corner_b[0];
    if (number_a >= a.core.count() || number_b >= b.core.count() || !set_scales(a.place, b.place)) return false;
    const std::uint32_t of_a = a.core.number(number_a), of_b = b.core.number(number_b);
    // The call is written twice, so that each instance knows which shape has the edge.
    const bool found = cache.count == 1                ? closest_corners(a, b, of_a, of_b, result)
                       : number_a != cache.corner_a[1] ? edge_from_cache(a, b, of_a, of_b, true, result)
                                                       : edge_from_cache(b, a, of_b, of_a, false, result);
    if (found) cache_axis(result, cache);
    return found;
}

/// From the edge with the widest gap: the other's lowest vertex is in front of it, or in the Voronoi region of one of
/// its ends. For overlapping polygons the least separating move is along that edge's normal.
template <class Core>
[[gnu::noinline]] bool closest_from_scratch(const ShapeRef<2>& given_a, const ShapeRef<2>& given_b, Cache* cache,
                                            Closest<2>& result) {
    Placed<Core> a(given_a), b(given_b);
    if (!set_scales(a.place, b.place)) return false;
    Rigid2 relative_places[2];
    EdgeGap widest;
    if (!find_widest(a, b, relative_places, widest)) return false;
    const bool a_is_reference = widest.of == 0;
    const Placed<Core>&reference = a_is_reference ? a : b, &other = a_is_reference ? b : a;
    const EdgeVertexPair<Core> found(reference, other, widest.side, widest.corner);
    if (found.region == EdgeRegion::within) {
        write(found, reference, other, widest.side, widest.corner, a_is_reference, result);
        if (cache != nullptr) cache_edge(reference, other, widest, *cache);
    } else {
        if (!(found.gap > 0)) return false;
        const std::uint32_t end =
            found.region == EdgeRegion::before_start ? widest.side : reference.core.after(widest.side);
        const std::uint32_t of_a = a_is_reference ? end : widest.corner, of_b = a_is_reference ? widest.corner : end;
        if (!closest_corners(a, b, of_a, of_b, result)) return false;
        if (cache != nullptr) {
            cache->count = 1;
            cache->corner_a[0] = cache->corner_a[1] = a.core.number(of_a);
            cache->corner_b[0] = cache->corner_b[1] = b.core.number(of_b);
        }
    }
    if (cache != nullptr) cache_axis(result, *cache);
    return true;
}

template <class Core>
bool closest_of(const ShapeRef<2>& a, const ShapeRef<2>& b, Cache* cache, Closest<2>& result) {
    return (cache != nullptr && closest_from_cache<Core>(a, b, *cache, result)) ||
           closest_from_scratch<Core>(a, b, cache, result);
}

template <class Core>
inline bool separates(const Placed<Core>& reference, const Placed<Core>& other, std::uint32_t number, double reach) {
    if (number >= reference.core.count()) return false;
    const std::uint32_t side = reference.core.number(number);
    const Double2 normal = reference.place.vector(reference.core.normal(side));
    const Double2 between = other.place.position - reference.place.position;
    const double lowest =
        other.core.lowest(other.place.back(normal)) * (reference.place.scale[0] * other.place.scale[0]);
    const double away = lanes::dot(normal, between)[0] * reference.place.scale[0];
    const double tolerance =
        1e-14 * (std::abs(between[0]) + std::abs(between[1]) + reference.core.size() + other.core.size());
    return away + lowest - reference.core.offset(side) > reach + tolerance;
}

template <class Core>
bool cache_separates(const ShapeRef<2>& given_a, const ShapeRef<2>& given_b, const Cache& cache, double reach) {
    Placed<Core> a(given_a), b(given_b);
    if (!set_scales(a.place, b.place)) return false;
    return cache.corner_a[0] != cache.corner_a[1] ? separates(a, b, cache.corner_a[0], reach)
                                                  : separates(b, a, cache.corner_b[0], reach);
}

}  // namespace

bool closest_polygons(const ShapeRef<2>& a, const ShapeRef<2>& b, Cache* cache, Closest<2>& result) {
    if (is_polygon(a) && is_polygon(b)) return closest_of<PolygonCore>(a, b, cache, result);
    return is_box(a) && is_box(b) && closest_of<BoxCore>(a, b, cache, result);
}

bool separated_by_cache(const ShapeRef<2>& a, const ShapeRef<2>& b, const Cache& cache, double reach) {
    if (cache.count != 2) return false;
    if (is_polygon(a) && is_polygon(b)) return cache_separates<PolygonCore>(a, b, cache, reach);
    return is_box(a) && is_box(b) && cache_separates<BoxCore>(a, b, cache, reach);
}

}  // namespace abut::detail
