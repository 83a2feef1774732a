#pragma once

// The Minkowski difference A - B of two cores, given by its support function.

#include <abut/convex/support.hpp>

namespace abut::detail {

/// A point of A - B with the points of A and B that it is the difference of. It has no initialisers, because the
/// searches hold arrays of them.
template <int D>
struct DifferencePoint {
    DVec<D> position;  ///< on_a - on_b
    DVec<D> on_a;
    DVec<D> on_b;
    std::uint32_t index_a;
    std::uint32_t index_b;
};

/// Both cores relative to a point of A, so that no precision is lost far from the origin of the world. Positions in
/// results are relative to `origin` too.
template <int D>
class CoreDifference {
public:
    CoreDifference(const Convex<D>& a, const Convex<D>& b) : origin_(reference_point(a)), a_(a), b_(b) {
        a_.place.offset -= origin_;
        b_.place.offset -= origin_;
    }

    /// The support point of A - B along a direction of any nonzero length.
    DifferencePoint<D> support(const DVec<D>& direction) const {
        const CorePoint<D> on_a = core_support(a_, direction);
        const CorePoint<D> on_b = core_support(b_, -direction);
        return {on_a.position - on_b.position, on_a.position, on_b.position, on_a.index, on_b.index};
    }

    const DVec<D>& origin() const { return origin_; }
    const Convex<D>& a() const { return a_; }
    const Convex<D>& b() const { return b_; }

private:
    DVec<D> origin_;
    Convex<D> a_, b_;
};

}  // namespace abut::detail
