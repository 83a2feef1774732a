#include "tool/check/deepest_frames.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include <glm/common.hpp>
#include <glm/ext/vector_int3.hpp>
#include <glm/gtc/quaternion.hpp>

namespace abut::tool {
namespace {

// Two depths that differ by less than this fraction count as equal: of a pair that moves as one, rounding would make
// each frame the deepest.
constexpr float equal_depths = 1e-3f;

View<3> placed(const Object<3>& object, const Pose3& pose) {
    return view(at(object.shape, pose));
}

// Whether a predicate holds for any of 98 directions, to points spread over the surface of a cube.
template <class Holds>
bool any_spread_direction(const Holds& holds) {
    for (int i = 0; i < 125; ++i) {
        const glm::ivec3 point(i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2), size = glm::abs(point);
        if (std::max({size.x, size.y, size.z}) == 2 && holds(glm::normalize(Vec3(point)))) return true;
    }
    return false;
}

}  // namespace

bool DeepFrames::is_no_deeper(const Frame& frame) const {
    if (normals_.empty()) return false;
    const View<3> a = placed(*a_, frame.a);
    const auto parts_along = [&](const Vec3& normal) {
        const Vec3 move = normal * ((1 + equal_depths) * depth_);
        return !overlaps(a, placed(*b_, {frame.b.position + move, frame.b.rotation}));
    };
    const auto parts_along_any = [&](const Normal& normal) {
        return parts_along(frame.a.rotation * normal.in_a) || parts_along(frame.b.rotation * normal.in_b) ||
               parts_along(normal.in_world);
    };
    return std::any_of(normals_.begin(), normals_.end(), parts_along_any) || any_spread_direction(parts_along);
}

std::optional<DeepFrames::Deepest> DeepFrames::take_deepest(const Limits& limits) {
    std::optional<Deepest> result;
    const std::vector<Frame> frames = std::exchange(frames_, {});
    // From the middle to the middles of the halves, and so on: that finds the deepest frame soon.
    for (std::size_t step = std::bit_ceil(frames.size() + 1); step > 0; step /= 2)
        for (std::size_t i = step; i <= frames.size(); i += 2 * step) {
            const Frame& frame = frames[i - 1];
            if (is_no_deeper(frame)) continue;
            const View<3> a = placed(*a_, frame.a), b = placed(*b_, frame.b);
            const Aabb3 box_a = bounds(a), box_b = bounds(b);
            std::optional<PairContact<3>> contact =
                pair_contact(ObjectAt<3>(*a_, frame.a, a, box_a), ObjectAt<3>(*b_, frame.b, b, box_b), limits);
            if (!contact) continue;
            if (normals_.size() < max_normals) normals_.emplace_back();
            normals_[next_normal_++ % max_normals] = {contact->normal,
                                                      glm::conjugate(frame.a.rotation) * contact->normal,
                                                      glm::conjugate(frame.b.rotation) * contact->normal};
            if (!(-contact->distance > depth_)) continue;
            depth_ = -contact->distance;
            result = Deepest{frame.number, *std::move(contact)};
        }
    return result;
}

void DeepestFrames::add(const Pair& pair, std::size_t frame) {
    const auto entry = pairs_.try_emplace(pair, copies_.of(pair.first), copies_.of(pair.second)).first;
    entry->second.add(frame, objects_[pair.first].pose, objects_[pair.second].pose);
    ++frames_;
}

void DeepestFrames::find(const std::vector<Pair>& going_on, ContactFindings<3>& findings) {
    const bool are_many = frames_ > max_frames;
    found_.clear();
    for (auto pair = pairs_.begin(); pair != pairs_.end(); ++pair) {
        const auto& [a, b] = pair->first;
        const bool is_over = !std::binary_search(going_on.begin(), going_on.end(), pair->first) ||
                             !pair->second.are_of(copies_.of(a), copies_.of(b));
        if (is_over || are_many) found_.push_back({pair, is_over});
    }
    workers_.run(static_cast<std::uint32_t>(found_.size()),
                 [&](std::uint32_t i) { found_[i].deepest = found_[i].pair->second.take_deepest(limits_); });
    for (Found& found : found_) {
        if (found.deepest) findings.deepen(found.pair->first, found.deepest->frame, std::move(found.deepest->contact));
        if (found.is_over) pairs_.erase(found.pair);
    }
    if (are_many) frames_ = 0;
}

}  // namespace abut::tool
