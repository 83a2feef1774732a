#include <abut/convex/pairs/placed_polygon2.hpp>
#include <abut/convex/pairs/round3.hpp>

namespace abut::detail {

ScaledTurn ScaledTurn::normalised(Double2 turn) {
    const DVec<2> unit_turn = unit(vector_of(turn));
    return {lanes::double2(unit_turn.x, unit_turn.y), lanes::double2(1)};
}

bool PlacedPolygon::set_triangle(const Vec2& a, const Vec2& b, const Vec2& c) {
    const DVec<2> points[] = {DVec<2>(a), DVec<2>(b), DVec<2>(c)}, u = points[1] - points[0], v = points[2] - points[0];
    const double area = cross(u, v);
    const double longest_squared = std::max({dot(u, u), dot(v, v), length_squared(v - u)});
    if (!(std::abs(area) > 1e-9 * longest_squared)) return false;
    const Vec2 counter_clockwise[] = {a, area < 0 ? c : b, area < 0 ? b : c};
    write_polygon_soa(counter_clockwise, storage.numbers);
    set_rows(storage.numbers, 3);
    if (area < 0) names = &reversed_names;
    return true;
}

namespace {

/// Writes the size, the area and one block.
void write_rows(const double (&x)[4], const double (&y)[4], const double (&normal_x)[4], const double (&normal_y)[4],
                const double (&offset)[4], double size, double area, double* numbers) {
    numbers[0] = size;
    numbers[1] = area;
    for (std::size_t i = 0; i < 4; ++i) {
        numbers[2 + i] = x[i];
        numbers[6 + i] = y[i];
        numbers[10 + i] = normal_x[i];
        numbers[14 + i] = normal_y[i];
        numbers[18 + i] = offset[i];
    }
}

}  // namespace

void write_box_rows(Double2 half, SoaStorage& storage, PolygonSoa& sides) {
    const double x = half[0], y = half[1];
    write_rows({x, -x, -x, x}, {y, y, -y, -y}, {0, -1, 0, 1}, {1, 0, -1, 0}, {y, x, y, x}, x + y, 4 * x * y,
               storage.numbers);
    sides.view_rows(storage.numbers, 4);
}

void PlacedPolygon::make_rows() {
    if (core == Core::polygon) return;
    core = Core::polygon;
    if (names == &box_names) return write_box_rows(half, storage, sides);
    const double x = half[0];
    write_rows({-x, x, -x, -x}, {0, 0, 0, 0}, {0, 0, 0, 0}, {-1, 1, -1, -1}, {0, 0, 0, 0}, x, 0, storage.numbers);
    sides.view_rows(storage.numbers, x > 0 ? 2 : 1);
    names = &listed_names;
}

bool set_placed_polygon(const Convex<2>& convex, PlacedPolygon& polygon) {
    const Affine<2>& place = convex.place;
    polygon.radius = convex.radius;
    if (is_round_points(convex, 1)) {
        const DVec<2> point = place.point(DVec<2>(convex.vertices()[0]));
        polygon.set_point(lanes::double2(point.x, point.y));
        return true;
    }
    if (is_round_points(convex, 2)) {
        const DVec<2> a(convex.vertices()[0]), b(convex.vertices()[1]);
        const DVec<2> middle = place.point(0.5 * (a + b)), along = place.vector(b - a);
        polygon.set_segment(lanes::double2(middle.x, middle.y), lanes::double2(along.x, along.y));
        return true;
    }
    const bool rigid = has_similarity_placement(convex) && std::abs(convex.scale - 1) <= 1e-12 &&
                       cross(place.column[0], place.column[1]) > 0;
    if (!rigid) return false;
    polygon.place.position = lanes::double2(place.offset.x, place.offset.y);
    polygon.place.set_turn(lanes::double2(place.column[0].x, place.column[0].y));
    if (convex.sides != nullptr) {
        polygon.set_rows(convex.sides, convex.count);
        return true;
    }
    if (convex.core == Core::box) {
        polygon.set_box(lanes::loaded(&convex.own[0].x));
        return true;
    }
    const Vec2* points = convex.vertices();
    return convex.core == Core::points && convex.count == 3 && polygon.set_triangle(points[0], points[1], points[2]);
}

}  // namespace abut::detail
