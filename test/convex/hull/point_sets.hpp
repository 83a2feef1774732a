#pragma once

// Point sets that are difficult for hulls, each for another reason.

#include "../../oracle/random.hpp"
#include <abut/math/affine.hpp>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace abut::test {

using detail::to_float;

using oracle::Random;

inline std::vector<Vec3> in_a_cube(Random& random, int count) {
    std::vector<Vec3> result;
    for (int i = 0; i < count; ++i) result.emplace_back(to_float(random.in_cube<3>()));
    return result;
}
inline std::vector<Vec3> on_a_sphere(Random& random, int count) {
    std::vector<Vec3> result;
    for (int i = 0; i < count; ++i) result.emplace_back(to_float(random.direction<3>()));
    return result;
}
inline std::vector<Vec3> on_a_lattice(Random& random, int count) {
    const auto coordinate = [&] { return static_cast<float>(random.below(4)) - 1.5f; };
    std::vector<Vec3> result;
    for (int i = 0; i < count; ++i) result.push_back({coordinate(), coordinate(), coordinate()});
    return result;
}
inline std::vector<Vec3> stretched(std::vector<Vec3> points, const Vec3& factor) {
    for (Vec3& point : points) point *= factor;
    return points;
}
inline std::vector<Vec3> turned(std::vector<Vec3> points, Random& random) {
    const detail::Affine<3> place = detail::affine(Pose3{Vec3(0.0f), random.rotation<3>()});
    for (Vec3& point : points) point = to_float(place.point(detail::DVec<3>(point)));
    return points;
}
inline std::vector<Vec3> rings(int sides) {
    std::vector<Vec3> result;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * 3.14159265358979323846 * i / sides;
        const auto x = static_cast<float>(std::cos(angle)), y = static_cast<float>(std::sin(angle));
        result.insert(result.end(), {{x, y, -1.0f}, {x, y, 1.0f}});
    }
    return result;
}
inline std::vector<Vec3> box_surface(int pieces) {
    std::vector<Vec3> result;
    const auto at = [&](int i) { return static_cast<float>(2 * i - pieces) / static_cast<float>(pieces); };
    for (int x = 0; x <= pieces; ++x)
        for (int y = 0; y <= pieces; ++y)
            for (int z = 0; z <= pieces; ++z)
                if (x % pieces == 0 || y % pieces == 0 || z % pieces == 0) result.emplace_back(at(x), at(y), at(z));
    return result;
}
inline std::vector<Vec3> with_near_copies(std::vector<Vec3> points, Random& random) {
    const std::size_t count = points.size();
    for (std::size_t i = 0; i < count; ++i) {
        const double distance = random.power_of_two(-26, -18);
        points.push_back(points[i] + to_float(random.in_cube<3>() * distance));
    }
    return points;
}

/// One statement for each random number: the compiler chooses the order in which arguments are evaluated.
struct Kind {
    std::string name;
    std::function<std::vector<Vec3>(Random&)> make;
};
inline float thin(Random& random) {
    return static_cast<float>(random.power_of_two(-24, -1));
}
inline const std::vector<Kind> kinds{
    {"few in a cube",
     [](Random& random) {
         const int count = 4 + static_cast<int>(random.below(12));
         return in_a_cube(random, count);
     }},
    {"many in a cube", [](Random& random) { return in_a_cube(random, 400); }},
    {"on a sphere", [](Random& random) { return on_a_sphere(random, 300); }},
    {"on a lattice",
     [](Random& random) {
         const int count = 6 + static_cast<int>(random.below(40));
         return on_a_lattice(random, count);
     }},
    {"lattice, turned",
     [](Random& random) {
         const std::vector<Vec3> points = on_a_lattice(random, 40);
         return turned(points, random);
     }},
    {"box, turned",
     [](Random& random) {
         const int pieces = 1 + static_cast<int>(random.below(6));
         return turned(box_surface(pieces), random);
     }},
    {"cylinder, turned",
     [](Random& random) {
         const int sides = 3 + static_cast<int>(random.below(62));
         return turned(rings(sides), random);
     }},
    {"plate",
     [](Random& random) {
         const std::vector<Vec3> points = in_a_cube(random, 60);
         const float z = thin(random);
         return turned(stretched(points, {1, 1, z}), random);
     }},
    {"needle",
     [](Random& random) {
         const std::vector<Vec3> points = in_a_cube(random, 60);
         const float xy = 0.05f * thin(random);
         return turned(stretched(points, {xy, xy, 1}), random);
     }},
    {"lens",
     [](Random& random) {
         const std::vector<Vec3> points = on_a_sphere(random, 200);
         return stretched(points, {1, 1, thin(random)});
     }},
    {"flake in a needle",
     [](Random& random) {
         const std::vector<Vec3> points = in_a_cube(random, 50);
         const float x = thin(random), z = thin(random);
         return stretched(points, {x, 1, z});
     }},
    {"near copies",
     [](Random& random) {
         const std::vector<Vec3> points = in_a_cube(random, 30);
         return with_near_copies(points, random);
     }},
};

}  // namespace abut::test
