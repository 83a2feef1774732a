// Cylinders, cones and ellipsoids against the best of many directions, with closed forms of their support functions.

#include "../oracle/expect.hpp"
#include "../oracle/pair.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/placed.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace abut {

using namespace detail;

namespace {

using Extent = std::function<double(const DVec<3>&)>;

struct Round {
    std::shared_ptr<const void> keeper;
    View<3> view;
    Extent extent;               ///< the maximum of dot(n, p) over the shape, for n of length 1
    std::vector<DVec<3>> kinks;  ///< directions of flat ends and faces, where the extent has a sharp minimum
};

template <class S>
Round round_shape(S shape, Extent extent, std::vector<DVec<3>> kinks = {}) {
    auto keeper = std::make_shared<const S>(std::move(shape));
    return {keeper, view(*keeper), std::move(extent), std::move(kinks)};
}

Extent discs(const Vec3& a, const Vec3& b, float radius_a, float radius_b) {
    const DVec<3> from(a), to(b), axis = normalized(to - from);
    const double ra = static_cast<double>(radius_a), rb = static_cast<double>(radius_b);
    return [=](const DVec<3>& n) {
        const double across = length(n - axis * dot(n, axis));
        return std::max(dot(from, n) + ra * across, dot(to, n) + rb * across);
    };
}

/// 0 to 4 are round with rims or stretched; 5 and 6 have closed forms.
Round make(int kind, oracle::Random& random, const DVec<3>& center, double size) {
    const auto spot = [&](double spread) { return to_float(center + random.in_cube<3>() * (spread * size)); };
    const Vec3 a = spot(0.8), b = spot(0.8);
    const float radius = random.uniform_float(0.1 * size, size);
    const Pose3 pose{spot(0), random.rotation<3>()};
    const Affine<3> place = affine(pose);
    const DVec<3> axis = normalized(DVec<3>(b) - DVec<3>(a));
    const Vec3 radii(radius, random.uniform_float(0.1 * size, size), random.uniform_float(0.1 * size, size));
    const auto stretch = [place, radii](const DVec<3>& n) {
        return dot(place.offset, n) + length(place.transposed(n) * DVec<3>(radii));
    };
    switch (kind) {
        case 0:
            return round_shape(Cylinder{a, b, radius}, discs(a, b, radius, radius), {axis});
        case 1:
            return round_shape(Cone{a, b, radius}, discs(a, b, radius, 0), {axis});
        case 2:
            return round_shape(at(stretched(Sphere{{0, 0, 0}, 1}, radii), pose), stretch);
        case 3: {
            // The stretched ends of the segment, and the stretched ball around it.
            const Vec3 u = to_float(random.in_cube<3>()), v = to_float(random.in_cube<3>());
            const DVec<3> p = place.vector(DVec<3>(u) * DVec<3>(radii)), q = place.vector(DVec<3>(v) * DVec<3>(radii));
            return round_shape(at(stretched(Capsule<3>{u, v, 1}, radii), pose),
                               [=](const DVec<3>& n) { return stretch(n) + std::max(dot(p, n), dot(q, n)); });
        }
        case 4:
            return round_shape(rounded(Cylinder{a, b, radius}, radius),
                               [=, core = discs(a, b, radius, radius)](const DVec<3>& n) {
                                   return core(n) + static_cast<double>(radius);
                               },
                               {axis});
        case 5:
            return round_shape(Sphere{a, radius},
                               [=](const DVec<3>& n) { return dot(DVec<3>(a), n) + static_cast<double>(radius); });
        default:
            return round_shape(Box3{pose.position, radii, pose.rotation},
                               [=](const DVec<3>& n) {
                                   const DVec<3> local = place.transposed(n);
                                   return dot(place.offset, n) + std::abs(local.x) * static_cast<double>(radii.x) +
                                          std::abs(local.y) * static_cast<double>(radii.y) +
                                          std::abs(local.z) * static_cast<double>(radii.z);
                               },
                               {place.column[0], place.column[1], place.column[2]});
    }
}

/// The minimum of f over unit vectors: the best of some thousand, then ever smaller steps from the best few.
double min_over_directions(const Extent& f, const std::vector<DVec<3>>& kinks) {
    struct Start {
        double value;
        DVec<3> n;
    };
    std::vector<Start> starts;
    for (const DVec<3>& n : kinks) {
        starts.push_back({f(n), n});
        starts.push_back({f(-n), -n});
    }
    oracle::Random random(1);
    for (int i = 0; i < 1500; ++i) {
        const DVec<3> n = random.direction<3>();
        starts.push_back({f(n), n});
    }
    std::partial_sort(starts.begin(), starts.begin() + 8, starts.end(),
                      [](const Start& a, const Start& b) { return a.value < b.value; });
    double least = starts[0].value;
    for (int i = 0; i < 8; ++i) {
        Start now = starts[static_cast<std::size_t>(i)];
        for (double step = 0.1; step > 1e-7;) {
            const DVec<3> n = normalized(now.n + random.in_cube<3>() * step);
            const double value = f(n);
            if (value < now.value)
                now = {value, n};
            else
                step *= 0.97;
        }
        least = std::min(least, now.value);
    }
    return least;
}

/// The largest errors of one pair.
struct Seen {
    bool overlapping = false;
    double above_least = 0;  ///< of a depth, as a share of the smaller size
};

Seen check_round_pair(std::uint64_t seed, int kind_a, int kind_b) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", kinds " << kind_a << " and " << kind_b);
    oracle::Random random(seed);
    const double size_a = random.power_of_two(-10, 13), size_b = size_a * random.power_of_two(-2, 2);
    const DVec<3> center = random.direction<3>() * (size_a * random.uniform(0, 100));
    const Round a = make(kind_a, random, center, size_a);
    const DVec<3> away = random.direction<3>() * ((size_a + size_b) * random.uniform(0, 1.4));
    const Round b = make(kind_b, random, center + away, size_b);
    const Extent reach = [&](const DVec<3>& n) { return a.extent(n) + b.extent(-n); };
    std::vector<DVec<3>> kinks = a.kinks;
    kinks.insert(kinks.end(), b.kinks.begin(), b.kinks.end());
    const double least = min_over_directions(reach, kinks);
    const double smaller = std::min(size(a.view), size(b.view));
    const double rounding = oracle::ulp(102 * size_a), margin = 1e-5 * smaller + 2 * rounding;

    const Closest<3> found = closest(a.view, b.view);
    const double distance = static_cast<double>(found.distance);
    EXPECT_TRUE(oracle::is_unit(found.normal));
    EXPECT_NEAR(-reach(normalized(DVec<3>(found.normal))), distance, margin) << "the move doesn't part them";
    if (std::abs(least) > margin) {
        EXPECT_EQ(overlaps(a.view, b.view), least > 0);
    }
    if (least > 0) {
        EXPECT_LE(-distance, least + 1e-3 * smaller);
        return {true, (-distance - least) / smaller};
    }
    EXPECT_GE(distance, -least - margin);
    // No farther than two points of the shapes, so the distance is exact.
    EXPECT_NEAR(length(DVec<3>(found.on_b) - DVec<3>(found.on_a)), distance, margin + 4 * rounding);
    for (int i = 0; i < 50; ++i) {
        const DVec<3> n = random.direction<3>();
        EXPECT_LE(dot(DVec<3>(found.on_a), n), a.extent(n) + margin + 4 * rounding);
        EXPECT_LE(dot(DVec<3>(found.on_b), n), b.extent(n) + margin + 4 * rounding);
    }
    return {};
}

TEST(RoundShapes, AreAsFarOrDeepAsTheBestOfManyDirections) {
    int pairs = 0, overlapping = 0;
    double worst = 0;
    for (int kind_a = 0; kind_a < 5; ++kind_a)
        for (int kind_b = 0; kind_b < 7; ++kind_b)
            for (int i = 0; i < oracle::case_count(12); ++i) {
                const Seen seen = check_round_pair(static_cast<std::uint64_t>(pairs++), kind_a, kind_b);
                overlapping += seen.overlapping ? 1 : 0;
                worst = std::max(worst, seen.above_least);
            }
    RecordProperty("worst_depth_above_least", std::to_string(worst));
    EXPECT_GT(overlapping, pairs * 3 / 10);
    EXPECT_LT(overlapping, pairs * 7 / 10);
}

TEST(RoundShapes, StayApartWhenTheSimplexShrinksToRounding) {
    // GJK was within 1e-15 of the end, then took a tetrahedron without thickness for an overlap 2000 deep.
    check_round_pair(1008, 0, 0);
    check_round_pair(4634, 0, 3);
    check_round_pair(4657, 0, 3);
    check_round_pair(7797, 0, 6);
}

}  // namespace
}  // namespace abut
