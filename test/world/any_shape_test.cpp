// Shapes that are added to several worlds. Regression: a view could be added once, and referred to a shape of the first
// world. When that shape was removed, the second world answered from freed memory: 14.5 for a distance of 0.5.

#include "support/bits.hpp"
#include <abut/shape/box.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/world/world.hpp>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

template <class S, int D>
concept Addable = requires(World<D>& world, const S& shape) {
    world.add(shape);
};
template <class S, int D>
concept Settable = requires(World<D>& world, const S& shape) {
    world.set_shape(Id{}, shape);
};
template <class S, int D>
constexpr bool is_ownable = Addable<S, D>&& Settable<S, D>&& std::is_constructible_v<AnyShape<D>, const S&>;
template <class S, int D>
constexpr bool is_refused =
    !Addable<S, D> && !Settable<S, D> && !std::is_constructible_v<AnyShape<D>, const S&> && !Ownable<S>;

static_assert(is_ownable<Circle, 2> && is_ownable<AnyShape<3>, 3> && is_ownable<At<Circle&>, 2> &&
              is_ownable<HalfSpace3, 3>);
static_assert(is_ownable<Stretched<AnyShape<3>>, 3> && is_ownable<Rounded<At<AnyShape<2>>>, 2> &&
              is_ownable<Compound2, 2>);
static_assert(is_ownable<Unowned<2>, 2> && is_ownable<At<Unowned<3>>, 3>);
static_assert(is_refused<View<2>, 2> && is_refused<detail::Convex<3>, 3> && is_refused<detail::Composite<3>, 3>);
static_assert(is_refused<DistanceFunction<2>, 2> && is_refused<At<View<2>>, 2> && is_refused<Stretched<View<3>&>, 3>);
static_assert(is_refused<Rounded<At<const detail::Convex<2>&>>, 2>);

Polyhedron tetrahedron(float size) {
    return *Polyhedron::build(
        std::vector<Vec3>{{-size, -size, -size}, {size, -size, -size}, {0, size, -size}, {0, 0, 2 * size}});
}

TEST(AnyShape, OfAWorldOutlivesItsItem) {
    World3 a, b;
    const Vec3 point{0, 0, 3};
    const Id id = a.add(tetrahedron(1), {.pose = {{5, 0, 0}}});
    const AnyShape<3> own_shape = a.any_shape(id);
    const Id copy = b.add(a.any_shape(id));
    a.remove(id);
    a.update();
    for (int i = 0; i < 10; ++i) a.add(tetrahedron(0.1f));
    const Closest<3> expected = closest(tetrahedron(1), point);
    EXPECT_EQ(Bits(closest(own_shape, point)), Bits(expected)) << "in its own frame, without the pose of its item";
    EXPECT_EQ(Bits(closest(b.shape(copy), point)), Bits(expected));
}

TEST(AnyShape, OfAWorldIsStretchedInPlace) {
    World3 world;
    const Pose3 pose{{5, 0, 0}, turn_about({0, 0, 1}, 0.5f)};
    const Id id = world.add(tetrahedron(1), {.pose = pose});
    world.set_shape(id, stretched(world.any_shape(id), {1, 0.5f, 1}));
    world.set_shape(id, rounded(world.any_shape(id), 0.25f));
    const Vec3 point{5, 3, 1};
    const Polyhedron own = tetrahedron(1);
    EXPECT_EQ(Bits(closest(world.shape(id), point)),
              Bits(closest(at(rounded(stretched(own, Vec3(1, 0.5f, 1)), 0.25f), pose), point)));
}

TEST(AnyShape, OfAWorldIsAPartOfACompound) {
    World2 world;
    const Id id = world.add(Box2{{0, 0}, {1, 1}});
    const auto compound = Compound2::build({world.any_shape(id), at(world.any_shape(id), Pose2{{5, 0}})});
    world.remove(id);
    EXPECT_EQ(closest(*compound, Vec2(8, 0)).distance, 2);
}

}  // namespace
}  // namespace abut::test
