#pragma once

// Shapes of the corpus: from given points, and in difficult styles.

#include "../oracle/sample.hpp"

namespace abut::corpus {

using detail::DVec;
using detail::to_float;

using oracle::Kind;
using oracle::Polytope;
using oracle::Random;
using oracle::Sample;

/// A random kind of shape whose core is the hull of the points: one with this number of points, a hull, or a
/// user-defined shape. It has a pose, or, if `baked`, points transformed by the pose and rounded to floats.
template <int D>
Sample<D> shape_of(Random& random, std::vector<Vec<D>> points, float radius, Pose<D> pose, bool baked) {
    if (baked) {
        const detail::Affine<D> place = detail::affine(pose);
        for (Vec<D>& point : points) point = to_float(place.point(DVec<D>(point)));
        pose = {};
    }
    const Polytope<D> solid = mapped(oracle::hull_of<D>(points, static_cast<double>(radius)), detail::affine(pose));
    const auto done = [&](Kind kind, auto shape) { return oracle::sample<D>(kind, at(std::move(shape), pose), solid); };
    const std::uint32_t form = random.below(3);
    if (form == 0 && points.size() == 1) return done(Kind::ball, Ball<D>{points[0], radius});
    if (form == 0 && points.size() == 2 && radius == 0) return done(Kind::segment, Segment<D>{points[0], points[1]});
    if (form == 0 && points.size() == 2) return done(Kind::capsule, Capsule<D>{points[0], points[1], radius});
    if (form == 0 && points.size() == 3 && radius == 0)
        return done(Kind::triangle, Triangle<D>{points[0], points[1], points[2]});
    if (form == 0 && points.size() == 3)
        return done(Kind::rounded_triangle, rounded(Triangle<D>{points[0], points[1], points[2]}, radius));
    if (form == 1) {
        oracle::PointCloud<D> cloud{points};
        return radius == 0 ? done(Kind::cloud, cloud) : done(Kind::cloud, rounded(std::move(cloud), radius));
    }
    oracle::BuiltHull<D> hull = *oracle::BuiltHull<D>::build(points);
    return radius == 0 ? done(Kind::polytope, hull) : done(Kind::polytope, rounded(std::move(hull), radius));
}

/// A random box: rotated by itself or by the pose, axis-aligned, or rounded.
template <int D>
Sample<D> box_shape(Random& random, const Vec<D>& center, const Vec<D>& half, float radius, const Pose<D>& pose) {
    const detail::Affine<D> place = detail::affine(pose);
    const auto done = [&](Kind kind, auto shape, const Polytope<D>& solid) {
        return oracle::sample<D>(kind, at(std::move(shape), pose), mapped(solid, place));
    };
    if (random.chance(0.5)) {
        const Aabb<D> box{center - half, center + half};
        const auto solid = oracle::box_between(box.min, box.max, {}, static_cast<double>(radius));
        if (radius == 0) return done(Kind::aabb, box, solid);
        return done(Kind::rounded_box, rounded(Aabb<D>(box), radius), solid);
    }
    const Box<D> box{center, half, no_rotation<D>};
    const auto solid =
        oracle::box_of(detail::affine(Pose<D>{center, no_rotation<D>}), half, static_cast<double>(radius));
    if (radius == 0) return done(Kind::box, box, solid);
    return done(Kind::rounded_box, rounded(Box<D>(box), radius), solid);
}

enum class Style { plain, needle, flake, zero_size, duplicate_points };

/// Makes shapes of a style around a center. Equal numbers give equal shapes at another center.
template <int D>
class StyledMaker {
public:
    StyledMaker(Random random, double size, Style style) : random_(random), size_(size), style_(style) {}

    Sample<D> make(const DVec<D>& center) {
        if (style_ == Style::plain)
            return oracle::SampleGenerator<D>(random_, center, size_)
                .make(static_cast<Kind>(random_.below(oracle::kind_count)));
        const Pose<D> pose{to_float(center), random_.chance(0.2) ? no_rotation<D> : random_.template rotation<D>()};
        const DVec<D> spread = scale() * size_;
        const bool baked = random_.chance(0.3);
        const float round = radius(0.3);
        if (style_ == Style::duplicate_points) return shape_of<D>(random_, crowded(), round, pose, baked);
        if (random_.chance(0.5)) {
            Vec<D> half;
            for (int i = 0; i < D; ++i) half[i] = random_.uniform_float(0.3, 1) * static_cast<float>(spread[i]);
            const Vec<D> middle = to_float(random_.in_cube<D>() * spread);
            return box_shape<D>(random_, middle, half, round, pose);
        }
        std::vector<Vec<D>> points;
        for (std::uint32_t i = 1 + random_.below(9); i > 0; --i)
            points.push_back(to_float(random_.in_cube<D>() * spread));
        return shape_of<D>(random_, std::move(points), round, pose, baked);
    }

private:
    /// The extents along the axes, relative to the size.
    DVec<D> scale() {
        DVec<D> result(1.0);
        const double thin = random_.power_of_two(-20, -10);
        const int special = static_cast<int>(random_.below(D));
        thin_ = style_ == Style::zero_size ? 0 : thin;
        for (int i = 0; i < D; ++i) {
            if (style_ == Style::needle && i != special) result[i] = thin;
            if (style_ == Style::flake && i == special) result[i] = thin;
            if (style_ == Style::zero_size && random_.chance(0.5)) result[i] = 0;
        }
        return result;
    }
    /// The radius: often 0, else as thin as the shape, or thicker.
    float radius(double chance) {
        if (!random_.chance(chance)) return 0;
        const double part = random_.uniform(0.05, 0.5);
        return static_cast<float>(size_ * (random_.chance(0.5) ? part : thin_));
    }
    /// Points of a lattice or of circles, with duplicates and with points between others.
    std::vector<Vec<D>> crowded() {
        const float unit = static_cast<float>(std::ldexp(1.0, std::ilogb(size_) - 2));
        const bool circles = random_.chance(0.3);
        std::vector<Vec<D>> points;
        for (std::uint32_t i = 1 + random_.below(circles ? 10 : 6); i > 0; --i)
            points.push_back((circles ? on_circle() : on_lattice()) * unit);
        const std::uint32_t distinct = static_cast<std::uint32_t>(points.size());
        for (std::uint32_t i = random_.below(6); i > 0; --i) {
            const Vec<D> a = points[random_.below(distinct)];
            const Vec<D> b = points[random_.below(distinct)];
            const float share = 0.25f * static_cast<float>(random_.below(4));
            points.push_back(a + (b - a) * share);
        }
        return points;
    }
    Vec<D> on_lattice() {
        Vec<D> result;
        for (int i = 0; i < D; ++i) result[i] = static_cast<float>(random_.below(9)) - 4;
        return result;
    }
    /// Integer points on a circle of radius 5; in 3D on one of two rings.
    Vec<D> on_circle() {
        constexpr std::array<std::array<float, 2>, 3> first{{{5, 0}, {4, 3}, {3, 4}}};
        const auto& [x, y] = first[random_.below(3)];
        const std::uint32_t quarter = random_.below(4);
        Vec<D> result(0.0f);
        result[0] = quarter == 0 ? x : quarter == 1 ? -y : quarter == 2 ? -x : y;
        result[1] = quarter == 0 ? y : quarter == 1 ? x : quarter == 2 ? -y : -x;
        if constexpr (D == 3) result[2] = random_.chance(0.5) ? 2.0f : -2.0f;
        return result;
    }

    Random random_;
    double size_;
    Style style_;
    double thin_ = 0;
};

}  // namespace abut::corpus
