// Pairs of the last update: the items that touch an item, and the contact and impact of a pair.

#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/world/world.hpp>

#include <vector>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

using Ids = std::vector<Id>;

template <class Dimension>
class Touching : public testing::Test {
protected:
    static constexpr int D = Dimension::value;

    static Pose<D> place(float x, float y = 0) {
        Pose<D> result;
        result.position[0] = x;
        result.position[1] = y;
        return result;
    }
    Id add(float x, ItemOptions<D> options = {}) {
        options.pose = place(x);
        return world.add(Ball<D>{Vec<D>(0.0f), 1}, options);
    }

    World<D> world;
};

using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Touching, Dimensions);

TYPED_TEST(Touching, IsAsOfTheLastUpdateAndSorted) {
    const Id left = this->add(-1.5f), sensor = this->add(1.5f, {.sensor = true}), middle = this->add(0),
             far = this->add(9), right = this->add(1.75f, {.fixed = true});
    EXPECT_TRUE(this->world.touching(middle).empty()) << "there was no update";
    this->world.update();
    EXPECT_EQ(this->world.touching(middle), (Ids{left, sensor, right}));
    EXPECT_EQ(this->world.touching(left), Ids{middle});
    EXPECT_EQ(this->world.touching(sensor), (Ids{middle, right}));
    EXPECT_TRUE(this->world.touching(far).empty());
    Ids some;
    this->world.each_touching(middle, [&](Id other) {
        some.push_back(other);
        return some.size() < 2;
    });
    EXPECT_EQ(some, (Ids{left, sensor}));

    // The pair with the sensor has no contact.
    Ids with_contact;
    this->world.each_contact_of(middle, [&](const auto& found) {
        EXPECT_TRUE(found.a == middle || found.b == middle);
        EXPECT_EQ(found.contact.depth, this->world.contact({found.a, found.b}).depth);
        with_contact.push_back(found.a == middle ? found.b : found.a);
    });
    EXPECT_EQ(with_contact, (Ids{left, right}));
    int visits = 0;
    this->world.each_contact_of(middle, [&](const auto&) { return ++visits < 1; });
    EXPECT_EQ(visits, 1);
    this->world.each_contact_of(far, [&](const auto&) { ADD_FAILURE(); });

    this->world.move(left, this->place(9));
    EXPECT_EQ(this->world.touching(middle), (Ids{left, sensor, right}));
    this->world.remove(sensor);
    const Id next = this->add(0.5f);
    EXPECT_EQ(next.index, sensor.index);
    EXPECT_EQ(this->world.touching(middle), (Ids{left, right})) << "what is gone has no name";
    EXPECT_TRUE(this->world.touching(next).empty());
    this->world.update();
    EXPECT_EQ(this->world.touching(middle), (Ids{next, right}));
    EXPECT_EQ(this->world.touching(left), Ids{far});
}

TYPED_TEST(Touching, OneAmongManyIsFound) {
    const Id floor =
        this->world.add(Box<TestFixture::D>{Vec<TestFixture::D>(0.0f), Vec<TestFixture::D>(1000.0f)}, {.fixed = true});
    Ids ids;
    for (int i = 0; i < 300; ++i) ids.push_back(this->add(1.5f * static_cast<float>(i)));
    this->world.update();
    EXPECT_EQ(this->world.touching(floor), ids);
    EXPECT_EQ(this->world.touching(ids[0]), (Ids{floor, ids[1]}));
    EXPECT_EQ(this->world.touching(ids[150]), (Ids{floor, ids[149], ids[151]}));
    EXPECT_EQ(this->world.touching(ids[299]), (Ids{floor, ids[298]}));
}

TYPED_TEST(Touching, PairsHaveTheContactOfTheList) {
    const Id a = this->add(0), sensor = this->add(0.5f, {.sensor = true}), b = this->add(1.5f);
    EXPECT_FALSE(this->world.contact({a, b}));
    this->world.update();
    const auto contact = this->world.contact({a, b});
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact.depth, 0.5f);
    EXPECT_EQ(contact.normal[0], 1) << "from a to b";
    EXPECT_EQ(this->world.contact({b, a}).normal, contact.normal) << "in whichever order";
    EXPECT_FALSE(this->world.contact({a, sensor}));
    EXPECT_FALSE(this->world.contact({a, a}));
    EXPECT_FALSE(this->world.contact({{}, {}}));
    EXPECT_TRUE(this->world.impacts().empty());
    EXPECT_FALSE(this->world.impact({a, b})) << "neither is continuous";
    // The contact remains that of the last update.
    this->world.remove(b);
    EXPECT_TRUE(this->world.contact({a, b}));
    this->world.update();
    EXPECT_FALSE(this->world.contact({a, b}));
}

TYPED_TEST(Touching, ImpactsHaveTheHitOfABullet) {
    const Id wall = this->add(0, {.fixed = true}), bullet = this->add(-10, {.continuous = true}),
             zone = this->add(4, {.fixed = true, .sensor = true});
    this->world.update();
    this->world.move(bullet, this->place(10));
    const Events events = this->world.update();
    ASSERT_EQ(events.began.size(), 2u);
    EXPECT_TRUE(this->world.contacts().empty());
    ASSERT_EQ(this->world.impacts().size(), 2u);
    EXPECT_EQ(this->world.impacts()[0].a, wall);
    EXPECT_EQ(this->world.impacts()[0].b, bullet);
    const auto hit = this->world.impact({wall, bullet});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->fraction, 0.4, 1e-6);
    EXPECT_EQ(hit->fraction, events.fractions[0]);
    EXPECT_NEAR(hit->normal[0], 1, 1e-6) << "it faces the lower id, the wall: the bullet comes from the left";
    EXPECT_NEAR(hit->point[0], -1, 1e-5);
    const auto in_zone = this->world.impact({bullet, zone});
    ASSERT_TRUE(in_zone) << "sensors have one, too";
    EXPECT_NEAR(in_zone->fraction, 0.6, 1e-6);
    EXPECT_NEAR(in_zone->point[0], 3, 1e-5);
    // A resting item has no impact.
    this->world.update();
    EXPECT_TRUE(this->world.impacts().empty());
    EXPECT_FALSE(this->world.impact({wall, bullet}));
    // The item in which the bullet comes to rest has both an impact and a contact.
    this->world.move(bullet, this->place(1.5f));
    this->world.update();
    ASSERT_TRUE(this->world.impact({wall, bullet}));
    EXPECT_NEAR(this->world.impact({wall, bullet})->point[0], 1, 1e-5);
    EXPECT_TRUE(this->world.contact({wall, bullet}));
    // A pair that stays has a contact alone.
    this->world.move(bullet, this->place(1.25f));
    EXPECT_EQ(this->world.update().stayed.size(), 1u);
    EXPECT_FALSE(this->world.impact({wall, bullet}));
    EXPECT_TRUE(this->world.contact({wall, bullet}));
}

}  // namespace
}  // namespace abut::test
