#pragma once

// How far a box is from a ray or from another box, with the reach of the search. For .cpp files: all in double.

#include <abut/broad_phase/boxes.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/ray.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

/// Covers what a float loses when a distance, or the length of a unit direction, is rounded to it.
inline constexpr double reach_slack = 1 + 1e-6;

/// The part of a ray that is still of interest. Its measure of a box is the distance along the ray where it comes in.
template <int D>
class RayReach {
public:
    explicit RayReach(const Ray<D>& ray) : origin_(ray.origin), direction_(ray.direction), inverse_(1.0 / direction_) {
        const bool usable_ray = is_finite(ray.origin) && is_finite(ray.direction);
        if (usable_ray && ray.length >= 0) reach_ = static_cast<double>(ray.length) * reach_slack;
    }

    bool over() const { return reach_ < 0; }
    bool within(double measure) const { return measure <= reach_; }
    void shrink(float reach) { reach_ = std::min(reach_, static_cast<double>(reach) * reach_slack); }

    /// True where the ray touches the box, with its measure. Never true of an empty box.
    template <class Box>
    bool measure(const Box& box, double& enters) const {
        double from = 0, to = reach_;
        for (int i = 0; i < D; ++i) {
            const double min = static_cast<double>(box.min[i]), max = static_cast<double>(box.max[i]);
            if (direction_[i] == 0) {
                if (!(min <= origin_[i] && origin_[i] <= max)) return false;
                continue;
            }
            const double at_min = (min - origin_[i]) * inverse_[i], at_max = (max - origin_[i]) * inverse_[i];
            from = std::max(from, direction_[i] > 0 ? at_min : at_max);
            to = std::min(to, direction_[i] > 0 ? at_max : at_min);
        }
        enters = from;
        // Each bound carries three roundings, of 1e-16 each; signs are exact.
        return from <= to * (1 + 1e-12);
    }

private:
    DVec<D> origin_, direction_, inverse_;
    double reach_ = -1;
};

/// What is no farther than a reach from a box, or a point. Its measure of another box is the distance squared.
template <int D>
class BoxReach {
public:
    BoxReach(const Aabb<D>& box, float reach) : box_(usable(box)) {
        constexpr float far = std::numeric_limits<float>::infinity();
        bool somewhere = reach >= 0;
        for (int i = 0; i < D; ++i) somewhere = somewhere && box_.min[i] < far && box_.max[i] > -far;
        if (somewhere) reach_squared_ = squared(reach);
    }

    bool over() const { return reach_squared_ < 0; }
    bool within(double measure) const { return measure <= reach_squared_; }
    void shrink(float reach) { reach_squared_ = std::min(reach_squared_, squared(reach)); }

    /// True where the box is within reach, with its measure. Perhaps true of an empty box.
    template <class Box>
    bool measure(const Box& box, double& result) const {
        result = 0;
        for (int i = 0; i < D; ++i) {
            // Compared before they are subtracted: both may be infinite.
            double gap = 0;
            if (box.min[i] > box_.max[i])
                gap = static_cast<double>(box.min[i]) - static_cast<double>(box_.max[i]);
            else if (box_.min[i] > box.max[i])
                gap = static_cast<double>(box_.min[i]) - static_cast<double>(box.max[i]);
            result += gap * gap;
        }
        return result <= reach_squared_;
    }

private:
    static double squared(float reach) {
        const double more = static_cast<double>(reach) * reach_slack;
        return reach < 0 ? -1 : more * more;
    }

    Aabb<D> box_;
    double reach_squared_ = -1;
};

}  // namespace abut
