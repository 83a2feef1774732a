// Level shapes in a World: each question answers as the same question to the items one by one, and events and contacts
// are those of the pairs that touch.

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

/// Near enough to one another that about half of the questions find something.
template <int D>
constexpr double extent = D == 2 ? 4 : 1.5;

/// Levels that rest and levels that move, convex shapes that move; half of them moved once more since the update.
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

/// The answers of the items one by one, the least first.
template <int D, class Ask>
std::optional<std::pair<float, Id>> least(const Scene<D>& scene, Ask&& ask) {
    std::optional<std::pair<float, Id>> result;
    for (const Id id : scene.ids)
        if (const std::optional<float> answer = ask(scene.shape(id)); answer && (!result || *answer < result->first))
            result = std::pair(*answer, id);
    return result;
}

template <int D>
void check_world(int rounds) {
    int hits = 0, swept = 0, inside = 0, touching = 0, asked = 0;
    for (int seed = 0; seed < rounds; ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(static_cast<std::uint64_t>(seed));
        Scene<D> scene = random_scene<D>(random);
        for (int i = 0; i < 8; ++i, ++asked) {
            const Vec<D> from = random_point<D>(random, 1.5 * extent<D>),
                         way = random_point<D>(random, extent<D>) - from * random.uniform_float(0, 1.5);
            const Ray<D> ray = Ray<D>::between(from, from + way);
            const auto first = least(scene, [&](const View<D>& item) -> std::optional<float> {
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
            const auto first_swept = least(scene, [&](const View<D>& item) -> std::optional<float> {
                const auto touch = sweep(shape, way, item);
                return touch ? std::optional(touch->fraction) : std::nullopt;
            });
            const auto touch = scene.world.sweep(shape, way);
            ASSERT_EQ(touch.has_value(), first_swept.has_value());
            if (touch) {
                EXPECT_NEAR(touch->hit.fraction, first_swept->first, 1e-5);
                ++swept;
            }
            const auto nearest =
                least(scene, [&](const View<D>& item) { return std::optional(closest(item, from).distance); });
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
        std::vector<IdPair> told;
        for (const WorldContact<D>& contact : scene.world.contacts()) told.push_back({contact.a, contact.b});
        std::sort(pairs.begin(), pairs.end());
        touching += static_cast<int>(pairs.size());
        // A pair may overlap and have no contact: at the back of what is one-sided, and where another tells of it.
        EXPECT_TRUE(std::includes(pairs.begin(), pairs.end(), told.begin(), told.end()));
        EXPECT_GE(3 * told.size() + 6, 2 * pairs.size());
        if (testing::Test::HasFailure()) return;
    }
    EXPECT_TRUE(hits > 0.2 * asked && hits < 0.95 * asked) << hits << " of " << asked;
    EXPECT_TRUE(swept > 0.2 * asked && swept < 0.95 * asked) << swept << " of " << asked;
    EXPECT_TRUE(inside > 0.2 * asked && inside < 0.95 * asked) << inside << " of " << asked;
    EXPECT_GT(touching, rounds);
}

TEST(LevelsInAWorld, OfThePlaneAnswerAsOneByOne) {
    check_world<2>(oracle::amount(30));
}
TEST(LevelsInAWorld, InSpaceAnswerAsOneByOne) {
    check_world<3>(oracle::amount(20));
}

/// What a bullet meets between two updates, of ground that it is through by then.
TEST(LevelsInAWorld, AreMetByWhatIsContinuous) {
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
