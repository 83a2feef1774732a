#pragma once

// Walks of a Mover, with each frame checked by the oracle against all pieces of the level.

#include "../oracle/distance.hpp"
#include <abut/broad_phase/bvh.hpp>
#include <abut/motion/mover.hpp>
#include <abut/shape/capsule.hpp>

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {

using detail::dot;
using detail::DVec;
using detail::largest;
using detail::length;
using detail::normalized;
using detail::to_float;

/// The convex pieces of a level, with a tree of their boxes.
template <int D>
class Pieces {
public:
    void add(const oracle::Polytope<D>& piece) { pieces_.push_back(piece); }
    void build() {
        boxes_.clear();
        for (const oracle::Polytope<D>& piece : pieces_) boxes_.push_back(box_of(piece));
        tree_.build(boxes_);
    }

    /// The minimal signed distance to any piece, by the oracle; 1 if nothing is near.
    double distance(const oracle::Polytope<D>& shape) const {
        double result = 1;
        tree_.each_overlapping(box_of(shape), [&](std::uint32_t i) {
            result = std::min(result, oracle::truth(shape, pieces_[i], oracle::Arithmetic::floating_point).distance);
        });
        return result;
    }
    Aabb<D> bounds() const {
        Aabb<D> result = Aabb<D>::empty();
        for (const Aabb<D>& box : boxes_) result = merged(result, box);
        return result;
    }
    const Bvh<D>& tree() const { return tree_; }
    const oracle::Polytope<D>& operator[](std::uint32_t i) const { return pieces_[i]; }
    std::size_t size() const { return pieces_.size(); }

private:
    static Aabb<D> box_of(const oracle::Polytope<D>& piece) {
        Aabb<D> result = Aabb<D>::empty();
        for (const DVec<D>& corner : oracle::corners_relative_to(piece, DVec<D>(0.0))) {
            const Vec<D> point = to_float(corner);
            result = merged(result, Aabb<D>{point, point});
        }
        return grown(result, static_cast<float>(piece.radius) + 1e-3f);
    }

    std::vector<oracle::Polytope<D>> pieces_;
    std::vector<Aabb<D>> boxes_;
    Bvh<D> tree_;
};

/// A ball or capsule around its position, for the oracle and for the library.
template <int D>
struct Walking {
    Capsule<D> shape;

    oracle::Polytope<D> at(const Vec<D>& position) const {
        std::vector<Vec<D>> core{shape.a};
        if (shape.b != shape.a) core.push_back(shape.b);
        oracle::Polytope<D> result = oracle::hull_of<D>(core, static_cast<double>(shape.radius));
        result.place.offset = DVec<D>(position);
        return result;
    }
    double size() const { return 0.5 * length(DVec<D>(shape.b - shape.a)) + static_cast<double>(shape.radius); }
};

/// The measurements of walks.
struct Walked {
    long frames = 0, grounded = 0, touching = 0, crushed = 0, rests = 0;
    double deepest = 0;      ///< relative to the tolerance
    double restless = 0;     ///< the largest move of a resting mover, relative to the size
    double path_length = 0;  ///< the length of the path, in sizes
    std::string first_fault;
    long faults = 0;

    void fault(const std::string& what) {
        if (++faults <= 1) first_fault = what;
    }
};

template <int D>
std::string text_of(const Vec<D>& v) {
    std::string result;
    for (int i = 0; i < D; ++i) result += (i > 0 ? ", " : "") + std::to_string(v[i]);
    return '(' + result + ')';
}

/// A mover on a walk through a level, with a check of every frame.
template <int D>
class Walker {
public:
    Walker(const World<D>& world, const Pieces<D>& pieces, const Walking<D>& shape, const MoverOptions<D>& options,
           const Vec<D>& position, Walked& walked)
        : world_(world), pieces_(pieces), shape_(shape), mover_(options), position_(position), walked_(walked) {}

    const Vec<D>& position() const { return position_; }
    const Moved<D>& moved() const { return moved_; }
    void put(const Vec<D>& position) {
        position_ = position;
        was_free_ = false;
    }

    void go(const Vec<D>& motion) {
        const Vec<D> before = position_;
        moved_ = mover_.move(world_, shape_.shape, position_, motion);
        position_ = moved_.position;
        check_frame(before, motion);
    }

    /// A resting mover stays in place, to 1e-4 of its size.
    void rest(const Vec<D>& motion) {
        // A mover that has just landed may settle.
        int stands = 0;
        for (int i = 0; i < 100 && stands < 20; ++i) {
            go(motion);
            stands = moved_.grounded && !moved_.crushed ? stands + 1 : 0;
        }
        if (stands < 20) return;
        const Vec<D> from = position_;
        double max_move = 0;
        for (int i = 0; i < 20; ++i) {
            go(motion);
            max_move = std::max(max_move, length(DVec<D>(position_ - from)) / shape_.size());
        }
        ++walked_.rests;
        walked_.restless = std::max(walked_.restless, max_move);
        if (max_move > 1e-4) walked_.fault("doesn't rest at " + text_of<D>(from) + ", by " + std::to_string(max_move));
    }

private:
    void check_frame(const Vec<D>& before, const Vec<D>& motion) {
        ++walked_.frames;
        walked_.grounded += moved_.grounded ? 1 : 0;
        walked_.touching += moved_.touches.empty() ? 0 : 1;
        walked_.crushed += moved_.crushed ? 1 : 0;
        if (!detail::is_finite(position_) || !detail::is_finite(moved_.motion)) {
            position_ = before;
            return walked_.fault("isn't finite, from " + text_of<D>(before));
        }
        const double size = shape_.size(), rounding = 16 * 6e-8 * largest(DVec<D>(position_)) + 1e-5 * size;
        const DVec<D> gone = DVec<D>(position_) - DVec<D>(before) - DVec<D>(moved_.carried) - DVec<D>(moved_.pushed);
        const DVec<D> up = normalized(DVec<D>(mover_.options().up), DVec<D>(0.0));
        const double rise = dot(gone, up), requested = length(DVec<D>(motion));
        const double steps = static_cast<double>(std::max(mover_.options().step_height, mover_.options().stick));
        if (length(gone - up * rise) > requested + rounding)
            walked_.fault("goes too far, from " + text_of<D>(before) + " by " + text_of<D>(motion));
        if (std::abs(rise) > requested + (up == DVec<D>(0.0) ? 0 : steps) + rounding)
            walked_.fault("climbs or falls too far, from " + text_of<D>(before) + " by " + text_of<D>(motion));
        walked_.path_length += length(gone) / size;
        // The level is static: only a mover that started inside can be crushed.
        if (moved_.crushed && was_free_) walked_.fault("is crushed, from " + text_of<D>(before));
        was_free_ = !moved_.crushed;
        if (moved_.crushed) return;
        const double depth = -pieces_.distance(shape_.at(position_));
        walked_.deepest = std::max(walked_.deepest, depth / rounding);
        if (depth > rounding)
            walked_.fault("is in something by " + std::to_string(depth) + ", from " + text_of<D>(before) + " by " +
                          text_of<D>(motion));
        // A mover that reached its target moved straight.
        if (requested > size && length(gone - DVec<D>(motion)) < rounding &&
            length(DVec<D>(moved_.carried + moved_.pushed)) == 0) {
            Walking<D> start_to_end = shape_;
            if (start_to_end.shape.a == start_to_end.shape.b) {
                start_to_end.shape.a += before - position_;
                if (-pieces_.distance(start_to_end.at(position_)) > rounding)
                    walked_.fault("went through something, from " + text_of<D>(before) + " by " + text_of<D>(motion));
            }
        }
    }

    const World<D>& world_;
    const Pieces<D>& pieces_;
    Walking<D> shape_;
    Mover<D> mover_;
    Vec<D> position_;
    Moved<D> moved_{};
    bool was_free_ = false;
    Walked& walked_;
};

}  // namespace abut::test
