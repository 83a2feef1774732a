#pragma once

// Pairs of convex shapes at given distances: once, or over a sequence of frames.

#include "convex_shapes.hpp"
#include <abut/query/closest.hpp>

#include <utility>

namespace abut::scenes {

template <int D>
struct Placed {
    std::size_t shape;
    Pose<D> pose;
};
template <int D>
struct PlacedPair {
    Placed<D> a, b;
};

/// Shapes, and pairs of them by index. Over several frames a pair keeps its position in the list.
template <int D>
struct ConvexPairs {
    std::size_t count() const { return pairs.size() / frames; }

    std::vector<AnyConvex<D>> shapes;
    std::vector<PlacedPair<D>> pairs;
    std::size_t frames = 1;
};

/// The signed distances of pairs.
struct Gaps {
    double low, high;
    double min_distance = 0.01;  ///< minimum absolute distance: overlap is unambiguous

    bool allow(double gap) const { return low <= gap && gap <= high && !(-min_distance < gap && gap < min_distance); }
};

/// Draws one shape of `a` and one of `b` with random rotations. B starts far off in a random direction and moves along
/// the line of closest approach until the distance is uniform in the given range; negative distances are depths along
/// that line.
template <int D, class A, class B>
class PairMaker {
public:
    PairMaker(std::vector<A> a, std::vector<B> b, oracle::Random& random)
        : a_(std::move(a)), b_(std::move(b)), random_(random) {}

    PlacedPair<D> make(const Gaps& gaps) {
        double gap = gaps.high;
        do gap = random_.uniform(gaps.low, gaps.high);
        while (!gaps.allow(gap));
        const Placed<D> a{any(a_), {detail::to_float<D>(random_.in_cube<D>() * 10.0), random_.rotation<D>()}};
        Placed<D> b{a_.size() + any(b_),
                    {a.pose.position + detail::to_float<D>(random_.direction<D>() * 5.0), random_.rotation<D>()}};
        const Closest<D> before = closest({a, b});
        b.pose.position += (static_cast<float>(gap) - before.distance) * before.normal;
        return {a, b};
    }

    Closest<D> closest(const PlacedPair<D>& pair) const {
        return abut::closest(placed(a_[pair.a.shape], pair.a.pose), placed(b_[pair.b.shape - a_.size()], pair.b.pose));
    }

    std::vector<AnyConvex<D>> shapes() const {
        std::vector<AnyConvex<D>> result(a_.begin(), a_.end());
        result.insert(result.end(), b_.begin(), b_.end());
        return result;
    }

private:
    template <class S>
    std::size_t any(const std::vector<S>& shapes) {
        return random_.below(static_cast<std::uint32_t>(shapes.size()));
    }

    std::vector<A> a_;
    std::vector<B> b_;
    oracle::Random& random_;
};

template <int D, class A, class B>
ConvexPairs<D> resting_pairs(PairMaker<D, A, B>& maker, std::size_t count, const Gaps& gaps) {
    ConvexPairs<D> result{.shapes = maker.shapes(), .pairs = {}};
    while (result.pairs.size() < count) result.pairs.push_back(maker.make(gaps));
    return result;
}

}  // namespace abut::scenes
