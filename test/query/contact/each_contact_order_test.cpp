// The contacts of each_contact don't depend on the numbering of the parts or on the order of the two shapes.

#include "../../oracle/random.hpp"
#include <abut/query/each_contact.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/segment.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace abut {
namespace {

using oracle::Random;

/// Normal, depth, and the points with their depths; `turn` = -1 reverses the normal.
template <int D>
std::vector<float> numbers_of(const Contact<D>& contact, float turn) {
    std::vector<float> result;
    const auto add = [&](const Vec<D>& v, float sign) {
        for (int i = 0; i < D; ++i) result.push_back(sign * v[i] + 0.0f);
    };
    add(contact.normal, turn);
    result.push_back(contact.depth);
    std::vector<std::vector<float>> points;
    for (const ContactPoint<D>& point : contact.points) {
        std::vector<float>& numbers = points.emplace_back();
        for (int i = 0; i < D; ++i) numbers.push_back(point.position[i] + 0.0f);
        numbers.push_back(point.depth);
    }
    std::sort(points.begin(), points.end());
    for (const auto& point : points) result.insert(result.end(), point.begin(), point.end());
    return result;
}

template <int D>
std::vector<std::vector<float>> contacts_of(const View<D>& a, const View<D>& b, float turn = 1) {
    std::vector<std::vector<float>> result;
    each_contact(a, b, [&](const Contact<D>& contact) { result.push_back(numbers_of(contact, turn)); });
    std::sort(result.begin(), result.end());
    return result;
}

template <class Parts>
void shuffle(Parts& parts, Random& random) {
    for (std::size_t i = parts.size(); i > 1; --i)
        std::swap(parts[i - 1], parts[random.below(static_cast<std::uint32_t>(i))]);
}

constexpr int side = 12;  // squares along each side of the ground, each 1 wide

/// A ground that is flat in places and rough in others; some triangles are doubled.
struct Ground {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;

    explicit Ground(Random& random) {
        const double rough = random.chance(0.5) ? 0 : random.uniform(0.01, 0.5);
        for (int z = 0; z <= side; ++z)
            for (int x = 0; x <= side; ++x)
                points.push_back({x, random.chance(0.5) ? 0 : random.uniform_float(-rough, rough), z});
        const auto at = [](int x, int z) { return static_cast<std::uint32_t>(z * (side + 1) + x); };
        for (int z = 0; z < side; ++z)
            for (int x = 0; x < side; ++x) {
                triangles.push_back({at(x, z), at(x, z + 1), at(x + 1, z)});
                triangles.push_back({at(x + 1, z), at(x, z + 1), at(x + 1, z + 1)});
                if (random.chance(0.1)) triangles.push_back(triangles.back());
            }
    }
};

TEST(EachContactOrder, OfTrianglesDoesNotMatter) {
    int several = 0, many = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        Ground ground(random);
        const Mesh one = *Mesh::build(ground.points, ground.triangles);
        shuffle(ground.triangles, random);
        const Mesh other = *Mesh::build(ground.points, ground.triangles);
        const float size = random.chance(0.2) ? 4.0f : 1.5f;
        const Box3 box{{random.uniform_float(2, 10), random.uniform_float(-0.3, 0.3), random.uniform_float(2, 10)},
                       {size, 0.3f, 0.7f * size},
                       random.chance(0.5) ? random.rotation<3>() : no_rotation<3>};
        const auto expected = contacts_of<3>(view(box), view(one));
        EXPECT_EQ(contacts_of<3>(view(box), view(other)), expected);
        several += expected.size() > 3 ? 1 : 0;
        many += expected.size() > 8 ? 1 : 0;
    }
    EXPECT_GT(several, 80);
    EXPECT_GT(many, 5);
}

TEST(EachContactOrder, OfBoxesDoesNotMatter) {
    int several = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        std::vector<AnyShape<2>> tiles;
        for (int i = 0; i < 40; ++i) {
            const Vec2 place(static_cast<float>(i % 10), static_cast<float>(i / 10));
            if (random.chance(0.7)) tiles.push_back(Box2{place, {0.5f, 0.5f}});
        }
        const Compound2 one = *Compound2::build(tiles);
        shuffle(tiles, random);
        const Compound2 other = *Compound2::build(tiles);
        const Box2 box{{random.uniform_float(2, 8), random.uniform_float(0, 4)},
                       {random.uniform_float(0.2, 2), 0.4f},
                       random.rotation<2>()};
        const auto expected = contacts_of<2>(view(box), view(one));
        EXPECT_EQ(contacts_of<2>(view(box), view(other)), expected);
        several += expected.size() > 2 ? 1 : 0;
    }
    EXPECT_GT(several, 100);
}

/// A floor of `count` boxes, from 0 on.
Compound2 row_of_boxes(int count, float width) {
    std::vector<AnyShape<2>> boxes;
    for (int i = 0; i < count; ++i)
        boxes.push_back(Box2{{width * (static_cast<float>(i) + 0.5f), 0}, {0.5f * width, 0.5f}});
    return *Compound2::build(boxes);
}

/// Two rows of boxes, one on the other: normals of internal edges of either row are replaced by level ones.
TEST(EachContactOrder, OfTheTwoShapesDoesNotMatter) {
    const Compound2 floor = row_of_boxes(8, 1), moving = row_of_boxes(3, 0.7f);
    int contacts_compared = 0;
    for (int i = 0; i < 300; ++i) {
        const float x = 1 + 0.0137f * static_cast<float>(i), depth = 0.0007f * static_cast<float>(i % 90);
        const auto placed = at(moving, Pose2{{x, 1 - depth}});
        const View<2> a = view(placed), b = view(floor);
        const auto one = contacts_of<2>(a, b), other = contacts_of<2>(b, a, -1);
        ASSERT_EQ(one.size(), other.size()) << i;
        for (std::size_t k = 0; k < one.size(); ++k, ++contacts_compared) {
            EXPECT_NEAR(one[k][0], 0, 1e-6) << i;
            EXPECT_NEAR(one[k][1], -1, 1e-6) << i;
            EXPECT_NEAR(one[k][2], depth, 1e-6) << i;
            EXPECT_NEAR(other[k][1], -1, 1e-6) << i;
            EXPECT_NEAR(other[k][2], depth, 1e-6) << i;
        }
    }
    EXPECT_EQ(contacts_compared, 300);
}

/// A row of boxes lies on a block with an internal edge above it. The contact has the plane of the row, in either order
/// of the two shapes.
TEST(EachContactOrder, OfTwoCompositesTheRightSurfaceIsReported) {
    const Compound2 row = row_of_boxes(3, 1), block = row_of_boxes(1, 1);
    const auto placed = at(row, Pose2{{4, 0.95f}});
    const auto under = at(block, Pose2{{4.97f, 0}});
    const auto one = contacts_of<2>(view(placed), view(under)), other = contacts_of<2>(view(under), view(placed), -1);
    ASSERT_GT(one.size(), 0u);
    EXPECT_EQ(one, other);
    for (const auto& contact : one) {
        EXPECT_NEAR(contact[1], -1, 1e-6);
        EXPECT_NEAR(contact[2], 0.05, 1e-6);
    }
}

/// A shape of one part lies between two parts of the other: the substitute normal is the same in either order.
TEST(EachContactOrder, OfAGhostIsTheSameFromEitherSide) {
    const Compound2 floor = row_of_boxes(8, 1);
    // The overlap is deeper than the width of either box below the shape.
    const Box2 box{{4, 0.55f}, {0.04f, 0.1f}};
    const auto one = contacts_of<2>(view(box), view(floor)), other = contacts_of<2>(view(floor), view(box), -1);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_EQ(one, other);
    EXPECT_NEAR(one[0][1], -1, 1e-6);
    EXPECT_NEAR(one[0][2], 0.05, 1e-6);
}

}  // namespace
}  // namespace abut
