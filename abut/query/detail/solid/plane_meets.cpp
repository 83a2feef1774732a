#include <abut/query/detail/solid/plane_meets.hpp>

#include <algorithm>
#include <limits>

namespace abut::detail {
namespace {

constexpr double plane_rounding = 1e-9;

bool is_in_front(const MeetOfPlanes& meet, const DVec<3>& move) {
    return std::all_of(meet.planes.begin(), meet.planes.begin() + static_cast<std::ptrdiff_t>(meet.count),
                       [&](const MovePlane& plane) {
                           return dot(plane.normal, move) >=
                                  plane.distance - plane_rounding * (plane.distance + length(move));
                       });
}

/// The least move onto two planes, or none if they are parallel.
std::optional<DVec<3>> meet_of(const MovePlane& p, const MovePlane& q) {
    const double cosine = dot(p.normal, q.normal), det = 1 - cosine * cosine;
    if (det < plane_rounding) return std::nullopt;
    return p.normal * ((p.distance - cosine * q.distance) / det) +
           q.normal * ((q.distance - cosine * p.distance) / det);
}

std::optional<DVec<3>> meet_of(const MovePlane& p, const MovePlane& q, const MovePlane& r) {
    const DVec<3> across = cross(q.normal, r.normal);
    const double det = dot(p.normal, across);
    if (std::abs(det) < plane_rounding) return std::nullopt;
    return (across * p.distance + cross(r.normal, p.normal) * q.distance + cross(p.normal, q.normal) * r.distance) /
           det;
}

}  // namespace

void NearestPlanes::add(const MovePlane& plane, double limit) {
    if (plane.distance >= limit) return;
    const auto end = planes_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto same = [&](const MovePlane& other) {
        return dot(plane.normal, other.normal) > 1 - 1e-12 &&
               std::abs(plane.distance - other.distance) <= plane_rounding * limit;
    };
    if (std::any_of(planes_.begin(), end, same)) return;
    if (count_ < planes_.size()) {
        planes_[count_++] = plane;
        return;
    }
    const auto farthest = std::max_element(
        planes_.begin(), end, [](const MovePlane& p, const MovePlane& q) { return p.distance < q.distance; });
    if (plane.distance < farthest->distance) *farthest = plane;
}

std::optional<MeetOfPlanes> with_plane(const MeetOfPlanes& meet, const MovePlane& plane) {
    MeetOfPlanes result = meet;
    if (result.count == result.planes.size()) return std::nullopt;
    result.planes[result.count++] = plane;
    double nearest = std::numeric_limits<double>::infinity();
    const auto offer = [&](const std::optional<DVec<3>>& move) {
        if (!move) return;
        const double squared = length_squared(*move);
        if (squared >= nearest || !is_in_front(result, *move)) return;
        nearest = squared;
        result.move = *move;
    };
    // The new plane is one of those on which the least move lies.
    offer(plane.normal * plane.distance);
    for (std::size_t i = 0; i < meet.count; ++i) {
        offer(meet_of(plane, meet.planes[i]));
        for (std::size_t j = 0; j < i; ++j) offer(meet_of(plane, meet.planes[i], meet.planes[j]));
    }
    if (!(nearest < std::numeric_limits<double>::infinity())) return std::nullopt;
    result.distance = length(result.move);
    return result;
}

MeetOfPlanes farther_by(const MeetOfPlanes& meet, double distance) {
    MeetOfPlanes result;
    for (std::size_t i = 0; i < meet.count; ++i) {
        const MovePlane& plane = meet.planes[i];
        if (const std::optional<MeetOfPlanes> next = with_plane(result, {plane.normal, plane.distance + distance}))
            result = *next;
    }
    return result;
}

void MoveQueue::add(const MeetOfPlanes& meet, double limit) {
    if (meet.distance >= limit) return;
    const auto known_end = known_.begin() + static_cast<std::ptrdiff_t>(known_count_);
    const auto same = [&](const DVec<3>& other) { return length(meet.move - other) <= plane_rounding * limit; };
    if (std::any_of(known_.begin(), known_end, same)) return;
    if (known_count_ < known_.size()) known_[known_count_++] = meet.move;
    const auto end = sorted_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto place = std::upper_bound(sorted_.begin(), end, meet, [](const MeetOfPlanes& p, const MeetOfPlanes& q) {
        return p.distance > q.distance;
    });
    if (count_ < sorted_.size()) {
        std::move_backward(place, end, end + 1);
        *place = meet;
        ++count_;
        return;
    }
    if (place == sorted_.begin()) return;
    std::move(sorted_.begin() + 1, place, sorted_.begin());
    *(place - 1) = meet;
}

std::optional<MeetOfPlanes> MoveQueue::take_nearest() {
    if (count_ == 0) return std::nullopt;
    return sorted_[--count_];
}

}  // namespace abut::detail
