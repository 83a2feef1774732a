// Saving and loading of shapes.

#include "../oracle/seal.hpp"
#include "saved_shapes.hpp"
#include <abut/field/file.hpp>
#include <abut/walk/file.hpp>

#include <cstring>
#include <limits>
#include <string>
#include <typeinfo>

#include <gtest/gtest.h>

namespace abut {
namespace {

using namespace test;
using oracle::Random;
using oracle::seal;

constexpr std::size_t checksum_sums = 8;

template <class S>
Problem refusal_of(const Bytes& bytes) {
    const Result<S> result = load<S>(bytes);
    if (result) return {ProblemCode::cancelled, "it was loaded"};
    EXPECT_FALSE(result.problem().message.empty());
    EXPECT_EQ(result.problem().message.find('\n'), std::string::npos);
    return result.problem();
}

template <class S>
void expect_same(std::uint64_t seeds) {
    int touching = 0, queries = 0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const S shape = random_shape<S>(random);
        const Bytes bytes = file_of(shape);
        const Result<S> again = load<S>(bytes);
        ASSERT_TRUE(again) << again.problem().message;
        ASSERT_EQ(file_of(*again), bytes);
        Random first(seed), second(seed);
        queries += 2 * 6;
        int also = 0;
        ASSERT_EQ(answers_of(*again, second, 6, also), answers_of(shape, first, 6, touching));
    }
    if (seeds < 10) return;
    EXPECT_GT(touching, queries / 20);
    EXPECT_LT(touching, queries * 9 / 10);
}

TEST(ShapeFile, IsTheSameMeshAgain) {
    expect_same<Mesh>(200);
}
TEST(ShapeFile, IsTheSamePolyhedronAgain) {
    expect_same<Polyhedron>(400);
}
TEST(ShapeFile, IsTheSamePolygonAgain) {
    expect_same<Polygon>(400);
}
TEST(ShapeFile, IsTheSameHeightFieldAgain) {
    expect_same<HeightField>(100);
}
TEST(ShapeFile, IsTheSameTileMapAgain) {
    expect_same<TileMap>(100);
}
TEST(ShapeFile, IsTheSameVoxelMapAgain) {
    expect_same<VoxelMap>(100);
}
TEST(ShapeFile, IsTheSameChainAgain) {
    expect_same<Chain>(200);
}
TEST(ShapeFile, IsTheSameSolidLevelAgain) {
    expect_same<SolidBsp2>(150);
    expect_same<SolidBsp3>(150);
}
TEST(ShapeFile, IsTheSameCompoundAgain) {
    expect_same<Compound2>(100);
    expect_same<Compound3>(100);
}

TEST(ShapeFile, IsTheSamePolytopeAgainForAnyPoints) {
    int count = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        const double scale = random.power_of_two(-60, 60), far = random.chance(0.3) ? random.power_of_two(0, 20) : 0;
        const auto moved = [&](auto points) {
            for (auto& p : points) p = (p + static_cast<float>(far)) * static_cast<float>(scale);
            return points;
        };
        HullOptions options;
        if (random.chance(0.3)) options.max_vertices = 4 + random.below(6);
        const auto polygon = Polygon::build(moved(random_points<2>(random)), options);
        const auto polyhedron = Polyhedron::build(moved(random_points<3>(random)), options);
        if (!polygon || !polyhedron) continue;
        ++count;
        const auto loaded_polygon = load_polygon(save(*polygon));
        const auto loaded_polyhedron = load_polyhedron(save(*polyhedron));
        ASSERT_TRUE(loaded_polygon) << "seed " << seed << ": " << loaded_polygon.problem().message;
        ASSERT_TRUE(loaded_polyhedron) << "seed " << seed << ": " << loaded_polyhedron.problem().message;
        ASSERT_EQ(loaded_polyhedron->volume(), polyhedron->volume());
        ASSERT_EQ(loaded_polyhedron->rank(), polyhedron->rank());
        ASSERT_EQ(loaded_polygon->area(), polygon->area());
    }
    EXPECT_GT(count, 1900);
}

TEST(ShapeFile, OfADefaultPolytopeIsAPoint) {
    const Result<Polyhedron> polyhedron = load_polyhedron(save(Polyhedron()));
    ASSERT_TRUE(polyhedron) << polyhedron.problem().message;
    EXPECT_EQ(polyhedron->points().size(), 1u);
    const Result<Polygon> polygon = load_polygon(save(Polygon()));
    ASSERT_TRUE(polygon) << polygon.problem().message;
    EXPECT_EQ(polygon->points()[0], Vec2(0, 0));
}

TEST(ShapeFile, CutShortOrDamagedIsRefused) {
    each_saved_type([]<class S>() {
        SCOPED_TRACE(typeid(S).name());
        Random random(3);
        Bytes bytes = file_of(random_shape<S>(random));
        while (bytes.size() > 3000) bytes = file_of(random_shape<S>(random));
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
            ASSERT_EQ(refusal_of<S>(cut).code, ProblemCode::bad_format) << size;
        }
        for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
            Bytes damaged = bytes;
            damaged[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
            ASSERT_EQ(refusal_of<S>(damaged).code, ProblemCode::bad_format) << bit;
        }
        Bytes longer = bytes;
        longer.push_back(std::byte{0});
        EXPECT_EQ(refusal_of<S>(longer).code, ProblemCode::bad_format);
        seal(longer, checksum_sums);
        EXPECT_EQ(refusal_of<S>(longer).code, ProblemCode::bad_format);
    });
}

/// Each byte changed, and the checksum mended: the file is refused, or is that of a shape that answers.
TEST(ShapeFile, ChangedOnPurposeIsRefusedOrAnswers) {
    each_saved_type([]<class S>() {
        SCOPED_TRACE(typeid(S).name());
        int refused = 0, loaded = 0, touching = 0;
        for (std::uint64_t seed = 0; seed < 3; ++seed) {
            Random random(seed);
            Bytes bytes = file_of(random_shape<S>(random));
            while (bytes.size() > 6000) bytes = file_of(random_shape<S>(random));
            for (std::size_t i = 0; i + 8 < bytes.size(); ++i) {
                Bytes changed = bytes;
                changed[i] ^= static_cast<std::byte>(random.chance(0.5) ? 1 << random.below(8) : 1 + random.below(255));
                seal(changed, checksum_sums);
                const Result<S> shape = load<S>(changed);
                ++(shape ? loaded : refused);
                if (!shape) continue;
                ASSERT_EQ(file_of(*shape), changed) << "byte " << i << ", seed " << seed;
                answers_of(*shape, random, 1, touching);
            }
        }
        EXPECT_GT(refused, 50);
        EXPECT_GT(loaded, 5);
    });
}

TEST(ShapeFile, NamesWhatItIsInstead) {
    const Mesh mesh = box_surface({0, 0, 0}, {1, 1, 1}).mesh();
    const Bytes bytes = save(mesh);
    EXPECT_EQ(refusal_of<Polyhedron>(bytes).message, "this is a mesh, not a polyhedron");
    EXPECT_EQ(refusal_of<Mesh>(save(*Polygon::build({{0, 0}, {1, 0}, {0, 1}}))).message,
              "this is a polygon, not a mesh");
    EXPECT_EQ(refusal_of<SolidBsp3>(save(*SolidBsp2::build(std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}},
                                                           std::vector<glm::uvec2>{{0, 1}, {1, 2}, {2, 0}})))
                  .message,
              "this is a 2D solid level, not a 3D solid level");
    EXPECT_EQ(refusal_of<Mesh>(save(*WalkMesh::build(mesh.points(), mesh.triangles()))).message,
              "this is a walk mesh, not a mesh");
    EXPECT_EQ(refusal_of<Mesh>({}).message, "this is not a mesh: its signature is truncated");
    EXPECT_EQ(refusal_of<Mesh>(Bytes(100)).message, "this is not a mesh: its signature is wrong");
    const auto changed = [&](std::size_t at, std::uint32_t number) {
        Bytes other = bytes;
        std::memcpy(other.data() + at, &number, sizeof(number));
        seal(other, checksum_sums);
        return refusal_of<Mesh>(other).message;
    };
    EXPECT_EQ(changed(8, 99), "this is not a mesh: its kind is unknown");
    EXPECT_EQ(changed(12, 7), "a file of a mesh has version 7, not 1");
    Bytes damaged = bytes;
    damaged[100] ^= std::byte{1};
    EXPECT_EQ(refusal_of<Mesh>(damaged).message, "the file of a mesh is damaged: its checksum is wrong");
}

/// The counts of a mesh: none of them allocates more than the bytes have.
TEST(ShapeFile, CountsAreCheckedBeforeMemoryIsAllocated) {
    const Bytes bytes = save(box_surface({0, 0, 0}, {1, 1, 1}).mesh());
    for (std::size_t i = 0; i < 5; ++i)
        for (const std::uint64_t count :
             {std::uint64_t{1} << 20, std::uint64_t{1} << 32, std::uint64_t{1} << 60, UINT64_MAX}) {
            Bytes changed = bytes;
            std::memcpy(changed.data() + 16 + 8 * i, &count, sizeof(count));
            seal(changed, checksum_sums);
            EXPECT_EQ(refusal_of<Mesh>(changed).message, "the file of a mesh is truncated");
        }
}

TEST(ShapeFile, HasTheTrianglesThatThereCanBe) {
    const Bytes bytes = save(box_surface({0, 0, 0}, {1, 1, 1}).mesh());
    constexpr std::size_t header = 16 + 5 * 8 + 4 + 24, triangles = header + 8 * 12, neighbours = triangles + 12 * 12;
    const auto changed = [&](std::size_t at, auto number) {
        Bytes other = bytes;
        std::memcpy(other.data() + at, &number, sizeof(number));
        seal(other, checksum_sums);
        return refusal_of<Mesh>(other);
    };
    EXPECT_EQ(changed(header + 12, std::numeric_limits<float>::quiet_NaN()).message,
              "point 1 has a coordinate that is not finite");
    EXPECT_EQ(changed(triangles + 12, 8u).message, "triangle 1 names point 8 of 8");
    EXPECT_EQ(changed(neighbours + 24, 12u).message, "the file of a mesh names a neighbour that doesn't exist");
    EXPECT_EQ(changed(neighbours + 24, 12u).index, 2u);
    EXPECT_EQ(changed(neighbours + 12 * 12, 12u).message, "the file of a mesh has a triangle in two leaves");
}

/// A user's shape.
struct Dot {};
[[maybe_unused]] Aabb3 bounds(const Dot&) {
    return {{0, 0, 0}, {0, 0, 0}};
}
Vec3 support(const Dot&, const Vec3&) {
    return {0, 0, 0};
}

TEST(ShapeFile, OfACompoundHoldsTheShapesOfThisLibrary) {
    const Result<Bytes> bytes = save(*Compound3::build({Sphere{{0, 0, 0}, 1}, Dot()}));
    ASSERT_FALSE(bytes);
    EXPECT_EQ(bytes.problem().code, ProblemCode::bad_argument);
    EXPECT_EQ(bytes.problem().index, 1u);
    Compound3 nested = *Compound3::build({Sphere{{0, 0, 0}, 1}});
    for (int i = 1; i < 16; ++i) nested = *Compound3::build({nested});
    const Result<Bytes> deep = save(nested);
    ASSERT_TRUE(deep);
    EXPECT_TRUE(load_compound<3>(*deep));
    EXPECT_EQ(save(*Compound3::build({nested})).problem().code, ProblemCode::too_large);
    Compound3 many = *Compound3::build({Sphere{{0, 0, 0}, 1}});
    for (int i = 0; i < 4; ++i) many = *Compound3::build(std::vector<AnyShape<3>>(40, many));
    EXPECT_EQ(save(many).problem().code, ProblemCode::too_large);
}

TEST(ShapeFile, OfACompoundHoldsSharedDataOnce) {
    const Mesh mesh = box_surface({0, 0, 0}, {1, 1, 1}).mesh();
    std::vector<AnyShape<3>> children;
    for (int i = 0; i < 20; ++i) children.emplace_back(at(mesh, Pose3{{static_cast<float>(i), 0, 0}}));
    const Compound3 row = *Compound3::build(children);
    const Bytes bytes = *save(row);
    EXPECT_LT(bytes.size(), save(mesh).size() + 20 * 180);
    const Result<Compound3> again = load_compound<3>(bytes);
    ASSERT_TRUE(again);
    const auto tree = [&](std::uint32_t i) { return std::get<detail::Composite<3>>(again->child(i)).triangles; };
    EXPECT_NE(tree(0), nullptr);
    EXPECT_EQ(tree(0), tree(19));
}

}  // namespace
}  // namespace abut
