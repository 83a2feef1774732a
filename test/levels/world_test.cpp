// Level shapes in a World: each query has the answer of the query on single items, and events and contacts are those of
// the touching pairs.

#include "../oracle/pair.hpp"
#include "levels.hpp"
#include <abut/query/contains.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/sweep.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <optional>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

template <int D>
struct Scene {
    World<D> world;
    std::vector<Id> ids;

    View<D> shape(Id id) const { return world.shape(id); }
};

/// Shapes so close together that about half of the queries find something.
template <int D>
constexpr double extent = D == 2 ? 4 : 1.5;

/// Fixed and moving levels, and moving convex shapes; half of them moved again after the update.
template <int D>
Scene<D> random_scene(oracle::Random& random) {
    Scene<D> scene;
    for (std::uint32_t i = 0; i < 10; ++i) {
        const Pose<D> pose = random_pose<D>(random, extent<D>);
        if (i < 5)
            scene.ids.push_back(scene.world.add(random_level<D>(random, i % 4).shape, {.pose = pose, .fixed = i < 3}));
        else
            scene.ids.push_back(
                scene.world.add(random_convex(random, std::integral_constant<int, D>(), 0.1, 1), {.pose = pose}));
    }
    scene.world.update();
    for (std::uint32_t i = 3; i < 10; i += 2) scene.world.move(scene.ids[i], random_pose<D>(random, extent<D>));
    return scene;
}

/// The minimal answer over the single items, and its id.
template <int D, class Query>
std::optional<std::pair<float, Id>> first_answer(const Scene<D>& scene, Query&& query) {
    std::optional<std::pair<float, Id>> result;
    for (const Id id : scene.ids)
        if (const std::optional<float> answer = query(scene.shape(id)); answer && (!result || *answer < result->first))
            result = std::pair(*answer, id);
    return result;
}

template <int D>
void check_world(int rounds) {
    int hits = 0, swept = 0, inside = 0, touching = 0, queries = 0;
    for (int seed = 0; seed < rounds; ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(static_cast<std::uint64_t>(seed));
        Scene<D> scene = random_scene<D>(random);
        for (int i = 0; i < 8; ++i, ++queries) {
            const Vec<D> from = random_point<D>(random, 1.5 * extent<D>),
                         motion = random_point<D>(random, extent<D>) - from * random.uniform_float(0, 1.5);
            const Ray<D> ray = Ray<D>::between(from, from + motion);
            const auto first = first_answer(scene, [&](const View<D>& item) -> std::optional<float> {
                const auto hit = raycast(ray, item);
                return hit ? std::optional(hit->distance) : std::nullopt;
            });
            const auto hit = scene.world.raycast(ray);
            ASSERT_EQ(hit.has_value(), first.has_value());
            EXPECT_EQ(scene.world.raycast_any(ray), first.has_value());
            if (hit) {
                EXPECT_EQ(hit->hit.distance, first->first);
                EXPECT_EQ(hit->id, first->second);
                ++hits;
            }
            const AnyShape<D> shape = random_convex(random, std::integral_constant<int, D>(), extent<D>, 0.7);
            const auto first_swept = first_answer(scene, [&](const View<D>& item) -> std::optional<float> {
                const auto touch = sweep(shape, motion, item);
                return touch ? std::optional(touch->fraction) : std::nullopt;
            });
            const auto touch = scene.world.sweep(shape, motion);
            ASSERT_EQ(touch.has_value(), first_swept.has_value());
            if (touch) {
                EXPECT_NEAR(touch->hit.fraction, first_swept->first, 1e-5);
                ++swept;
            }
            const auto nearest =
                first_answer(scene, [&](const View<D>& item) { return std::optional(closest(item, from).distance); });
            const auto closest_item = scene.world.closest(from);
            ASSERT_TRUE(closest_item);
            EXPECT_NEAR(closest_item->closest.distance, nearest->first, 1e-5);
            std::vector<Id> overlapping, containing;
            for (const Id id : scene.ids) {
                if (overlaps(shape, scene.shape(id))) overlapping.push_back(id);
                if (contains(scene.shape(id), from)) containing.push_back(id);
            }
            std::sort(overlapping.begin(), overlapping.end());
            std::sort(containing.begin(), containing.end());
            EXPECT_EQ(scene.world.overlapping(shape), overlapping);
            EXPECT_EQ(scene.world.containing(from), containing);
            inside += overlapping.empty() ? 0 : 1;
        }
        scene.world.update();
        std::vector<IdPair> pairs;
        for (std::size_t i = 0; i < scene.ids.size(); ++i)
            for (std::size_t j = std::max<std::size_t>(i + 1, 3); j < scene.ids.size(); ++j)
                if (overlaps(scene.shape(scene.ids[i]), scene.shape(scene.ids[j])))
                    pairs.push_back({scene.ids[i], scene.ids[j]});
        std::vector<IdPair> reported;
        for (const WorldContact<D>& contact : scene.world.contacts()) reported.push_back({contact.a, contact.b});
        reported.erase(std::unique(reported.begin(), reported.end()), reported.end());
        std::sort(pairs.begin(), pairs.end());
        touching += static_cast<int>(pairs.size());
        // An overlapping pair may have no contact: at the back of a one-sided shape, or if another contact covers it.
        EXPECT_TRUE(std::includes(pairs.begin(), pairs.end(), reported.begin(), reported.end()));
        EXPECT_GE(3 * reported.size() + 6, 2 * pairs.size());
        if (testing::Test::HasFailure()) return;
    }
    EXPECT_TRUE(hits > 0.2 * queries && hits < 0.95 * queries) << hits << " of " << queries;
    EXPECT_TRUE(swept > 0.2 * queries && swept < 0.95 * queries) << swept << " of " << queries;
    EXPECT_TRUE(inside > 0.2 * queries && inside < 0.95 * queries) << inside << " of " << queries;
    EXPECT_GT(touching, rounds);
}

TEST(LevelsInAWorld, OfThePlaneAnswerAsOneByOne) {
    check_world<2>(oracle::case_count(30));
}
TEST(LevelsInAWorld, InSpaceAnswerAsOneByOne) {
    check_world<3>(oracle::case_count(20));
}

/// Tests the impacts of a bullet that passes through the ground between two updates.
TEST(LevelsInAWorld, AreHitByContinuousItems) {
    World3 world;
    const HeightField field = *HeightField::build(std::vector<float>(36, 0.0f), 6, 1.0f);
    const Id ground = world.add(field, {.fixed = true});
    const Id bullet = world.add(Sphere{{0, 0, 0}, 0.01f}, {.pose = {{2.5f, 2.5f, 5}}, .continuous = true});
    world.update();
    world.move(bullet, Pose3{{2.5f, 2.5f, -5}});
    const Events events = world.update();
    ASSERT_EQ(events.began.size(), 1u);
    EXPECT_EQ(events.began[0], (IdPair{ground, bullet}));
    EXPECT_NEAR(events.fractions[0], 0.499, 1e-4);
}

}  // namespace
}  // namespace abut::test
