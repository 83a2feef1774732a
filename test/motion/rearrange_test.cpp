// Plans from one arrangement to another: every plan is executed step by step, with a check of all distances.

#include "arrangements.hpp"
#include <abut/motion/order/projection.hpp>
#include <abut/motion/rearrange.hpp>
#include <abut/query/closest.hpp>

#include <numeric>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

/// Executes the moves, and checks at samples of each move the distance of the moved shape to all others.
template <int D>
void expect_carried_out(std::span<const Convex<D>> shapes, std::vector<Pose<D>> poses, const std::vector<Pose<D>>& to,
                        const Rearrangement<D>& plan, const std::string& where, int moments = 9) {
    ASSERT_TRUE(plan) << where;
    std::vector<Convex<D>> placed;
    for (std::size_t i = 0; i < shapes.size(); ++i) placed.push_back(moved(shapes[i], affine(poses[i])));
    for (const Move<D>& move : plan.moves) {
        ASSERT_EQ(move.from, poses[move.shape]) << where;
        const bool turns = move.from.rotation != move.to.rotation;
        ASSERT_TRUE(!turns || move.from.position == move.to.position) << "it moves and turns at once; " << where;
        for (int k = 0; k <= moments; ++k) {
            const double part = static_cast<double>(k) / static_cast<double>(moments);
            Pose<D> between{to_float(DVec<D>(move.from.position) * (1 - part) + DVec<D>(move.to.position) * part),
                            move.to.rotation};
            if (turns && k < moments) {
                oracle::Random random(static_cast<std::uint64_t>(k));
                between.rotation = random.rotation<D>();
            }
            const Convex<D> mover = moved(shapes[move.shape], affine(between));
            for (std::uint32_t j = 0; j < placed.size(); ++j) {
                if (j == move.shape || !overlaps(bounds(mover), bounds(placed[j]))) continue;
                ASSERT_GE(static_cast<double>(closest(mover, placed[j]).distance), -3 * tolerance_for(mover, placed[j]))
                    << move.shape << " runs into " << j << ", " << where;
            }
        }
        poses[move.shape] = move.to;
        placed[move.shape] = moved(shapes[move.shape], affine(move.to));
    }
    ASSERT_EQ(poses, to) << where;
}

std::vector<Pose2> places(const std::vector<Vec2>& positions) {
    std::vector<Pose2> result;
    for (const Vec2& position : positions) result.push_back({position});
    return result;
}

template <int D, class S>
std::vector<Convex<D>> views_of(const std::vector<S>& shapes) {
    std::vector<Convex<D>> result;
    for (const S& shape : shapes) result.push_back(view(shape));
    return result;
}

const Box2 unit_box{{0, 0}, {0.5f, 0.5f}};

TEST(Rearrange, WhatStandsRightStays) {
    const std::vector<Box2> boxes(3, unit_box);
    const auto here = places({{0, 0}, {1, 0}, {2, 0}});
    const auto plan = rearrange(boxes, here, here);
    EXPECT_TRUE(plan);
    EXPECT_TRUE(plan.moves.empty());
    EXPECT_TRUE(rearrange(std::vector<Box2>{}, {}, {}).moves.empty());
}

TEST(Rearrange, WhatCanGoStraightDoes) {
    // In a row, each shape moves one place on, starting with the last.
    const std::vector<Box2> boxes(3, unit_box);
    const auto from = places({{0, 0}, {1, 0}, {2, 0}}), to = places({{1, 0}, {2, 0}, {3, 0}});
    const auto plan = rearrange(boxes, from, to);
    ASSERT_EQ(plan.moves.size(), 3u);
    EXPECT_EQ(plan.moves[0].shape, 2u);
    EXPECT_EQ(plan.moves[2].shape, 0u);
    expect_carried_out<2>(views_of<2>(boxes), from, to, plan, "a row");
}

TEST(Rearrange, TwoChangePlacesAndTheirNeighboursStay) {
    const std::vector<Box2> boxes(4, unit_box);
    const auto from = places({{0, 0}, {1, 0}, {2, 0}, {3, 0}}), to = places({{0, 0}, {2, 0}, {1, 0}, {3, 0}});
    const auto plan = rearrange(boxes, from, to);
    expect_carried_out<2>(views_of<2>(boxes), from, to, plan, "a row");
    for (const Move<2>& move : plan.moves) EXPECT_TRUE(move.shape == 1 || move.shape == 2);
    EXPECT_LE(plan.moves.size(), 8u);
}

TEST(Rearrange, WhatLiesOnTopIsLiftedAndPutBack) {
    const std::vector<Box2> boxes(3, unit_box);
    const auto from = places({{0, 0}, {0, 1}, {0, 2}}), to = places({{0, 1}, {0, 0}, {0, 2}});
    const auto plan = rearrange(boxes, from, to);
    expect_carried_out<2>(views_of<2>(boxes), from, to, plan, "a stack");
    EXPECT_TRUE(std::any_of(plan.moves.begin(), plan.moves.end(), [](const Move<2>& move) { return move.shape == 2; }));
}

/// The pieces of a square, each around its own center, with their poses in the square.
struct Puzzle {
    std::vector<Polygon> pieces;
    std::vector<Pose2> solved;
};
Puzzle make_puzzle(oracle::Random& random, int cuts, double size) {
    test::Things<2> whole;
    cut_up(whole, random, {{-size, -size}, {size, -size}, {size, size}, {-size, size}}, cuts, {});
    Puzzle puzzle;
    for (const Convex<2>& piece : whole.views()) {
        const std::span<const Vec2> corners(piece.vertices(), piece.count);
        const Vec2 middle = center(bounds(piece));
        std::vector<Vec2> own;
        for (const Vec2& corner : corners) own.push_back(corner - middle);
        puzzle.pieces.push_back(*Polygon::build(own));
        puzzle.solved.push_back({middle});
    }
    return puzzle;
}
/// Each piece in a cell of its own, rotated or not, in random order.
std::vector<Pose2> spread_out(oracle::Random& random, std::size_t count, double size, bool turned) {
    std::vector<std::size_t> cells(count);
    std::iota(cells.begin(), cells.end(), 0u);
    for (std::size_t i = count; i > 1; --i) std::swap(cells[i - 1], cells[random.below(static_cast<std::uint32_t>(i))]);
    std::vector<Pose2> result;
    for (const std::size_t cell : cells) {
        const DVec<2> place(static_cast<double>(cell % 8), static_cast<double>(cell / 8));
        result.push_back({to_float(place * (2.9 * size)), turned ? random.rotation<2>() : Turn{}});
    }
    return result;
}

TEST(Rearrange, PuzzlesAreTakenApartAndPutTogether) {
    constexpr std::uint64_t seed = 81;
    oracle::Random random(seed);
    std::size_t moves = 0, pieces = 0;
    for (int repeat = 0; repeat < 500; ++repeat) {
        const double size = random.power_of_two(-6, 8);
        const Puzzle puzzle = make_puzzle(random, 1 + static_cast<int>(random.below(4)), size);
        const auto loose = spread_out(random, puzzle.pieces.size(), size, random.chance(0.7));
        const RearrangeOptions<2> options{.away = random.chance(0.5) ? Vec2(0, 1) : Vec2(random.direction<2>())};
        const std::string where = "seed " + std::to_string(seed) + ", repeat " + std::to_string(repeat);
        const auto views = views_of<2>(puzzle.pieces);
        const auto together = rearrange(puzzle.pieces, loose, puzzle.solved, options);
        expect_carried_out<2>(views, loose, puzzle.solved, together, where + ", together");
        const auto apart = rearrange(puzzle.pieces, puzzle.solved, loose, options);
        expect_carried_out<2>(views, puzzle.solved, loose, apart, where + ", apart");
        moves += together.moves.size();
        pieces += puzzle.pieces.size();
        if (HasFatalFailure()) return;
    }
    EXPECT_GT(moves, pieces);
    EXPECT_LE(moves, 5 * pieces);
}

TEST(Rearrange, EqualThingsThatTouchChangePlaces) {
    constexpr std::uint64_t seed = 82;
    oracle::Random random(seed);
    for (int repeat = 0; repeat < 500; ++repeat) {
        test::Things<2> things;
        std::vector<Pose2> from;
        const std::uint32_t columns = 2 + random.below(3);
        for (std::uint32_t i = 0; i < columns * columns; ++i) {
            if (random.chance(0.3))
                things.add(Circle{{0, 0}, 0.5f});
            else
                things.add(unit_box);
            from.push_back({{static_cast<float>(i % columns), static_cast<float>(i / columns)}});
        }
        std::vector<Pose2> to = from;
        for (std::size_t i = to.size(); i > 1; --i)
            std::swap(to[i - 1], to[random.below(static_cast<std::uint32_t>(i))]);
        const auto plan = rearrange<2>(things.views(), from, to);
        expect_carried_out<2>(things.views(), from, to, plan, "seed 82, repeat " + std::to_string(repeat));
        if (HasFatalFailure()) return;
    }
}

TEST(Rearrange, AThousandPieces) {
    oracle::Random random(83);
    const Puzzle puzzle = make_puzzle(random, 10, 10);
    ASSERT_EQ(puzzle.pieces.size(), 1024u);
    std::vector<Pose2> loose = spread_out(random, puzzle.pieces.size(), 4, false);
    const auto plan = rearrange(puzzle.pieces, loose, puzzle.solved);
    expect_carried_out<2>(views_of<2>(puzzle.pieces), loose, puzzle.solved, plan, "seed 83", 3);
}

// --- in space -----------------------------------------------------------------------------------------------------

TEST(Rearrange, BallsAndBoxesInSpace) {
    constexpr std::uint64_t seed = 84;
    oracle::Random random(seed);
    for (int repeat = 0; repeat < 200; ++repeat) {
        test::Things<3> things;
        std::vector<Pose3> from, to;
        for (int i = 0; i < 18; ++i) {
            if (random.chance(0.3))
                things.add(Sphere{Vec3(0), 0.5f});
            else
                things.add(Box3{Vec3(0), Vec3(0.5f)});
            from.push_back({Vec3(i % 3, i / 3 % 3, i / 9)});
        }
        to = from;
        for (std::size_t i = to.size(); i > 1; --i)
            std::swap(to[i - 1], to[random.below(static_cast<std::uint32_t>(i))]);
        for (Pose3& pose : to) {
            const bool turned = random.chance(0.5);
            pose.position = pose.position * 2.0f + Vec3(1, 1, 0);
            if (turned) pose.rotation = random.rotation<3>();
        }
        const auto plan = rearrange<3>(things.views(), from, to);
        expect_carried_out<3>(things.views(), from, to, plan, "seed 84, repeat " + std::to_string(repeat));
        if (HasFatalFailure()) return;
    }
}

TEST(Rearrange, GoesAlongAnAxisIfBlockedInOtherDirections) {
    const std::vector<Aabb3> sticks = test::three_sticks();
    const std::vector<Pose3> from(3), to{{Vec3(20, 0, 0)}, {Vec3(-20, 0, 0)}, {Vec3(0, 20, 20)}};
    EXPECT_FALSE(removal_order(sticks, {1, 1, 1}));
    const auto plan = rearrange(sticks, from, to, {.away = Vec3(1, 1, 1)});
    expect_carried_out<3>(views_of<3>(sticks), from, to, plan, "along an axis");
}

/// One group of sticks, rotated so that an axis is its diagonal, blocks one axis. Three groups of different rotations
/// block all axes.
TEST(Rearrange, NamesWhatIsStuckInSpace) {
    std::vector<Convex<3>> shapes;
    std::vector<Pose3> from, to;
    const std::vector<Aabb3> sticks = test::three_sticks();
    // The rotation that takes (1, 1, 1) to an axis: about their cross product, by the angle between them.
    const float angle = 0.95531662f;
    const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int group = 0; group < 3; ++group) {
        const DVec<3> about = normalized(cross(DVec<3>(1.0), DVec<3>(axes[group])));
        const glm::quat rotation = turn_about(to_float(about), angle);
        EXPECT_NEAR(length(DVec<3>(rotate(rotation, Vec3(1))) - DVec<3>(axes[group]) * std::sqrt(3.0)), 0, 1e-6);
        for (const Aabb3& stick : sticks) {
            shapes.push_back(view(stick));
            from.push_back({axes[group] * 30.0f, rotation});
            to.push_back({axes[group] * -30.0f, glm::quat(1, 0, 0, 0)});
        }
    }
    auto plan = rearrange<3>(std::span<const Convex<3>>(shapes), from, to, {.away = Vec3(1, 0, 0)});
    std::sort(plan.stuck.begin(), plan.stuck.end());
    EXPECT_FALSE(plan);
    EXPECT_TRUE(plan.moves.empty());
    EXPECT_EQ(plan.stuck, (std::vector<std::uint32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace abut
