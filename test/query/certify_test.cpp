// Right answers have a certificate; deliberately wrong answers do not.

#include "../oracle/degenerate.hpp"
#include "../oracle/pair.hpp"
#include <abut/query/certify.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/mesh.hpp>

#include <limits>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

template <class T>
class Certify : public testing::Test {
protected:
    static constexpr int dimensions = T::value;

    /// Calls visit(a, b, random) for a random pair, or for a degenerate one if the seed is odd.
    template <class Visit>
    static void visit_pair(std::uint64_t seed, const Visit& visit) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        if (seed % 2 == 0) {
            const auto kind = [&] { return static_cast<oracle::Kind>(random.below(oracle::kind_count)); };
            const oracle::Kind kind_a = kind(), kind_b = kind();
            const auto pair = oracle::random_pair<dimensions>(random, kind_a, kind_b);
            visit(pair.a.view, pair.b.view, random);
        } else {
            const auto disturbance = static_cast<oracle::Perturbation>(random.below(oracle::perturbation_count));
            oracle::LatticeGenerator<dimensions> maker(random, disturbance);
            const auto a = maker.make(), b = maker.make();
            visit(a.view, b.view, random);
        }
    }
    template <class Visit>
    static void each_pair(const Visit& visit) {
        for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(oracle::case_count(4000)); ++seed)
            visit_pair(seed, visit);
        // In space, the point on a segment in the plane of a box's face was 8 beyond its end.
        visit_pair(226767, visit);
    }
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Certify, Dimensions);

TYPED_TEST(Certify, HoldsForEveryAnswer) {
    int pairs = 0, overlapping = 0;
    this->each_pair([&](const auto& a, const auto& b, oracle::Random&) {
        const auto answer = closest(a, b);
        const auto found = certify(a, b, answer);
        EXPECT_TRUE(found) << "distance " << answer.distance << " margin " << found.margin << " plane " << found.plane
                           << " off " << found.off_a << " and " << found.off_b << " across " << found.across
                           << " common " << found.off_common;
        ++pairs;
        overlapping += answer.distance <= 0 ? 1 : 0;
    });
    EXPECT_GT(overlapping, pairs * 3 / 10);
    EXPECT_LT(overlapping, pairs * 7 / 10);
}

TYPED_TEST(Certify, RefusesWhatIsMadeWrong) {
    constexpr int D = TypeParam::value;
    this->each_pair([](const auto& a, const auto& b, oracle::Random& random) {
        const auto answer = closest(a, b);
        const auto margin = certify(a, b, answer).margin;
        const double step = 8 * margin + 16 * oracle::ulp(largest(DVec<D>(answer.on_a)) + margin);
        const float error = static_cast<float>(random.chance(0.5) ? step : -step);
        auto farther = answer;
        farther.distance += error;
        EXPECT_FALSE(certify(a, b, farther));
        auto elsewhere = answer;
        elsewhere.on_a += answer.normal * error;
        EXPECT_FALSE(certify(a, b, elsewhere));
    });
}

// A point that is no number read past the edges of a polygon.
TYPED_TEST(Certify, RefusesWhatIsNoNumber) {
    for (std::uint64_t seed = 0; seed < 200; ++seed)
        this->visit_pair(seed, [](const auto& a, const auto& b, oracle::Random&) {
            const auto answer = closest(a, b);
            using Limits = std::numeric_limits<float>;
            for (const float wrong : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()}) {
                auto on_a = answer, on_b = answer, normal = answer, distance = answer;
                on_a.on_a.x = on_b.on_b.y = normal.normal.x = distance.distance = wrong;
                for (const auto& forged : {on_a, on_b, normal, distance}) EXPECT_FALSE(certify(a, b, forged));
            }
        });
}

TYPED_TEST(Certify, RefusesTheOtherWayOut) {
    constexpr int D = TypeParam::value;
    const Ball<D> a{Vec<D>(0), 1}, b{Vec<D>(0.25f), 1};
    auto answer = closest(a, b);
    EXPECT_TRUE(certify(a, b, answer));
    answer.normal = -answer.normal;
    EXPECT_FALSE(certify(a, b, answer));
    answer.normal = Vec<D>(0);
    EXPECT_FALSE(certify(a, b, answer));
}

TYPED_TEST(Certify, GivesACommonPoint) {
    constexpr int D = TypeParam::value;
    // The midpoint of on_a and on_b is in neither of two crossing bars.
    Vec<D> along(1.0f), across(1.0f);
    along[0] = 10;
    across[1] = 10;
    const Box<D> a{Vec<D>(0), along}, b{Vec<D>(0.5f), across};
    const auto found = certify(a, b, closest(a, b));
    EXPECT_TRUE(found);
    EXPECT_LE(closest(a, found.common).distance, 1e-6f);
    EXPECT_LE(closest(b, found.common).distance, 1e-6f);
}

TEST(CertifyInSpace, KnowsHalfSpacesMeshesAndRoundShapes) {
    const HalfSpace3 ground{{0, 0, 1}, 0};
    const Cylinder cylinder{{0, 0, -0.5f}, {0, 1, 0.5f}, 0.5f};
    EXPECT_TRUE(certify(cylinder, ground, closest(cylinder, ground)));
    EXPECT_TRUE(certify(ground, cylinder, closest(ground, cylinder)));
    const Mesh mesh = *Mesh::build(std::vector<Vec3>{{-1, -1, 0}, {1, -1, 0}, {0, 2, 0}, {0, 0, -3}},
                                   std::vector<glm::uvec3>{{0, 1, 3}, {0, 1, 2}});
    const auto answer = closest(cylinder, mesh);
    EXPECT_EQ(answer.feature_b.part, 1u);
    EXPECT_TRUE(certify(cylinder, mesh, answer));
}

}  // namespace
}  // namespace abut
