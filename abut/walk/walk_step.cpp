#include <abut/math/assert.hpp>
#include <abut/walk/walk_frame.hpp>
#include <abut/walk/walk_strip-inl.h>
#include <abut/walk/walk_turn.hpp>

#include <algorithm>
#include <cmath>

namespace abut {
namespace {

/// A way over several triangles: straight on in the strip of those that it has unfolded, whatever it has turned in
/// space. Only the last of them is kept.
class StripWalk {
public:
    StripWalk(const WalkMeshData& data, const WalkOptions& options, const WalkStrip& strip, double length)
        : triangles_(data.walk.data()), options_(options), strip_(strip), left_(length), room_(options.max_crossings) {}

    /// The step leads beyond the side of the strip that it begins with.
    void run() {
        while (go_straight() && slide()) {
        }
    }

    WalkPoint place() const { return {strip_.triangle, weights_}; }
    double walked() const { return walked_; }
    WalkMet met() const { return met_; }
    const WalkSide& barrier() const { return barrier_; }
    std::uint32_t crossings() const { return crossings_; }
    bool mirrored() const { return strip_.mirrored != reflected_; }

    /// The step, carried along, in the frame of the last triangle.
    DVec<2> ahead() const {
        const lanes::Both axis = strip_.first_axis() * triangles_[strip_.triangle].inverse_width;
        return {axis[0], strip_.mirrored ? axis[1] : -axis[1]};
    }

private:
    // Coordinates grow along the way, and the triangles don't: now and then they begin anew.
    static constexpr std::uint32_t most_from_one_origin = 64;

    WalkLink way_over(const WalkStrip& strip) const {
        const WalkLink link = triangles_[strip.triangle].link[strip.side];
        if (!options_.allow || link.is_border()) return link;
        const bool allowed =
            (*options_.allow)(WalkSide{strip.triangle, strip.side}, WalkSide{link.triangle(), link.side()});
        return allowed ? link : WalkLink{};
    }

    /// Over the side ahead, and on. True where it comes to a barrier, false at the end.
    bool go_straight() {
        WalkStrip strip = strip_;
        double left = left_;
        std::uint32_t count = 0;
        const std::uint32_t most = room_;
        WalkLink link = way_over(strip);
        bool within = false;
        while (!link.is_border() && count < most) {
            const lanes::Both corner = strip.apex(triangles_[strip.triangle]);
            strip.enter(link, corner, corner[1] >= 0);
            ++count;
            if (!strip.is_beyond(left) && !strip.is_beyond_or_along(left)) {
                within = true;
                break;
            }
            if (count % most_from_one_origin == 0) {
                const double x = std::clamp(strip.at(strip.crossing())[0], 0.0, left);
                strip.move_origin(lanes::Both{x, 0});
                left -= x;
                walked_ += x;
            }
            link = way_over(strip);
        }
        strip_ = strip;
        left_ = left;
        room_ -= count;
        crossings_ += count;
        if (within) return end_within();
        if (link.is_border()) return true;
        const double share = strip_.crossing();
        begin_at_side(share);
        return stop(WalkMet::limit, share);
    }

    /// Along the barrier ahead, and on along others, until the way ahead is free again. False at the end.
    bool slide() {
        double share = strip_.crossing();
        if (barrier_.triangle == no_walk_side) barrier_ = {strip_.triangle, strip_.side};
        begin_at_side(share);
        while (room_ > 0) {
            --room_;
            lanes::Both along = strip_.left - strip_.right;
            if (along[0] == 0) return stop(WalkMet::corner, share);
            if (along[0] < 0) {
                reflect();
                share = 1 - share;
                along = strip_.left - strip_.right;
            }
            const double size = std::sqrt(lanes::dot(along, along)[0]), cosine = along[0] / size,
                         to_corner = (1 - share) * size;
            met_ = WalkMet::border;
            if (left_ * cosine <= to_corner) {
                walked_ += left_ * cosine;
                return end_at(share + left_ * cosine / size);
            }
            walked_ += to_corner;
            left_ = std::max(left_ - to_corner / cosine, 0.0);
            strip_.move_origin(strip_.left);
            strip_.go_round_left();
            share = 0;
            switch (go_round_corner()) {
                case Round::free:
                    return strip_.is_beyond_or_along(left_) || end_within();
                case Round::barrier:
                    break;
                case Round::limit:
                    return stop(WalkMet::limit, 0);
            }
            if (strip_.left[0] <= 0) return stop(WalkMet::corner, 0);
        }
        return stop(WalkMet::limit, share);
    }

    enum class Round { free, barrier, limit };

    /// From the corner at the right end of the side, over triangles that meet there, to that in which the way goes on,
    /// or to the next barrier.
    Round go_round_corner() {
        for (;;) {
            const WalkLink link = way_over(strip_);
            if (link.is_border()) return Round::barrier;
            if (room_ == 0) return Round::limit;
            const lanes::Both corner = strip_.apex(triangles_[strip_.triangle]);
            const bool is_ahead = strip_.left[1] >= 0 && corner[1] < 0;
            strip_.enter(link, corner, !is_ahead);
            --room_;
            ++crossings_;
            if (is_ahead) return Round::free;
        }
    }

    void reflect() {
        strip_.reflect();
        reflected_ = !reflected_;
    }

    void begin_at_side(double share) {
        const lanes::Both point = strip_.at(share);
        const double x = std::clamp(point[0], 0.0, left_);
        strip_.move_origin(point);
        walked_ += x;
        left_ -= x;
    }

    bool end_within() {
        walked_ += left_;
        const WalkWeights weights = strip_.weights(left_);
        weights_ = in_grains(weights.second, weights.third);
        return false;
    }
    bool end_at(double share) {
        weights_ = strip_.weights_at(share);
        return false;
    }
    bool stop(WalkMet met, double share) {
        met_ = met;
        return end_at(share);
    }

    const WalkTriangle* triangles_;
    const WalkOptions& options_;
    WalkStrip strip_;
    double left_;  ///< of the step: it ends so far ahead of the origin
    double walked_ = 0;
    std::uint32_t room_;  ///< for crossings and slides
    std::uint32_t crossings_ = 0;
    bool reflected_ = false;
    WalkMet met_ = WalkMet::nothing;
    WalkSide barrier_;
    Vec3 weights_{1, 0, 0};
};

/// The step is in the frame of the triangle.
Walked walk_on(const WalkMeshData& data, const WalkPoint& place, const DVec<2>& step, const WalkOptions& options) {
    const WalkTriangle& walk = data.walk[place.triangle];
    const double length = std::sqrt(dot(step, step));
    ABUT_ASSERT(walk.is_walkable());
    Walked result;
    result.place = place;
    if (!walk.is_walkable() || !(length <= std::numeric_limits<double>::max())) return result;

    const WalkWeights weights = shares(place.weights);
    const DVec<2> by = in_weights(walk, step);
    const double second = weights.second + by.x, third = weights.third + by.y, first = weights.first - by.x - by.y;
    // As near to a side as this is on it.
    constexpr double outside = -0.5 * walk_grain;
    if (first >= outside && second >= outside && third >= outside) {
        result.place.weights = in_grains(second, third);
        result.length = static_cast<float>(length);
        return result;
    }

    const double end = dot(step, step);
    StripWalk way(data, options, strip_ahead(walk, place.triangle, weights, step), end);
    way.run();
    // Without a barrier all of it was walked, but for rounding.
    const double walked = way.met() == WalkMet::nothing ? length : std::min(way.walked() / length, length);
    result.place = way.place();
    result.length = static_cast<float>(walked);
    result.lost = static_cast<float>(length - walked);
    result.met = way.met();
    result.side = way.barrier();
    result.crossings = way.crossings();
    if (way.crossings() > 0)
        result.turn = turn_along(walk, step, data.walk[result.place.triangle], way.ahead(), way.mirrored(), end);
    return result;
}

}  // namespace

Walked WalkMesh::walk(const WalkPoint& place, const Vec3& step, const WalkOptions& options) const {
    ABUT_ASSERT(is_finite(step));
    return walk_on(*data_, place, WalkFrame(data_->walk[place.triangle]).to_plane(DVec<3>(step)), options);
}
Walked WalkMesh::walk(const WalkPoint& place, const Vec2& step, const WalkOptions& options) const {
    ABUT_ASSERT(is_finite(step));
    return walk_on(*data_, place, DVec<2>(step), options);
}

}  // namespace abut
