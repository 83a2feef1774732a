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
#include <abut/math/dvec.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/detail/solid/interior_overlap.hpp>
#include <abut/query/detail/solid/separating_move.hpp>
#include <abut/query/detail/solid/slide_interval.hpp>
#include <abut/query/raycast.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace abut::detail {
namespace {

/// A ball inside a solid.
struct InnerBall {
    DVec<3> center{0.0};
    double radius = 0;
};

Vec3 middle_of(const Corners& t) {
    return to_float((t[0] + t[1] + t[2]) / 3.0);
}

/// The ball around the middle of a chord that begins at a triangle.
std::optional<InnerBall> inner_ball(const View<3>& shape, const PlacedSolid& solid, std::uint32_t triangle,
                                    double extent) {
    const Corners t = solid.corners(triangle);
    const Vec3 inward = to_float(normalized<3>(cross(t[2] - t[0], t[1] - t[0])));
    const Vec3 start = middle_of(t) + inward * static_cast<float>(1e-4 * extent);
    const std::optional<Hit<3>> end = raycast(Ray3{start, inward, static_cast<float>(extent)}, shape);
    if (!end) return std::nullopt;
    const Vec3 center = start + inward * (0.5f * end->distance);
    if (solid.side_of(DVec<3>(center)) != PointSide::inside) return std::nullopt;
    const float radius = std::abs(closest(shape, Ball<3>{center, 0}).distance);
    if (!(radius > 0)) return std::nullopt;
    return InnerBall{DVec<3>(center), static_cast<double>(radius) * (1 - 1e-4)};
}

/// Balls inside a solid, behind triangles evenly spread over their order.
template <std::size_t N>
std::size_t find_inner_balls(const View<3>& shape, const PlacedSolid& solid, std::array<InnerBall, N>& balls) {
    const double extent = length(DVec<3>(solid.box().max) - DVec<3>(solid.box().min));
    std::size_t count = 0;
    for (std::size_t i = 0; i < N; ++i) {
        const auto triangle = static_cast<std::uint32_t>(i * solid.triangle_count() / N);
        if (const std::optional<InnerBall> ball = inner_ball(shape, solid, triangle, extent)) balls[count++] = *ball;
    }
    return count;
}

/// Refers to the two solids.
class MoveCover {
public:
    MoveCover(const PlacedSolid& a, const PlacedSolid& b) : a_(a), b_(b) {}

    /// Adds the moves that bring a ball inside B to a ball inside A. The balls are found by rays through the shapes.
    void add_balls(const View<3>& shape_a, const View<3>& shape_b) {
        std::array<InnerBall, max_inner> inner_a, inner_b;
        const std::size_t count_a = find_inner_balls(surface_view(shape_a), a_, inner_a),
                          count_b = find_inner_balls(surface_view(shape_b), b_, inner_b);
        for (std::size_t i = 0; i < count_a; ++i)
            for (std::size_t j = 0; j < count_b; ++j) {
                const DVec<3> center = inner_a[i].center - inner_b[j].center;
                const double radius = inner_a[i].radius + inner_b[j].radius;
                if (is_in_ball(center, radius)) continue;
                x_[ball_count_] = center.x;
                y_[ball_count_] = center.y;
                z_[ball_count_] = center.z;
                radius_[ball_count_] = radius;
                beyond_[ball_count_++] = length_squared(center) - radius * radius;
                min_distance_ = std::max(min_distance_, radius - length(center));
            }
    }

    /// Adds the moves at which two triangles cross.
    void add_pair(std::uint32_t triangle_a, std::uint32_t triangle_b) {
        const Corners a = a_.corners(triangle_a), b = b_.corners(triangle_b);
        const DVec<3> middle_a = (a[0] + a[1] + a[2]) / 3.0, middle_b = (b[0] + b[1] + b[2]) / 3.0;
        double radius_a = 0, radius_b = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            radius_a = std::max(radius_a, length(a[i] - middle_a));
            radius_b = std::max(radius_b, length(b[i] - middle_b));
        }
        pairs_[next_pair_] = {triangle_a, triangle_b};
        around_pairs_[next_pair_] = {middle_a - middle_b, radius_a + radius_b};
        next_pair_ = (next_pair_ + 1) % max_pairs;
        pair_count_ = std::min(pair_count_ + 1, max_pairs);
    }

    /// No shorter move parts the solids.
    double min_distance() const { return min_distance_; }

    /// Whether a ball contains the moves along a direction up to the limit, which seldom changes. Quick.
    bool has_ball_along(const DVec<3>& direction, double limit) {
        if (limit != limit_of_caps_) {
            limit_of_caps_ = limit;
            cap_count_ = 0;
            for (std::size_t i = 0; i < ball_count_; ++i) {
                const double beyond = beyond_[i];
                if (beyond < 0)
                    caps_[cap_count_++] = {static_cast<std::uint32_t>(i), (limit * limit + beyond) / (2 * limit)};
            }
        }
        for (std::size_t i = 0; i < cap_count_; ++i) {
            if (!(dot(direction, center(caps_[i].ball)) > caps_[i].min_along)) continue;
            // Neighbouring directions are in one ball.
            std::swap(caps_[i], caps_[i / 2]);
            return true;
        }
        return false;
    }

    /// Goes on along a direction as long as a set contains the move, at least by `step`, or up to the limit. Sets the
    /// normal of the last plane.
    void leave(const DVec<3>& direction, double step, double limit, double& distance, DVec<3>& normal) {
        if (distance == 0) set_spans(direction);
        for (bool goes_on = true; goes_on && distance < limit;) {
            goes_on = false;
            const double end = end_of_balls(distance, step);
            if (end > distance) normal = DVec<3>(0.0);
            distance = end;
            for (std::size_t i = 0; i < pair_count_ && distance < limit; ++i) {
                const Ball& around = around_pairs_[i];
                if (length_squared(direction * distance - around.center) >= around.radius * around.radius) continue;
                SlideInterval slide;
                const SlideRange range{distance == 0 ? 0 : distance - step, distance + 2 * step};
                if (!slide_interval(a_.corners(pairs_[i].a), b_.corners(pairs_[i].b), direction, range, slide))
                    continue;
                distance = slide.to;
                normal = slide.exit_normal;
                goes_on = true;
            }
        }
    }

    /// Whether a set contains the move.
    bool has_ball_at(const DVec<3>& move) const {
        const double squared = length_squared(move);
        for (std::size_t i = 0; i < ball_count_; ++i)
            if (squared - 2 * (x_[i] * move.x + y_[i] * move.y + z_[i] * move.z) + beyond_[i] < 0) return true;
        return false;
    }

private:
    /// A ball of moves, or the pair of triangles whose moves are in it.
    struct Ball {
        DVec<3> center{0.0};
        double radius = 0;
    };
    struct TrianglePair {
        std::uint32_t a, b;
    };

    static constexpr std::size_t max_inner = 24;  ///< balls inside of each solid
    static constexpr std::size_t max_pairs = 256;

    static constexpr std::size_t max_balls = max_inner * max_inner;

    bool is_in_ball(const DVec<3>& middle, double radius) const {
        for (std::size_t i = 0; i < ball_count_; ++i) {
            const double between = radius_[i] - radius;
            if (between >= 0 && length_squared(middle - center(i)) <= between * between) return true;
        }
        return false;
    }

    DVec<3> center(std::size_t ball) const { return {x_[ball], y_[ball], z_[ball]}; }
    /// Sets the spans in which the balls contain moves along a direction.
    void set_spans(const DVec<3>& direction) {
        for (std::size_t i = 0; i < ball_count_; ++i) {
            const double along = x_[i] * direction.x + y_[i] * direction.y + z_[i] * direction.z;
            const double half = std::sqrt(std::max(0.0, along * along - beyond_[i]));
            from_[i] = along - half;
            to_[i] = along + half;
        }
    }

    double end_of_balls(double from, double step) const {
        for (double end = from;;) {
            double farther = end;
            for (std::size_t i = 0; i < ball_count_; ++i) farther = std::max(farther, from_[i] < end ? to_[i] : end);
            if (!(farther > end + step)) return farther;
            end = farther;
        }
    }

    /// A ball contains 0 and `limit * d` where dot(d, center) > min_along.
    struct Cap {
        std::uint32_t ball = 0;
        double min_along = 0;
    };

    const PlacedSolid &a_, &b_;
    // Balls: the centres, the radii, and the squared distances of 0 from the centres, less the squared radii.
    std::array<double, max_balls> x_, y_, z_, radius_, beyond_;
    std::size_t ball_count_ = 0;
    std::array<double, max_balls> from_, to_;  ///< the spans; empty for a ball that the line misses
    std::array<Cap, max_balls> caps_;
    std::size_t cap_count_ = 0;
    double limit_of_caps_ = 0;
    std::array<Ball, max_pairs> around_pairs_;
    std::array<TrianglePair, max_pairs> pairs_;
    std::size_t pair_count_ = 0, next_pair_ = 0;
    double min_distance_ = 0;
};

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
        is_fine_ = a_.triangle_count() + b_.triangle_count() > min_fine_triangles;
        if (!is_fine_) return;
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

    /// Of some triangles that cross at a distance along a direction, or a step farther on, those that part last. Of
    /// fine solids all are tested, and only those that part last are added to the cover: slivers about one corner cross
    /// in thousands of pairs, most of which part at once.
    Crossing crossing_at(const DVec<3>& direction, double distance, double limit) {
        Crossing result;
        int crossing_count = 0;
        std::optional<std::array<std::uint32_t, 2>> last;
        double last_to = 0;
        each_triangle_pair(
            a_, b_.moved(direction * distance), static_cast<float>(2 * step_),
            [&](std::uint32_t index_a, const Corners& a, std::uint32_t index_b, const Corners& b) {
                SlideInterval slide;
                if (!slide_interval(a, b, direction, {step_, 2 * step_}, slide)) return true;
                if (slide.from < -step_ && !is_fine_) cover_.add_pair(index_a, index_b);
                if (slide.from < -step_ && is_fine_ && slide.to > last_to) {
                    last = {index_a, index_b};
                    last_to = slide.to;
                }
                if (!result.found || distance + slide.to > result.to)
                    result = {true, distance + slide.from, distance + slide.to, slide.exit_normal};
                return result.to < limit && (is_fine_ || ++crossing_count < max_crossings);
            },
            direction);
        if (last) cover_.add_pair((*last)[0], (*last)[1]);
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
    double step_ = 0;       ///< a distance that doesn't count
    bool is_fine_ = false;  ///< the two have many triangles
    TriedDirections tried_;
    int max_meets_ = 512;  ///< how many meets of planes are tried
};

}  // namespace

SeparatingMove separating_move(const View<3>& a, const View<3>& b) {
    return MoveSearch(a, b).find();
}

}  // namespace abut::detail
