#pragma once

// Where things stand while they are moved about one at a time. For .cpp files.

#include <abut/math/pose.hpp>
#include <abut/shape/view.hpp>

#include <optional>
#include <span>
#include <vector>

namespace abut {

/// Shapes at poses that change. Refers to the shapes.
template <int D>
class FloorPlan {
public:
    FloorPlan(std::span<const Convex<D>> shapes, std::span<const Pose<D>> poses);

    std::uint32_t size() const { return static_cast<std::uint32_t>(poses_.size()); }
    const Pose<D>& pose(std::uint32_t shape) const { return poses_[shape]; }
    const Convex<D>& placed(std::uint32_t shape) const { return placed_[shape]; }
    Convex<D> placed_at(std::uint32_t shape, const Pose<D>& pose) const { return moved(shapes_[shape], affine(pose)); }
    void put(std::uint32_t shape, const Pose<D>& pose);

    /// How far the shape reaches from its own origin, about which it turns.
    double reach(std::uint32_t shape) const { return reach_[shape]; }

    /// The lowest other shape that this one runs into on the straight way from where it is, if any. To arrive in
    /// contact is not to run into.
    std::optional<std::uint32_t> met(std::uint32_t shape, const Vec<D>& to) const;
    /// The lowest other shape that is within reach of this one where it turns.
    std::optional<std::uint32_t> near(std::uint32_t shape) const;
    /// Whether a shape that is moved from `start`, where it is now or elsewhere, runs into another.
    bool meets(const Convex<D>& start, const Vec<D>& motion, std::uint32_t other) const;

private:
    std::span<const Convex<D>> shapes_;
    std::vector<Pose<D>> poses_;
    std::vector<Convex<D>> placed_;
    std::vector<Aabb<D>> boxes_;
    std::vector<double> reach_;
};

}  // namespace abut
