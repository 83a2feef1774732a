#pragma once

// Shapes of every kind for the tests of the world, and two user-defined ones.

#include "../../oracle/random.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace abut::test {

using detail::length;
using detail::to_float;

/// A user's convex shape, given by bounds and a support function: |x| + |y| (+ |z|) <= radius.
template <int D>
struct Diamond {
    Vec<D> center{};
    float radius = 1;
};

template <int D>
Aabb<D> bounds(const Diamond<D>& shape) {
    return {shape.center - Vec<D>(shape.radius), shape.center + Vec<D>(shape.radius)};
}

template <int D>
Vec<D> support(const Diamond<D>& shape, const Vec<D>& direction) {
    int longest = 0;
    for (int i = 1; i < D; ++i)
        if (std::abs(direction[i]) > std::abs(direction[longest])) longest = i;
    Vec<D> result = shape.center;
    result[longest] += direction[longest] < 0 ? -shape.radius : shape.radius;
    return result;
}

/// A user's composite shape: boxes in the form of stairs, in a container of its own.
template <int D>
struct Stairs {
    std::vector<Aabb<D>> steps;
};

template <int D>
Stairs<D> stairs(int count, float step) {
    Stairs<D> result;
    for (int i = 0; i < count; ++i) {
        const Vec<D> corner(static_cast<float>(i) * step);
        result.steps.push_back({corner, corner + Vec<D>(step)});
    }
    return result;
}

template <int D>
Aabb<D> bounds(const Stairs<D>& shape) {
    Aabb<D> result = Aabb<D>::empty();
    for (const Aabb<D>& step : shape.steps) result = merged(result, step);
    return result;
}

template <int D, class F>
void each_part(const Stairs<D>& shape, const Aabb<D>& box, F&& visit) {
    for (std::uint32_t i = 0; i < shape.steps.size(); ++i)
        if (overlaps(shape.steps[i], box) && !visit(shape.steps[i], i)) return;
}

/// A closed mesh of eight triangles with outward winding: a ridged roof over a square floor.
inline Mesh house(float size) {
    const float s = size;
    const std::array<Vec3, 6> points{
        {{-s, -s, 0}, {s, -s, 0}, {s, s, 0}, {-s, s, 0}, {-0.5f * s, 0, 1.5f * s}, {0.5f * s, 0, s}}};
    const std::array<glm::uvec3, 8> triangles{
        {{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}, {1, 2, 5}, {2, 3, 4}, {2, 4, 5}, {3, 0, 4}}};
    return *Mesh::build(points, triangles);
}

/// Returns `count` points in a cube.
template <int D>
std::vector<Vec<D>> cloud(oracle::Random& random, int count, double size) {
    std::vector<Vec<D>> result;
    for (int i = 0; i < count; ++i) result.push_back(to_float(random.in_cube<D>() * size));
    return result;
}

template <int D>
inline constexpr int shape_kinds = D == 2 ? 12 : 16;

/// Calls `take` with a random shape of one of the kinds, around its own origin, with an extent of about 1 or less. The
/// shape may refer to temporaries, so `take` must copy it as World::add does.
template <int D, class Take>
void with_random_shape(oracle::Random& random, int kind, Take&& take) {
    const auto length = [&] { return random.uniform_float(0.2, 0.6); };
    const auto point = [&] { return to_float(random.in_cube<D>() * 0.6); };
    const auto box = [&] {
        return Box<D>{Vec<D>(0.1f), to_float(random.in_cube<D>() * 0.4) + Vec<D>(0.45f), random.rotation<D>()};
    };
    const auto scale = [&] {
        Vec<D> result;
        for (int i = 0; i < D; ++i) {
            const bool mirrored = random.chance(0.3);
            result[i] = random.uniform_float(0.4, 1.6) * (mirrored ? -1.0f : 1.0f);
        }
        return result;
    };
    switch (kind) {
        case 0:
            return take(Ball<D>{point(), length()});
        case 1:
            return take(Capsule<D>{point(), point(), 0.5f * length()});
        case 2:
            return take(box());
        case 3:
            return take(bounds(view(box())));
        case 4:
            return take(Segment<D>{point(), point()});
        case 5:
            return take(Triangle<D>{point(), point(), point()});
        case 6:
            return take(HalfSpace<D>{to_float(random.direction<D>()), random.uniform_float(-1, -0.5)});
        case 7:
            return take(Diamond<D>{point(), length()});
        case 8:
            return take(stairs<D>(2 + static_cast<int>(random.below(3)), 0.25f));
        case 9: {
            const Triangle<D> inner{point(), point(), point()};
            return take(rounded(stretched(inner, scale()), 0.1f));
        }
        case 10: {
            const Pose<D> inner{point(), random.rotation<D>()}, outer{point()};
            return take(at(rounded(at(stairs<D>(3, 0.2f), inner), 0.1f), outer));
        }
        default:
            break;
    }
    if constexpr (D == 2) {
        return take(*Polygon::build(cloud<2>(random, 7, 0.7)));
    } else {
        switch (kind) {
            case 11:
                return take(Cylinder{point(), point(), 0.5f * length()});
            case 12:
                return take(Cone{point(), point(), length()});
            case 13:
                return take(*Polyhedron::build(cloud<3>(random, 12, 0.7)));
            case 14:
                return take(house(length()));
            default: {
                const Mesh inner = house(length());
                return take(rounded(stretched(inner, scale()), 0.05f));
            }
        }
    }
}

/// A random kind; half-spaces are rare, because they are unbounded.
template <int D>
int random_kind(oracle::Random& random, double half_spaces = 0.3) {
    for (;;) {
        const int kind = static_cast<int>(random.below(shape_kinds<D>));
        if (kind != 6 || random.chance(half_spaces)) return kind;
    }
}

template <int D>
Pose<D> random_pose(oracle::Random& random, double extent) {
    return {to_float(random.in_cube<D>() * extent), random.rotation<D>()};
}

/// The pose a frame later, after a small translation and a small rotation.
template <int D>
Pose<D> moved_a_little(oracle::Random& random, const Pose<D>& pose, double step) {
    const float angle = random.uniform_float(-0.1, 0.1);
    Pose<D> turn;
    if constexpr (D == 2)
        turn.rotation = Turn::by(angle);
    else
        turn.rotation = turn_about(to_float(random.direction<3>()), angle);
    Pose<D> result = pose * turn;
    result.position += to_float(random.in_cube<D>() * step);
    return result;
}

}  // namespace abut::test
