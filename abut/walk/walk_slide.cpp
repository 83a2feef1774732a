#include <abut/walk/walk_slide.hpp>

#include <algorithm>
#include <cmath>

namespace abut {
namespace {

/// Cosines that are nothing but rounding.
constexpr double head_on = 1e-9;

}  // namespace

void WalkSlide::run(WalkStop stop) {
    while (stop == WalkStop::barrier) {
        if (!slide()) return;
        stop = go_straight(triangles_, options_, way_);
    }
    if (stop == WalkStop::within) {
        end_within();
        return;
    }
    const double share = way_.here.crossing();
    begin_at_side(share);
    end_at(WalkMet::limit, share);
}

/// Along the barrier ahead, and on along others, until the way ahead is free again. False at the end.
bool WalkSlide::slide() {
    UnfoldedTriangle& here = way_.here;
    double share = here.crossing();
    if (barrier_.triangle == no_walk_side) barrier_ = {here.triangle, here.side};
    begin_at_side(share);
    while (way_.room > 0) {
        --way_.room;
        lanes::Both along = here.left - here.right;
        const double size = std::sqrt(lanes::dot(along, along)[0]);
        if (std::abs(along[0]) <= head_on * size) {
            end_at(WalkMet::corner, share);
            return false;
        }
        if (along[0] < 0) {
            here.reflect();
            reflected_ = !reflected_;
            share = 1 - share;
            along = here.left - here.right;
        }
        const double cosine = along[0] / size;
        const double to_corner = (1 - share) * size;
        if (way_.left * cosine <= to_corner) {
            way_.walked += way_.left * cosine;
            end_at(WalkMet::border, share + way_.left * cosine / size);
            return false;
        }
        met_ = WalkMet::border;
        way_.walked += to_corner;
        way_.left = std::max(way_.left - to_corner / cosine, 0.0);
        here.move_origin(here.left);
        here.go_round_left();
        share = 0;
        switch (go_round_corner()) {
            case Round::free:
                if (here.is_beyond(way_.left)) return true;
                end_within();
                return false;
            case Round::barrier:
                break;
            case Round::limit:
                end_at(WalkMet::limit, 0);
                return false;
        }
        if (here.left[0] <= 0) {
            end_at(WalkMet::corner, 0);
            return false;
        }
    }
    end_at(WalkMet::limit, share);
    return false;
}

/// From the corner at the right end of the side, over triangles that meet there, to that in which the way goes on, or
/// to the next barrier.
WalkSlide::Round WalkSlide::go_round_corner() {
    UnfoldedTriangle& here = way_.here;
    for (;;) {
        const WalkLink link = way_over(triangles_, options_, here);
        if (link.is_border()) return Round::barrier;
        if (way_.room == 0) return Round::limit;
        const lanes::Both corner = here.apex(triangles_[here.triangle]);
        const bool is_ahead = here.left[1] >= 0 && corner[1] < 0;
        here.enter(link, corner, !is_ahead);
        --way_.room;
        ++way_.crossings;
        if (is_ahead) return Round::free;
    }
}

void WalkSlide::begin_at_side(double share) {
    const lanes::Both point = way_.here.at(share);
    const double x = std::clamp(point[0], 0.0, way_.left);
    way_.here.move_origin(point);
    way_.walked += x;
    way_.left -= x;
}

void WalkSlide::end_within() {
    way_.walked += way_.left;
    weights_ = in_grains(way_.here.weights(way_.left));
}

void WalkSlide::end_at(WalkMet met, double share) {
    met_ = met;
    weights_ = way_.here.weights_at(share);
}

}  // namespace abut
