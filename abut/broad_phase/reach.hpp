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

/// The part of a ray, or of the way of a moving box, that is still of interest. Its measure of a box is the distance
/// along the way where it comes in.
template <int D>
class RayReach {
public:
    explicit RayReach(const Ray<D>& ray)
        : RayReach(DVec<D>(ray.origin), DVec<D>(ray.origin), DVec<D>(ray.direction), static_cast<double>(ray.length)) {}

    static RayReach of_box(const MovingBox<D>& box) {
        return {box.center - box.half, box.center + box.half, box.direction, box.length};
    }

    double reach() const { return reach_; }
    bool over() const { return reach_ < 0; }
    bool within(double measure) const { return measure <= reach_; }
    void shrink(float reach) { reach_ = std::min(reach_, static_cast<double>(reach) * reach_slack); }
    double most() const { return reach_; }  ///< the largest measure within reach

    /// The box it begins with, for a ray a point, and the way it goes.
    const DVec<D>& low() const { return low_; }
    const DVec<D>& high() const { return high_; }
    const DVec<D>& direction() const { return direction_; }
    const DVec<D>& inverse() const { return inverse_; }

    /// True where the ray touches the box, with its measure. Never true of an empty box.
    template <class Box>
    bool measure(const Box& box, double& enters) const {
        double from = 0, to = reach_;
        for (int i = 0; i < D; ++i) {
            const double min = static_cast<double>(box.min[i]), max = static_cast<double>(box.max[i]);
            if (direction_[i] == 0) {
                if (!(min <= high_[i] && low_[i] <= max)) return false;
                continue;
            }
            const double at_min = (min - high_[i]) * inverse_[i], at_max = (max - low_[i]) * inverse_[i];
            from = std::max(from, direction_[i] > 0 ? at_min : at_max);
            to = std::min(to, direction_[i] > 0 ? at_max : at_min);
        }
        enters = from;
        // Each bound carries three roundings, of 1e-16 each; signs are exact.
        return from <= to * (1 + 1e-12);
    }

private:
    RayReach(const DVec<D>& low, const DVec<D>& high, const DVec<D>& direction, double length_of_way)
        : low_(low), high_(high), direction_(direction), inverse_(1.0 / direction_) {
        // Of doubles that were floats once no square is infinite.
        const bool usable_way =
            std::isfinite(length_squared(low_) + length_squared(high_) + length_squared(direction_));
        if (usable_way && length_of_way >= 0) reach_ = length_of_way * reach_slack;
    }

    DVec<D> low_, high_, direction_, inverse_;  ///< the box it begins with, for a ray a point
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
    double most() const { return reach_squared_; }  ///< the largest measure within reach
    const Aabb<D>& box() const { return box_; }

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
