#include <abut/query/placed_sides.hpp>
#include <abut/query/polygons2.hpp>

namespace abut {
namespace {

using namespace placed_sides;

/// Whether the circles around them, about the points where they are placed, are apart. Not of what has no end.
template <class Core>
bool circles_apart(const Placed<Core>& a, const Placed<Core>& b) {
    const Double2 between = b.place.position - a.place.position;
    const double reach = a.core.radius() + b.core.radius(), square = lanes::dot(between, between)[0];
    return square > reach * reach && square < without_end;
}

/// Two polygons are apart exactly if a side of one parts them.
template <class Core>
DirectAnswer overlap_of(const ShapeRef<2>& given_a, const ShapeRef<2>& given_b, Cache* cache) {
    Placed<Core> a(given_a), b(given_b);
    if (!set_scales(a.place, b.place)) return DirectAnswer::unknown;
    Rigid2 seen[2];
    EdgeGap widest;
    if (circles_apart(a, b)) return DirectAnswer::no;
    if (!a.core.has_area() || !b.core.has_area() || !find_widest(a, b, seen, widest)) return DirectAnswer::unknown;
    if (cache != nullptr) remember_side(widest.of == 0 ? a : b, widest.of == 0 ? b : a, widest, *cache);
    return widest.gap > 0 ? DirectAnswer::no : DirectAnswer::yes;
}

}  // namespace

DirectAnswer overlap_polygons(const ShapeRef<2>& a, const ShapeRef<2>& b, Cache* cache) {
    if (is_polygon(a) && is_polygon(b)) return overlap_of<PolygonCore>(a, b, cache);
    return is_box(a) && is_box(b) ? overlap_of<BoxCore>(a, b, cache) : DirectAnswer::unknown;
}

}  // namespace abut
