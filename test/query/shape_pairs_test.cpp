// Every kind of shape against every other, at two poses with known answers: each shape ends at x = 1, where it is flat,
// or round about the x axis.

#include "../oracle/expect.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <memory>
#include <vector>

namespace abut {
namespace {

using oracle::near;

template <int D>
struct Entry {
    std::string name;
    std::shared_ptr<const void> keeper;
    View<D> view;
    bool thin = false;  ///< of zero thickness
};

template <int D>
class Zoo {
public:
    template <class S>
    void add(const std::string& name, S shape, bool thin = false) {
        auto keeper = std::make_shared<const S>(std::move(shape));
        entries_.push_back({name, keeper, view(*keeper), thin});
    }
    const std::vector<Entry<D>>& entries() const { return entries_; }

private:
    std::vector<Entry<D>> entries_;
};

Zoo<2> zoo(std::integral_constant<int, 2>) {
    const Turn quarter = Turn::by(1.57079633f);
    Zoo<2> zoo;
    zoo.add("Circle", Circle{{0, 0}, 1});
    zoo.add("Capsule across", Capsule<2>{{0.5f, -1}, {0.5f, 1}, 0.5f});
    zoo.add("Capsule along", Capsule<2>{{-1, 0}, {0.5f, 0}, 0.5f});
    zoo.add("Box", Box2{{0, 0}, {1, 2}});
    zoo.add("turned Box", Box2{{0, 0}, {2, 1}, quarter});
    zoo.add("Aabb", Aabb2{{-1, -1}, {1, 1}});
    zoo.add("Polygon", *Polygon::build({{1, -1}, {1, 1}, {-1, 2}, {-2, 0}, {-1, -2}}));
    zoo.add("rounded Box", rounded(Box2{{0, 0}, {0.5f, 0.5f}}, 0.5f));
    zoo.add("ellipse", stretched(Circle{{0, 0}, 1}, Vec2(1, 2)));
    zoo.add("placed Box", at(Box2{{-3, 0}, {1, 1}}, Pose2{{0, 3}, quarter}));
    zoo.add("Segment", Segment<2>{{-1, 0}, {1, 0}}, true);
    zoo.add("point", Circle{{1, 0}, 0}, true);
    zoo.add("pointed Triangle", Triangle<2>{{1, 0}, {0.5f, 1}, {0.5f, -1}});
    return zoo;
}

Zoo<3> zoo(std::integral_constant<int, 3>) {
    const glm::quat quarter = turn_about({0, 0, 1}, 1.57079633f);
    Zoo<3> zoo;
    zoo.add("Sphere", Sphere{{0, 0, 0}, 1});
    zoo.add("Capsule across", Capsule<3>{{0.5f, -1, 0}, {0.5f, 1, 0}, 0.5f});
    zoo.add("Capsule along", Capsule<3>{{-1, 0, 0}, {0.5f, 0, 0}, 0.5f});
    zoo.add("Box", Box3{{0, 0, 0}, {1, 2, 1}});
    zoo.add("turned Box", Box3{{0, 0, 0}, {2, 1, 1}, quarter});
    zoo.add("Aabb", Aabb3{{-1, -1, -1}, {1, 1, 1}});
    zoo.add("Polyhedron",
            *Polyhedron::build({{1, -1, -1}, {1, 1, -1}, {1, -1, 1}, {1, 1, 1}, {-2, 0, 0}, {-1, 2, 0}, {-1, -2, 0}}));
    zoo.add("Cylinder", Cylinder{{-1, 0, 0}, {1, 0, 0}, 1});
    zoo.add("Cylinder on its side", Cylinder{{0, -1, 0}, {0, 1, 0}, 1});
    zoo.add("Cone", Cone{{1, 0, 0}, {-1, 0, 0}, 1});
    zoo.add("rounded Box", rounded(Box3{{0, 0, 0}, {0.5f, 0.5f, 0.5f}}, 0.5f));
    zoo.add("ellipsoid", stretched(Sphere{{0, 0, 0}, 1}, Vec3(1, 2, 2)));
    zoo.add("placed Box", at(Box3{{-3, 0, 0}, {1, 1, 1}}, Pose3{{0, 3, 0}, quarter}));
    zoo.add("Segment", Segment<3>{{-1, 0, 0}, {1, 0, 0}}, true);
    zoo.add("Triangle", Triangle<3>{{1, 0, 0}, {0.5f, 1, 0}, {0.5f, -1, 0}}, true);
    zoo.add("point", Sphere{{1, 0, 0}, 0}, true);
    return zoo;
}

/// The pose that rotates the shape by 180 degrees, so that its end at x = 1 is at `border` and faces -x.
Pose2 facing(std::integral_constant<int, 2>, float border) {
    return {{border + 1, 0}, Turn{-1, 0}};
}
Pose3 facing(std::integral_constant<int, 3>, float border) {
    return {{border + 1, 0, 0}, glm::quat(0, 0, 0, 1)};
}

/// Depths of round shapes are right to 1e-3 of their size, which is at most 3 here.
constexpr double tolerance = 2e-3;

template <class T>
class ShapePairs : public testing::Test {
protected:
    static constexpr int dimensions = T::value;

    template <class Visit>
    static void each_pair(float border, Visit&& visit) {
        const Zoo<dimensions> all = zoo(T());
        for (const auto& a : all.entries())
            for (const auto& b : all.entries()) {
                SCOPED_TRACE(a.name + " against " + b.name);
                visit(a, b, view(at(b.view, facing(T(), border))));
            }
    }
    static Vec<dimensions> along_x(float x) {
        Vec<dimensions> result(0);
        result[0] = x;
        return result;
    }
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(ShapePairs, Dimensions);

TYPED_TEST(ShapePairs, AreOneApart) {
    constexpr int D = TypeParam::value;
    this->each_pair(2, [&](const auto& a, const Entry<D>&, const auto& b) {
        EXPECT_FALSE(overlaps(a.view, b));
        EXPECT_FALSE(contact(a.view, b));
        const Closest<D> found = closest(a.view, b);
        EXPECT_NEAR(found.distance, 1, 1e-6);
        EXPECT_TRUE(near(found.normal, this->along_x(1), 1e-3));
        EXPECT_NEAR(found.on_a.x, 1, 1e-6);
        EXPECT_NEAR(found.on_b.x, 2, 1e-6);
        // With a contact margin, a near miss is a contact of negative depth.
        const Contact<D> miss = contact(a.view, b, {.margin = 1.5f});
        ASSERT_TRUE(miss);
        EXPECT_NEAR(miss.depth, -1, 1e-6);
        for (const ContactPoint<D>& point : miss.points) EXPECT_LE(point.depth, -1 + 1e-5f);
    });
}

TYPED_TEST(ShapePairs, AreAQuarterDeep) {
    constexpr int D = TypeParam::value;
    this->each_pair(0.75f, [&](const auto& entry_a, const Entry<D>& entry_b, const auto& b) {
        const View<D>& a = entry_a.view;
        const Closest<D> found = closest(a, b);
        if (entry_a.thin && entry_b.thin) {  // both lie in one line or plane, or are points
            EXPECT_GE(found.distance, 0);
            return;
        }
        // Wedges and tips of flat shapes separate sideways; blunt shapes separate along x.
        EXPECT_TRUE(overlaps(a, b));
        EXPECT_LT(found.distance, 0);
        EXPECT_GE(found.distance, -0.25 - tolerance);
        const Contact<D> touch = contact(a, b);
        ASSERT_TRUE(touch);
        EXPECT_NEAR(touch.depth, -found.distance, tolerance);
        const bool pointed = (entry_a.name + entry_b.name).find("pointed") != std::string::npos;
        if (pointed && (entry_a.thin || entry_b.thin || entry_a.name == entry_b.name)) return;
        EXPECT_NEAR(found.distance, -0.25, tolerance);
        EXPECT_TRUE(near(found.normal, this->along_x(1), 0.1));
        EXPECT_NEAR(found.on_a.x, 1, tolerance);
        EXPECT_NEAR(found.on_b.x, 0.75, tolerance);
    });
}

TYPED_TEST(ShapePairs, AreHitByARayAtTheirBorder) {
    constexpr int D = TypeParam::value;
    const Zoo<D> all = zoo(TypeParam());
    for (const auto& entry : all.entries()) {
        SCOPED_TRACE(entry.name);
        Ray<D> ray = Ray<D>::between(this->along_x(5), this->along_x(-3));
        const auto hit = raycast(ray, entry.view);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->distance, 4, 1e-5);
        EXPECT_NEAR(hit->fraction, 0.5, 1e-6);
        EXPECT_TRUE(near(hit->point, this->along_x(1), 1e-5));
        // At the tip of the triangle, every direction between the normals of its sides is valid.
        EXPECT_TRUE(near(hit->normal, this->along_x(1), entry.name == "pointed Triangle" ? 0.5 : 1e-3));
        EXPECT_FALSE(hit->started_inside);
        EXPECT_FALSE(raycast(Ray<D>::between(this->along_x(5), this->along_x(1.001f)), entry.view));
        EXPECT_FALSE(raycast(Ray<D>::between(this->along_x(2), this->along_x(5)), entry.view));
    }
}

TYPED_TEST(ShapePairs, ContainTheirBorder) {
    constexpr int D = TypeParam::value;
    const Zoo<D> all = zoo(TypeParam());
    for (const auto& entry : all.entries()) {
        SCOPED_TRACE(entry.name);
        EXPECT_TRUE(contains(entry.view, this->along_x(0.999f)) || entry.thin);
        EXPECT_FALSE(contains(entry.view, this->along_x(1.001f)));
        EXPECT_NEAR(closest(entry.view, this->along_x(3)).distance, 2, 1e-5);
    }
}

TYPED_TEST(ShapePairs, MeetAHalfSpace) {
    constexpr int D = TypeParam::value;
    const Zoo<D> all = zoo(TypeParam());
    for (const auto& entry : all.entries()) {
        SCOPED_TRACE(entry.name);
        const HalfSpace<D> ahead{this->along_x(-1), -2}, into{this->along_x(-1), -0.75f};
        EXPECT_FALSE(overlaps(entry.view, ahead));
        EXPECT_FALSE(contact(entry.view, ahead));
        const Closest<D> gap = closest(entry.view, ahead);
        EXPECT_NEAR(gap.distance, 1, 1e-6);
        EXPECT_TRUE(near(gap.normal, this->along_x(1)));
        EXPECT_NEAR(gap.on_a.x, 1, 1e-6);
        EXPECT_NEAR(gap.on_b.x, 2, 1e-6);

        EXPECT_TRUE(overlaps(into, entry.view));
        const Closest<D> deep = closest(into, entry.view);
        EXPECT_NEAR(deep.distance, -0.25, 1e-6);
        EXPECT_TRUE(near(deep.normal, this->along_x(-1)));
        EXPECT_NEAR(deep.on_a.x, 0.75, 1e-6);
        EXPECT_NEAR(deep.on_b.x, 1, 1e-6);
        const Contact<D> touch = contact(entry.view, into);
        ASSERT_TRUE(touch);
        EXPECT_NEAR(touch.depth, 0.25, 1e-6);
        EXPECT_TRUE(near(touch.normal, this->along_x(1)));
    }
}

}  // namespace
}  // namespace abut
