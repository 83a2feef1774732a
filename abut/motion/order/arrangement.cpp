#include <abut/motion/order/arrangement.hpp>
#include <abut/motion/order/pair_tolerance.hpp>
#include <abut/motion/order/projection.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/sweep.hpp>

namespace abut::detail {
namespace {

template <int D>
double farthest_corner(const Aabb<D>& box) {
    DVec<D> corner;
    for (int i = 0; i < D; ++i) corner[i] = static_cast<double>(std::max(std::abs(box.min[i]), std::abs(box.max[i])));
    return length(corner);
}

}  // namespace

template <int D>
Arrangement<D>::Arrangement(std::span<const Convex<D>> shapes, std::span<const Pose<D>> poses)
    : shapes_(shapes), poses_(poses.begin(), poses.end()) {
    for (std::uint32_t i = 0; i < size(); ++i) {
        placed_.push_back(placed_at(i, poses_[i]));
        boxes_.push_back(bounds(placed_.back()));
        reach_.push_back(farthest_corner(bounds(shapes_[i])));
    }
}

template <int D>
void Arrangement<D>::set_pose(std::uint32_t shape, const Pose<D>& pose) {
    poses_[shape] = pose;
    placed_[shape] = placed_at(shape, pose);
    boxes_[shape] = bounds(placed_[shape]);
}

template <int D>
bool Arrangement<D>::runs_into(const Convex<D>& start, const Vec<D>& motion, std::uint32_t other) const {
    const Convex<D>& obstacle = placed_[other];
    const std::optional<Hit<D>> hit = sweep(start, motion, obstacle);
    if (!hit) return false;
    // The depth that the rest of the motion would add; a shape may also just touch what it passes.
    const double tolerance = tolerance_for(start, obstacle), distance = length(DVec<D>(motion));
    const double remaining = (1 - static_cast<double>(hit->fraction)) * -dot(DVec<D>(motion), DVec<D>(hit->normal));
    return remaining > tolerance && projected_depth(start, obstacle, DVec<D>(motion) / distance) > tolerance;
}

template <int D>
std::optional<std::uint32_t> Arrangement<D>::first_blocker(std::uint32_t shape, const Vec<D>& to) const {
    const Vec<D> motion = to_float(DVec<D>(to) - DVec<D>(poses_[shape].position));
    const Aabb<D> end = bounds(placed_at(shape, Pose<D>{to, poses_[shape].rotation}));
    const Aabb<D> swept = merged(boxes_[shape], end);
    for (std::uint32_t other = 0; other < size(); ++other)
        if (other != shape && overlaps(swept, boxes_[other]) && runs_into(placed_[shape], motion, other)) return other;
    return std::nullopt;
}

template <int D>
std::optional<std::uint32_t> Arrangement<D>::first_within_reach(std::uint32_t shape) const {
    const Ball<D> reachable{poses_[shape].position, static_cast<float>(reach_[shape])};
    for (std::uint32_t other = 0; other < size(); ++other)
        if (other != shape && !(closest(reachable, placed_[other]).distance > 0)) return other;
    return std::nullopt;
}

template class Arrangement<2>;
template class Arrangement<3>;

}  // namespace abut::detail
