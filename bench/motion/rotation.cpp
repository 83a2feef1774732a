// Sweeps with rotation: the time of impact of boxes between two poses.

#include "rotation.hpp"

#include "../../test/oracle/random.hpp"
#include "../each_pair.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/placed.hpp>

#include <memory>

namespace abut::bench {

using namespace detail;

namespace {

constexpr std::size_t pair_count = 1024;
constexpr double pi = 3.14159265358979323846;

/// Random proportions, or rods with an aspect ratio of twenty.
enum class Form { any, rod };

template <int D>
Angle<D> random_angle(oracle::Random& random, double max_angle) {
    const double angle = random.uniform(-max_angle, max_angle);
    if constexpr (D == 2)
        return static_cast<float>(angle);
    else
        return to_float(random.direction<3>() * angle);
}

template <int D>
Box<D> box_of(oracle::Random& random, Form form) {
    Box<D> result;
    for (int i = 0; i < D; ++i) result.half[i] = form == Form::rod ? 0.05f : random.uniform_float(0.2, 1);
    if (form == Form::rod) result.half[0] = 1;
    return result;
}

/// Two boxes that start apart and come close midway, each rotating by up to `max_angle`; about half of them collide.
/// Pairs that barely collide, or barely don't, are left out.
template <int D>
RotationScene<D> rotating_boxes(Form form, double max_angle) {
    oracle::Random random(1);
    RotationScene<D> scene;
    const double aside = form == Form::rod ? 1.5 : 4;
    while (scene.pairs.size() < pair_count) {
        RotatingPair<D> pair;
        Motion<D> motions[2];
        const DVec<D> motion = random.direction<D>() * random.uniform(2, 5);
        RotatingBox<D>* const both[2] = {&pair.a, &pair.b};
        for (int i = 0; i < 2; ++i) {
            const DVec<D> half = motion * (i == 0 ? 0.5 : -0.5);
            motions[i] = {{to_float(half), random.rotation<D>()},
                          to_float(-2.0 * half + random.in_cube<D>() * aside),
                          random_angle<D>(random, max_angle)};
            *both[i] = {box_of<D>(random, form), motions[i].from, pose_at(motions[i], 1), motions[i].turn};
        }
        const RotatingBox<D>&a = pair.a, &b = pair.b;
        if (closest(at(a.box, a.from), at(b.box, b.from)).distance < 0.05f) continue;
        const auto hit_of = [&](float grown) {
            return sweep(rounded(a.box, grown), motions[0], b.box, motions[1]).has_value();
        };
        Box<D> less = a.box;
        less.half -= Vec<D>(0.01f);
        if (hit_of(0.01f) != sweep(less, motions[0], b.box, motions[1]).has_value()) continue;
        scene.pairs.push_back(pair);
    }
    return scene;
}

template <int D>
Side abut_rotation(const RotationScene<D>& scene) {
    return {"abut", each_pair(std::make_shared<const RotationScene<D>>(scene),
                              [](const RotatingPair<D>& pair, std::size_t) -> double {
                                  const auto& [a, b] = pair;
                                  const auto hit = sweep(a.box, a.from, a.to, b.box, b.from, b.to);
                                  return hit ? hit->fraction : no_impact;
                              })};
}

Side straying(Side side, double share) {
    side.strays = share;
    return side;
}

Job job(std::vector<Side> sides) {
    // Peers stop early by a distance tolerance.
    return {.items = pair_count, .values = pair_count, .tolerance = 0.02, .sides = std::move(sides)};
}

Job in_plane(double max_angle) {
    const RotationScene<2> scene = rotating_boxes<2>(Form::any, max_angle);
    return job({abut_rotation(scene), straying(box2d_rotation(scene), 1)});
}
Job in_space(Form form, double max_angle) {
    const RotationScene<3> scene = rotating_boxes<3>(form, max_angle);
    return job({abut_rotation(scene), straying(bullet_rotation(scene), 1), straying(fcl_rotation(scene), 1)});
}

}  // namespace

std::vector<Bench> motion_rotation_benches() {
    return {
        {"motion/rotation/2d/box/pi4", [] { return in_plane(pi / 4); }},
        {"motion/rotation/2d/box/pi", [] { return in_plane(pi); }},
        {"motion/rotation/3d/box/pi4", [] { return in_space(Form::any, pi / 4); }},
        {"motion/rotation/3d/box/pi", [] { return in_space(Form::any, pi); }},
        {"motion/rotation/3d/rod/pi4", [] { return in_space(Form::rod, pi / 4); }},
        {"motion/rotation/3d/rod/pi", [] { return in_space(Form::rod, pi); }},
    };
}

}  // namespace abut::bench
