// Determinism: a hash over the bits of a million answers of every query equals a constant, with each SIMD target of
// this machine.
//
// The shapes have integer coordinates, so this file's arithmetic does not affect the answers. After a change that is
// meant to change answers, the constant is renewed from the failing test's output. First, gcc and clang with -O0 and
// -O3 -march=native must agree on it.

#include "../oracle/random.hpp"
#include "../oracle/simd_targets.hpp"
#include "hash.hpp"
#include <abut/query/certify.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/intersection.hpp>
#include <abut/query/minkowski_sum.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace abut {
namespace {

/// Random shapes with integer coordinates, 8 units in extent and near the origin. Each random number is drawn in a
/// statement of its own, because compilers evaluate arguments in any order.
template <int D>
class WholeNumbers {
public:
    explicit WholeNumbers(std::uint64_t seed) : random_(seed) {}

    float number(int most) {
        return static_cast<float>(static_cast<int>(random_.below(static_cast<std::uint32_t>(2 * most + 1))) - most);
    }
    float size() { return (1 + static_cast<float>(random_.below(64))) / 16; }
    Vec<D> point() {
        Vec<D> result;
        for (int i = 0; i < D; ++i) result[i] = number(512) / 128;
        return result;
    }
    Vec<D> half() {
        Vec<D> result;
        for (int i = 0; i < D; ++i) result[i] = size();
        return result;
    }
    Rotation<D> rotation() {
        if constexpr (D == 2)
            return {number(100), number(100)};
        else
            return glm::quat{number(100), number(100), number(100), number(100)};
    }
    std::vector<Vec<D>> points(std::uint32_t count) {
        std::vector<Vec<D>> result;
        for (std::uint32_t i = 0; i < count; ++i) result.push_back(point());
        return result;
    }

    /// The shape lives as long as this generator.
    View<D> shape() {
        switch (random_.below(D == 2 ? 9 : 12)) {
            case 0:
                return keep(Ball<D>{point(), size()});
            case 1:
                return keep(Capsule<D>{point(), point(), size()});
            case 2:
                return keep(Segment<D>{point(), point()});
            case 3:
                return keep(Triangle<D>{point(), point(), point()});
            case 4:
                return keep(Box<D>{point(), half(), rotation()});
            case 5: {
                const Pose<D> pose{point(), rotation()};
                const Box<D> box{point(), half()};
                return keep(at(rounded(Box<D>(box), size()), pose));
            }
            case 6: {
                const Pose<D> pose{point(), rotation()};
                const Ball<D> ball{point() / 8.0f, size()};
                return keep(at(stretched(Ball<D>(ball), half()), pose));
            }
            case 7:
                if constexpr (D == 2)
                    return keep(*Polygon::build(points(random_.below(8) == 0 ? 120 : 8)));
                else
                    return keep(*Polyhedron::build(points(random_.below(8) == 0 ? 60 : 12)));
            case 8: {
                const Vec<D> a = point(), b = point();
                return keep(merged(Aabb<D>{a, a}, Aabb<D>{b, b}));
            }
            case 9:
                if constexpr (D == 3) return keep(Cylinder{point(), point(), size()});
                break;
            case 10:
                if constexpr (D == 3) return keep(Cone{point(), point(), size()});
                break;
            default:
                if constexpr (D == 3) {
                    std::vector<glm::uvec3> triangles;
                    for (int i = 0; i < 8; ++i)
                        triangles.push_back({random_.below(8), random_.below(8), random_.below(8)});
                    return keep(*Mesh::build(points(8), triangles));
                }
                break;
        }
        return {};
    }

private:
    template <class S>
    View<D> keep(S shape) {
        auto stored = std::make_shared<const S>(std::move(shape));
        stored_.push_back(stored);
        return view(*stored);
    }

    oracle::Random random_;
    std::vector<std::shared_ptr<const void>> stored_;
};

/// The cheap queries.
template <int D>
void add_answers(Hash& hash, WholeNumbers<D>& make, const View<D>& a, const View<D>& b, Cache& cache) {
    hash.add(std::uint64_t{overlaps(a, b)});
    const Closest<D> found = closest(a, b);
    add_closest(hash, found);
    add_closest(hash, closest(a, b, {.cache = &cache}));
    hash.add(std::uint64_t{certify(a, b, found).holds});
    add_contact(hash, contact(a, b));
    add_contact(hash, contact(a, b, {.margin = 1}));
    hash.add(std::uint64_t{contains(a, make.point())});
    add_closest(hash, closest(a, make.point()));
    const Vec<D> from = make.point() * 4.0f;
    add_hit(hash, raycast(Ray<D>::between(from, make.point()), a));
}

/// The queries that return polytopes.
template <int D>
void add_polytopes(Hash& hash, WholeNumbers<D>& make) {
    const auto add = [&](const PolytopeOf<D>& polytope) {
        for (const Vec<D>& point : polytope.points()) hash.add<D>(point);
        hash.add<D>(polytope.centroid());
        hash.add<D>(polytope.normal());
    };
    const Box<D> box{make.point(), make.half(), make.rotation()};
    const PolytopeOf<D> hull = *PolytopeOf<D>::build(make.points(12));
    const Triangle<D> triangle{make.point(), make.point(), make.point()};
    if (const auto overlap = intersection(box, hull)) add(*overlap);
    if (const auto overlap = intersection(hull, triangle)) add(*overlap);
    add(minkowski_sum(box, triangle));
    add(minkowski_difference(hull, box));
    const Ball<D> ball{make.point(), make.size()};
    add(polytope(ball, ball.radius / 4));
}

template <int D>
std::uint64_t hash_of_answers() {
    Hash hash;
    Cache cache;
    for (std::uint64_t seed = 0; seed < 60000; ++seed) {
        WholeNumbers<D> make(seed);
        const View<D> a = make.shape(), b = make.shape();
        add_answers<D>(hash, make, a, b, cache);
        if (seed % 25 == 0) add_polytopes<D>(hash, make);
    }
    return hash.value();
}

class Golden : public oracle::BySimdTarget {};

TEST_P(Golden, AnswersInThePlaneHaveTheSameBitsEverywhere) {
    EXPECT_EQ(hash_of_answers<2>(), 507605480454300265u);
}
TEST_P(Golden, AnswersInSpaceHaveTheSameBitsEverywhere) {
    EXPECT_EQ(hash_of_answers<3>(), 17006860094429097013u);
}

INSTANTIATE_TEST_SUITE_P(Targets, Golden, oracle::simd_targets(), oracle::simd_target_name);

}  // namespace
}  // namespace abut
