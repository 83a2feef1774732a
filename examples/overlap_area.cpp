// How much of a unit stands in the zone? The unit with the largest overlap area owns the zone.
// The intersection of two shapes is a shape too, with an area and a centroid. A round unit is converted to a polygon
// first.
#include <abut/query/intersection.hpp>
#include <abut/shape/ball.hpp>

#include <cstdio>

int main() {
    const abut::Box2 zone{{0, 0}, {4, 3}, abut::Turn::by(0.2f)};
    const abut::Circle units[] = {{{1, 1}, 0.5f}, {{3.7f, -1}, 1}, {{9, 0}, 2}};

    double held[3] = {};
    for (int i = 0; i < 3; ++i) {
        const abut::Polygon unit = abut::polytope(units[i], 0.01f);
        if (const auto inside = abut::intersection(unit, zone)) {
            held[i] = inside->area();
            const abut::Vec2 flag = inside->centroid();
            std::printf("unit %d: %.0f %% inside, around %.2f, %.2f\n", i, 100 * inside->area() / unit.area(), flag.x,
                        flag.y);
        }
    }
    return held[1] > held[0] && held[0] > 0.75 && held[2] == 0 ? 0 : 1;
}
