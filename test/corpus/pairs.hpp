#pragma once

// The pairs of the corpus. A family and a seed determine a pair on every machine.

#include "../oracle/degenerate.hpp"
#include "family.hpp"
#include "touching.hpp"

namespace abut::corpus {

using detail::axis;
using detail::DVec;
using detail::to_float;

using oracle::Arithmetic;
using oracle::Truth;

/// Makes B with the size, style and kind of its numbers, around some center.
template <int D>
struct Movable {
    Random random;
    double size;
    Style style = Style::plain;

    Sample<D> at(const DVec<D>& center) const { return StyledMaker<D>(random, size, style).make(center); }
};

template <int D>
double smaller_size(const Sample<D>& a, const Sample<D>& b) {
    return std::min(oracle::size(a.solid), oracle::size(b.solid));
}

/// Moves the center of B until the signed distance is nearly `wanted`, limited only by rounding.
template <int D>
Sample<D> brought(const Sample<D>& a, const Movable<D>& b, DVec<D>& center, double wanted) {
    for (int i = 0; i < 2; ++i) {
        const Truth<D> now = oracle::truth(a.solid, b.at(center).solid, Arithmetic::floating_point);
        center += now.normal * (wanted - now.distance);
    }
    return b.at(center);
}

/// Moves B along a random direction, so close that about half of the pairs overlap.
template <int D>
Sample<D> near_by(Random& random, const Sample<D>& a, const Movable<D>& b, DVec<D>& center) {
    const Sample<D> there = b.at(center);
    const DVec<D> n = random.direction<D>();
    const double gap = oracle::gap_along(a.solid, there.solid, n) - a.solid.radius - there.solid.radius;
    center += n * (smaller_size(a, there) * random.uniform(-2, 0.05) - gap);
    return b.at(center);
}

/// A signed fraction of the smaller size, from 2^low to 2^high, slightly more often negative.
template <int D>
double some_gap(Random& random, const Sample<D>& a, const Sample<D>& b, int low, int high) {
    const double part = random.power_of_two(low, high);
    return smaller_size(a, b) * (random.chance(0.6) ? -part : part);
}

struct Sizes {
    double a, b;
};
/// Two sizes, mostly similar.
inline Sizes some_sizes(Random& random) {
    const double a = random.power_of_two(-10, 13);
    return {a, random.chance(0.9) ? a * random.power_of_two(-2, 2) : random.power_of_two(-10, 13)};
}

/// A center at most about a thousand sizes from the origin.
template <int D>
DVec<D> some_center(Random& random, const Sizes& sizes) {
    const double away = random.chance(0.5) ? 0 : random.power_of_two(0, 12);
    return random.direction<D>() * std::min(away * std::max(sizes.a, sizes.b), 1e6);
}

/// Two shapes of the given styles: close together, with a small depth, or concentric.
template <int D>
SamplePair<D> styled_pair(Random& random, Style style_a, Style style_b) {
    const Sizes sizes = some_sizes(random);
    const DVec<D> center_a = some_center<D>(random, sizes);
    DVec<D> center_b = center_a;
    const Movable<D> make_a{Random(random.bits()), sizes.a, style_a}, make_b{Random(random.bits()), sizes.b, style_b};
    const Sample<D> a = make_a.at(center_a);
    const double dice = random.unit();
    Sample<D> b = dice < 0.1 ? make_b.at(center_b) : near_by(random, a, make_b, center_b);
    if (dice > 0.55) b = brought(a, make_b, center_b, some_gap(random, a, b, -20, -7));
    return random.chance(0.5) ? SamplePair<D>{a, b} : SamplePair<D>{b, a};
}

template <int D>
SamplePair<D> random_pair(Random& random) {
    const Sizes sizes = some_sizes(random);
    DVec<D> center = some_center<D>(random, sizes);
    const Sample<D> a = Movable<D>{Random(random.bits()), sizes.a}.at(center);
    return {a, near_by(random, a, Movable<D>{Random(random.bits()), sizes.b}, center)};
}

/// A step of a coherent sequence, from 0 on; each is at most 1e-3 of a size from touching.
template <int D>
SamplePair<D> coherent_pair(Random random, int step) {
    const Sizes sizes = some_sizes(random);
    DVec<D> center = some_center<D>(random, sizes);
    const Sample<D> a = Movable<D>{Random(random.bits()), sizes.a}.at(center);
    const Movable<D> make_b{Random(random.bits()), sizes.b};
    Sample<D> b = near_by(random, a, make_b, center);
    for (int i = 0; i <= step; ++i) b = brought(a, make_b, center, some_gap(random, a, b, -20, -9));
    return {a, b};
}

template <int D>
SamplePair<D> parallel_faces(Random& random) {
    const Sizes sizes = some_sizes(random);
    const Pose<D> pose{to_float(some_center<D>(random, sizes)),
                       random.chance(0.3) ? no_rotation<D> : random.rotation<D>()};
    const auto half = [&](double size) {
        Vec<D> result;
        for (int i = 0; i < D; ++i) result[i] = random.uniform_float(0.1, 1) * static_cast<float>(size);
        return result;
    };
    const Vec<D> half_a = half(sizes.a), half_b = random.chance(0.2) ? half_a : half(sizes.b);
    const int across = static_cast<int>(random.below(D));
    const double smaller = std::min(sizes.a, sizes.b);
    Vec<D> offset;
    for (int i = 0; i < D; ++i) {
        const double reach = static_cast<double>(half_a[i] + half_b[i]);
        const double part = smaller * random.power_of_two(-24, 0), beside = random.uniform(-reach, reach);
        const double gap = random.chance(0.5) ? -part : part;
        offset[i] = static_cast<float>(i == across ? reach + gap : random.chance(0.2) ? 0 : beside);
    }
    const float radius = random.chance(0.3) ? random.uniform_float(0, 0.3) * static_cast<float>(smaller) : 0;
    const Sample<D> a = box_shape<D>(random, Vec<D>(0.0f), half_a, radius, pose);
    const float other_radius = random.chance(0.5) ? radius : 0;
    return {a, box_shape<D>(random, offset, half_b, other_radius, pose)};
}

/// A shape that is symmetric about the origin of its pose.
template <int D>
Sample<D> symmetric(Random& random, double size, const Pose<D>& pose) {
    const float radius = random.chance(0.5) ? random.uniform_float(0, size) : 0;
    const std::uint32_t form = random.below(3);
    if (form == 0) {
        Vec<D> half;
        for (int i = 0; i < D; ++i) half[i] = random.uniform_float(0.1, 1) * static_cast<float>(size);
        if (random.chance(0.4)) half = Vec<D>(half[0]);
        return box_shape<D>(random, Vec<D>(0.0f), half, radius, pose);
    }
    const bool baked = random.chance(0.3);
    if (form == 1) return shape_of<D>(random, {Vec<D>(0.0f)}, radius, pose, baked);
    std::vector<Vec<D>> points;
    for (std::uint32_t i = 1 + random.below(4); i > 0; --i) {
        points.push_back(to_float(random.in_cube<D>() * size));
        points.push_back(-points.back());
    }
    return shape_of<D>(random, std::move(points), radius, pose, baked);
}

template <int D>
SamplePair<D> concentric(Random& random) {
    const Sizes sizes = some_sizes(random);
    const Pose<D> pose{to_float(some_center<D>(random, sizes)), random.rotation<D>()};
    const Pose<D> other{pose.position, random.chance(0.5) ? pose.rotation : random.rotation<D>()};
    const Sample<D> a = symmetric<D>(random, sizes.a, pose);
    const double size_b = random.chance(0.3) ? sizes.a : sizes.b;
    return {a, symmetric<D>(random, size_b, other)};
}

template <int D>
SamplePair<D> identical(Random& random) {
    const Sizes sizes = some_sizes(random);
    const DVec<D> center = some_center<D>(random, sizes);
    const Movable<D> make{Random(random.bits()), sizes.a, static_cast<Style>(random.below(5))};
    const Sample<D> a = make.at(center);
    if (random.chance(0.5)) return {a, make.at(center)};
    const double away = oracle::size(a.solid) * random.power_of_two(-24, 0);
    return {a, make.at(center + (random.chance(0.5) ? random.direction<D>() : axis<D>(0)) * away)};
}

template <int D>
SamplePair<D> small_gap(Random& random) {
    const Sizes sizes = some_sizes(random);
    DVec<D> center = some_center<D>(random, sizes);
    const auto style = [&] { return random.chance(0.5) ? Style::plain : static_cast<Style>(random.below(5)); };
    const Sample<D> a = Movable<D>{Random(random.bits()), sizes.a, style()}.at(center);
    const Movable<D> make_b{Random(random.bits()), sizes.b, style()};
    const Sample<D> b = near_by(random, a, make_b, center);
    // 2^-23.25 is 1e-7.
    return {a, brought(a, make_b, center, some_gap(random, a, b, -23, -10))};
}

template <int D>
SamplePair<D> mixed_or_far(Random& random, bool far) {
    const auto style = [&] { return random.chance(0.7) ? Style::plain : static_cast<Style>(random.below(5)); };
    const Sizes sizes = far && random.chance(0.7) ? some_sizes(random)
                                                  : Sizes{random.power_of_two(-10, 13), random.power_of_two(-10, 13)};
    DVec<D> center = some_center<D>(random, sizes);
    if (far) center = random.direction<D>() * random.power_of_two(10, 20);
    const Sample<D> a = Movable<D>{Random(random.bits()), sizes.a, style()}.at(center);
    const Movable<D> make_b{Random(random.bits()), sizes.b, style()};
    Sample<D> b = near_by(random, a, make_b, center);
    if (random.chance(0.5)) b = brought(a, make_b, center, some_gap(random, a, b, -20, -7));
    return random.chance(0.5) ? SamplePair<D>{a, b} : SamplePair<D>{b, a};
}

/// Makes a pair of the families of polytopes with radii; of the coherent family, the first step.
template <int D>
SamplePair<D> sample_pair(Family family, std::uint64_t seed) {
    Random random(seed);
    const auto other = [&] { return random.chance(0.5) ? Style::plain : static_cast<Style>(1 + random.below(4)); };
    switch (family) {
        case Family::coherent:
            return coherent_pair<D>(random, 0);
        case Family::face_face:
            return TouchingMaker<D>(random).make(Touch::face, Touch::face);
        case Family::edge_edge:
            return TouchingMaker<D>(random).make(D == 2 ? Touch::vertex : Touch::edge,
                                                 D == 2 ? Touch::vertex : Touch::edge);
        case Family::vertex_face:
            return TouchingMaker<D>(random).make(Touch::vertex, Touch::face);
        case Family::edge_or_vertex: {
            const Touch touch = random.chance(0.5) ? Touch::edge : Touch::vertex;
            return TouchingMaker<D>(random).make(touch, static_cast<Touch>(random.below(3)));
        }
        case Family::lattice: {
            oracle::LatticeGenerator<D> maker(random, static_cast<oracle::Perturbation>(random.below(
                                                          static_cast<std::uint32_t>(oracle::perturbation_count))));
            const Sample<D> a = maker.make();
            return {a, maker.make()};
        }
        case Family::parallel_faces:
            return parallel_faces<D>(random);
        case Family::needle:
            return styled_pair<D>(random, Style::needle, other());
        case Family::flake:
            return styled_pair<D>(random, Style::flake, other());
        case Family::concentric:
            return concentric<D>(random);
        case Family::identical:
            return identical<D>(random);
        case Family::zero_size:
            return styled_pair<D>(random, Style::zero_size, other());
        case Family::duplicate_points:
            return styled_pair<D>(random, Style::duplicate_points, other());
        case Family::small_gap:
            return small_gap<D>(random);
        case Family::mixed_sizes:
        case Family::far:
            return mixed_or_far<D>(random, family == Family::far);
        default:
            return random_pair<D>(random);
    }
}

}  // namespace abut::corpus
