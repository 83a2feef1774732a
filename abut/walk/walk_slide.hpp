#pragma once

// What becomes of a way over a walk mesh at borders and closed edges. For .cpp files.

#include <abut/walk/walk_data.hpp>
#include <abut/walk/walk_way-inl.h>

#include <cstdint>

namespace abut {

/// Along barriers and on between them, until the step ends.
class WalkSlide {
public:
    WalkSlide(const WalkTriangle* triangles, const WalkOptions& options, const WalkWay& way)
        : triangles_(triangles), options_(options), way_(way) {}

    /// From where the way has stopped at a barrier, or at its limit.
    void run(WalkStop stop);

    const WalkWay& way() const { return way_; }
    Vec3 weights() const { return weights_; }
    WalkMet met() const { return met_; }
    const WalkSide& barrier() const { return barrier_; }
    /// The triangle is seen in a mirror.
    bool reflected() const { return reflected_; }

private:
    enum class Round { free, barrier, limit };

    bool slide();
    Round go_round_corner();
    void begin_at_side(double share);
    void end_within();
    void end_at(WalkMet met, double share);

    const WalkTriangle* triangles_;
    const WalkOptions& options_;
    WalkWay way_;
    bool reflected_ = false;
    WalkMet met_ = WalkMet::nothing;
    WalkSide barrier_;
    Vec3 weights_{1, 0, 0};
};

}  // namespace abut
