#include <abut/convex/ray/portal.hpp>

#include <limits>

namespace abut::detail {
namespace {

/// Bounds on the search for a portal, and on its refinement.
constexpr int max_search_steps = 24, max_refinements = 96;

/// A face with a smaller slope along the line is left to a robust search.
constexpr double min_slope = 1e-3;

template <int D>
class Portal {
public:
    Portal(const Convex<D>& a, const Convex<D>& b, const DVec<D>& direction, const PortalTolerances& tolerances)
        : a_(a), b_(b), direction_(direction), tolerances_(tolerances) {}

    PortalHit<D> run() {
        PortalHit<D> hit;
        hit.answer = find();
        if (hit.answer == RayAnswer::enters && !(move_outwards(hit) && penetrates(hit)))
            hit.answer = RayAnswer::undecided;
        return hit;
    }

private:
    DifferencePoint<D> support(const DVec<D>& toward) {
        const CorePoint<D> on_a = core_support(a_, toward), on_b = core_support(b_, -toward);
        scale_ = std::max({scale_, largest(on_a.position), largest(on_b.position)});
        return {on_a.position - on_b.position, on_a.position, on_b.position, on_a.index, on_b.index};
    }

    /// Whether the projection of the difference ends before the line along a unit direction, by more than the depth.
    bool misses_along(const DVec<D>& across, const DifferencePoint<D>& farthest) const {
        return dot(across, farthest.position) < -tolerances_.depth;
    }

    /// Two points in 2D, right and left of the line.
    RayAnswer find() requires(D == 2) {
        const DVec<2> right(direction_.y, -direction_.x);
        for (std::size_t i = 0; i < 2; ++i) {
            const DVec<2> across = i == 0 ? right : -right;
            corners_[i] = support(across);
            if (misses_along(across, corners_[i])) return RayAnswer::misses;
            if (!(dot(across, corners_[i].position) > tolerances_.depth)) return RayAnswer::undecided;
        }
        return RayAnswer::enters;
    }
    DVec<2> outwards() const requires(D == 2) {
        const DVec<2> edge = corners_[1].position - corners_[0].position;
        return {edge.y, -edge.x};
    }
    void take(const DifferencePoint<2>& farther) requires(D == 2) {
        corners_[cross(direction_, farther.position) < 0 ? 0 : 1] = farther;
    }

    /// Three points in 3D around the line, counter-clockwise seen against the motion: GJK in the projection.
    RayAnswer find() requires(D == 3) {
        u_ = perpendicular(direction_);
        v_ = cross(direction_, u_);
        DVec<2> toward = -projected(reference_point(a_) - reference_point(b_));
        std::size_t count = 0;
        for (int step = 0; step < max_search_steps; ++step) {
            toward = normalized(toward);
            const DVec<3> across = u_ * toward.x + v_ * toward.y;
            const DifferencePoint<3> newest = support(across);
            if (misses_along(across, newest)) return RayAnswer::misses;
            if (!(dot(across, newest.position) > tolerances_.depth)) return RayAnswer::undecided;
            const DVec<2> here = projected(newest.position);
            if (count == 0) {
                toward = -here;
            } else if (count == 1) {
                toward = side_of_origin(here, projected(corners_[0].position));
            } else {
                // Of the two edges at the newest point, one has the line beyond it, or the three points are a portal.
                const DVec<2> first = projected(corners_[0].position), second = projected(corners_[1].position);
                const double turn = cross(first - here, second - here) < 0 ? -1 : 1;
                if (turn * cross(first - here, -here) < 0) {
                    corners_[1] = newest;
                    toward = side_of_origin(here, first);
                    continue;
                }
                if (turn * cross(-here, second - here) < 0) {
                    corners_[0] = newest;
                    toward = side_of_origin(here, second);
                    continue;
                }
                corners_[2] = newest;
                if (turn < 0) std::swap(corners_[0], corners_[1]);
                return RayAnswer::enters;
            }
            corners_[count++] = newest;
        }
        return RayAnswer::undecided;
    }
    DVec<2> projected(const DVec<3>& position) const requires(D == 3) { return {dot(u_, position), dot(v_, position)}; }
    /// Orthogonal to the line of two points, towards the origin.
    static DVec<2> side_of_origin(const DVec<2>& a, const DVec<2>& b) {
        const DVec<2> edge = b - a, across(-edge.y, edge.x);
        return dot(across, a) > 0 ? -across : across;
    }
    DVec<3> outwards() const requires(D == 3) {
        const DVec<3>& a = corners_[0].position;
        return cross(corners_[1].position - a, corners_[2].position - a);
    }
    /// The new portal: the triangle of the new point and an edge whose projection contains the line.
    void take(const DifferencePoint<3>& farther) requires(D == 3) {
        const DVec<2> here = projected(farther.position);
        const auto side = [&](std::size_t i) { return cross(here, projected(corners_[i].position)); };
        const double a = side(0), b = side(1), c = side(2);
        if (a >= 0 && b <= 0)
            corners_[2] = farther;
        else if (b >= 0 && c <= 0)
            corners_[0] = farther;
        else
            corners_[1] = farther;
    }

    /// Refines the portal until no support point is in front of it, or by less than the tolerance along the ray.
    bool move_outwards(PortalHit<D>& hit) {
        for (int step = 0; step < max_refinements; ++step) {
            const DVec<D> out = outwards();
            const double long_out = length(out), slope = dot(out, direction_);
            if (!(slope > min_slope * long_out)) return false;
            const DifferencePoint<D> farthest = support(out);
            const double gain = dot(out, farthest.position - corners_[0].position);
            if (gain <= tolerances_.bound_gap * slope) {
                if (tolerances_.bound_gap < 1e-13 * scale_) return false;
                hit.along = -dot(out, farthest.position) / slope;
                hit.normal = out / long_out;
                std::copy_n(corners_.begin(), D, hit.corners.begin());
                set_weights(hit);
                return true;
            }
            take(farthest);
        }
        return false;
    }
    void set_weights(PortalHit<D>& hit) const {
        if constexpr (D == 2) {
            const double right = cross(direction_, corners_[0].position),
                         left = cross(direction_, corners_[1].position);
            hit.weights = {left / (left - right), right / (right - left)};
        } else {
            const DVec<2> a = projected(corners_[0].position), b = projected(corners_[1].position),
                          c = projected(corners_[2].position);
            const double at_a = cross(b, c), at_b = cross(c, a), at_c = cross(a, b), whole = at_a + at_b + at_c;
            hit.weights = {at_a / whole, at_b / whole, at_c / whole};
        }
    }

    /// Whether the line penetrates the difference by `depth` behind the portal, in the simplex of the portal and the
    /// farthest point behind it.
    bool penetrates(const PortalHit<D>& hit) {
        const DifferencePoint<D> last = support(-hit.normal);
        const double thick = dot(hit.normal, corners_[0].position - last.position);
        if (!(thick > 8 * tolerances_.depth)) return false;
        // Not far behind the portal, which may be the widest cross-section.
        const DVec<D> place = direction_ * (-hit.along - 4 * tolerances_.depth / dot(hit.normal, direction_));
        for (std::size_t i = 0; i < D; ++i) {
            const DVec<D>& opposite = corners_[i].position;
            DVec<D> across;
            if constexpr (D == 2) {
                const DVec<2> side = corners_[1 - i].position - last.position;
                across = {-side.y, side.x};
            } else {
                across = cross(corners_[(i + 1) % 3].position - last.position,
                               corners_[(i + 2) % 3].position - last.position);
            }
            const double height = dot(across, place - last.position),
                         sign = dot(across, opposite - last.position) < 0 ? -1 : 1;
            if (!(height * sign > tolerances_.depth * length(across))) return false;
        }
        return true;
    }

    const Convex<D>&a_, &b_;
    const DVec<D>& direction_;
    const PortalTolerances& tolerances_;
    std::array<DifferencePoint<D>, static_cast<std::size_t>(D)> corners_;
    DVec<3> u_{0.0}, v_{0.0};  ///< across the line, in 3D
    double scale_ = 0;         ///< the largest coordinate so far
};

}  // namespace

template <int D>
PortalHit<D> enter_difference(const Convex<D>& a, const Convex<D>& b, const DVec<D>& direction,
                              const PortalTolerances& tolerances) {
    return Portal<D>(a, b, direction, tolerances).run();
}

template PortalHit<2> enter_difference(const Convex<2>&, const Convex<2>&, const DVec<2>&, const PortalTolerances&);
template PortalHit<3> enter_difference(const Convex<3>&, const Convex<3>&, const DVec<3>&, const PortalTolerances&);

}  // namespace abut::detail
