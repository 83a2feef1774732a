// The closest point of a simplex: known answers, and brute force over many weights.

#include "../../oracle/random.hpp"
#include <abut/convex/gjk/simplex.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

template <int D>
Simplex<D> simplex_of(std::initializer_list<DVec<D>> positions) {
    Simplex<D> simplex;
    for (const DVec<D>& position : positions)
        simplex.points[simplex.count++] = {position, position, DVec<D>(0.0), static_cast<std::uint32_t>(simplex.count),
                                           0};
    return simplex;
}

TEST(Simplex, KeepsTheCornerThatIsClosest) {
    auto simplex = simplex_of<3>({{1, 1, 0}, {2, 5, 0}, {5, 2, 1}});
    EXPECT_EQ(reduce_to_closest(simplex), DVec<3>(1, 1, 0));
    EXPECT_EQ(simplex.count, 1u);
}

TEST(Simplex, KeepsTheEdgeThatIsClosest) {
    auto simplex = simplex_of<2>({{-1, 2}, {3, 2}, {0, 9}});
    EXPECT_EQ(reduce_to_closest(simplex), DVec<2>(0, 2));
    ASSERT_EQ(simplex.count, 2u);
    EXPECT_DOUBLE_EQ(simplex.weights[0], 0.75);
    EXPECT_DOUBLE_EQ(simplex.weights[1], 0.25);
}

TEST(Simplex, KeepsTheFaceThatIsClosest) {
    auto simplex = simplex_of<3>({{3, 0, 2}, {-3, 3, 2}, {-3, -3, 2}, {0, 0, 8}});
    EXPECT_EQ(reduce_to_closest(simplex), DVec<3>(0, 0, 2));
    ASSERT_EQ(simplex.count, 3u);
    EXPECT_DOUBLE_EQ(simplex.weights[0], 0.5);
    EXPECT_DOUBLE_EQ(simplex.weights[1] + simplex.weights[2], 0.5);
}

TEST(Simplex, StaysWholeAroundTheOrigin) {
    auto triangle = simplex_of<2>({{1, -1}, {0, 1}, {-1, -1}});
    reduce_to_closest(triangle);
    EXPECT_EQ(triangle.count, 3u);
    auto tetrahedron = simplex_of<3>({{4, 0, -1}, {-4, 4, -1}, {-4, -4, -1}, {0, 0, 3}});
    EXPECT_EQ(reduce_to_closest(tetrahedron), DVec<3>(0, 0, 0));
    ASSERT_EQ(tetrahedron.count, 4u);
    EXPECT_LT(length(tetrahedron.combine(&DifferencePoint<3>::position)), 1e-15);
    EXPECT_DOUBLE_EQ(tetrahedron.weights[3], 0.25);
}

TEST(Simplex, OfFlatPiecesIsStillAnswered) {
    // Four coplanar points, three collinear ones, all equal.
    auto flat = simplex_of<3>({{1, 0, 1}, {-1, 1, 1}, {-1, -1, 1}, {-2, 0, 1}});
    EXPECT_LT(length(reduce_to_closest(flat) - DVec<3>(0, 0, 1)), 1e-15);
    EXPECT_LE(flat.count, 3u);
    auto row = simplex_of<3>({{-1, 2, 0}, {1, 2, 0}, {3, 2, 0}});
    EXPECT_LT(length(reduce_to_closest(row) - DVec<3>(0, 2, 0)), 1e-15);
    auto same = simplex_of<3>({{1, 2, 2}, {1, 2, 2}, {1, 2, 2}, {1, 2, 2}});
    EXPECT_EQ(reduce_to_closest(same), DVec<3>(1, 2, 2));
}

/// The least length over many combinations of weights.
double min_over_weights(const Simplex<3>& simplex) {
    double least = std::numeric_limits<double>::infinity();
    constexpr int steps = 40;
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; i + j <= steps; ++j)
            for (int k = 0; i + j + k <= steps; ++k) {
                const double weights[4] = {i / 40.0, j / 40.0, k / 40.0, (steps - i - j - k) / 40.0};
                DVec<3> point(0.0);
                for (std::size_t corner = 0; corner < 4; ++corner)
                    point += simplex.points[corner].position * weights[corner];
                least = std::min(least, length(point));
            }
    return least;
}

TEST(Simplex, OfRandomTetrahedraIsNoFartherThanAnyCombination) {
    int whole = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const DVec<3> shift = random.in_cube<3>() * 0.3;
        auto simplex = simplex_of<3>({random.in_cube<3>() + shift, random.in_cube<3>() + shift,
                                      random.in_cube<3>() + shift, random.in_cube<3>() + shift});
        const double least = min_over_weights(simplex);
        const DVec<3> closest = reduce_to_closest(simplex);
        EXPECT_LE(length(closest), least + 1e-12);
        EXPECT_GE(length(closest), least - 0.1);
        EXPECT_LT(length(closest - simplex.combine(&DifferencePoint<3>::position)), 1e-12);
        double sum = 0;
        for (std::size_t i = 0; i < simplex.count; ++i) {
            EXPECT_GE(simplex.weights[i], 0);
            sum += simplex.weights[i];
        }
        EXPECT_NEAR(sum, 1, 1e-14);
        whole += simplex.count == 4 ? 1 : 0;
    }
    EXPECT_GT(whole, 10);
}

TEST(Simplex, NearAFaceFindsTheClosestPoint) {
    const DVec<3> target(1, 1, 5);
    const auto simplex = simplex_of<3>({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
    const Simplex<3> face = closest_subsimplex({simplex.points[0], simplex.points[1], simplex.points[2]}, target);
    EXPECT_LT(length(face.combine(&DifferencePoint<3>::position) - DVec<3>(1, 1, 0)), 1e-15);
    EXPECT_LT(length(face.combine(&DifferencePoint<3>::on_a) - DVec<3>(1, 1, 0)), 1e-15);
}

TEST(Simplex, OfANeedleKnowsItsWeights) {
    // 36 long and 3e-4 wide: weights from volumes alone led to a point 1e-5 beside the origin, which was taken for
    // outside. The expected weights are from rational numbers.
    Simplex<3> simplex;
    for (const DVec<3>& p : {DVec<3>(1.8535382801015869, 17.776018479940966, -3.6774544660502864),
                             DVec<3>(-1.8064386701057733, -17.325371928003758, 3.5840265421671118),
                             DVec<3>(-0.4537176929581731, -4.3489906809527792, 0.89975178248499543),
                             DVec<3>(1.4168627629357806, 13.585752712852226, -2.8103287450518089)})
        simplex.points[simplex.count++] = {p, p, DVec<3>(0.0), 0, 0};
    EXPECT_EQ(reduce_to_closest(simplex), DVec<3>(0.0));
    ASSERT_EQ(simplex.count, 4u);
    const double expected[] = {0.22684032243346897, 0.289288430358481, 0.31191097077554275, 0.17196027643250733};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(simplex.weights[i], expected[i], 1e-8);
    EXPECT_LT(length(simplex.combine(&DifferencePoint<3>::position)), 1e-14);
}

}  // namespace
}  // namespace abut
