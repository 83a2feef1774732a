#pragma once

// Random shapes of every kind for golden hashes.

#include "../oracle/random.hpp"
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

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace abut {

/// Random shapes with integer coordinates, 8 units in extent and near the origin, so that the arithmetic of the tests
/// does not affect the answers. Each random number is drawn in a statement of its own, because compilers evaluate
/// arguments in any order.
template <int D>
class WholeNumbers {
public:
    /// On a coarse lattice, shapes share corners, edges and faces, coincide, or have no thickness.
    explicit WholeNumbers(std::uint64_t seed, bool coarse = false) : random_(seed), coarse_(coarse) {}

    float number(int most) {
        return static_cast<float>(static_cast<int>(random_.below(static_cast<std::uint32_t>(2 * most + 1))) - most);
    }
    float size() {
        return coarse_ ? 0.5f + 0.5f * static_cast<float>(random_.below(4))
                       : (1 + static_cast<float>(random_.below(64))) / 16;
    }
    Vec<D> point() {
        Vec<D> result;
        for (int i = 0; i < D; ++i) result[i] = coarse_ ? number(2) : number(512) / 128;
        return result;
    }
    Vec<D> half() {
        Vec<D> result;
        for (int i = 0; i < D; ++i) result[i] = size();
        return result;
    }
    Rotation<D> rotation() {
        if (coarse_) return no_rotation<D>;
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
    bool coarse_;
    std::vector<std::shared_ptr<const void>> stored_;
};

}  // namespace abut
