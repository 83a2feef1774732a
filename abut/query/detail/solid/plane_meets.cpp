#include <abut/math/detail/next_float.hpp>
#include <abut/query/detail/solid/plane_meets.hpp>

#include <algorithm>

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

bool LeastMoveSearch::take(const DVec<3>& direction, double distance) {
    const Vec3 normal = to_float(direction);
    auto depth = static_cast<float>(distance);
    for (const double longer : {0.0, 0.0, 1.0, 4.0}) {
        if (static_cast<double>(depth) >= best_distance_) return false;
        if (parts(DVec<3>(normal) * static_cast<double>(depth))) {
            best_ = {normal, depth};
            best_distance_ = static_cast<double>(depth);
            return true;
        }
        depth = std::max(next_up(depth), static_cast<float>(distance + tolerance_ + longer * float_step_));
    }
    return false;
}

void LeastMoveSearch::try_direction(DVec<3> direction) {
    // The plane through which a move leaves may be nearer along its own normal.
    for (int i = 0; i < 4; ++i) {
        if (!may_improve(direction)) return;
        const Exit exit = exit_along(direction, limit());
        if (!(exit.distance < limit())) return;
        take(direction, exit.distance);
        if (length_squared(exit.normal) < 0.5 || dot(exit.normal, direction) > 1 - 1e-9) return;
        direction = exit.normal;
    }
}

void LeastMoveSearch::leave_box(const Aabb<3>& a, const Aabb<3>& b) {
    for (int i = 0; i < 3; ++i)
        for (const double sign : {1.0, -1.0}) {
            const double distance = sign > 0 ? static_cast<double>(a.max[i]) - static_cast<double>(b.min[i])
                                             : static_cast<double>(b.max[i]) - static_cast<double>(a.min[i]);
            if (distance >= best_distance_) continue;
            best_ = {to_float(axis<3>(i, sign)), next_up(static_cast<float>(distance))};
            best_distance_ = static_cast<double>(best_.depth);
        }
}

void LeastMoveSearch::search_meets(int max_meets, double farther) {
    MoveQueue queue;
    queue.add({}, limit());
    for (int i = 0; i < max_meets; ++i) {
        const std::optional<MeetOfPlanes> next = queue.take_nearest();
        if (!next || next->distance >= limit()) return;
        if (next->count > 0 && (take_meet(*next) || take_meet(farther_by(*next, farther)))) return;
        NearestPlanes planes;
        collect_planes(next->move, planes);
        for (const MovePlane& plane : planes.all())
            if (const std::optional<MeetOfPlanes> meet = with_plane(*next, plane)) queue.add(*meet, limit());
    }
}

bool LeastMoveSearch::take_meet(const MeetOfPlanes& meet) {
    if (!(meet.distance < limit()) || !parts(meet.move)) return false;
    const DVec<3> direction = meet.move / meet.distance;
    if (!take(direction, meet.distance)) return false;
    // The planes are those of triangles, which a part of the move may leave already.
    try_direction(direction);
    return true;
}

}  // namespace abut::detail
