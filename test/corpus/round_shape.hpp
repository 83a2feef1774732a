#pragma once

// Shapes that are no polytopes with a radius, for the oracle: by the formula of their support value, and by the
// distance of a point outside.

#include "../oracle/random.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/placed.hpp>

#include <memory>
#include <vector>

namespace abut::corpus {

using detail::dot;
using detail::DVec;
using detail::length;
using detail::length_squared;
using detail::normalized;
using detail::to_float;

using oracle::Random;

/// The core mapped by `place`, with a radius. The core is a capsule (a ball if a == b) that `place` stretches, a box
/// around the origin, or a cylinder or cone.
template <int D>
struct RoundShape {
    enum class Core { capsule, box, discs };

    std::shared_ptr<const void> keeper;
    View<D> view;
    Core core = Core::capsule;
    detail::Affine<D> place;
    DVec<D> a{0.0}, b{0.0};             ///< capsule, discs: the ends; box: a = half extents
    double radius_a = 0, radius_b = 0;  ///< of the ends
    double radius = 0;

    /// The maximum of dot(n, p - origin) over the shape, for n of length 1.
    double extent(const DVec<D>& n, const DVec<D>& origin) const {
        const DVec<D> local = place.transposed(n);
        double along = dot(place.offset - origin, n) + radius;
        if (core == Core::box) {
            for (int i = 0; i < D; ++i) along += std::abs(local[i]) * a[i];
            return along;
        }
        const double round = length(core == Core::discs ? off_axis(local) : local);
        return along + std::max(dot(a, local) + radius_a * round, dot(b, local) + radius_b * round);
    }

    /// The distance of a point outside; zero inside.
    double beyond(const DVec<D>& point) const {
        // In the frame of the core, `place` is a stretch along the core's axes and a rotation, or a translation.
        const DVec<D> scale = stretch();
        const DVec<D> local = unturned(point - place.offset, scale);
        if (core == Core::capsule) return std::max(beyond_capsule(local, scale) - radius, 0.0);
        DVec<D> inside;
        if (core == Core::box)
            for (int i = 0; i < D; ++i) inside[i] = std::clamp(local[i], -a[i], a[i]);
        else
            inside = nearest_on_discs(local);
        return std::max(length(local - inside) - radius, 0.0);
    }

    double size() const {
        if (core == Core::box) return length(place.vector(a)) + radius;
        double most = 0;
        for (int i = 0; i < D; ++i) most = std::max(most, length(place.column[static_cast<std::size_t>(i)]));
        if (core == Core::capsule) return 0.5 * length(place.vector(b - a)) + most * radius_a + radius;
        return 0.5 * length(b - a) + std::max(radius_a, radius_b) + radius;
    }

    DVec<D> axis_of_discs() const { return normalized(b - a, detail::axis<D>(D - 1)); }

private:
    DVec<D> off_axis(const DVec<D>& v) const {
        const DVec<D> u = axis_of_discs();
        return v - u * dot(u, v);
    }
    DVec<D> stretch() const {
        DVec<D> result;
        for (int i = 0; i < D; ++i) result[i] = length(place.column[static_cast<std::size_t>(i)]);
        return result;
    }
    /// Moves the shape without a change of its stretch.
    DVec<D> unturned(const DVec<D>& v, const DVec<D>& scale) const {
        DVec<D> result;
        for (int i = 0; i < D; ++i) result[i] = dot(place.column[static_cast<std::size_t>(i)], v) / scale[i];
        return result;
    }
    /// The distance from a point to the ellipsoid with half-axes `half`: the root of a decreasing function (Eberly,
    /// "Distance from a point to an ellipse, an ellipsoid, or a hyperellipsoid", 2011).
    static double beyond_ellipsoid(const DVec<D>& point, const DVec<D>& half) {
        const auto nearest = [&](double t) {
            DVec<D> q;
            for (int i = 0; i < D; ++i) q[i] = half[i] * half[i] * point[i] / (t + half[i] * half[i]);
            return q;
        };
        if (detail::largest(half) == 0) return length(point);
        if (length(point / half) <= 1) return 0;
        double low = 0, high = length(point * half);
        for (int i = 0; i < 120; ++i) {
            const double middle = 0.5 * (low + high);
            if (middle <= low || middle >= high) break;
            (length(nearest(middle) / half) > 1 ? low : high) = middle;
        }
        return length(point - nearest(high));
    }
    /// The minimum over the balls from a to b; the distance is unimodal along the segment.
    double beyond_capsule(const DVec<D>& local, const DVec<D>& scale) const {
        const DVec<D> half = scale * radius_a, from = a * scale, along = (b - a) * scale;
        const auto beyond = [&](double t) { return beyond_ellipsoid(local - from - along * t, half); };
        if (length_squared(along) == 0) return beyond(0);
        double low = 0, high = 1;
        for (int i = 0; i < 60; ++i) {
            const double third = (high - low) / 3, first = beyond(low + third), second = beyond(high - third);
            if (first == 0 || second == 0) return 0;
            (first < second ? high : low) = first < second ? high - third : low + third;
        }
        return beyond(0.5 * (low + high));
    }
    /// The closest point of the trapezoid between the two discs, in the half-plane through the axis.
    DVec<D> nearest_on_discs(const DVec<D>& local) const {
        const DVec<D> u = axis_of_discs();
        const double height = length(b - a), along = dot(local - a, u);
        const DVec<D> off = (local - a) - u * along;
        const double away = length(off);
        const DVec<2> p(along, away), corner_a(0, radius_a), corner_b(height, radius_b);
        DVec<2> best(std::clamp(along, 0.0, height), 0);
        const double share = height > 0 ? best.x / height : 0;
        const double wide = radius_a + (radius_b - radius_a) * share;
        if (along >= 0 && along <= height && away <= wide) return local;
        const auto offer = [&](const DVec<2>& from, const DVec<2>& to) {
            const DVec<2> edge = to - from;
            const double whole = dot(edge, edge);
            const DVec<2> q = whole > 0 ? from + edge * std::clamp(dot(p - from, edge) / whole, 0.0, 1.0) : from;
            if (length(q - p) < length(best - p)) best = q;
        };
        offer({0, 0}, corner_a);
        offer({height, 0}, corner_b);
        offer(corner_a, corner_b);
        return a + u * best.x + (away > 0 ? off * (best.y / away) : DVec<D>(0.0));
    }
};

template <int D, class S>
RoundShape<D> with_view(RoundShape<D> round, S shape) {
    auto keeper = std::make_shared<const S>(std::move(shape));
    round.keeper = keeper;
    round.view = view(*keeper);
    return round;
}

/// A stretch along the axes, then a rotation.
template <int D>
detail::Affine<D> turned_stretch(const Pose<D>& pose, const Vec<D>& scale) {
    return detail::affine(pose) * detail::scaling(scale);
}

/// A shape around `center`. Kinds 0 and 1 are stretched, 2 to 4 have rims (only in 3D), 5 and 6 are their partners.
inline constexpr int round_kind_count = 7;
template <int D>
RoundShape<D> round_shape(Random random, int kind, const DVec<D>& center, double size, double thinnest) {
    using Shape = RoundShape<D>;
    const auto around = [&](double spread) { return to_float(center + random.in_cube<D>() * (spread * size)); };
    const Pose<D> pose{to_float(center), random.chance(0.3) ? no_rotation<D> : random.rotation<D>()};
    Vec<D> scale;
    const auto some = [&](double low) {
        const double wide = size * random.uniform(low, 1);
        return static_cast<float>(random.chance(0.5) ? wide : wide * thinnest);
    };
    for (int i = 0; i < D; ++i) scale[i] = some(0.3);
    const Vec<D> a = around(0.8), b = random.chance(0.1) ? a : around(0.8);
    const float radius = some(0.1);
    Shape result;
    switch (D == 2 && kind >= 2 && kind <= 4 ? kind % 2 : kind) {
        case 0:
            result.place = turned_stretch(pose, scale);
            result.radius_a = result.radius_b = 1;
            return with_view(result, at(stretched(Ball<D>{Vec<D>(0.0f), 1}, scale), pose));
        case 1: {
            const Vec<D> u = to_float(random.in_cube<D>()), v = to_float(random.in_cube<D>());
            result.place = turned_stretch(pose, scale);
            result.a = DVec<D>(u);
            result.b = DVec<D>(v);
            result.radius_a = result.radius_b = 1;
            return with_view(result, at(stretched(Capsule<D>{u, v, 1}, scale), pose));
        }
        case 5:
            result.place.offset = DVec<D>(a);
            result.radius = static_cast<double>(radius);
            return with_view(result, Ball<D>{a, radius});
        case 6:
            result.core = Shape::Core::box;
            result.place = detail::affine(pose);
            result.a = DVec<D>(scale);
            return with_view(result, Box<D>{pose.position, scale, pose.rotation});
        default:
            break;
    }
    if constexpr (D == 3) {
        result.core = Shape::Core::discs;
        result.place.offset = DVec<3>(a);
        result.b = DVec<3>(b) - DVec<3>(a);
        result.radius_a = static_cast<double>(radius);
        result.radius_b = kind == 3 ? 0 : result.radius_a;
        if (kind == 2) return with_view(result, Cylinder{a, b, radius});
        if (kind == 3) return with_view(result, Cone{a, b, radius});
        result.radius = result.radius_a;
        return with_view(result, rounded(Cylinder{a, b, radius}, radius));
    }
    return result;
}

}  // namespace abut::corpus
