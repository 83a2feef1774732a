#pragma once

// Sliding along borders and forbidden edges. For .cpp files.

#include <abut/walk/data.hpp>
#include <abut/walk/geodesic-inl.h>

#include <cstdint>

namespace abut::detail {

/// Continues a geodesic along barriers and between them until the step ends.
class WalkSlide {
public:
    WalkSlide(const WalkTriangle* triangles, const WalkOptions& options, const WalkGeodesic& geodesic)
        : triangles_(triangles), options_(options), geodesic_(geodesic) {}

    /// Starts where the geodesic stopped, at a barrier or at its limit.
    void run(WalkStop stop);

    const WalkGeodesic& geodesic() const { return geodesic_; }
    Vec3 weights() const { return weights_; }
    WalkMet met() const { return met_; }
    const WalkSide& barrier() const { return barrier_; }
    /// True if the triangle is seen mirrored.
    bool reflected() const { return reflected_; }

private:
    enum class CornerResult { free, barrier, limit };

    bool slide();
    CornerResult walk_around_corner();
    void begin_at_side(double fraction);
    void end_within();
    void end_at(WalkMet met, double fraction);

    const WalkTriangle* triangles_;
    const WalkOptions& options_;
    WalkGeodesic geodesic_;
    bool reflected_ = false;
    WalkMet met_ = WalkMet::nothing;
    WalkSide barrier_;
    Vec3 weights_{1, 0, 0};
};

}  // namespace abut::detail
