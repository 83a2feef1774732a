// The items nearest to a point or a shape, and queries that ignore several items, with known answers.

#include "support/before_and_after_update.hpp"
#include "support/bits.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/world/world.hpp>

#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

using Ids = std::vector<Id>;

template <class Dimension>
class Nearest : public testing::Test {
protected:
    static constexpr int D = Dimension::value;
    static Vec<D> at_x(float x) {
        Vec<D> result(0.0f);
        result[0] = x;
        return result;
    }
    Id add(float x, ItemOptions<D> options = {}) {
        options.pose.position = at_x(x);
        return world.add(Ball<D>{Vec<D>(0.0f), 1}, options);
    }
    static Ids ids_of(const std::vector<WorldClosest<D>>& list) {
        Ids result;
        for (const auto& each : list) result.push_back(each.id);
        return result;
    }

    World<D> world;
};

using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Nearest, Dimensions);

TYPED_TEST(Nearest, ComeByDistanceAndThenById) {
    static constexpr int N = TestFixture::D;
    const auto origin = this->at_x(0);
    before_and_after_update(this->world, [&] { EXPECT_TRUE(this->world.k_nearest(origin, 3).empty()); });
    const Id far = this->add(9), right = this->add(4, {.fixed = true}), left = this->add(-4), inside = this->add(0.5f),
             deeper = this->add(0.25f);
    before_and_after_update(this->world, [&] {
        const auto all = this->world.k_nearest(origin, 100);
        EXPECT_EQ(this->ids_of(all), (Ids{deeper, inside, right, left, far}));
        EXPECT_EQ(all[0].closest.distance, -0.75f);
        EXPECT_EQ(all[1].closest.distance, -0.5f);
        EXPECT_EQ(all[2].closest.distance, 3);
        EXPECT_EQ(all[2].closest.on_b, this->at_x(3));
        EXPECT_EQ(all[4].closest.distance, 8);
        for (std::size_t k = 0; k <= 5; ++k) {
            const auto some = this->world.k_nearest(origin, k);
            EXPECT_EQ(Bits(some), Bits(std::vector(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(k)))) << k;
        }
        EXPECT_EQ(Bits(this->world.k_nearest(origin, 1)[0]), Bits(*this->world.closest(origin)));
        const auto of_ball = this->world.k_nearest(Ball<N>{this->at_x(6), 0.5f}, 2);
        EXPECT_EQ(this->ids_of(of_ball), (Ids{right, far}));
        EXPECT_EQ(of_ball[0].closest.distance, 0.5f);
        EXPECT_EQ(of_ball[1].closest.distance, 1.5f);
    });
}

TYPED_TEST(Nearest, FillsTheSpanAndNoMore) {
    static constexpr int N = TestFixture::D;
    const Id a = this->add(2), b = this->add(4);
    const WorldClosest<N> untouched{{77, 7}, {}};
    std::array<WorldClosest<N>, 3> out{untouched, untouched, untouched};
    EXPECT_EQ(this->world.k_nearest(this->at_x(0), out), 2u);
    EXPECT_EQ(out[0].id, a);
    EXPECT_EQ(out[1].id, b);
    EXPECT_EQ(out[2].id, untouched.id);
    EXPECT_EQ(this->world.k_nearest(this->at_x(9), std::span(out).first(1)), 1u);
    EXPECT_EQ(out[0].id, b);
    EXPECT_EQ(out[1].id, b);
    EXPECT_EQ(this->world.k_nearest(this->at_x(0), std::span<WorldClosest<N>>()), 0u);
}

TYPED_TEST(Nearest, HalfSpacesAndMovedItemsAreAmongThem) {
    static constexpr int N = TestFixture::D;
    const Id ground = this->world.add(HalfSpace<N>{this->at_x(1), 0}, {.fixed = true});
    const Id ball = this->add(5), other = this->add(9);
    this->world.update();
    EXPECT_EQ(this->ids_of(this->world.k_nearest(this->at_x(1), 3)), (Ids{ground, ball, other}));
    this->world.move(other, {this->at_x(2)});
    EXPECT_EQ(this->ids_of(this->world.k_nearest(this->at_x(1), 3)), (Ids{other, ground, ball}));
    EXPECT_EQ(this->ids_of(this->world.k_nearest(HalfSpace<N>{this->at_x(-1), -8}, 3)), (Ids{ball, other}))
        << "two half-spaces don't pair";
}

TYPED_TEST(Nearest, EveryQueryIgnoresSeveral) {
    static constexpr int N = TestFixture::D;
    Ids ids;
    for (int i = 0; i < 6; ++i) ids.push_back(this->add(3 * static_cast<float>(i), {.fixed = i % 2 == 0}));
    const std::vector<Id> ignored{ids[2], ids[0], {}, {99, 1}, ids[1]};
    const Filter filter{.ignore = ids[3], .ignore_ids = ignored};
    const Ray<N> ray = Ray<N>::between(this->at_x(-5), this->at_x(50));
    const Ball<N> large{this->at_x(0), 100}, small{this->at_x(-5), 0.5f};
    before_and_after_update(this->world, [&] {
        const Ids left{ids[4], ids[5]};
        EXPECT_EQ(this->world.raycast(ray, filter)->id, ids[4]);
        EXPECT_TRUE(this->world.raycast_any(ray, filter));
        EXPECT_EQ(this->world.raycast_all(ray, filter).size(), 2u);
        EXPECT_EQ(this->world.sweep(small, this->at_x(50), filter)->id, ids[4]);
        EXPECT_EQ(this->world.sweep(small, Pose<N>{}, Pose<N>{this->at_x(50)}, filter)->id, ids[4]);
        EXPECT_EQ(this->world.sweep(small, Motion<N>{.move = this->at_x(50)}, filter)->id, ids[4]);
        EXPECT_EQ(this->world.closest(this->at_x(0), filter)->id, ids[4]);
        EXPECT_EQ(this->ids_of(this->world.k_nearest(this->at_x(0), 9, filter)), left);
        EXPECT_EQ(this->world.overlapping(large, filter), left);
        EXPECT_TRUE(this->world.containing(this->at_x(3), filter).empty());
        EXPECT_EQ(this->world.containing(this->at_x(12), filter), Ids{ids[4]});
        int visits = 0;
        this->world.each_overlapping(
            large, [&](Id) { ++visits; }, filter);
        this->world.each_in_box(
            bounds(view(large)), [&](Id, const View<N>&) { ++visits; }, filter);
        EXPECT_EQ(visits, 4);
        EXPECT_FALSE(this->world.raycast(ray, {.ignore_ids = ids}));
        EXPECT_FALSE(this->world.raycast_any(ray, {.ignore_ids = ids}));
    });
}

}  // namespace
}  // namespace abut::test
