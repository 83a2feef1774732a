// The translations at which the interiors overlap are an open set around 0, bounded by parts of planes: a face of one
// solid against a corner of the other, or an edge against an edge. The least move ends where such a plane is nearest,
// or, if both solids are concave there, where two or three of them meet.
//
// 1. Along directions spread evenly the set is left step by step: as long as some triangles cross, B moves to where
//    they part. Where none cross, the exact test decides whether the interiors still overlap.
// 2. From there the move slides over planes towards 0 until it can't become shorter: then it is the least one nearby.
// 3. Of the moves at which a feature touches a feature, those that part the solids are least ones, too. What surely
//    overlaps, by balls inside the solids and by pairs of triangles that cross, rules out nearly all of them.
// 4. The nearest moves to where planes meet, beginning with those of the triangles that cross at the start, find
//    pockets that no direction leads to.
// 5. Of coarse solids no move along the normal of a face is shorter.
//
// Every move that is taken has passed the exact test.

#include <abut/math/detail/next_float.hpp>
#include <abut/math/dvec.hpp>
#include <abut/query/detail/solid/interior_overlap.hpp>
#include <abut/query/detail/solid/move_cover.hpp>
#include <abut/query/detail/solid/separating_move.hpp>
#include <abut/query/detail/solid/slide_interval.hpp>
#include <abut/query/detail/solid/touching_moves.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace abut::detail {
namespace {

double extent_of(const Aabb3& box) {
    return length(DVec<3>(box.max) - DVec<3>(box.min));
}

/// The box and the places that it passes on a move.
Aabb3 swept(Aabb3 box, const DVec<3>& move) {
    for (int i = 0; i < 3; ++i) {
        if (move[i] < 0) box.min[i] = next_down(static_cast<float>(static_cast<double>(box.min[i]) + move[i]));
        if (move[i] > 0) box.max[i] = next_up(static_cast<float>(static_cast<double>(box.max[i]) + move[i]));
    }
    return box;
}

/// Whether the front of a triangle clearly faces a direction.
bool faces(const Corners& t, const DVec<3>& direction) {
    const DVec<3> normal = cross(t[1] - t[0], t[2] - t[0]);
    const double along = dot(normal, direction);
    return along > 0 && along * along > 1e-12 * length_squared(normal);
}

class MoveSearch : LeastMoveSearch {
public:
    MoveSearch(const View<3>& shape_a, const View<3>& shape_b) : a_(shape_a), b_(shape_b), cover_(a_, b_) {
        const double smaller = std::min(extent_of(a_.box()), extent_of(b_.box()));
        double farthest = 0;
        for (const Aabb3& box : {a_.box(), b_.box()})
            farthest = std::max({farthest, largest(DVec<3>(box.min)), largest(DVec<3>(box.max))});
        step_ = 1e-9 * smaller + 1e-14 * farthest;
        float_step_ = 0x1p-23 * farthest;
        is_fine_ = a_.triangle_count() + b_.triangle_count() > max_coarse_triangles;
        if (is_fine_) cover_.add_balls(shape_a, shape_b);
    }

    SeparatingMove find() {
        leave_box(a_.box(), b_.box());
        // First, as nothing slid: of moves that are equally long up to rounding the one along an axis is reported.
        for (int i = 0; i < 3; ++i)
            for (const double sign : {1.0, -1.0}) {
                const DVec<3> direction = axis<3>(i, sign);
                const Exit exit = exit_along(direction, limit());
                // With the step that an exit may have more, the floats may be other ones.
                if (exit.distance < limit() && !take(direction, exit.distance - 2 * step_))
                    take(direction, exit.distance);
            }
        each_spread_direction([&](const DVec<3>& direction, double longer) {
            if (is_done()) return;
            const double limit = best_distance_ * longer;
            const Exit exit = exit_along(direction, limit);
            if (exit.distance < limit) descend(direction * exit.distance, exit.normal);
        });
        each_touching_move(a_, b_,
                           {[&] { return is_done() ? 0 : best_distance_; },
                            [&](const DVec<3>& first, const DVec<3>& last) {
                                return cover_.end_of_balls_between(first, last, best_distance_);
                            },
                            [&](const DVec<3>& direction, double distance) { try_move(direction, distance); }});
        if (!is_done()) search_meets(max_meets, step_);
        if (!is_fine_) {
            leave_along_normals(a_, 1);
            leave_along_normals(b_, -1);
        }
        return best_;
    }

private:
    struct Crossing {
        bool found = false;
        double from = 0, to = 0;
        DVec<3> normal{0.0};
    };
    /// Where triangles begin to cross, and the normal of the plane, in front of which they don't.
    struct Entry {
        double distance = 0;
        DVec<3> normal{0.0};
    };

    /// Visits the directions to 98 points spread over the surface of a cube, each with the length, relative to the best
    /// move, up to which an exit along it counts. It may still become shorter than the best.
    template <class Visit>
    static void each_spread_direction(const Visit& visit) {
        for (const int squared : {4, 8, 12, 5, 6, 9})
            for (int i = 0; i < 125; ++i) {
                const DVec<3> point(i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2);
                if (largest(point) == 2 && length_squared(point) == squared)
                    visit(normalized<3>(point), squared % 4 == 0 ? 1.25 : 1);
            }
    }

    /// Whether the best move is the least, or no more may be tested.
    bool is_done() const { return tests_ >= max_tests || best_distance_ <= cover_.min_distance() * (1 + 1e-5); }

    /// Moves B along the normals of a solid's faces. `sign` is that of the normal in the move.
    void leave_along_normals(const PlacedSolid& solid, double sign) {
        DVec<3> last(0.0);
        for (std::uint32_t i = 0; i < solid.triangle_count() && !is_done(); ++i) {
            const Corners t = solid.corners(i);
            const DVec<3> normal = normalized<3>(cross(t[1] - t[0], t[2] - t[0])) * sign;
            if (normal == last) continue;
            last = normal;
            const Exit exit = exit_along(normal, limit());
            if (exit.distance < limit()) take(normal, exit.distance);
        }
    }

    void try_move(const DVec<3>& direction, double distance) {
        if (cover_.has_ball_at(direction * distance) || cover_.has_pair_at(direction, distance, step_)) return;
        const Crossing crossing = crossing_at(direction, distance, best_distance_, false);
        if (!crossing.found || crossing.from >= distance - step_) take(direction, distance);
    }

    bool parts(const DVec<3>& move) const override {
        return !cover_.has_ball_at(move) && !interiors_overlap(a_, b_.moved(move), move);
    }

    bool may_improve(const DVec<3>& direction) override {
        return cover_.end_of_balls_between(direction, direction, limit()) < limit();
    }

    Exit exit_along(const DVec<3>& direction, double limit) override {
        Exit exit;
        double distance = 0;
        for (int i = 0; i < 256; ++i) {
            cover_.leave(direction, step_, limit, distance, exit.normal);
            if (distance >= limit) break;
            const Crossing crossing = crossing_at(direction, distance, limit, is_fine_);
            if (crossing.found && crossing.from < distance - step_) {
                distance = crossing.to;
                exit.normal = crossing.normal;
                continue;
            }
            // A step farther on nothing is flush, which takes long to decide; but there may be no room.
            const double parted = crossing.found ? distance : distance + 2 * step_;
            if (parts(direction * parted)) {
                exit.distance = parted;
                return exit;
            }
            if (crossing.found) {
                distance = crossing.to;
                exit.normal = crossing.normal;
                continue;
            }
            distance = parted;
            // One solid is inside the other, or they are flush.
            const Entry entry = first_entry(b_.moved(direction * distance), direction, limit - distance, false);
            distance += std::max(entry.distance, step_);
        }
        return exit;
    }

    /// Shortens a move that parts the solids, in front of a plane unless the normal is 0, and takes it.
    void descend(DVec<3> move, const DVec<3>& normal) {
        MeetOfPlanes planes;
        const auto stay_in_front = [&](const DVec<3>& of) {
            const std::optional<MeetOfPlanes> next = with_plane(planes, {of, dot(of, move)});
            if (next) planes = *next;
            return next.has_value();
        };
        if (normal != DVec<3>(0.0)) stay_in_front(normal);
        for (int i = 0; i < max_slides; ++i) {
            const DVec<3> way = planes.move - move;
            const double far = length(way);
            if (!(far > 4 * step_)) break;
            const DVec<3> direction = way / far;
            const Entry entry = first_entry_from(move, direction, far);
            const double distance = std::max(entry.distance - 2 * step_, 0.0);
            move += direction * distance;
            if (distance > 8 * step_) planes = {};
            if (entry.distance < far && !stay_in_front(entry.normal)) break;
        }
        // As floats the move may be behind one of the planes.
        for (const double farther : {0.0, 1.0, 4.0}) {
            if (farther > 0) move = farther_by(planes, farther * 0x1p-23 * length(move)).move;
            const double distance = length(move);
            if (!(distance > 0 && distance < limit()) || take(move / distance, distance)) return;
        }
    }

    /// Where triangles begin to cross on the way from a move that parts the solids.
    Entry first_entry_from(const DVec<3>& move, const DVec<3>& direction, double reach) const {
        const PlacedSolid moved = b_.moved(move);
        // Near first, as most ways end soon.
        for (double span = reach / 64; span < reach; span *= 8) {
            const Entry entry = first_entry(moved, direction, span, true);
            if (entry.distance < span) return entry;
        }
        return first_entry(moved, direction, reach, true);
    }

    /// Where triangles begin to cross as B moves on; as far as `reach` if they don't.
    Entry first_entry(const PlacedSolid& moved, const DVec<3>& direction, double reach, bool from_outside) const {
        Entry entry{reach, DVec<3>(0.0)};
        const bool is_a_outer = !a_.has_tree() || moved.has_tree();
        const PlacedSolid &outer = is_a_outer ? a_ : moved, &inner = is_a_outer ? moved : a_;
        const DVec<3> of_inner = is_a_outer ? direction : -direction;
        outer.each_triangle(swept(inner.box(), of_inner * reach), [&](std::uint32_t index) {
            const Corners t = outer.corners(index);
            if (from_outside && faces(t, of_inner)) return true;
            inner.each_triangle(swept(box_of(t), of_inner * -entry.distance), [&](std::uint32_t other_index) {
                if (++tests_ >= max_tests) return false;
                const Corners other = inner.corners(other_index);
                if (from_outside && faces(other, -of_inner)) return true;
                // Where they begin to cross is where they part on the way back.
                SlideInterval slide;
                if (slide_interval(is_a_outer ? t : other, is_a_outer ? other : t, -direction,
                                   {-step_, -entry.distance}, slide) &&
                    slide.to < step_)
                    entry = {std::max(-slide.to, 0.0), slide.exit_normal};
                return true;
            });
            return tests_ < max_tests;
        });
        return entry;
    }

    /// Of some triangles that cross at a distance along a direction, or a step farther on, those that part last. If
    /// thorough, all are tested, and only those that part last are added to the cover: slivers about one corner cross
    /// in thousands of pairs, most of which part at once. All that is known after too many tests is that they may cross
    /// as far as the limit.
    Crossing crossing_at(const DVec<3>& direction, double distance, double limit, bool thorough) {
        Crossing result;
        int crossing_count = 0;
        std::optional<std::array<std::uint32_t, 2>> last;
        double last_to = 0;
        each_triangle_pair(
            a_, b_.moved(direction * distance), static_cast<float>(2 * step_),
            [&](std::uint32_t index_a, const Corners& a, std::uint32_t index_b, const Corners& b) {
                if (++tests_ >= max_tests) {
                    result = {true, 0, limit, DVec<3>(0.0)};
                    return false;
                }
                SlideInterval slide;
                if (!slide_interval(a, b, direction, {step_, 2 * step_}, slide)) return true;
                if (slide.from < -step_ && !thorough) cover_.add_pair(index_a, index_b);
                if (slide.from < -step_ && thorough && slide.to > last_to) {
                    last = {index_a, index_b};
                    last_to = slide.to;
                }
                if (!result.found || distance + slide.to > result.to)
                    result = {true, distance + slide.from, distance + slide.to, slide.exit_normal};
                return result.to < limit && (thorough || ++crossing_count < max_crossings);
            },
            direction);
        if (last) cover_.add_pair((*last)[0], (*last)[1]);
        return result;
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

    /// Beyond this number of tests of two triangles the best move so far is the answer. Solids of 10,000 triangles that
    /// aren't slivers take fewer.
    static constexpr std::uint32_t max_tests = 1u << 23u;
    static constexpr int max_slides = 64, max_crossings = 4, max_meets = 8;
    /// Solids of up to so many triangles together have so few features that balls don't pay.
    static constexpr std::uint32_t max_coarse_triangles = 256;

    PlacedSolid a_, b_;
    MoveCover cover_;
    double step_ = 0;       ///< a distance that doesn't count
    bool is_fine_ = false;  ///< the two have many triangles
    mutable std::uint32_t tests_ = 0;
};

}  // namespace

SeparatingMove separating_move(const View<3>& a, const View<3>& b) {
    return MoveSearch(a, b).find();
}

}  // namespace abut::detail
