// The nearest move that planes allow, against a test of all subsets of planes, and in very narrow corners.

#include "../oracle/random.hpp"
#include <abut/motion/push/plane_solver.hpp>

#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;

constexpr std::uint64_t seed = 20260722;

template <int D>
bool is_allowed(const std::vector<MovePlane<D>>& planes, const DVec<D>& move, double tolerance) {
    for (const MovePlane<D>& plane : planes)
        if (dot(plane.normal, move) < -plane.clearance - tolerance) return false;
    return true;
}

/// The reference: the nearest allowed move among the projections onto all subsets of up to D planes.
template <int D>
DVec<D> nearest_by_trying(const std::vector<MovePlane<D>>& planes, const DVec<D>& wanted) {
    DVec<D> best(0.0);
    double min_distance = std::numeric_limits<double>::infinity();
    for (std::uint32_t chosen = 0; chosen < 1u << planes.size(); ++chosen) {
        std::vector<MovePlane<D>> in;
        for (std::size_t i = 0; i < planes.size(); ++i)
            if ((chosen >> i & 1u) != 0) in.push_back(planes[i]);
        if (in.size() > D) continue;
        // move = wanted + sum of f_i n_i, with dot(n_j, move) = -room_j: by elimination.
        std::vector<std::vector<double>> rows;
        for (const MovePlane<D>& plane : in) {
            std::vector<double> row;
            for (const MovePlane<D>& other : in) row.push_back(dot(plane.normal, other.normal));
            row.push_back(-plane.clearance - dot(plane.normal, wanted));
            rows.push_back(row);
        }
        bool regular = true;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            regular = regular && std::abs(rows[i][i]) > 1e-9;
            for (std::size_t j = 0; regular && j < rows.size(); ++j)
                if (j != i) {
                    const double factor = rows[j][i] / rows[i][i];
                    for (std::size_t k = 0; k < rows[i].size(); ++k) rows[j][k] -= factor * rows[i][k];
                }
        }
        if (!regular) continue;
        DVec<D> move = wanted;
        for (std::size_t i = 0; i < rows.size(); ++i) move += in[i].normal * (rows[i].back() / rows[i][i]);
        if (!is_allowed<D>(planes, move, 1e-7) || length(move - wanted) >= min_distance) continue;
        min_distance = length(move - wanted);
        best = move;
    }
    return best;
}

template <int D>
void compare_with_trying() {
    Random random(seed);
    int blocked = 0;
    for (int i = 0; i < 2000; ++i) {
        std::vector<MovePlane<D>> planes(1 + random.below(6));
        for (MovePlane<D>& plane : planes)
            plane = {random.direction<D>(), random.chance(0.5) ? 0 : random.uniform(0, 0.5)};
        const DVec<D> wanted = random.in_cube<D>() * 2.0;
        DVec<D> move(0.0);
        ASSERT_TRUE(nearest_move<D>(planes, wanted, 1e-12, move)) << i;
        EXPECT_TRUE(is_allowed<D>(planes, move, 1e-9)) << i;
        EXPECT_LE(length(move), length(wanted) + 1e-9) << i;
        EXPECT_LT(length(move - nearest_by_trying<D>(planes, wanted)), 1e-5) << i;
        blocked += length(move - wanted) > 1e-9 ? 1 : 0;
    }
    EXPECT_GT(blocked, 600);
    EXPECT_LT(blocked, 1950);
}
TEST(PlaneSolver, AgreesWithTryingAllInThePlane) {
    compare_with_trying<2>();
}
TEST(PlaneSolver, AgreesWithTryingAllInSpace) {
    compare_with_trying<3>();
}

TEST(PlaneSolver, PushesOutOfAll) {
    const std::vector<MovePlane<2>> planes{{{1, 0}, -0.3}, {{0, 1}, -0.4}};
    DVec<2> move(0.0);
    ASSERT_TRUE(nearest_move<2>(planes, {0, 0}, 1e-12, move));
    EXPECT_DOUBLE_EQ(move.x, 0.3);
    EXPECT_DOUBLE_EQ(move.y, 0.4);
}

TEST(PlaneSolver, ReportsThatThereIsNoSolution) {
    DVec<2> move(0.0);
    const std::vector<MovePlane<2>> opposite{{{1, 0}, -0.3}, {{-1, 0}, -0.3}};
    EXPECT_FALSE(nearest_move<2>(opposite, {0, 0}, 1e-12, move));
    const std::vector<MovePlane<2>> around{{{0, 1}, -1}, {{0.8660254, -0.5}, -1}, {{-0.8660254, -0.5}, -1}};
    EXPECT_FALSE(nearest_move<2>(around, {0, 0}, 1e-12, move));
    const std::vector<MovePlane<2>> both{{{0, 1}, 0}, {{0, -1}, 0}};
    ASSERT_TRUE(nearest_move<2>(both, {3, 4}, 1e-12, move));
    EXPECT_NEAR(move.x, 3, 1e-9);
    EXPECT_NEAR(move.y, 0, 1e-9);
}

}  // namespace
}  // namespace abut
