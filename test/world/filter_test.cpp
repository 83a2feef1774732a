// Which pairs and queries take an item into account: 64 layers, groups, the pair filter, items that are not enabled,
// and a query's own predicate.

#include <abut/shape/ball.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

template <class Dimension>
class WorldFilter : public testing::Test {
public:
    static constexpr int D = Dimension::value;
    using Ids = std::vector<Id>;

    /// All items overlap.
    Id add(const ItemOptions<D>& options = {}) { return world.add(Ball<D>{Vec<D>(0.0f), 1}, options); }
    std::vector<IdPair> pairs() {
        const Events events = world.update();
        std::vector<IdPair> result(events.began.begin(), events.began.end());
        result.insert(result.end(), events.stayed.begin(), events.stayed.end());
        std::sort(result.begin(), result.end());
        return result;
    }
    bool pair() { return !pairs().empty(); }
    Ids found(const Filter& filter = {}) const { return world.overlapping(Ball<D>{Vec<D>(0.0f), 1}, filter); }

    World<D> world;
};

using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(WorldFilter, Dimensions);

TYPED_TEST(WorldFilter, HasLayersAbove32) {
    constexpr std::uint64_t high = std::uint64_t{1} << 63, other = std::uint64_t{1} << 33;
    const Id a = this->add({.layers = high, .mask = other}), b = this->add({.layers = other, .mask = high});
    EXPECT_TRUE(this->pair());
    this->world.set_filter(b, other, other);
    EXPECT_FALSE(this->pair());
    EXPECT_EQ(this->found({.mask = high}), (std::vector{a}));
    EXPECT_EQ(this->found({.layers = high}), (std::vector<Id>{}));
    EXPECT_EQ(this->found({.layers = other}), (std::vector{a, b}));
}

TYPED_TEST(WorldFilter, GroupsOverruleLayers) {
    struct Case {
        std::int32_t a, b;
        std::uint64_t mask;
        bool pairs;
    };
    for (const Case& c : std::vector<Case>{{0, 0, 1, true},
                                           {0, 0, 2, false},
                                           {3, 3, 2, true},
                                           {-3, -3, 1, false},
                                           {3, 4, 2, false},
                                           {-3, -4, 1, true},
                                           {-3, 3, 1, true},
                                           {0, -3, 1, true}}) {
        World<TestFixture::D> world;
        const Ball<TestFixture::D> ball{Vec<TestFixture::D>(0.0f), 1};
        const Id a = world.add(ball, {.mask = c.mask}), b = world.add(ball, {.group = c.b});
        world.set_group(a, c.a);
        EXPECT_EQ(world.group(a), c.a);
        EXPECT_EQ(world.group(b), c.b);
        EXPECT_EQ(world.update().began.size(), c.pairs ? 1u : 0u) << c.a << " " << c.b << " " << c.mask;
    }
}

TYPED_TEST(WorldFilter, AnItemThatIsNotEnabledHasNoPairsAndIsNotFound) {
    const Id a = this->add(), b = this->add({.enabled = false});
    EXPECT_FALSE(this->pair());
    EXPECT_EQ(this->found(), (std::vector{a}));
    this->world.set_enabled(b, true);
    EXPECT_EQ(this->found(), (std::vector{a, b}));
    EXPECT_TRUE(this->pair());
    this->world.set_enabled(b, false);
    EXPECT_EQ(this->world.update().ended.size(), 1u);
    EXPECT_TRUE(this->world.contains(b));
    this->world.move(b, {});
    this->world.set_fixed(b, true);
    this->world.set_fixed(b, false);
    EXPECT_EQ(this->found(), (std::vector{a})) << "after other changes too";
}

// A bullet that was not enabled on its way hits nothing there.
TYPED_TEST(WorldFilter, AnItemThatIsEnabledAgainBeginsAtItsPose) {
    Pose<TestFixture::D> left, right;
    left.position.x = -10;
    right.position.x = 10;
    this->add();
    const Id bullet = this->add({.pose = left, .continuous = true});
    this->world.update();
    this->world.set_enabled(bullet, false);
    this->world.move(bullet, right);
    this->world.set_enabled(bullet, true);
    EXPECT_FALSE(this->pair());
    this->world.move(bullet, left);
    EXPECT_TRUE(this->pair()) << "the way back";
}

// Items at rest are tested again when the answer changes, which their boxes and options don't show.
TYPED_TEST(WorldFilter, PairFilterMayChangeItsAnswer) {
    const Id a = this->add(), b = this->add(), c = this->add();
    bool accepts = false;
    this->world.set_pair_filter([&](Id first, Id second) {
        EXPECT_LT(first, second);
        return accepts || first != a || second != c;
    });
    const std::vector<IdPair> without{{a, b}, {b, c}}, with{{a, b}, {a, c}, {b, c}};
    EXPECT_EQ(this->pairs(), without);
    accepts = true;
    EXPECT_EQ(this->pairs(), with);
    accepts = false;
    EXPECT_EQ(this->pairs(), without);
    this->world.set_pair_filter(nullptr);
    EXPECT_EQ(this->pairs(), with) << "without the filter";
    EXPECT_EQ(this->world.contacts().size(), 3u);
}

TYPED_TEST(WorldFilter, QueriesObeyTheirPredicate) {
    constexpr int D = TestFixture::D;
    const Id a = this->add(), b = this->add();
    const auto not_a = [&](Id id) { return id != a; };
    const Filter filter{.accepts = not_a};
    EXPECT_EQ(this->found(filter), (std::vector{b}));
    Vec<D> start(0.0f), direction(0.0f);
    start[0] = -5;
    direction[0] = 1;
    const Ray<D> ray{start, direction, 10};
    EXPECT_EQ(this->world.raycast(ray, filter)->id, b);
    EXPECT_EQ(this->world.raycast_all(ray, filter).size(), 1u);
    EXPECT_EQ(this->world.sweep(Ball<D>{start, 1}, direction * 10.0f, filter)->id, b);
    EXPECT_EQ(this->world.closest(start, filter)->id, b);
    EXPECT_EQ(this->world.k_nearest(start, 2, filter).size(), 1u);
    EXPECT_EQ(this->world.containing(Vec<D>(0.0f), filter), (std::vector{b}));
    EXPECT_FALSE(this->world.raycast_any(ray, {.accepts = [](Id) { return false; }}));
}

TYPED_TEST(WorldFilter, SnapshotsHoldAllOptions) {
    constexpr std::uint64_t high = std::uint64_t{1} << 40;
    const std::vector<ItemOptions<TestFixture::D>> all{{},
                                                       {.mask = 5},
                                                       {.mask = 5 | high},
                                                       {.layers = high},
                                                       {.group = -7},
                                                       {.layers = 3 | high, .mask = ~high, .group = 9},
                                                       {.enabled = false}};
    std::vector<Id> ids;
    for (const auto& options : all) ids.push_back(this->add(options));
    const std::vector<std::byte> bytes = this->world.save();
    for (const Id id : ids) {
        this->world.set_filter(id, 2, 2);
        this->world.set_group(id, 1);
        this->world.set_enabled(id, true);
    }
    ASSERT_FALSE(this->world.restore(bytes));
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(this->world.layers(ids[i]), all[i].layers) << i;
        EXPECT_EQ(this->world.mask(ids[i]), all[i].mask) << i;
        EXPECT_EQ(this->world.group(ids[i]), all[i].group) << i;
        EXPECT_EQ(this->world.is_enabled(ids[i]), all[i].enabled) << i;
    }
    EXPECT_EQ(this->found().size(), all.size() - 1);
    EXPECT_EQ(this->world.save(), bytes);
}

}  // namespace
}  // namespace abut::test
