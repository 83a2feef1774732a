#include <abut/query/detail/closed_form/polygon_cores2.hpp>
#include <abut/query/detail/closed_form/polygons2.hpp>

namespace abut::detail {
namespace {

using namespace polygon_cores;

/// Two edges count as parallel below this sine of their angle.
constexpr double parallel_sine = 1e-6;

/// The two ends of an edge, one in each lane, in the frame of the reference.
struct Edge {
    Double2 x, y;
    std::uint32_t names[2];
};

/// Clips an edge at both ends of the reference edge, and returns where its ends are along that. It has no branch, as
/// clipping is unpredictable. The edge has length 0 if both ends are beyond one end.
template <class Core>
inline Double2 cut_off(const Core& reference, std::uint32_t side, Edge& edge) {
    const Double2 normal = reference.normal(side), x = lanes::first(normal), y = lanes::second(normal);
    const Double2 ends = x * reference.ends_y(side) - y * reference.ends_x(side);
    const Double2 from = lanes::first(ends), to = lanes::second(ends), at = x * edge.y - y * edge.x;
    const Double2 clamped = lanes::lesser(lanes::greater(at, from), to);
    const std::uint32_t below = lanes::bits(at < from), above = lanes::bits(at > to);
    const double run = at[1] - at[0], per_run = run != 0 ? 1 / run : 0;
    const Double2 part = (clamped - at) * lanes::double2(per_run);
    edge.x += lanes::double2(edge.x[1] - edge.x[0]) * part;
    edge.y += lanes::double2(edge.y[1] - edge.y[0]) * part;
    const std::uint32_t start = reference.contact_number(side) + 1,
                        end = reference.contact_number(reference.after(side)) + 1;
    for (std::uint32_t i = 0; i < 2; ++i) edge.names[i] |= (start * (below >> i & 1u) | end * (above >> i & 1u)) << 16;
    return clamped;
}

/// Adds the ends of the edge that are near enough, midway between the two surfaces. Returns false, and adds none, if
/// the deepest vertex has been clipped.
template <class Core>
inline bool add_points(const Placed<Core>& reference, std::uint32_t side, const Edge& edge, double depth, double margin,
                       double tolerance, Contact<2>& result) {
    const Double2 normal = reference.core.normal(side), x = lanes::first(normal), y = lanes::second(normal);
    const Double2 gaps = (x * edge.x + y * edge.y) - lanes::double2(reference.core.offset(side));
    const Double2 depths = lanes::lesser(-gaps, lanes::double2(depth));
    if (!(std::max(depths[0], depths[1]) >= depth - tolerance)) return false;
    const Double2 half = depths * Double2{0.5, 0.5}, middle_x = edge.x + x * half, middle_y = edge.y + y * half;
    const PolygonPlacement& place = reference.place;
    const Double2 cos = place.cos * place.scale, sin = lanes::first(place.sin) * place.scale;
    const Double2 world_x = (cos * middle_x - sin * middle_y) + lanes::first(place.position);
    const Double2 world_y = (sin * middle_x + cos * middle_y) + lanes::second(place.position);
    const std::uint32_t near = lanes::bits(depths >= lanes::double2(-margin - tolerance));
    const Double2 reported = margin > 0 ? depths : lanes::greater(depths, Double2{0, 0});
    for (std::uint32_t i = 0; i < 2; ++i)
        if ((near >> i & 1) != 0)
            result.points.push_back({{static_cast<float>(world_x[i]), static_cast<float>(world_y[i])},
                                     static_cast<float>(reported[i]),
                                     edge.names[i]});
    return true;
}

template <class Core>
bool contact_of(const ShapeRef<2>& given_a, const ShapeRef<2>& given_b, double margin, Cache* cache,
                Contact<2>& result) {
    Placed<Core> a(given_a), b(given_b);
    if (!set_scales(a.place, b.place) || !a.core.has_area() || !b.core.has_area()) return false;
    Rigid2 relative_places[2];
    EdgeGap widest;
    if (!find_widest(a, b, relative_places, widest)) return false;
    const bool a_is_reference = widest.of == 0;
    const Placed<Core>&reference = a_is_reference ? a : b, &other = a_is_reference ? b : a;
    if (widest.gap > margin) {
        if (cache != nullptr) cache_edge(reference, other, widest, *cache);
        return true;
    }

    const std::uint32_t side = widest.side, corner = widest.corner;
    const EdgeVertexPair<Core> found(reference, other, side, corner);
    if (found.region != EdgeRegion::within) return false;
    const Double2 down = -other.place.back(found.normal);
    const std::uint32_t facing = other.core.facing(corner, down);
    const Double2 faces = other.core.normal(facing);
    // Of two parallel edges, A's is the reference.
    const double alignment = lanes::dot(faces, down)[0] * (a.place.scale[0] * b.place.scale[0]);
    if (!a_is_reference && !(alignment < 1 - parallel_sine)) return false;

    const Rigid2& of_other = relative_places[widest.of];
    const Double2 x = other.core.ends_x(facing), y = other.core.ends_y(facing);
    const Double2 cos = lanes::double2(of_other.cos), sin = lanes::double2(of_other.sin);
    Edge edge{(cos * x - sin * y) + lanes::double2(of_other.x),
              (sin * x + cos * y) + lanes::double2(of_other.y),
              {other.core.contact_number(facing), other.core.contact_number(other.core.after(facing))}};
    const Double2 along = cut_off(reference.core, side, edge);
    const double tolerance = 1e-6 * std::min(a.core.extent(), b.core.extent());
    if (!(std::abs(along[0] - along[1]) > tolerance)) return false;

    const double depth = -found.gap;
    if (!add_points(reference, side, edge, depth, margin, tolerance, result)) return false;
    static constexpr double towards_b[2] = {-1, 1};
    const Double2 out = found.normal * reference.place.scale * lanes::double2(towards_b[a_is_reference ? 1 : 0]);
    lanes::store(out, &result.normal.x);
    result.depth = static_cast<float>(depth);
    name_edge(reference.core, side, a_is_reference ? result.feature_a : result.feature_b);
    name_vertex(other.core.number(corner), a_is_reference ? result.feature_b : result.feature_a);
    if (cache != nullptr) {
        cache_edge(reference, other, widest, *cache);
        cache->axis = {result.normal.x, result.normal.y, 0};
    }
    return true;
}

}  // namespace

bool contact_polygons(const ShapeRef<2>& a, const ShapeRef<2>& b, double margin, Cache* cache, Contact<2>& result) {
    if (!(margin >= 0)) return false;
    if (is_polygon(a) && is_polygon(b)) return contact_of<PolygonCore>(a, b, margin, cache, result);
    return is_box(a) && is_box(b) && contact_of<BoxCore>(a, b, margin, cache, result);
}

}  // namespace abut::detail
