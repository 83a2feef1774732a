#include "kit_pairs.hpp"

#include "rational.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <vector>

namespace abut::oracle {
namespace {

using scenes::KitPart;
using scenes::KitPiece;
using Exact = std::array<Rational, 3>;

Exact exact(const Vec3& v) {
    return {Rational(v.x), Rational(v.y), Rational(v.z)};
}
Rational dot(const Exact& a, const Exact& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Exact cross(const Exact& a, const Exact& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The directions of the faces of the Minkowski sum of A and -B.
std::vector<Exact> face_directions(const KitPart& a, const KitPart& b) {
    std::vector<Exact> result;
    for (const KitPart* part : {&a, &b})
        for (const Vec3& normal : part->normals) result.push_back(exact(normal));
    for (const Vec3& edge_a : a.edges)
        for (const Vec3& edge_b : b.edges) {
            const Exact normal = cross(exact(edge_a), exact(edge_b));
            if (normal[0] != 0 || normal[1] != 0 || normal[2] != 0) result.push_back(normal);
        }
    return result;
}

struct Range {
    Rational low, high;
};

Range range_along(const Exact& direction, const KitPart& part, const Vec3& at) {
    const Rational shift = dot(direction, exact(at));
    Range result;
    bool first = true;
    for (const Vec3& point : part.points) {
        const Rational along = dot(direction, exact(point));
        if (first || along < result.low) result.low = along;
        if (first || along > result.high) result.high = along;
        first = false;
    }
    result.low += shift;
    result.high += shift;
    return result;
}

/// Sums of floats of these pieces are exact in double.
bool boxes_overlap(const KitPart& a, const Vec3& at_a, const KitPart& b, const Vec3& at_b) {
    for (int i = 0; i < 3; ++i) {
        double low_a = 1e300, high_a = -1e300, low_b = 1e300, high_b = -1e300;
        for (const Vec3& point : a.points) {
            low_a = std::min(low_a, static_cast<double>(point[i]) + static_cast<double>(at_a[i]));
            high_a = std::max(high_a, static_cast<double>(point[i]) + static_cast<double>(at_a[i]));
        }
        for (const Vec3& point : b.points) {
            low_b = std::min(low_b, static_cast<double>(point[i]) + static_cast<double>(at_b[i]));
            high_b = std::max(high_b, static_cast<double>(point[i]) + static_cast<double>(at_b[i]));
        }
        if (high_a <= low_b || high_b <= low_a) return false;
    }
    return true;
}

bool parts_overlap(const KitPart& a, const Vec3& at_a, const KitPart& b, const Vec3& at_b) {
    if (!boxes_overlap(a, at_a, b, at_b)) return false;
    for (const Exact& direction : face_directions(a, b)) {
        const Range range_a = range_along(direction, a, at_a), range_b = range_along(direction, b, at_b);
        if (range_a.high <= range_b.low || range_b.high <= range_a.low) return false;
    }
    return true;
}

using Half = MoveHalfSpace;
using Sum = std::vector<Half>;

/// The moves of B at which two parts overlap.
Sum minkowski_sum(const KitPart& a, const Vec3& at_a, const KitPart& b, const Vec3& at_b) {
    Sum result;
    for (const Exact& direction : face_directions(a, b)) {
        const DVec<3> axis(static_cast<double>(direction[0]), static_cast<double>(direction[1]),
                           static_cast<double>(direction[2]));
        const double size = length(axis);
        const DVec<3> normal = axis / size;
        const auto same = [&](const Half& half) { return std::abs(detail::dot(half.normal, normal)) > 1 - 1e-13; };
        if (std::any_of(result.begin(), result.end(), same)) continue;
        const Range range_a = range_along(direction, a, at_a), range_b = range_along(direction, b, at_b);
        result.push_back({normal, static_cast<double>(Rational(range_a.high - range_b.low)) / size});
        result.push_back({-normal, static_cast<double>(Rational(range_b.high - range_a.low)) / size});
    }
    return result;
}

/// The least move outside of all half-spaces: on one of their planes, or where two or three of them meet.
std::optional<DVec<3>> least_outside(const std::vector<Half>& halves) {
    std::optional<DVec<3>> best;
    double nearest = std::numeric_limits<double>::infinity();
    const auto offer = [&](const DVec<3>& move) {
        if (length(move) >= nearest) return;
        for (const Half& half : halves)
            if (detail::dot(half.normal, move) < half.distance - 1e-9) return;
        nearest = length(move);
        best = move;
    };
    const std::size_t count = halves.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Half& p = halves[i];
        offer(p.normal * p.distance);
        for (std::size_t j = 0; j < i; ++j) {
            const Half& q = halves[j];
            const double cosine = detail::dot(p.normal, q.normal), det = 1 - cosine * cosine;
            if (det < 1e-10) continue;
            offer(p.normal * ((p.distance - cosine * q.distance) / det) +
                  q.normal * ((q.distance - cosine * p.distance) / det));
            for (std::size_t k = 0; k < j; ++k) {
                const Half& r = halves[k];
                const DVec<3> across = detail::cross(q.normal, r.normal);
                const double volume = detail::dot(p.normal, across);
                if (std::abs(volume) < 1e-9) continue;
                offer((across * p.distance + detail::cross(r.normal, p.normal) * q.distance +
                       detail::cross(p.normal, q.normal) * r.distance) /
                      volume);
            }
        }
    }
    return best;
}

struct Node {
    DVec<3> move{0.0};
    std::vector<Half> outside;

    bool operator<(const Node& other) const { return length(move) > length(other.move); }
};

/// How far a move is inside of a sum; at most 0 outside.
double depth_in(const Sum& sum, const DVec<3>& move) {
    double depth = std::numeric_limits<double>::infinity();
    for (const Half& half : sum) depth = std::min(depth, half.distance - detail::dot(half.normal, move));
    return depth;
}

}  // namespace

bool interiors_overlap(const KitPiece& a, const Vec3& at_a, const KitPiece& b, const Vec3& at_b) {
    for (const KitPart& part_a : a.parts)
        for (const KitPart& part_b : b.parts)
            if (parts_overlap(part_a, at_a, part_b, at_b)) return true;
    return false;
}

OverlappingMoves::OverlappingMoves(const KitPiece& a, const Vec3& at_a, const KitPiece& b, const Vec3& at_b) {
    for (const KitPart& part_a : a.parts)
        for (const KitPart& part_b : b.parts) sums_.push_back(minkowski_sum(part_a, at_a, part_b, at_b));
}

std::optional<double> OverlappingMoves::least_separation() const {
    std::priority_queue<Node> nodes;
    nodes.push({});
    for (int i = 0; i < 3000 && !nodes.empty(); ++i) {
        const Node node = nodes.top();
        nodes.pop();
        const Sum* inside = nullptr;
        double deepest = 1e-9;
        for (const Sum& sum : sums_) {
            const double depth = depth_in(sum, node.move);
            if (depth <= deepest) continue;
            deepest = depth;
            inside = &sum;
        }
        if (inside == nullptr) return length(node.move);
        for (const Half& half : *inside) {
            Node next{{}, node.outside};
            next.outside.push_back(half);
            if (const std::optional<DVec<3>> move = least_outside(next.outside)) {
                next.move = *move;
                nodes.push(std::move(next));
            }
        }
    }
    return std::nullopt;
}

double OverlappingMoves::separation_along(const DVec<3>& direction) const {
    double distance = 0;
    for (bool goes_on = true; goes_on;) {
        goes_on = false;
        for (const Sum& sum : sums_) {
            if (depth_in(sum, direction * distance) <= 1e-9) continue;
            double end = std::numeric_limits<double>::infinity();
            for (const Half& half : sum) {
                const double speed = detail::dot(half.normal, direction);
                if (speed > 1e-12) end = std::min(end, half.distance / speed);
            }
            if (end <= distance) continue;
            distance = end;
            goes_on = true;
        }
    }
    return distance;
}

}  // namespace abut::oracle
