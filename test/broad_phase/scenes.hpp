#pragma once

// Scenes of boxes for broad phases, and their motions.

#include "../oracle/random.hpp"
#include <abut/math/aabb.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace abut::test {

using detail::axis;
using detail::DVec;

/// The dimension of a broad phase.
template <class T>
inline constexpr int dimension_of = decltype(T().bounds().min)::length();

enum class Scene { uniform, clustered, mixed_sizes, coincident, touching_grid, line, growing_gaps, holes_and_endless };

inline constexpr std::array all_scenes{Scene::uniform,      Scene::clustered,        Scene::mixed_sizes,
                                       Scene::coincident,   Scene::touching_grid,    Scene::line,
                                       Scene::growing_gaps, Scene::holes_and_endless};

template <int D>
Aabb<D> box_at(const DVec<D>& center, const DVec<D>& half) {
    return {Vec<D>(center - half), Vec<D>(center + half)};
}

/// A random box within reach of the origin, with sides of at most twice `half`.
template <int D>
Aabb<D> some_box(oracle::Random& random, double reach, double half) {
    // The numbers are drawn in statements of their own, because compilers evaluate arguments in any order.
    const DVec<D> center = random.in_cube<D>() * reach;
    return box_at<D>(center, DVec<D>(random.uniform(0, half)));
}

/// A box that is unbounded on some or all sides.
template <int D>
Aabb<D> endless_box(oracle::Random& random) {
    Aabb<D> result = some_box<D>(random, 10, 2);
    constexpr float far = std::numeric_limits<float>::infinity();
    for (int i = 0; i < D; ++i) {
        if (random.chance(0.5)) result.min[i] = -far;
        if (random.chance(0.5)) result.max[i] = far;
    }
    return result;
}

template <int D>
std::vector<Aabb<D>> make_scene(Scene scene, std::uint32_t count, oracle::Random& random) {
    std::vector<Aabb<D>> result;
    const double side = std::pow(static_cast<double>(count), 1.0 / D);
    for (std::uint32_t i = 0; i < count; ++i) {
        const DVec<D> place = random.in_cube<D>() * side;
        const DVec<D> half = DVec<D>(1.0) + 0.9 * random.in_cube<D>();
        switch (scene) {
            case Scene::uniform:
                result.push_back(box_at<D>(place, half));
                break;
            case Scene::clustered: {
                const double cluster = 20.0 * random.below(4), width = random.uniform(0, 9);
                result.push_back(box_at<D>(DVec<D>(cluster) + random.in_cube<D>() * width, half));
                break;
            }
            case Scene::mixed_sizes:
                result.push_back(
                    box_at<D>(place * 100.0, half * (random.chance(0.05) ? 1e4 : random.power_of_two(-10, 7))));
                break;
            case Scene::coincident:
                result.push_back(box_at<D>(DVec<D>(3.0), DVec<D>(1.0)));
                break;
            case Scene::touching_grid: {
                Vec<D> corner;
                std::uint32_t rest = i;
                for (int axis = 0; axis < D; ++axis, rest /= 6) corner[axis] = static_cast<float>(rest % 6);
                result.push_back({corner, corner + Vec<D>(1)});
                break;
            }
            case Scene::line:
                result.push_back(box_at<D>(DVec<D>(1.0) * (0.9 * i), DVec<D>(0.5)));
                break;
            case Scene::growing_gaps:
                result.push_back(box_at<D>(axis<D>(0) * std::ldexp(1.0, static_cast<int>(i % 120)), half));
                break;
            case Scene::holes_and_endless:
                result.push_back(random.chance(0.3)   ? Aabb<D>::empty()
                                 : random.chance(0.1) ? endless_box<D>(random)
                                                      : box_at<D>(place, half));
                break;
        }
    }
    return result;
}

/// Most boxes drift, some jump, change their size, vanish, come back or lose their bounds.
template <int D>
void move_some(std::vector<Aabb<D>>& boxes, oracle::Random& random) {
    for (Aabb<D>& box : boxes) {
        const double what = random.unit();
        if (what < 0.01)
            box = Aabb<D>::empty();
        else if (what < 0.011)
            box = endless_box<D>(random);
        else if (what < 0.04)
            box = some_box<D>(random, 20, 3);
        else if (what < 0.6) {
            const Vec<D> step(random.in_cube<D>() * 0.3);
            box.min += step;
            box.max += step;
        }
    }
}

}  // namespace abut::test
