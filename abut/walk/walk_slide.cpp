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
    const double share = way_.strip.crossing();
    begin_at_side(share);
    end_at(WalkMet::limit, share);
}

/// Along the barrier ahead, and on along others, until the way ahead is free again. False at the end.
bool WalkSlide::slide() {
    WalkStrip& strip = way_.strip;
    double share = strip.crossing();
    if (barrier_.triangle == no_walk_side) barrier_ = {strip.triangle, strip.side};
    begin_at_side(share);
    while (way_.room > 0) {
        --way_.room;
        lanes::Both along = strip.left - strip.right;
        const double size = std::sqrt(lanes::dot(along, along)[0]);
        if (std::abs(along[0]) <= head_on * size) {
            end_at(WalkMet::corner, share);
            return false;
        }
        if (along[0] < 0) {
            strip.reflect();
            reflected_ = !reflected_;
            share = 1 - share;
            along = strip.left - strip.right;
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
        strip.move_origin(strip.left);
        strip.go_round_left();
        share = 0;
        switch (go_round_corner()) {
            case Round::free:
                if (strip.is_beyond(way_.left) || strip.is_beyond_along(way_.left)) return true;
                end_within();
                return false;
            case Round::barrier:
                break;
            case Round::limit:
                end_at(WalkMet::limit, 0);
                return false;
        }
        if (strip.left[0] <= 0) {
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
    WalkStrip& strip = way_.strip;
    for (;;) {
        const WalkLink link = way_over(triangles_, options_, strip);
        if (link.is_border()) return Round::barrier;
        if (way_.room == 0) return Round::limit;
        const lanes::Both corner = strip.apex(triangles_[strip.triangle]);
        const bool is_ahead = strip.left[1] >= 0 && corner[1] < 0;
        strip.enter(link, corner, !is_ahead);
        --way_.room;
        ++way_.crossings;
        if (is_ahead) return Round::free;
    }
}

void WalkSlide::begin_at_side(double share) {
    const lanes::Both point = way_.strip.at(share);
    const double x = std::clamp(point[0], 0.0, way_.left);
    way_.strip.move_origin(point);
    way_.walked += x;
    way_.left -= x;
}

void WalkSlide::end_within() {
    way_.walked += way_.left;
    weights_ = in_grains(way_.strip.weights(way_.left));
}

void WalkSlide::end_at(WalkMet met, double share) {
    met_ = met;
    weights_ = way_.strip.weights_at(share);
}

}  // namespace abut
