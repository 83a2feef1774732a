#include <abut/draw/draw.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/polyhedron.hpp>

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace abut {
namespace {

/// The smallest canvas that a user can write.
template <int D>
class Lines final : public Canvas<D> {
public:
    Aabb<D> shown() const override { return {Vec<D>(-10), Vec<D>(10)}; }
    void line(const Vec<D>& a, const Vec<D>& b, const Style&) override {
        ends.push_back(a);
        ends.push_back(b);
    }
    void point(const Vec<D>&, const Style&) override { ++points; }

    std::vector<Vec<D>> ends;
    int points = 0;
};

TEST(Canvas, DrawsAPolygonByItsLinesByDefault) {
    Lines<2> canvas;
    const Vec2 corners[] = {{0, 0}, {1, 0}, {0, 1}};
    canvas.polygon(corners, {});
    EXPECT_EQ(canvas.ends, (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 0}, {0, 1}, {0, 1}, {0, 0}}));
    canvas.polygon(corners, {.stroke = transparent, .fill = {255, 0, 0}});
    EXPECT_EQ(canvas.ends.size(), 6u) << "an area alone has no lines";
}

TEST(Canvas, DrawsABallByLinesAtItsRadius) {
    Lines<2> flat;
    draw(flat, Circle{{1, 2}, 3});
    EXPECT_EQ(flat.ends.size(), 2 * 64u);
    for (const Vec2& end : flat.ends) EXPECT_NEAR(std::hypot(end.x - 1, end.y - 2), 3, 1e-5);

    Lines<3> deep;
    draw(deep, Sphere{{1, 2, 3}, 4});
    EXPECT_EQ(deep.ends.size(), 3 * 2 * 64u);
    for (const Vec3& end : deep.ends) EXPECT_NEAR(std::hypot(end.x - 1, end.y - 2, end.z - 3), 4, 1e-5);
}

TEST(Canvas, OfLinesAndPointsAloneShowsEverything) {
    Lines<3> canvas;
    canvas.text({0, 0, 0}, "not to be seen", {});
    EXPECT_TRUE(canvas.ends.empty());
    const Result<Polyhedron> hull = Polyhedron::build({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    ASSERT_TRUE(hull);
    draw(canvas, *hull);
    EXPECT_EQ(canvas.ends.size(), 2 * 6u);
    draw(canvas, closest(*hull, Sphere{{5, 0, 0}, 1}));
    EXPECT_EQ(canvas.points, 2);
}

}  // namespace
}  // namespace abut
