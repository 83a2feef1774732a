#include <abut/math/simd/square_root.hpp>
#include <abut/walk/slide.hpp>

#include <algorithm>
#include <cmath>

namespace abut::detail {
namespace {

/// Smaller cosines are rounding.
constexpr double head_on = 1e-9;

}  // namespace

void WalkSlide::run(WalkStop stop) {
    while (stop == WalkStop::barrier) {
        if (!slide()) return;
        stop = trace_geodesic(triangles_, options_, geodesic_);
    }
    if (stop == WalkStop::within) {
        end_within();
        return;
    }
    const double fraction = geodesic_.here.crossing();
    begin_at_side(fraction);
    end_at(WalkMet::limit, fraction);
}

/// Slides along the barrier, and along further ones, until the path ahead is free. Returns false at the end of the
/// step.
bool WalkSlide::slide() {
    UnfoldedTriangle& here = geodesic_.here;
    double fraction = here.crossing();
    if (barrier_.triangle == no_walk_side) barrier_ = {here.triangle, here.side};
    begin_at_side(fraction);
    while (geodesic_.crossings_left > 0) {
        --geodesic_.crossings_left;
        lanes::Double2 along = here.left - here.right;
        const double size = square_root(lanes::dot(along, along)[0]);
        if (std::abs(along[0]) <= head_on * size) {
            end_at(WalkMet::corner, fraction);
            return false;
        }
        if (along[0] < 0) {
            here.reflect();
            reflected_ = !reflected_;
            fraction = 1 - fraction;
            along = here.left - here.right;
        }
        const double cosine = along[0] / size;
        const double to_corner = (1 - fraction) * size;
        if (geodesic_.remaining * cosine <= to_corner) {
            geodesic_.walked += geodesic_.remaining * cosine;
            end_at(WalkMet::border, fraction + geodesic_.remaining * cosine / size);
            return false;
        }
        met_ = WalkMet::border;
        geodesic_.walked += to_corner;
        geodesic_.remaining = std::max(geodesic_.remaining - to_corner / cosine, 0.0);
        here.move_origin(here.left);
        here.rotate_left();
        fraction = 0;
        switch (walk_around_corner()) {
            case CornerResult::free:
                if (here.is_beyond(geodesic_.remaining)) return true;
                end_within();
                return false;
            case CornerResult::barrier:
                break;
            case CornerResult::limit:
                end_at(WalkMet::limit, 0);
                return false;
        }
        if (here.left[0] <= 0) {
            end_at(WalkMet::corner, 0);
            return false;
        }
    }
    end_at(WalkMet::limit, fraction);
    return false;
}

/// Walks around the corner at the right end of the side, through adjacent triangles, to the one in which the path
/// continues, or to the next barrier.
WalkSlide::CornerResult WalkSlide::walk_around_corner() {
    UnfoldedTriangle& here = geodesic_.here;
    for (;;) {
        const WalkLink link = link_across(triangles_, options_, here);
        if (link.is_border()) return CornerResult::barrier;
        if (geodesic_.crossings_left == 0) return CornerResult::limit;
        const lanes::Double2 corner = here.apex(triangles_[here.triangle]);
        const bool is_ahead = here.left[1] >= 0 && corner[1] < 0;
        here.enter(link, corner, !is_ahead);
        --geodesic_.crossings_left;
        ++geodesic_.crossings;
        if (is_ahead) return CornerResult::free;
    }
}

void WalkSlide::begin_at_side(double fraction) {
    const lanes::Double2 point = geodesic_.here.at(fraction);
    const double x = std::clamp(point[0], 0.0, geodesic_.remaining);
    geodesic_.here.move_origin(point);
    geodesic_.walked += x;
    geodesic_.remaining -= x;
}

void WalkSlide::end_within() {
    geodesic_.walked += geodesic_.remaining;
    weights_ = quantised_weights(geodesic_.here.weights(geodesic_.remaining));
}

void WalkSlide::end_at(WalkMet met, double fraction) {
    met_ = met;
    weights_ = geodesic_.here.weights_at(fraction);
}

}  // namespace abut::detail
