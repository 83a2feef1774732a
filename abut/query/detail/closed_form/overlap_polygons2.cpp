#include <abut/query/detail/closed_form/polygon_cores2.hpp>
#include <abut/query/detail/closed_form/polygons2.hpp>

namespace abut::detail {
namespace {

using namespace polygon_cores;

/// Whether the bounding circles, around the origins of the local frames, are apart. False for infinite shapes.
template <class Core>
bool circles_apart(const Placed<Core>& a, const Placed<Core>& b) {
    const Double2 between = b.place.position - a.place.position;
    const double reach = a.core.radius() + b.core.radius(), square = lanes::dot(between, between)[0];
    return square > reach * reach && square < infinity;
}

/// Separating axis test: two polygons are apart exactly if an edge of one separates them.
template <class Core>
ClosedFormAnswer overlap_of(const ShapeRef<2>& given_a, const ShapeRef<2>& given_b, Cache* cache) {
    Placed<Core> a(given_a), b(given_b);
    if (!set_scales(a.place, b.place)) return ClosedFormAnswer::unknown;
    Rigid2 relative_places[2];
    EdgeGap widest;
    if (circles_apart(a, b)) return ClosedFormAnswer::no;
    if (!a.core.has_area() || !b.core.has_area() || !find_widest(a, b, relative_places, widest))
        return ClosedFormAnswer::unknown;
    if (cache != nullptr) cache_edge(widest.of == 0 ? a : b, widest.of == 0 ? b : a, widest, *cache);
    return widest.gap > 0 ? ClosedFormAnswer::no : ClosedFormAnswer::yes;
}

}  // namespace

ClosedFormAnswer overlap_polygons(const ShapeRef<2>& a, const ShapeRef<2>& b, Cache* cache) {
    if (is_polygon(a) && is_polygon(b)) return overlap_of<PolygonCore>(a, b, cache);
    return is_box(a) && is_box(b) ? overlap_of<BoxCore>(a, b, cache) : ClosedFormAnswer::unknown;
}

}  // namespace abut::detail
