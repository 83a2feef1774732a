#include <abut/convex/pairs/round3.hpp>
#include <abut/convex/polygon_soa.hpp>

namespace abut::detail {
namespace {

/// Writes corners in order to SoA rows.
class Rows {
public:
    Rows(double* numbers, std::uint32_t count)
        : numbers_(numbers), count_(count), capacity_(padded_edge_count(count)) {}

    template <class Corner>
    void write(const Corner& corner) {
        const DVec<2> first = corner(0);
        DVec<2> from = first, low = from, high = from;
        double area = 0;
        for (std::uint32_t i = 0; i < count_; ++i) {
            const DVec<2> to = corner(i + 1 == count_ ? 0 : i + 1), edge = to - from;
            // In double no square of a difference of floats overflows or underflows.
            const double part = 1 / std::sqrt(dot(edge, edge));
            const DVec<2> normal(edge.y * part, -edge.x * part);
            put(i, from, normal, dot(normal, from));
            area += cross(from - first, edge);
            low = {std::min(low.x, from.x), std::min(low.y, from.y)};
            high = {std::max(high.x, from.x), std::max(high.y, from.y)};
            from = to;
        }
        for (std::uint32_t i = count_; i < capacity_; ++i)
            for (std::uint32_t row = 0; row < 5; ++row) numbers_[row * capacity_ + i] = numbers_[row * capacity_];
        numbers_[5 * capacity_] = 0.5 * length(high - low);
        numbers_[5 * capacity_ + 1] = 0.5 * area;
    }

private:
    void put(std::uint32_t i, const DVec<2>& corner, const DVec<2>& normal, double offset) {
        numbers_[i] = corner.x;
        numbers_[capacity_ + i] = corner.y;
        numbers_[2 * capacity_ + i] = normal.x;
        numbers_[3 * capacity_ + i] = normal.y;
        numbers_[4 * capacity_ + i] = offset;
    }

    double* numbers_;
    std::uint32_t count_, capacity_;
};

}  // namespace

void write_polygon_soa(std::span<const Vec2> points, double* numbers) {
    Rows(numbers, static_cast<std::uint32_t>(points.size())).write([&](std::uint32_t i) { return DVec<2>(points[i]); });
}

bool PlacedPolygon::set_segment(const Vec2& a, const Vec2& b) {
    if (a == b) return false;
    Rows rows(storage.numbers, 2);
    rows.write([&](std::uint32_t i) { return DVec<2>(i == 0 ? a : b); });
    sides.view_rows(storage.numbers, 2);
    return true;
}

bool PlacedPolygon::set_triangle(const Vec2& a, const Vec2& b, const Vec2& c) {
    const DVec<2> points[] = {DVec<2>(a), DVec<2>(b), DVec<2>(c)}, u = points[1] - points[0], v = points[2] - points[0];
    const double area = cross(u, v);
    const double longest_squared = std::max({dot(u, u), dot(v, v), length_squared(v - u)});
    if (!(std::abs(area) > 1e-9 * longest_squared)) return false;
    const bool reversed = area < 0;
    Rows rows(storage.numbers, 3);
    rows.write([&](std::uint32_t i) { return points[reversed ? (3 - i) % 3 : i]; });
    sides.view_rows(storage.numbers, 3);
    if (reversed) sides.order = CornerOrder::reversed;
    return true;
}

bool set_placed_polygon(const Convex<2>& convex, PlacedPolygon& polygon) {
    const Affine<2>& place = convex.place;
    polygon.radius = convex.radius;
    if (is_round_points(convex, 1)) {
        polygon.set_point(place.point(DVec<2>(convex.vertices()[0])));
        return true;
    }
    const bool rigid = has_similarity_placement(convex) && std::abs(convex.scale - 1) <= 1e-12 &&
                       cross(place.column[0], place.column[1]) > 0;
    if (!rigid) return false;
    polygon.place = {place.column[0].x, place.column[0].y, place.offset.x, place.offset.y};
    if (convex.sides != nullptr) {
        polygon.sides.view_rows(convex.sides, convex.count);
        return true;
    }
    if (convex.core == Core::box) {
        polygon.set_box(DVec<2>(convex.own[0]));
        return true;
    }
    if (convex.core != Core::points) return false;
    const Vec2* points = convex.vertices();
    if (convex.count == 2) return polygon.set_segment(points[0], points[1]);
    return convex.count == 3 && polygon.set_triangle(points[0], points[1], points[2]);
}

}  // namespace abut::detail
