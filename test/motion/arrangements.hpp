#pragma once

// Arrangements of many convex shapes that don't overlap: heaps, shelves and puzzles.

#include "../oracle/random.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/segment.hpp>

#include <memory>
#include <span>
#include <vector>

namespace abut::test {

using detail::axis;
using detail::dot;
using detail::DVec;
using detail::length;
using detail::to_float;

/// Owned shapes of any kind, with views of them.
template <int D>
class Things {
public:
    template <class S>
    void add(const S& shape) {
        shapes_.push_back(std::make_shared<S>(shape));
        views_.push_back(view(*std::static_pointer_cast<S>(shapes_.back())));
    }
    std::size_t size() const { return views_.size(); }
    std::span<const detail::Convex<D>> views() const { return views_; }

private:
    std::vector<std::shared_ptr<void>> shapes_;
    std::vector<detail::Convex<D>> views_;
};

/// Three sticks, each of which blocks another.
inline std::vector<Aabb3> three_sticks() {
    return {{{-5, -1, 0}, {5, 0, 1}}, {{0, -5, -1}, {1, 5, 0}}, {{-1, 0, -5}, {0, 1, 5}}};
}

/// A convex polygon cut by random lines: the pieces touch along their sides.
inline void cut_up(Things<2>& things, oracle::Random& random, std::vector<DVec<2>> loop, int cuts, const Pose2& pose) {
    if (cuts == 0) {
        std::vector<Vec2> points;
        for (const DVec<2>& p : loop) points.push_back(pose * Vec2(p));
        things.add(*Polygon::build(points));
        return;
    }
    DVec<2> middle(0.0);
    for (const DVec<2>& p : loop) middle += p / static_cast<double>(loop.size());
    // The cuts are often vertical or horizontal.
    const DVec<2> normal = random.chance(0.6) ? axis<2>(static_cast<int>(random.below(2))) : random.direction<2>();
    std::vector<DVec<2>> part[2];
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const DVec<2>&a = loop[i], &b = loop[(i + 1) % loop.size()];
        const double at_a = dot(normal, a - middle), at_b = dot(normal, b - middle);
        part[at_a < 0 ? 0 : 1].push_back(a);
        if ((at_a < 0) == (at_b < 0)) continue;
        const DVec<2> crossing = a + (b - a) * (at_a / (at_a - at_b));
        part[0].push_back(crossing);
        part[1].push_back(crossing);
    }
    for (const auto& half : part) cut_up(things, random, half, cuts - 1, pose);
}

/// Equal boxes on a grid, some of them missing, some of them upright rods and points.
inline void on_a_grid(Things<2>& things, oracle::Random& random, int columns, const Pose2& pose) {
    for (int row = 0; row < columns; ++row)
        for (int column = 0; column < columns; ++column) {
            const Vec2 own(static_cast<float>(column), static_cast<float>(row)), at_place = pose * own;
            if (random.chance(0.1)) continue;
            if (random.chance(0.1))
                things.add(Circle{at_place, 0});
            else if (random.chance(0.1))
                things.add(Segment<2>{pose * (own - Vec2(0, 0.5f)), pose * (own + Vec2(0, 0.5f))});
            else if (random.chance(0.2))
                things.add(Circle{at_place, 0.5f});
            else
                things.add(Box2{at_place, {0.5f, 0.5f}, pose.rotation});
        }
}

/// Random shapes at free places.
template <int D>
void throw_in(Things<D>& things, oracle::Random& random, std::size_t count, double size) {
    std::vector<std::pair<DVec<D>, double>> balls;
    for (int attempt = 0; attempt < 100000 && things.size() < count; ++attempt) {
        const DVec<D> center = random.in_cube<D>() * size;
        const double radius = size * random.power_of_two(-7, -2);
        bool is_free = true;
        for (const auto& [other, reach] : balls) is_free = is_free && length(center - other) > radius + reach;
        if (!is_free) continue;
        balls.emplace_back(center, radius);
        const Vec<D> at_place = to_float(center), end = to_float(random.direction<D>() * (0.9 * radius));
        switch (random.below(4)) {
            case 0:
                things.add(Ball<D>{at_place, static_cast<float>(0.99 * radius)});
                break;
            case 1:
                things.add(Segment<D>{at_place - end, at_place + end});
                break;
            case 2: {
                const float thick = random.uniform_float(0, 0.3) * static_cast<float>(radius);
                things.add(Capsule<D>{at_place - end * 0.6f, at_place + end * 0.6f, thick});
                break;
            }
            default: {
                Vec<D> half;
                for (int i = 0; i < D; ++i) half[i] = random.uniform_float(0.05, 0.55) * static_cast<float>(radius);
                things.add(Box<D>{at_place, half, random.rotation<D>()});
            }
        }
    }
}

}  // namespace abut::test
