#pragma once

// Point sets that are difficult for a hull with a vertex limit: stretched, nearly flat, nearly collinear, caps, copies,
// denormals, far from the origin.

#include "point_sets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace abut::test {

using detail::DVec;
using detail::largest;
using detail::to_float;

/// A cap of a unit sphere, far away: its height is about the square of its radius.
inline std::vector<Vec3> cap_of_a_sphere(Random& random, int count) {
    const double radius = random.power_of_two(-12, 0) / 2;
    std::vector<Vec3> result;
    for (int i = 0; i < count; ++i) {
        const DVec<2> direction = random.direction<2>();
        const double out = radius * std::sqrt(random.unit());
        result.push_back(
            to_float(DVec<3>(direction.x * out, direction.y * out, out * out / (1 + std::sqrt(1 - out * out)))));
    }
    return result;
}

/// A flat polygon or a line with points moved by so many ulp.
inline std::vector<Vec3> off_by_ulps(std::vector<Vec3> points, Random& random, int most) {
    for (Vec3& point : points)
        for (int i = 0; i < 3; ++i)
            for (int steps = static_cast<int>(random.below(static_cast<std::uint32_t>(most) + 1)); steps > 0; --steps)
                point[i] = std::nextafter(point[i], random.chance(0.5) ? 1e30f : -1e30f);
    return points;
}

struct NastySet {
    std::string name;
    std::vector<Vec3> points;
};

inline NastySet nasty_set(std::uint64_t seed) {
    Random random(seed);
    NastySet result;
    const int count = 5 + static_cast<int>(random.below(random.chance(0.1) ? 400 : 60));
    const std::uint32_t kind = random.below(9);
    switch (kind) {
        case 0:
            result = {"cube", in_a_cube(random, count)};
            break;
        case 1:
            result = {"sphere", on_a_sphere(random, count)};
            break;
        case 2:
            result = {"cap", cap_of_a_sphere(random, count)};
            break;
        case 3:
            result = {"lattice", on_a_lattice(random, count)};
            break;
        case 4:
            result = {"rings", rings(3 + count / 2)};
            break;
        case 5:
            result = {"disc", stretched(on_a_sphere(random, count), {1, 1, 0})};
            break;
        case 6:
            result = {"line", stretched(in_a_cube(random, count), {1, 1e-6f, 1e-6f})};
            break;
        case 7:
            result = {"box surface", box_surface(1 + count / 20)};
            break;
        default:
            result = {"near copies", with_near_copies(in_a_cube(random, 5 + count / 8), random)};
            break;
    }
    std::vector<Vec3>& points = result.points;
    if (random.chance(0.3)) {
        result.name += ", turned";
        points = turned(points, random);
    }
    if (random.chance(0.6)) {
        result.name += ", stretched";
        Vec3 factor;
        for (int i = 0; i < 3; ++i) factor[i] = static_cast<float>(random.power_of_two(-20, 20));
        if (random.chance(0.5)) factor[1] = factor[0];
        points = stretched(points, factor);
    }
    if (random.chance(0.4)) {
        result.name += ", turned";
        points = turned(points, random);
    }
    if (random.chance(0.2)) {
        result.name += ", off by ulps";
        const int most = 1 + static_cast<int>(random.below(4));
        points = off_by_ulps(points, random, most);
    }
    double size = 0;
    for (const Vec3& point : points) size = std::max(size, largest(DVec<3>(point)));
    const double to_one = size > 0 ? 1 / size : 1;
    const std::uint32_t place = random.below(6);
    if (place == 0) {
        result.name += ", far away";
        const DVec<3> offset = random.in_cube<3>() * (size * random.power_of_two(0, 21));
        for (Vec3& point : points) point = to_float(DVec<3>(point) + offset);
    } else if (place == 1) {
        result.name += ", among denormals";
        for (Vec3& point : points) point = to_float(DVec<3>(point) * to_one * random.power_of_two(-146, -123));
    } else if (place == 2) {
        result.name += ", huge";
        for (Vec3& point : points) point = to_float(DVec<3>(point) * to_one * random.power_of_two(110, 122));
    }
    if (random.chance(0.2)) {
        result.name += ", with copies";
        const std::size_t before = points.size();
        for (std::size_t i = 0; i < before; i += 2) points.push_back(points[i]);
    }
    result.name += ", seed " + std::to_string(seed);
    return result;
}

}  // namespace abut::test
