// Poses from matrices: round trips of random poses, rounding, and refused matrices.

#include "../oracle/random.hpp"
#include <abut/math/dvec.hpp>
#include <abut/math/pose_from_matrix.hpp>

#include <limits>
#include <string>

#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

glm::mat3 matrix_of(const Pose2& pose) {
    const Turn& t = pose.rotation;
    return {{t.cos, t.sin, 0}, {-t.sin, t.cos, 0}, {pose.position.x, pose.position.y, 1}};
}
glm::mat4 matrix_of(const Pose3& pose) {
    glm::mat4 result = glm::mat4_cast(pose.rotation);
    result[3] = {pose.position, 1};
    return result;
}

double norm(const Turn& t) {
    return std::hypot(static_cast<double>(t.cos), static_cast<double>(t.sin));
}
double norm(const glm::quat& q) {
    return std::sqrt(static_cast<double>(q.w) * q.w + static_cast<double>(q.x) * q.x + static_cast<double>(q.y) * q.y +
                     static_cast<double>(q.z) * q.z);
}
double apart(const Turn& a, const Turn& b) {
    return std::hypot(static_cast<double>(a.cos - b.cos), static_cast<double>(a.sin - b.sin));
}
/// q and -q are equal rotations.
double apart(const glm::quat& a, const glm::quat& b) {
    return std::min(norm(glm::quat(a.w - b.w, a.x - b.x, a.y - b.y, a.z - b.z)),
                    norm(glm::quat(a.w + b.w, a.x + b.x, a.y + b.y, a.z + b.z)));
}

template <class Dimension>
class PoseFrom : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(PoseFrom, Dimensions);

TYPED_TEST(PoseFrom, MatrixOfAPoseIsThePose) {
    constexpr int D = TypeParam::value;
    oracle::Random random(1);
    for (const double extent : {0.0, 1.0, 1e4, 1e7})
        for (int i = 0; i < 2000; ++i) {
            const Pose<D> pose{to_float(random.in_cube<D>() * extent), random.rotation<D>()};
            const auto found = pose_from(matrix_of(pose));
            ASSERT_TRUE(found) << "seed 1, " << i << ": " << found.problem().message;
            ASSERT_EQ(found->position, pose.position) << "seed 1, " << i;
            ASSERT_LE(apart(found->rotation, pose.rotation), 3e-7) << "seed 1, " << i;
            ASSERT_NEAR(norm(found->rotation), 1, 1e-7) << "seed 1, " << i;
            if constexpr (D == 3) {
                ASSERT_GE(found->rotation.w, 0.0f) << "seed 1, " << i;
            }
        }
}

/// Products of many rotations drift, as a scene's nodes do: matrices with errors of up to 5e-5 are still near a
/// rotation.
TYPED_TEST(PoseFrom, RoundingIsAcceptedAndNormalised) {
    constexpr int D = TypeParam::value;
    oracle::Random random(2);
    for (int i = 0; i < 200; ++i) {
        auto product = matrix_of(Pose<D>{});
        Pose<D> pose;
        for (int k = 0; k < 50; ++k) {
            const Pose<D> each{to_float(random.in_cube<D>()), random.rotation<D>()};
            product = product * matrix_of(each);
            pose = pose * each;
        }
        const auto found = pose_from(product);
        ASSERT_TRUE(found) << "seed 2, " << i << ": " << found.problem().message;
        ASSERT_LE(apart(found->rotation, pose.rotation), 2e-5) << "seed 2, " << i;
        ASSERT_NEAR(norm(found->rotation), 1, 1e-7) << "seed 2, " << i;

        const Pose<D> true_pose{{}, random.rotation<D>()};
        auto noisy = matrix_of(true_pose);
        for (int c = 0; c < D; ++c)
            for (int r = 0; r < D; ++r) noisy[c][r] += random.uniform_float(-2e-5, 2e-5);
        const auto nearest = pose_from(noisy);
        ASSERT_TRUE(nearest) << "seed 2, " << i << ": " << nearest.problem().message;
        ASSERT_LE(apart(nearest->rotation, true_pose.rotation), 5e-5) << "seed 2, " << i;
        ASSERT_NEAR(norm(nearest->rotation), 1, 1e-7) << "seed 2, " << i;
    }
}

/// Half turns about many axes, where w is about 0.
TEST(PoseFromMatrix, HalfTurns) {
    oracle::Random random(3);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 axis = i < 3 ? to_float(abut::detail::axis<3>(i)) : to_float(random.direction<3>());
        const glm::quat turn = turn_about(axis, 3.14159265f + (i % 3 == 0 ? 0.0f : random.uniform_float(-1e-3, 1e-3)));
        const auto found = pose_from(matrix_of(Pose3{{}, turn}));
        ASSERT_TRUE(found) << "seed 3, " << i << ": " << found.problem().message;
        ASSERT_LE(apart(found->rotation, turn), 3e-7) << "seed 3, " << i;
    }
}

template <int D>
using MatrixOf = glm::mat<D + 1, D + 1, float>;

template <int D>
void expect_refused(const MatrixOf<D>& matrix, ProblemCode code, const std::string& word, std::size_t index) {
    const auto found = pose_from(matrix);
    ASSERT_FALSE(found) << word;
    EXPECT_EQ(found.problem().code, code) << word;
    EXPECT_NE(found.problem().message.find(word), std::string::npos) << found.problem().message;
    EXPECT_EQ(found.problem().index, index) << found.problem().message;
}

TYPED_TEST(PoseFrom, RefusesWhatIsNoPose) {
    constexpr int D = TypeParam::value;
    oracle::Random random(4);
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE("seed 4, " + std::to_string(i));
        const auto good = matrix_of(Pose<D>{to_float(random.in_cube<D>() * 100.0), random.rotation<D>()});
        const int axis = static_cast<int>(random.below(D)), other = (axis + 1) % D;
        const auto at = static_cast<std::size_t>(axis);
        const float factor = random.chance(0.5) ? random.uniform_float(1.001, 3) : random.uniform_float(0, 0.999);
        auto bad = good;
        bad[axis] *= factor;
        expect_refused<D>(bad, ProblemCode::bad_argument, "scales", at);
        for (int c = 0; c < D; ++c) bad[c] = good[c] * factor;
        expect_refused<D>(bad, ProblemCode::bad_argument, "scales", 0);
        bad = good;
        bad[axis] *= -1.0f;
        expect_refused<D>(bad, ProblemCode::bad_argument, "mirrors", 0);
        bad = good;
        const float lean = random.uniform_float(0.001, 0.9);
        bad[axis] = std::sqrt(1 - lean * lean) * good[axis] + lean * good[other];
        expect_refused<D>(bad, ProblemCode::bad_argument, "shears", static_cast<std::size_t>(std::max(axis, other)));
        bad = good;
        bad[axis][D] = random.chance(0.5) ? 1e-5f : -0.5f;
        expect_refused<D>(bad, ProblemCode::bad_argument, "projection", at);
        bad = good;
        bad[D][D] = factor;
        expect_refused<D>(bad, ProblemCode::bad_argument, "projection", D);
        const int column = static_cast<int>(random.below(D + 1)), row = static_cast<int>(random.below(D + 1));
        for (const float number : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                                   -std::numeric_limits<float>::infinity()}) {
            bad = good;
            bad[column][row] = number;
            expect_refused<D>(bad, ProblemCode::not_finite, "finite", static_cast<std::size_t>(column));
        }
    }
    expect_refused<D>(MatrixOf<D>(0.0f), ProblemCode::bad_argument, "projection", D);
    auto flat = matrix_of(Pose<D>{});
    flat[0] *= 0.0f;
    expect_refused<D>(flat, ProblemCode::bad_argument, "scales", 0);
    const float huge = std::numeric_limits<float>::max();
    expect_refused<D>(MatrixOf<D>(huge), ProblemCode::bad_argument, "projection", D);
    auto wide = matrix_of(Pose<D>{});
    wide[1] *= huge;
    expect_refused<D>(wide, ProblemCode::bad_argument, "scales", 1);
}

}  // namespace
}  // namespace abut::test
