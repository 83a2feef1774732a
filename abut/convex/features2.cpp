// Closest features of polygons. Coordinates are relative to the query point.

#include <abut/convex/features.hpp>
#include <abut/math/simd/library_entry.hpp>

#include <limits>

namespace abut::detail {
namespace {

/// A point no farther behind an edge than this, relative to the coordinates, may lie on it.
constexpr double plane_rounding = 0x1p-40;

struct Side {
    DVec<2> a, b;
    DVec<2> out;    ///< of length 1; zero if a and b are equal
    double beyond;  ///< the distance of the origin along `out`

    bool proper() const { return out != DVec<2>(0.0); }
    bool faces_origin() const { return proper() && beyond >= -plane_rounding * std::max(largest(a), largest(b)); }
};

/// A convex loop relative to the query point: corner(i) for i < count, counter-clockwise, or clockwise if `turn` is -1.
template <class Corner>
class Loop {
public:
    Loop(std::uint32_t count, double turn, const Corner& corner) : count_(count), turn_(turn), corner_(corner) {}

    /// Relative to the query point.
    ClosestFeature<2> closest() const {
        double largest_distance = -std::numeric_limits<double>::infinity();
        std::uint32_t nearest_side = 0;
        bool outside = false;
        for (std::uint32_t i = 0; i < count_; ++i) {
            const Side side = side_at(i);
            outside = outside || side.faces_origin();
            if (!side.proper() || side.beyond <= largest_distance) continue;
            largest_distance = side.beyond;
            nearest_side = i;
        }
        const bool is_point = !(largest_distance > -std::numeric_limits<double>::infinity());
        if (is_point) return closest_on_segment(corner_(0), corner_(0), DVec<2>(0.0));
        return outside ? closest_in_front() : on_line_inside(nearest_side, largest_distance);
    }

private:
    std::uint32_t next(std::uint32_t i) const { return i + 1 == count_ ? 0 : i + 1; }

    Side side_at(std::uint32_t i) const {
        const DVec<2> a = corner_(i), b = corner_(next(i)), along = (b - a) * turn_;
        const DVec<2> out = normalized(DVec<2>(along.y, -along.x), DVec<2>(0.0));
        return {a, b, out, -dot(out, largest(a) < largest(b) ? a : b)};
    }

    ClosestFeature<2> on_line(std::uint32_t i, const Side& side) const {
        ClosestFeature<2> result;
        result.kind = FeatureKind::edge;
        result.index = edge_index(i, next(i));
        result.point = -side.out * side.beyond;
        result.normal = side.out;
        result.distance = side.beyond;
        return result;
    }

    /// For a query point inside. Of collinear edges it takes the edge that contains the projection.
    ClosestFeature<2> on_line_inside(std::uint32_t nearest_side, double largest_distance) const {
        for (std::uint32_t i = 0; i < count_; ++i) {
            const Side side = side_at(i);
            const double tolerance = plane_rounding * std::max(largest(side.a), largest(side.b));
            if (!side.proper() || side.beyond < largest_distance - tolerance) continue;
            if (closest_on_segment(side.a, side.b, DVec<2>(0.0)).kind == FeatureKind::edge) return on_line(i, side);
        }
        return on_line(nearest_side, side_at(nearest_side));
    }

    ClosestFeature<2> closest_in_front() const {
        ClosestFeature<2> best;
        best.distance = std::numeric_limits<double>::infinity();
        for (std::uint32_t i = 0; i < count_; ++i) {
            const Side side = side_at(i);
            if (!side.faces_origin()) continue;
            ClosestFeature<2> found = closest_on_segment(side.a, side.b, DVec<2>(0.0), side.out);
            const bool within = found.kind == FeatureKind::edge;
            if (within && side.beyond >= 0) return on_line(i, side);
            if (!(found.distance < best.distance)) continue;
            if (within)
                found = on_line(i, side);
            else
                found.index = found.index == 0 ? i : next(i);
            best = found;
        }
        return best;
    }

    std::uint32_t count_;
    double turn_;
    const Corner& corner_;
};

template <class Corner>
ClosestFeature<2> closest_on_loop(std::uint32_t count, double turn, const DVec<2>& point, const Corner& corner) {
    ClosestFeature<2> result = Loop<Corner>(count, turn, corner).closest();
    result.point += point;
    return result;
}

}  // namespace

ClosestFeature<2> closest_on_triangle(const DVec<2>& a, const DVec<2>& b, const DVec<2>& c, const DVec<2>& point) {
    detail::enter_library();
    const std::array<DVec<2>, 3> corners{a - point, b - point, c - point};
    // The area from the corner of the two shorter edges: on a needle the long ones would round it away.
    double area = 0, minimum = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const DVec<2> u = corners[(i + 1) % 3] - corners[i], v = corners[(i + 2) % 3] - corners[i];
        const double product = largest(u) * largest(v);
        if (!(product < minimum)) continue;
        minimum = product;
        area = cross(u, v);
    }
    const double turn = area < 0 ? -1 : 1;
    return closest_on_loop(3, turn, point, [&](std::uint32_t i) { return corners[i]; });
}

ClosestFeature<2> closest_on_polygon(std::span<const Vec2> points, const DVec<2>& point, const Affine<2>& place) {
    detail::enter_library();
    Affine<2> relative = place;
    relative.offset -= point;
    const double turn = cross(place.column[0], place.column[1]) < 0 ? -1 : 1;
    return closest_on_loop(static_cast<std::uint32_t>(points.size()), turn, point,
                           [&](std::uint32_t i) { return relative.point(DVec<2>(points[i])); });
}

}  // namespace abut::detail
