#pragma once

// Pairs that touch exactly: multiples of a power of two on either side of a plane through the origin.

#include "../oracle/pair.hpp"
#include "shapes.hpp"

namespace abut::corpus {

using detail::axis;
using detail::cross;
using detail::dot;
using detail::DVec;
using detail::length;
using detail::length_squared;
using detail::to_float;

using oracle::SamplePair;

/// The feature of a shape that lies in the plane.
enum class Touch { vertex, edge, face };

template <int D>
class TouchingMaker {
public:
    explicit TouchingMaker(Random& random) : random_(random) {
        do {
            u_ = whole(2);
            v_ = whole(2);
            if (random.chance(0.4)) along_axes();
            if constexpr (D == 2)
                normal_ = {-u_.y, u_.x};
            else
                normal_ = cross(u_, v_);
        } while (length_squared(normal_) == 0);
        unit_ = std::ldexp(1.0, static_cast<int>(random.below(22)) - 11);
        if (random.chance(0.3)) pose_.rotation = random.rotation<D>();
        // Multiples of the unit are not rounded without a rotation.
        if (random.chance(0.5)) pose_.position = to_float(whole(100000) * unit_);
    }

    SamplePair<D> make(Touch a, Touch b) {
        const bool baked = random_.chance(0.3);
        const double radius_a = radius(), radius_b = radius();
        const Sample<D> below = side(a, -1, radius_a, baked), above = side(b, 1, radius_b, baked);
        return random_.chance(0.5) ? SamplePair<D>{below, above} : SamplePair<D>{above, below};
    }

private:
    DVec<D> whole(int most) {
        DVec<D> result;
        for (int i = 0; i < D; ++i)
            result[i] = static_cast<double>(random_.below(static_cast<std::uint32_t>(2 * most + 1))) - most;
        return result;
    }
    void along_axes() {
        const int first = static_cast<int>(random_.below(D));
        u_ = axis<D>(first);
        v_ = axis<D>((first + 1) % D);
        axes_ = true;
    }
    double times() { return 1 + static_cast<double>(random_.below(3)); }

    /// An offset along an axis, which is subtracted exactly.
    double radius() { return axes_ && random_.chance(0.3) ? times() : 0; }

    /// Around the origin, so that the features of both sides share a point.
    std::vector<DVec<D>> in_plane(Touch touch) {
        if (touch == Touch::vertex) return {DVec<D>(0.0)};
        if constexpr (D == 3) {
            if (touch == Touch::face) {
                if (random_.chance(0.5)) return {u_ * times(), v_ * times(), (u_ + v_) * -times()};
                return {u_ * times(), u_ * -times(), v_ * times(), v_ * -times()};
            }
            const double part_u = times() - 2, part_v = times() - 2;
            const DVec<3> mix = u_ * part_u + v_ * part_v;
            const DVec<3> along = length_squared(mix) > 0 ? mix : u_;
            return {along * times(), along * -times()};
        } else {
            return {u_ * times(), u_ * -times()};
        }
    }

    Sample<D> side(Touch touch, double sign, double radius, bool baked) {
        const double step = length(normal_);
        const DVec<D> back = radius > 0 ? normal_ * (sign * radius / step) : DVec<D>(0.0);
        if (touch == Touch::face && axes_ && random_.chance(0.4)) return box(sign, radius, back);
        std::vector<Vec<D>> points;
        for (const DVec<D>& p : in_plane(touch)) points.push_back(to_float((p + back) * unit_));
        const std::uint32_t wanted = random_.below(6);
        for (int tries = 0; points.size() < 4 + wanted && tries < 12; ++tries) {
            const DVec<D> p = whole(5);
            if (dot(p, normal_) * sign > 0) points.push_back(to_float((p + back) * unit_));
        }
        return shape_of<D>(random_, std::move(points), static_cast<float>(radius * unit_), pose_, baked);
    }
    Sample<D> box(double sign, double radius, const DVec<D>& back) {
        DVec<D> low = whole(3), high = low;
        for (int i = 0; i < D; ++i) {
            low[i] = -times();
            high[i] = times();
            if (normal_[i] == 0) continue;
            low[i] = sign * normal_[i] > 0 ? 0 : -2 * times();
            high[i] = sign * normal_[i] > 0 ? 2 * times() : 0;
        }
        return box_shape<D>(random_, to_float(((low + high) * 0.5 + back) * unit_),
                            to_float((high - low) * 0.5 * unit_), static_cast<float>(radius * unit_), pose_);
    }

    Random& random_;
    DVec<D> u_, v_, normal_;
    bool axes_ = false;
    double unit_;
    Pose<D> pose_;
};

}  // namespace abut::corpus
