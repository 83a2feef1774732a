#pragma once

// The poses of shapes that are moved one at a time. For .cpp files.

#include <abut/math/pose.hpp>
#include <abut/shape/view/view.hpp>

#include <optional>
#include <span>
#include <vector>

namespace abut::detail {

/// Shapes at changing poses. Refers to the shapes.
template <int D>
class Arrangement {
public:
    Arrangement(std::span<const Convex<D>> shapes, std::span<const Pose<D>> poses);

    std::uint32_t size() const { return static_cast<std::uint32_t>(poses_.size()); }
    const Pose<D>& pose(std::uint32_t shape) const { return poses_[shape]; }
    const Convex<D>& placed(std::uint32_t shape) const { return placed_[shape]; }
    Convex<D> placed_at(std::uint32_t shape, const Pose<D>& pose) const { return moved(shapes_[shape], affine(pose)); }
    void set_pose(std::uint32_t shape, const Pose<D>& pose);

    /// The radius of the shape around its local origin, about which it rotates.
    double reach(std::uint32_t shape) const { return reach_[shape]; }

    /// The lowest other shape that blocks the straight translation of this one to a position. Contact at the end
    /// doesn't block.
    std::optional<std::uint32_t> first_blocker(std::uint32_t shape, const Vec<D>& to) const;
    /// The lowest other shape within the rotation radius of this one.
    std::optional<std::uint32_t> first_within_reach(std::uint32_t shape) const;
    /// True if a shape that is translated from `start` penetrates `other`.
    bool runs_into(const Convex<D>& start, const Vec<D>& motion, std::uint32_t other) const;

private:
    std::span<const Convex<D>> shapes_;
    std::vector<Pose<D>> poses_;
    std::vector<Convex<D>> placed_;
    std::vector<Aabb<D>> boxes_;
    std::vector<double> reach_;
};

}  // namespace abut::detail
