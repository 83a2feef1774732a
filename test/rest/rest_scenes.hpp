#pragma once

// Scenes that must come to rest: boxes on floors of every kind, each with internal edges below the boxes.

#include "../../scenes/small_physics.hpp"
#include "../shape/brushes.hpp"
#include <abut/shape/box.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/height_field.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/tile_map.hpp>
#include <abut/shape/voxel_map.hpp>

#include <string>

namespace abut::test {

using scenes::Real;
using scenes::SmallPhysics;

/// Squares along each axis, each 1 wide; the floor extends as far on both sides of the origin, and its surface is at
/// height 0.
inline constexpr int rest_side = 8;

template <int D>
using RestRotation = scenes::DoubleRotation<D>;

inline glm::dvec2 tilted(double angle, glm::dvec2) {
    return {std::cos(angle), std::sin(angle)};
}
inline glm::dquat tilted(double angle, glm::dquat) {
    return glm::angleAxis(angle, glm::normalize(glm::dvec3(0.3, 0, 1)));
}

inline constexpr std::array rest_floors_2{"box", "boxes", "tiles", "chain", "compound", "solid"};
inline constexpr std::array rest_floors_3{"box", "boxes", "mesh", "height field", "voxels", "compound", "solid"};

/// The tiles of a floor.
template <int D>
std::vector<Box<D>> floor_boxes() {
    std::vector<Box<D>> result;
    for (int z = D == 3 ? -rest_side : 0; z < (D == 3 ? rest_side : 1); ++z)
        for (int x = -rest_side; x < rest_side; ++x) {
            Vec<D> center(-0.5f);
            center[0] = static_cast<float>(x) + 0.5f;
            if constexpr (D == 3) center[2] = static_cast<float>(z) + 0.5f;
            result.push_back({center, Vec<D>(0.5f)});
        }
    return result;
}
template <int D>
Compound<D> floor_compound() {
    std::vector<AnyShape<D>> shapes;
    for (const Box<D>& box : floor_boxes<D>()) shapes.push_back(box);
    return *Compound<D>::build(shapes);
}
template <int D>
void add_common_floor(SmallPhysics<D>& physics, const std::string& kind, const Pose<D>& pose) {
    if (kind == "box") {
        Vec<D> center(0.0f), half(static_cast<float>(rest_side));
        center.y = -half.y;
        physics.add_fixed(Box<D>{center, half}, pose);
    } else if (kind == "boxes") {
        for (const Box<D>& box : floor_boxes<D>()) physics.add_fixed(box, pose);
    } else if (kind == "compound") {
        physics.add_fixed(floor_compound<D>(), pose);
    } else if (kind == "solid") {
        physics.add_fixed(solid_of_boxes(floor_boxes<D>()), pose);
    }
}
inline void add_floor(SmallPhysics<2>& physics, const std::string& kind, const Pose2& pose) {
    if (kind == "tiles") {
        const TileMap map = *TileMap::build(std::vector<Tile>(2 * rest_side, Tile::full), 2 * rest_side, 1.0f);
        physics.add_fixed(at(map, Pose2{{-rest_side, -1}}), pose);
    } else if (kind == "chain") {
        std::vector<Vec2> points;
        for (int x = rest_side; x >= -rest_side; --x) points.push_back({x, 0});
        physics.add_fixed(*Chain::build(points, false, {.one_sided = true}), pose);
    } else {
        add_common_floor(physics, kind, pose);
    }
}
inline void add_floor(SmallPhysics<3>& physics, const std::string& kind, const Pose3& pose) {
    constexpr int columns = 2 * rest_side + 1;
    if (kind == "mesh") {
        std::vector<Vec3> points;
        std::vector<glm::uvec3> triangles;
        const auto at = [](int x, int z) { return static_cast<std::uint32_t>(z * columns + x); };
        for (int z = 0; z < columns; ++z)
            for (int x = 0; x < columns; ++x) points.push_back({x - rest_side, 0, z - rest_side});
        for (int z = 0; z + 1 < columns; ++z)
            for (int x = 0; x + 1 < columns; ++x) {
                triangles.push_back({at(x, z), at(x, z + 1), at(x + 1, z)});
                triangles.push_back({at(x + 1, z), at(x, z + 1), at(x + 1, z + 1)});
            }
        physics.add_fixed(*Mesh::build(points, triangles), pose);
    } else if (kind == "height field") {
        const std::vector<float> heights(columns * columns, 0.0f);
        const HeightField field = *HeightField::build(heights, columns, 1);
        // Heights are along z there.
        const Pose3 up{{-rest_side, 0, rest_side}, {std::sqrt(0.5f), -std::sqrt(0.5f), 0, 0}};
        physics.add_fixed(at(field, up), pose);
    } else if (kind == "voxels") {
        const std::vector<std::uint64_t> bits(2 * rest_side * 2 * rest_side * 2 / 64, ~std::uint64_t{0});
        const VoxelMap map = *VoxelMap::build(bits, {2 * rest_side, 2, 2 * rest_side}, 1.0f);
        physics.add_fixed(at(map, Pose3{{-rest_side, -2, -rest_side}}), pose);
    } else {
        add_common_floor(physics, kind, pose);
    }
}

struct RestCase {
    std::string floor;
    double slope = 0, tilt = 0, base = 0;
};

/// Places boxes relative to the floor.
template <int D>
class RestScene {
public:
    explicit RestScene(const RestCase& of) : case_(of) {
        Real<D> base(of.base);
        base.y *= 0.5;
        floor_.position = base;
        floor_.rotation = tilted(of.slope, RestRotation<D>());
        add_floor(physics, of.floor, floor_.pose());
    }
    /// The first coordinate of the position is along the floor, the second is the height of the lower face.
    void add(double x, double height, double z, const Vec<D>& half) {
        Real<D> position(0.0);
        position[D - 1] = z;
        position.x = x;
        position.y = height + static_cast<double>(half.y) - 0.003;
        const double sign = ++count_ % 2 == 0 ? 1 : -1;
        const RestRotation<D> own = tilted(sign * case_.tilt, RestRotation<D>());
        if constexpr (D == 2) {
            const glm::dvec2 turn = floor_.rotation;
            physics.add_box(floor_.position + glm::dvec2(turn.x * position.x - turn.y * position.y,
                                                         turn.y * position.x + turn.x * position.y),
                            {turn.x * own.x - turn.y * own.y, turn.y * own.x + turn.x * own.y}, half);
        } else {
            physics.add_box(floor_.position + floor_.rotation * position, floor_.rotation * own, half);
        }
    }

    SmallPhysics<D> physics;

private:
    RestCase case_;
    scenes::Body<D> floor_;
    int count_ = 0;
};

template <int D>
Vec<D> box_half(float x, float y, float z) {
    if constexpr (D == 2)
        return {x, y};
    else
        return {x, y, z};
}

inline constexpr std::array rest_scenes{"crate", "stack", "pyramid", "plank"};

template <int D>
void add_bodies(RestScene<D>& scene, const std::string& name) {
    const Vec<D> crate = box_half<D>(0.5f, 0.5f, 0.5f);
    if (name == "crate") {
        scene.add(0.07, 0, 0.11, crate);
    } else if (name == "stack") {
        for (int i = 0; i < 10; ++i) scene.add(0.07 + 0.03 * (i % 2), i, 0.11 + 0.04 * (i % 2), crate);
    } else if (name == "pyramid") {
        constexpr int base = D == 2 ? 6 : 3;
        for (int row = 0; row < base; ++row)
            for (int i = 0; i < base - row; ++i)
                for (int k = 0; k < (D == 2 ? 1 : base - row); ++k)
                    scene.add(0.07 + 1.1 * (i - 0.5 * (base - 1 - row)), row,
                              0.11 + (D == 2 ? 0 : 1.1 * (k - 0.5 * (base - 1 - row))), crate);
    } else {
        scene.add(0.07, 0, 0.11, box_half<D>(2.7f, 0.1f, 0.4f));
        scene.add(-2.1, 0.2, 0.11, box_half<D>(0.3f, 0.3f, 0.3f));
        scene.add(1.3, 0.2, 0.11, box_half<D>(0.3f, 0.3f, 0.3f));
    }
}

struct Rest {
    double speed = 0;       ///< root mean square over the last seconds
    double persistent = 0;  ///< share of the contact points that were there in the step before
    double moved = 0;       ///< the farthest that a body moved in the last seconds
    double points = 0;      ///< mean number of contact points
};

template <int D>
Rest play(const std::string& name, const RestCase& of, double seconds = 20, double measured = 5) {
    RestScene<D> scene(of);
    add_bodies(scene, name);
    constexpr int rate = 240;
    const int steps = static_cast<int>(seconds * rate), first = static_cast<int>((seconds - measured) * rate);
    Rest result;
    double sum = 0, persistent = 0, points = 0;
    std::vector<Real<D>> from;
    for (int i = 0; i < steps; ++i) {
        scene.physics.step(1.0 / rate);
        if (i < first) continue;
        if (from.empty())
            for (const auto& body : scene.physics.bodies()) from.push_back(body.position);
        sum += scene.physics.speed() * scene.physics.speed();
        persistent += static_cast<double>(scene.physics.persistent_points());
        points += static_cast<double>(scene.physics.points());
    }
    std::size_t k = 0;
    for (const auto& body : scene.physics.bodies())
        result.moved = std::max(result.moved, glm::length(body.position - from[k++]));
    result.speed = std::sqrt(sum / (steps - first));
    result.persistent = points > 0 ? persistent / points : 0;
    result.points = points / (steps - first);
    return result;
}

}  // namespace abut::test
