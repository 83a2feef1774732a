#include "../oracle/expect.hpp"
#include "../oracle/random.hpp"
#include "meshes.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/file.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace abut {
namespace {

TEST(Compound, TellsWhatIsWrongAndWhere) {
    EXPECT_EQ(Compound3::build({}).problem().code, ProblemCode::empty_input);
    const Result<Compound3> with_floor = Compound3::build({Sphere{{0, 0, 0}, 1}, HalfSpace3{{0, 1, 0}, 0}});
    ASSERT_FALSE(with_floor);
    EXPECT_EQ(with_floor.problem().code, ProblemCode::bad_argument);
    EXPECT_EQ(with_floor.problem().index, 1u);
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const Result<Compound2> with_nan = Compound2::build({Circle{{0, 0}, 1}, Circle{{0, 0}, 1}, Circle{{nan, 0}, 1}});
    ASSERT_FALSE(with_nan);
    EXPECT_EQ(with_nan.problem().code, ProblemCode::not_finite);
    EXPECT_EQ(with_nan.problem().index, 2u);
}

TEST(Compound, TellsTheChild) {
    // A dumbbell; the polygon's corners live in the compound from here on.
    const Compound2 dumbbell =
        *Compound2::build({Circle{{-2, 0}, 1}, Box2{{0, 0}, {2, 0.25f}}, *Polygon::build({{2, -1}, {3, 0}, {2, 1}})});
    EXPECT_EQ(dumbbell.size(), 3u);
    EXPECT_EQ(closest(dumbbell, Vec2(-4, 0)).feature_a.part, 0u);
    EXPECT_EQ(closest(dumbbell, Vec2(0, 2)).feature_a.part, 1u);
    EXPECT_EQ(closest(dumbbell, Vec2(4, 0)).feature_a.part, 2u);
    EXPECT_FLOAT_EQ(closest(dumbbell, Vec2(4, 0)).distance, 1);
    EXPECT_EQ(raycast(Ray2::between({0, 5}, {0, -5}), dumbbell)->feature.part, 1u);
    EXPECT_TRUE(contains(dumbbell, Vec2(-2.5f, 0.25f)));
    EXPECT_FALSE(contains(dumbbell, Vec2(-0.5f, 0.5f)));
}

TEST(Compound, OfLevelsReportsTheChildAndIsSolidWhereThatIs) {
    const Mesh cube = test::box_surface({-1, -1, -1}, {1, 1, 1}).mesh();
    const Compound3 inner = *Compound3::build({Sphere{{0, 5, 0}, 1}, at(cube, Pose3{{10, 0, 0}})});
    const Compound3 outer =
        *Compound3::build({Sphere{{0, 0, 0}, 1}, at(stretched(inner, Vec3(1, 1, 2)), Pose3{{0, 0, 10}})});
    EXPECT_EQ(closest(outer, Vec3(10, 3, 10)).feature_a.part, 1u);
    EXPECT_FLOAT_EQ(closest(outer, Vec3(10, 3, 10)).distance, 2);
    EXPECT_TRUE(contains(outer, Vec3(10, 0, 11.5f)));
    EXPECT_FALSE(contains(outer, Vec3(10, 0, 12.5f)));
    EXPECT_FALSE(overlaps(outer, Sphere{{10, 0, 10}, 0.5f}));  // within the mesh's surface
}

TEST(Compound, StretchesAChildThatWasStretchedAndThenRounded) {
    // The child is an ellipse of the half axes 2 and 1 with a ball of 0.5 about it. Stretched by 3 and 4, its half axes
    // are 6 and 4, and its ball has a radius of 1.5: the least factor.
    const auto child = rounded(stretched(Circle{{0, 0}, 1}, {2, 1}), 0.5f);
    const auto compound = *Compound2::build({child});
    const auto shape = stretched(compound, {3, -4});
    EXPECT_NEAR(closest(shape, Vec2(17.5f, 0)).distance, 10, 1e-4);
    EXPECT_NEAR(closest(shape, Vec2(0, 15.5f)).distance, 10, 1e-4);
    EXPECT_NEAR(closest(stretched(compound, {3, 0}), Vec2(16, 0)).distance, 10, 1e-4);
    // Its box contains it, also where the stretching shears.
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        oracle::Random random(seed);
        const Vec2 scale = detail::to_float(random.in_cube<2>() * 3.0);
        const auto turned =
            stretched(at(compound, Pose2{detail::to_float(random.in_cube<2>()), random.rotation<2>()}), scale);
        const Aabb2 box = bounds(turned);
        const Vec2 point = detail::to_float(random.in_cube<2>() * 20.0);
        const auto nearest = closest(turned, point);
        EXPECT_TRUE(contains(grown(box, 1e-4f), nearest.on_a)) << "seed " << seed;
    }
}

/// A compound of an instance of a mesh in a world: nothing is copied, and all queries find it.
TEST(Compound, InAWorldOutlivesWhatItWasMadeOf) {
    World3 world;
    Id id;
    {
        const Mesh cube = test::box_surface({-1, -1, -1}, {1, 1, 1}).mesh();
        id = world.add(*Compound3::build({at(cube, Pose3{{2, 0, 0}}), Capsule<3>{{-2, -1, 0}, {-2, 1, 0}, 0.5f}}),
                       {.pose = {{0, 0, 7}}});
    }
    world.update();
    const auto hit = world.raycast(Ray3::between({2, 5, 7}, {2, -5, 7}));
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->id, id);
    EXPECT_EQ(hit->hit.feature.part, 0u);
    EXPECT_FLOAT_EQ(hit->hit.distance, 4);
    EXPECT_EQ(world.containing({2, 0, 7}).size(), 1u);
    EXPECT_EQ(world.overlapping(Sphere{{-2, 0, 7}, 0.1f}).size(), 1u);
    EXPECT_EQ(world.overlapping(Sphere{{0, 0, 7}, 0.1f}).size(), 0u);
}

TEST(Compound, ChangesItsChildren) {
    Compound2 compound = *Compound2::build({Circle{{0, 0}, 1}, Circle{{5, 0}, 1}});
    const Compound2 before = compound;
    EXPECT_EQ(*compound.add(Box2{{0, 0}, {1, 1}}, {.position = {10, 0}}), 2u);
    EXPECT_EQ(closest(compound, Vec2(13, 0)).feature_a.part, 2u);
    EXPECT_FLOAT_EQ(closest(compound, Vec2(13, 0)).distance, 2);
    EXPECT_FALSE(compound.move(2, {.position = {20, 0}}));
    EXPECT_FLOAT_EQ(closest(compound, Vec2(13, 0)).distance, 6);
    EXPECT_EQ(bounds(compound).max, Vec2(21, 1));
    compound.remove(0);
    EXPECT_EQ(compound.size(), 3u);
    EXPECT_FALSE(compound.has_child(0));
    EXPECT_FALSE(compound.has_child(3));
    EXPECT_FALSE(overlaps(compound, Circle{{0, 0}, 1}));
    EXPECT_EQ(bounds(compound).min, Vec2(4, -1));
    EXPECT_FALSE(compound.set(1, *Polygon::build({{2, -1}, {3, 0}, {2, 1}})));
    EXPECT_TRUE(contains(compound, Vec2(2.5f, 0)));
    EXPECT_FALSE(contains(compound, Vec2(5, 0)));
    EXPECT_EQ(*compound.add(Circle{{0, 7}, 1}), 0u) << "the smallest free index is reused";
    EXPECT_TRUE(compound.has_child(0));
    EXPECT_TRUE(overlaps(compound, Circle{{0, 7}, 1}));
    for (std::uint32_t i = 0; i < 3; ++i) compound.remove(i);
    EXPECT_FALSE(overlaps(compound, Circle{{0, 7}, 100}));
    EXPECT_EQ(closest(compound, Vec2(0, 0)).distance, std::numeric_limits<float>::infinity());
    EXPECT_FALSE(raycast(Ray2::between({0, 5}, {0, -5}), compound));
    EXPECT_EQ(*compound.add(Circle{{0, 0}, 1}), 0u);
    EXPECT_TRUE(raycast(Ray2::between({0, 5}, {0, -5}), compound));
    EXPECT_EQ(before.size(), 2u);
    EXPECT_TRUE(contains(before, Vec2(5, 0)));
}

TEST(Compound, TellsWhatIsWrongWithAChange) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    Compound3 compound = *Compound3::build({Sphere{{0, 0, 0}, 1}});
    EXPECT_EQ(compound.add(HalfSpace3{{0, 1, 0}, 0}).problem().code, ProblemCode::bad_argument);
    EXPECT_EQ(compound.add(Sphere{{0, nan, 0}, 1}).problem().code, ProblemCode::not_finite);
    EXPECT_EQ(compound.add(Sphere{{0, 0, 0}, 1}, {.position = {0, nan, 0}}).problem().code, ProblemCode::not_finite);
    EXPECT_EQ(compound.set(0, HalfSpace3{{0, 1, 0}, 0})->code, ProblemCode::bad_argument);
    EXPECT_EQ(compound.set(0, Sphere{{0, 0, 0}, nan})->code, ProblemCode::not_finite);
    EXPECT_EQ(compound.move(0, {.position = {nan, 0, 0}})->code, ProblemCode::not_finite);
    EXPECT_EQ(compound.size(), 1u);
    EXPECT_FLOAT_EQ(closest(compound, Vec3(3, 0, 0)).distance, 2);
}

/// The children that a compound should have, by their index.
template <int D>
using Children = std::map<std::uint32_t, At<AnyShape<D>>>;

/// Adds, removes, replaces or moves a child.
template <int D>
void change(oracle::Random& random, Compound<D>& compound, Children<D>& children) {
    const auto place = [&] { return Pose<D>{detail::to_float(random.in_cube<D>() * 5.0), random.rotation<D>()}; };
    const auto shape = [&]() -> AnyShape<D> {
        if (random.chance(0.3)) return Ball<D>{Vec<D>(0.25f), random.uniform_float(0.1, 1)};
        if (random.chance(0.3)) return Capsule<D>{Vec<D>(0.25f), Vec<D>(-0.5f), random.uniform_float(0.1, 0.5)};
        if constexpr (D == 3)
            if (random.chance(0.3)) return test::box_surface({-1, -1, -1}, {1, 0.5f, 0}).mesh();
        return Box<D>{Vec<D>(0.5f), Vec<D>(random.uniform_float(0.1, 1)), random.rotation<D>()};
    };
    const std::uint32_t kind = random.below(5);
    if (kind == 4) {
        // Puts a child where there is one, or was one.
        const std::uint32_t index = random.below(compound.size());
        children.insert_or_assign(index, At<AnyShape<D>>{shape(), place()});
        ASSERT_FALSE(compound.set(index, children.at(index).shape, children.at(index).pose));
        return;
    }
    if (kind == 0 || children.empty()) {
        const At<AnyShape<D>> child{shape(), place()};
        std::uint32_t free = 0;
        while (children.contains(free)) ++free;
        const Result<std::uint32_t> index = compound.add(child.shape, child.pose);
        ASSERT_TRUE(index);
        ASSERT_EQ(*index, free);
        children.emplace(free, child);
        return;
    }
    const auto some = std::next(children.begin(), random.below(static_cast<std::uint32_t>(children.size())));
    if (kind == 1) {
        compound.remove(some->first);
        children.erase(some);
        return;
    }
    if (kind == 2) {
        some->second.shape = shape();
        some->second.pose = place();
        ASSERT_FALSE(compound.set(some->first, some->second.shape, some->second.pose));
        return;
    }
    // Far away, or by so little that it overlaps its place before.
    if (random.chance(0.5))
        some->second.pose = place();
    else
        some->second.pose.position += detail::to_float(random.in_cube<D>() * 0.3);
    ASSERT_FALSE(compound.move(some->first, some->second.pose));
}

/// The answers are those of the children one by one.
template <int D>
void expect_children(oracle::Random& random, const Compound<D>& compound, const Children<D>& children) {
    ASSERT_TRUE(children.empty() || compound.size() > children.rbegin()->first);
    for (std::uint32_t i = 0; i < compound.size(); ++i) ASSERT_EQ(compound.has_child(i), children.contains(i));
    const Vec<D> from = detail::to_float(random.in_cube<D>() * 6.0), to = detail::to_float(random.in_cube<D>() * 6.0);
    const Box<D> box{from, Vec<D>(0.5f), random.rotation<D>()};
    const Ray<D> ray = Ray<D>::between(from, to);
    Closest<D> near;
    near.distance = std::numeric_limits<float>::infinity();
    float fraction = 2;
    bool touches = false, inside = false;
    Aabb<D> all = Aabb<D>::empty();
    for (const auto& [index, child] : children) {
        const Closest<D> of_child = closest(box, child);
        if (of_child.distance < near.distance) {
            near = of_child;
            near.feature_b.part = index;
        }
        if (const auto hit = raycast(ray, child)) fraction = std::min(fraction, hit->fraction);
        touches = touches || overlaps(box, child);
        inside = inside || contains(child, to);
        all = merged(all, bounds(view(child)));
    }
    const Closest<D> found = closest(box, compound);
    ASSERT_EQ(found.distance, near.distance);
    if (!children.empty()) {
        ASSERT_EQ(found.feature_b.part, near.feature_b.part);
    }
    const auto hit = raycast(ray, compound);
    ASSERT_EQ(hit ? hit->fraction : 2, fraction);
    if (hit) {
        ASSERT_TRUE(children.contains(hit->feature.part));
    }
    ASSERT_EQ(overlaps(box, compound), touches);
    ASSERT_EQ(contains(compound, to), inside);
    ASSERT_EQ(bounds(compound).min, all.min);
    ASSERT_EQ(bounds(compound).max, all.max);
}

template <int D>
void expect_children_after_changes() {
    constexpr std::uint64_t seed = 20261129;
    oracle::Random random(seed);
    Compound<D> compound = *Compound<D>::build({Ball<D>{Vec<D>(0.0f), 1}});
    Children<D> children;
    children.emplace(0, At<AnyShape<D>>{Ball<D>{Vec<D>(0.0f), 1}, {}});
    // It grows, shrinks and is saved and loaded.
    std::size_t most = 0;
    for (int step = 0; step < 1400; ++step) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(step));
        change(random, compound, children);
        if (::testing::Test::HasFatalFailure()) return;
        if (step % 700 < 300) {
            const At<AnyShape<D>> child{Ball<D>{Vec<D>(0.0f), 0.25f},
                                        {detail::to_float(random.in_cube<D>() * 5.0), random.rotation<D>()}};
            children.emplace(*compound.add(child.shape, child.pose), child);
        }
        if (step % 700 > 450 && !children.empty()) {
            compound.remove(children.begin()->first);
            children.erase(children.begin());
        }
        most = std::max(most, children.size());
        if (step % 250 == 249) {
            const Result<std::vector<std::byte>> bytes = save(compound);
            ASSERT_TRUE(bytes);
            const Result<Compound<D>> again = load_compound<D>(*bytes);
            ASSERT_TRUE(again) << again.problem().message;
            EXPECT_EQ(*save(*again), *bytes);
            // What is in a file is given as it is placed, so that moves would be relative to that.
            expect_children(random, *again, children);
            Compound<D> changed = *again;
            Children<D> its_children = children;
            const At<AnyShape<D>> child{Ball<D>{Vec<D>(0.0f), 0.25f}, {}};
            its_children.emplace(*changed.add(child.shape), child);
            if (its_children.size() > 1) {
                changed.remove(its_children.rbegin()->first);
                its_children.erase(std::prev(its_children.end()));
            }
            expect_children(random, changed, its_children);
        }
        expect_children(random, compound, children);
        if (::testing::Test::HasFatalFailure()) return;
    }
    EXPECT_GT(most, 200u);
}

TEST(Compound, AnswersAsItsChildrenAfterManyChanges) {
    expect_children_after_changes<2>();
    expect_children_after_changes<3>();
}

}  // namespace
}  // namespace abut
