// The translations at which the interiors overlap are an open set around 0, bounded by parts of planes: a face of one
// solid against a corner of the other, or an edge against an edge. The least move ends where such a plane is nearest,
// or, if both solids are concave there, where two or three of them meet.
//
// 1. Along a direction the set is left step by step: as long as some triangles cross, B moves to where they part. Where
//    none cross, the exact test decides whether the interiors still overlap. The directions are the axes, the normals
//    of all faces, and those of the planes through which a move left the set.
// 2. A search, nearest first, over moves to where up to three planes meet takes care of notches.
//
// Every move that is taken has passed the exact test.

#include <abut/math/detail/next_float.hpp>
#include <abut/query/detail/solid/interior_overlap.hpp>
#include <abut/query/detail/solid/move_cover.hpp>
#include <abut/query/detail/solid/separating_move.hpp>
#include <abut/query/detail/solid/slide_interval.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::detail {
namespace {

double extent_of(const Aabb3& box) {
    return length(DVec<3>(box.max) - DVec<3>(box.min));
}

/// Directions that were tried, as far as they fit.
class TriedDirections {
public:
    /// Returns false if the direction was added before.
    bool add(const DVec<3>& direction) {
        const auto same = [&](const DVec<3>& other) { return dot(direction, other) > 1 - 1e-14; };
        const auto end = tried_.begin() + static_cast<std::ptrdiff_t>(count_);
        if (std::any_of(tried_.begin(), end, same)) return false;
        tried_[next_] = direction;
        next_ = (next_ + 1) % tried_.size();
        count_ = std::min(count_ + 1, tried_.size());
        return true;
    }

private:
    std::array<DVec<3>, 64> tried_;
    std::size_t count_ = 0, next_ = 0;
};

class MoveSearch : LeastMoveSearch {
public:
    MoveSearch(const View<3>& shape_a, const View<3>& shape_b) : a_(shape_a), b_(shape_b), cover_(a_, b_) {
        const double smaller = std::min(extent_of(a_.box()), extent_of(b_.box()));
        double farthest = 0;
        for (const Aabb3& box : {a_.box(), b_.box()})
            farthest = std::max({farthest, largest(DVec<3>(box.min)), largest(DVec<3>(box.max))});
        step_ = 1e-9 * smaller + 1e-14 * farthest;
        float_step_ = 0x1p-23 * farthest;
        if (a_.triangle_count() + b_.triangle_count() <= min_fine_triangles) return;
        cover_.add_balls(shape_a, shape_b);
        max_meets_ = max_meets_if_fine;
    }

    SeparatingMove find() {
        leave_box(a_.box(), b_.box());
        for (int i = 0; i < 3; ++i)
            for (const double sign : {1.0, -1.0}) try_direction(axis<3>(i, sign));
        each_face_direction([&](const DVec<3>& direction) {
            try_direction(direction);
            return !is_least();
        });
        if (!is_least()) search_meets(max_meets_, step_);
        return best_;
    }

private:
    /// Visits the normals of the faces, and the opposite directions; false stops.
    template <class Visit>
    void each_face_direction(const Visit& visit) {
        for (const bool of_a : {true, false}) {
            const PlacedSolid& solid = of_a ? a_ : b_;
            for (std::uint32_t i = 0; i < solid.triangle_count(); ++i) {
                const Corners t = solid.corners(i);
                const DVec<3> normal = cross(t[1] - t[0], t[2] - t[0]);
                const double size = length(normal);
                if (!(size > 0)) continue;
                // B leaves A by the front of A's faces; A leaves B by the front of B's.
                const DVec<3> direction = normal / (of_a ? size : -size);
                if (!visit(direction) || !visit(-direction)) return;
            }
        }
    }

    bool is_least() const { return best_distance_ <= cover_.min_distance() * (1 + 1e-5); }

    bool parts(const DVec<3>& move) const override {
        return !cover_.has_ball_at(move) && !interiors_overlap(a_, b_.moved(move), move);
    }

    bool may_improve(const DVec<3>& direction) override {
        return !cover_.has_ball_along(direction, limit()) && tried_.add(direction);
    }

    Exit exit_along(const DVec<3>& direction, double limit) override {
        Exit exit;
        double distance = 0;
        for (int i = 0; i < 256; ++i) {
            cover_.leave(direction, step_, limit, distance, exit.normal);
            if (distance >= limit) break;
            const Crossing crossing = crossing_at(direction, distance, limit);
            if (crossing.found && crossing.from < distance - step_) {
                distance = crossing.to;
                exit.normal = crossing.normal;
                continue;
            }
            if (parts(direction * distance)) {
                exit.distance = distance;
                return exit;
            }
            if (crossing.found) {
                distance = crossing.to;
                exit.normal = crossing.normal;
                continue;
            }
            distance += step_;
            if (parts(direction * distance)) {
                exit.distance = distance;
                return exit;
            }
            distance = next_crossing(direction, distance, limit);
        }
        return exit;
    }

    struct Crossing {
        bool found = false;
        double from = 0, to = 0;
        DVec<3> normal{0.0};
    };

    /// Of some triangles that cross at a distance along a direction, or a step farther on, those that part last.
    Crossing crossing_at(const DVec<3>& direction, double distance, double limit) {
        Crossing result;
        int crossing_count = 0;
        each_triangle_pair(
            a_, b_.moved(direction * distance), static_cast<float>(2 * step_),
            [&](std::uint32_t index_a, const Corners& a, std::uint32_t index_b, const Corners& b) {
                SlideInterval slide;
                if (!slide_interval(a, b, direction, {step_, 2 * step_}, slide)) return true;
                if (slide.from < -step_) cover_.add_pair(index_a, index_b);
                if (!result.found || distance + slide.to > result.to)
                    result = {true, distance + slide.from, distance + slide.to, slide.exit_normal};
                return result.to < limit && ++crossing_count < max_crossings;
            },
            direction);
        return result;
    }

    /// The next distance at which triangles begin to cross; the limit if none do. One solid is inside the other, or
    /// they are flush.
    double next_crossing(const DVec<3>& direction, double distance, double limit) const {
        double next = limit;
        const DVec<3> move = direction * (limit - distance);
        const PlacedSolid moved = b_.moved(direction * distance);
        const auto swept = [](Aabb3 box, const DVec<3>& by) {
            for (int i = 0; i < 3; ++i) {
                if (by[i] < 0) box.min[i] = next_down(static_cast<float>(static_cast<double>(box.min[i]) + by[i]));
                if (by[i] > 0) box.max[i] = next_up(static_cast<float>(static_cast<double>(box.max[i]) + by[i]));
            }
            return box;
        };
        a_.each_triangle(swept(moved.box(), move), [&](std::uint32_t index_a) {
            const Corners a = a_.corners(index_a);
            moved.each_triangle(swept(box_of(a), -move), [&](std::uint32_t index_b) {
                SlideInterval slide;
                if (slide_interval(a, moved.corners(index_b), direction, {limit - distance, step_}, slide))
                    next = std::min(next, distance + std::max(slide.from, step_));
                return true;
            });
            return true;
        });
        return next;
    }

    void collect_planes(const DVec<3>& move, NearestPlanes& planes) const override {
        each_triangle_pair(
            a_, b_.moved(move), 0,
            [&](std::uint32_t, const Corners& a, std::uint32_t, const Corners& b) {
                const auto add = [&](const Corners& face, double sign) {
                    const DVec<3> normal = normalized<3>(cross(face[1] - face[0], face[2] - face[0]) * sign);
                    double to = -unlimited_move, from = unlimited_move, back = from, front = to;
                    for (std::size_t i = 0; i < 3; ++i) {
                        const double on_a = dot(normal, a[i] - a[0]), on_b = dot(normal, b[i] - a[0]);
                        to = std::max(to, on_a);
                        back = std::min(back, on_a);
                        from = std::min(from, on_b);
                        front = std::max(front, on_b);
                    }
                    if (to - from > step_ && front - back > -step_)
                        planes.add({normal, dot(normal, move) + to - from}, limit());
                };
                add(a, 1);
                add(b, -1);
                return true;
            },
            move);
    }

    static constexpr int max_crossings = 4;

    /// Coarser solids have so few directions that balls don't pay, and larger faces, whose planes meet in notches.
    static constexpr std::uint32_t min_fine_triangles = 256;
    static constexpr int max_meets_if_fine = 4;

    PlacedSolid a_, b_;
    MoveCover cover_;
    double step_ = 0;  ///< a distance that doesn't count
    TriedDirections tried_;
    int max_meets_ = 512;  ///< how many meets of planes are tried
};

}  // namespace

SeparatingMove separating_move(const View<3>& a, const View<3>& b) {
    return MoveSearch(a, b).find();
}

}  // namespace abut::detail
