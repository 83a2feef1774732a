#include <abut/query/placed_sides.hpp>
#include <abut/query/polygons2.hpp>

namespace abut {
namespace {

using namespace placed_sides;

template <class Core>
inline void write(const SideAndCorner<Core>& found, const Placed<Core>& reference, const Placed<Core>& other,
                  std::uint32_t side, std::uint32_t corner, bool reference_is_a, Closest<2>& result) {
    const Double2 out = found.normal * reference.place.scale, on_other = other.place.position + found.arm;
    static constexpr double towards_b[2] = {-1, 1};
    result.distance = static_cast<float>(found.gap);
    lanes::store(out * lanes::double2(towards_b[reference_is_a ? 1 : 0]), &result.normal.x);
    lanes::store(on_other - out * lanes::double2(found.gap), reference_is_a ? &result.on_a.x : &result.on_b.x);
    lanes::store(on_other, reference_is_a ? &result.on_b.x : &result.on_a.x);
    name_side(reference.core, side, reference_is_a ? result.feature_a : result.feature_b);
    name_corner(other.core.number(corner), reference_is_a ? result.feature_b : result.feature_a);
}

/// Two corners. False where they aren't apart, each the farthest in the direction of the other.
template <class Core>
[[gnu::always_inline]] inline bool closest_corners(const Placed<Core>& a, const Placed<Core>& b, std::uint32_t corner_a,
                                                   std::uint32_t corner_b, Closest<2>& result) {
    const Double2 arm_a = a.place.vector(a.core.corner(corner_a)) * a.place.scale;
    const Double2 arm_b = b.place.vector(b.core.corner(corner_b)) * b.place.scale;
    const Double2 between = (b.place.position - a.place.position) + (arm_b - arm_a);
    const double square = lanes::dot(between, between)[0];
    if (!(square > 0 && square < without_end && a.core.is_farthest(corner_a, a.place.back(between)) &&
          b.core.is_farthest(corner_b, -b.place.back(between))))
        return false;
    // The root and the quotient side by side, not one after the other.
    const double gap = std::sqrt(square), per_gap = gap * (1 / square);
    result.distance = static_cast<float>(gap);
    lanes::store(between * lanes::double2(per_gap), &result.normal.x);
    lanes::store(a.place.position + arm_a, &result.on_a.x);
    lanes::store(b.place.position + arm_b, &result.on_b.x);
    name_corner(a.core.number(corner_a), result.feature_a);
    name_corner(b.core.number(corner_b), result.feature_b);
    return true;
}

/// The same corner before the same side, with nothing nearer.
template <class Core>
inline bool side_again(const Placed<Core>& reference, const Placed<Core>& other, std::uint32_t side,
                       std::uint32_t corner, bool reference_is_a, Closest<2>& result) {
    const SideAndCorner<Core> found(reference, other, side, corner);
    if (!(found.beside == Beside::within && found.gap > 0 && found.gap < without_end &&
          other.core.is_farthest(corner, -other.place.back(found.normal))))
        return false;
    write(found, reference, other, side, corner, reference_is_a, result);
    return true;
}

inline void remember_axis(const Closest<2>& result, Cache& cache) {
    cache.axis = {result.normal.x, result.normal.y, 0};
}

// What is done again and what is done anew place the shapes each for itself: shared, they would be kept in memory.

/// What was nearest last time is so still: the same corner before the same side, or the same two corners.
template <class Core>
inline bool closest_again(const ShapeRef<2>& given_a, const ShapeRef<2>& given_b, Cache& cache, Closest<2>& result) {
    if (cache.count == 0 || cache.count > 2) return false;
    Placed<Core> a(given_a), b(given_b);
    const std::uint32_t number_a = cache.corner_a[0], number_b = cache.corner_b[0];
    if (number_a >= a.core.count() || number_b >= b.core.count() || !set_scales(a.place, b.place)) return false;
    const std::uint32_t of_a = a.core.number(number_a), of_b = b.core.number(number_b);
    // Twice, so that each time it is known whose numbers are wanted.
    const bool found = cache.count == 1                ? closest_corners(a, b, of_a, of_b, result)
                       : number_a != cache.corner_a[1] ? side_again(a, b, of_a, of_b, true, result)
                                                       : side_again(b, a, of_b, of_a, false, result);
    if (found) remember_axis(result, cache);
    return found;
}

/// From the side with the widest gap: the other's lowest corner is before it, or before one of its ends. Where they
/// overlap, the least move apart is along that side's normal.
template <class Core>
[[gnu::noinline]] bool closest_anew(const ShapeRef<2>& given_a, const ShapeRef<2>& given_b, Cache* cache,
                                    Closest<2>& result) {
    Placed<Core> a(given_a), b(given_b);
    if (!set_scales(a.place, b.place)) return false;
    Rigid2 seen[2];
    EdgeGap widest;
    if (!find_widest(a, b, seen, widest)) return false;
    const bool a_is_reference = widest.of == 0;
    const Placed<Core>&reference = a_is_reference ? a : b, &other = a_is_reference ? b : a;
    const SideAndCorner<Core> found(reference, other, widest.side, widest.corner);
    if (found.beside == Beside::within) {
        write(found, reference, other, widest.side, widest.corner, a_is_reference, result);
        if (cache != nullptr) remember_side(reference, other, widest, *cache);
    } else {
        if (!(found.gap > 0)) return false;
        const std::uint32_t end =
            found.beside == Beside::before_start ? widest.side : reference.core.after(widest.side);
        const std::uint32_t of_a = a_is_reference ? end : widest.corner, of_b = a_is_reference ? widest.corner : end;
        if (!closest_corners(a, b, of_a, of_b, result)) return false;
        if (cache != nullptr) {
            cache->count = 1;
            cache->corner_a[0] = cache->corner_a[1] = a.core.number(of_a);
            cache->corner_b[0] = cache->corner_b[1] = b.core.number(of_b);
        }
    }
    if (cache != nullptr) remember_axis(result, *cache);
    return true;
}

template <class Core>
bool closest_of(const ShapeRef<2>& a, const ShapeRef<2>& b, Cache* cache, Closest<2>& result) {
    return (cache != nullptr && closest_again<Core>(a, b, *cache, result)) || closest_anew<Core>(a, b, cache, result);
}

template <class Core>
inline bool parts(const Placed<Core>& reference, const Placed<Core>& other, std::uint32_t number, double reach) {
    if (number >= reference.core.count()) return false;
    const std::uint32_t side = reference.core.number(number);
    const Double2 normal = reference.place.vector(reference.core.normal(side));
    const Double2 between = other.place.position - reference.place.position;
    const double lowest =
        other.core.lowest(other.place.back(normal)) * (reference.place.scale[0] * other.place.scale[0]);
    const double away = lanes::dot(normal, between)[0] * reference.place.scale[0];
    const double doubt =
        1e-14 * (std::abs(between[0]) + std::abs(between[1]) + reference.core.size() + other.core.size());
    return away + lowest - reference.core.offset(side) > reach + doubt;
}

template <class Core>
bool parted(const ShapeRef<2>& given_a, const ShapeRef<2>& given_b, const Cache& cache, double reach) {
    Placed<Core> a(given_a), b(given_b);
    if (!set_scales(a.place, b.place)) return false;
    return cache.corner_a[0] != cache.corner_a[1] ? parts(a, b, cache.corner_a[0], reach)
                                                  : parts(b, a, cache.corner_b[0], reach);
}

}  // namespace

bool closest_polygons(const ShapeRef<2>& a, const ShapeRef<2>& b, Cache* cache, Closest<2>& result) {
    if (is_polygon(a) && is_polygon(b)) return closest_of<PolygonCore>(a, b, cache, result);
    return is_box(a) && is_box(b) && closest_of<BoxCore>(a, b, cache, result);
}

bool parted_again(const ShapeRef<2>& a, const ShapeRef<2>& b, const Cache& cache, double reach) {
    if (cache.count != 2) return false;
    if (is_polygon(a) && is_polygon(b)) return parted<PolygonCore>(a, b, cache, reach);
    return is_box(a) && is_box(b) && parted<BoxCore>(a, b, cache, reach);
}

}  // namespace abut
