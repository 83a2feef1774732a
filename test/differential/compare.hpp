#pragma once

// Compares abut's answers about random pairs of well-conditioned shapes with those of another library. If they differ,
// the oracle decides: abut must be right, and the peer's errors are counted.

#include "../../scenes/convex_pairs.hpp"
#include "../oracle/check.hpp"
#include "../oracle/pair.hpp"
#include "../oracle/random.hpp"
#include "peers.hpp"

#include <iostream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace abut::differential {

using detail::dot;
using detail::DVec;
using detail::to_float;

using oracle::Random;

/// The shape around the origin of its own frame; a capsule lies along the y axis.
using AnyShape = std::variant<Box3, Sphere, Capsule3, Polyhedron>;
inline constexpr std::size_t kind_count = std::variant_size_v<AnyShape>;

struct Body {
    AnyShape shape;
    Pose3 pose;
};
struct BodyPair {
    Body a, b;
};

inline Sphere placed(const Sphere& ball, const Pose3& pose) {
    return {pose * ball.center, ball.radius};
}
using scenes::placed;

inline std::vector<Vec3> corners_of(const Box3& box) {
    return oracle::box_between<3>(-box.half, box.half).points;
}
inline std::vector<Vec3> corners_of(const Sphere& ball) {
    return {ball.center};
}
inline std::vector<Vec3> corners_of(const Capsule3& capsule) {
    return {capsule.a, capsule.b};
}
inline std::vector<Vec3> corners_of(const Polyhedron& hull) {
    return {hull.points().begin(), hull.points().end()};
}

inline double radius_of(const auto& shape) {
    if constexpr (requires { shape.radius; }) return static_cast<double>(shape.radius);
    return 0;
}

/// The oracle's shape, without its edges and faces, which are not needed for its size.
inline oracle::Polytope<3> corners_and_radius(const Body& body) {
    oracle::Polytope<3> result;
    result.place = detail::affine(body.pose);
    result.points = std::visit([](const auto& shape) { return corners_of(shape); }, body.shape);
    result.radius = std::visit([](const auto& shape) { return radius_of(shape); }, body.shape);
    return result;
}

/// The oracle's shape, with edges and faces.
inline oracle::Sample<3> sample_of(const Body& body) {
    const oracle::Polytope<3> bare = corners_and_radius(body);
    const auto solid = oracle::mapped(oracle::hull_of<3>(bare.points, bare.radius), bare.place);
    return std::visit(
        [&](const auto& shape) {
            return oracle::sample<3>(oracle::Kind::polytope, owned(placed(shape, body.pose)), solid);
        },
        body.shape);
}

/// The hull of 16 to 32 points on an ellipsoid; every point is a vertex.
inline Polyhedron random_hull(Random& random) {
    const DVec<3> half{random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1)};
    std::vector<Vec3> points;
    for (std::uint32_t i = 16 + random.below(17); i > 0; --i)
        points.push_back(to_float<3>(random.direction<3>() * half));
    return *Polyhedron::build(points);
}

inline AnyShape random_shape(Random& random, std::size_t kind) {
    switch (kind) {
        case 0:
            return scenes::random_box<3>(random);
        case 1:
            return scenes::random_ball<3>(random);
        case 2:
            return scenes::random_capsule(random);
        default:
            return random_hull(random);
    }
}

/// A random pair so close that about half of the pairs overlap.
inline BodyPair random_pair(Random& random, std::size_t kind_a, std::size_t kind_b) {
    const Vec3 position = to_float<3>(random.in_cube<3>() * 10.0);
    const Body a{random_shape(random, kind_a), {position, random.rotation<3>()}};
    Body b{random_shape(random, kind_b), {position, random.rotation<3>()}};
    const oracle::Polytope<3> solid_a = corners_and_radius(a), solid_b = corners_and_radius(b);
    const DVec<3> n = random.direction<3>();
    const double wanted = std::min(size(solid_a), size(solid_b)) * random.uniform(-0.8, 0.4);
    b.pose.position += to_float<3>(n * (wanted - oracle::gap_along_with_radii(solid_a, solid_b, n)));
    return {a, b};
}

/// The counts of a peer's answers over many pairs.
struct Tally {
    int pairs = 0;
    int overlapping = 0;
    int silent = 0;        ///< pairs without an answer
    int decisions = 0;     ///< wrong overlap tests
    int gaps = 0;          ///< gaps with an error above 1e-3
    int normals = 0;       ///< normals with an error above 2.6 degrees
    int too_small = 0;     ///< depths that don't separate the shapes
    int too_large = 0;     ///< depths more than 5 % above the minimum
    oracle::Tally judged;  ///< the pairs that the oracle decided

    int wrong_but_for_depths() const { return silent + decisions + gaps + normals; }

    friend std::ostream& operator<<(std::ostream& out, const Tally& t) {
        return out << t.pairs << " pairs, " << t.overlapping << " overlap, " << t.judged.pairs
                   << " decided by the oracle. The peer: no answer " << t.silent << ", wrong decisions " << t.decisions
                   << ", wrong gaps " << t.gaps << ", wrong normals " << t.normals << ", depths too small "
                   << t.too_small << ", depths > 5 % too large " << t.too_large;
    }
};

/// Whether the peer's answer agrees with abut's.
inline bool agrees(const PeerAnswer& theirs, const Closest<3>& ours, bool overlap, double size, Tally& tally) {
    if (theirs.state != PeerAnswer::State::answered) {
        ++tally.silent;
        return false;
    }
    const double distance = static_cast<double>(ours.distance);
    if ((theirs.distance <= 0) != overlap) {
        if (std::abs(distance) <= 1e-3 * size) return true;
        ++tally.decisions;
        return false;
    }
    if (overlap) {
        const double excess = distance - theirs.distance;
        if (excess < -1e-3 * size) ++tally.too_small;
        if (excess > 0.05 * -distance) ++tally.too_large;
        return std::abs(excess) <= 1e-3 * size;
    }
    const bool gap_agrees = std::abs(theirs.distance - distance) <= 1e-3 * distance + 1e-4 * size;
    const bool normal_agrees = distance <= 0.05 * size || dot(theirs.normal, DVec<3>(ours.normal)) > 0.999;
    if (!gap_agrees) ++tally.gaps;
    if (!normal_agrees) ++tally.normals;
    return gap_agrees && normal_agrees;
}

/// Converts a shape for the peers.
inline PeerShape peer_shape_of(const Body& body) {
    const bool box = std::holds_alternative<Box3>(body.shape);
    const oracle::Kind kind = box ? oracle::Kind::box : oracle::Kind::polytope;
    return *peer_shape({kind, nullptr, {}, corners_and_radius(body)});
}

inline void check_pair(const Body& a, const Body& b, Peer peer, Tally& tally) {
    const auto [ours, overlap] = std::visit(
        [&](const auto& shape_a, const auto& shape_b) {
            const auto in_a = placed(shape_a, a.pose);
            const auto in_b = placed(shape_b, b.pose);
            return std::pair(closest(in_a, in_b), overlaps(in_a, in_b));
        },
        a.shape, b.shape);
    const double size = std::min(oracle::size(corners_and_radius(a)), oracle::size(corners_and_radius(b)));
    ++tally.pairs;
    tally.overlapping += overlap ? 1 : 0;
    if (std::abs(static_cast<double>(ours.distance)) > 1e-3 * size) {
        EXPECT_EQ(overlap, ours.distance <= 0);
    }
    if (!agrees(peer(peer_shape_of(a), peer_shape_of(b), size), ours, overlap, size, tally))
        oracle::check_pair(sample_of(a), sample_of(b), tally.judged);
}

/// Tests every kind against every kind, `few` pairs each; stops if abut is wrong.
inline Tally compare(const std::string& name, Peer peer, int few) {
    constexpr std::uint64_t first_seed = 90210;
    Tally tally;
    for (std::size_t kind_a = 0; kind_a < kind_count; ++kind_a)
        for (std::size_t kind_b = 0; kind_b < kind_count; ++kind_b) {
            const Tally before = tally;
            while (tally.pairs < before.pairs + oracle::case_count(few)) {
                const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(tally.pairs);
                SCOPED_TRACE(testing::Message() << "seed " << seed << ", kinds " << kind_a << " and " << kind_b);
                Random random(seed);
                const BodyPair pair = random_pair(random, kind_a, kind_b);
                check_pair(pair.a, pair.b, peer, tally);
                if (testing::Test::HasFailure()) return tally;
            }
            const double share = static_cast<double>(tally.overlapping - before.overlapping) / oracle::case_count(few);
            EXPECT_GT(share, 0.3) << "kinds " << kind_a << " and " << kind_b;
            EXPECT_LT(share, 0.7) << "kinds " << kind_a << " and " << kind_b;
        }
    std::cout << name << ", seeds from " << first_seed << ": " << tally << "\n";
    return tally;
}

}  // namespace abut::differential
