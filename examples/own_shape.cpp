// A user-defined shape, an ellipsoid. Two functions beside the type make all queries work.
#include <abut/abut.hpp>

#include <cmath>
#include <cstdio>

namespace game {

struct Ellipsoid {
    abut::Vec3 center, radii;
};

abut::Aabb3 bounds(const Ellipsoid& e) {
    return {e.center - e.radii, e.center + e.radii};
}

/// The support function: the point of the ellipsoid that is farthest in a direction.
abut::Vec3 support(const Ellipsoid& e, const abut::Vec3& direction) {
    const abut::Vec3 scaled = e.radii * direction;
    const float length = std::sqrt(scaled.x * scaled.x + scaled.y * scaled.y + scaled.z * scaled.z);
    return length > 0 ? e.center + e.radii * scaled / length : e.center;
}

}  // namespace game

int main() {
    const game::Ellipsoid egg{{0, 0, 0}, {1, 1, 1.5f}};
    const abut::Box3 table{{0, 0, -2}, {3, 3, 0.25f}};

    const float gap = abut::closest(egg, table).distance;
    const auto hit =
        abut::raycast({{5, 0, 0}, {-1, 0, 0}}, abut::at(egg, {.rotation = abut::turn_about({0, 1, 0}, 1.5708f)}));
    if (!hit) return 1;

    std::printf("the egg is %g above the table; lying down, a ray hits it at %g\n", gap, hit->point.x);
    return std::abs(gap - 0.25f) < 1e-4f && std::abs(hit->point.x - 1.5f) < 1e-4f ? 0 : 1;
}
