#pragma once

// Level shapes of every kind, with their parts for tests one by one.

#include "../oracle/random.hpp"
#include "../shape/meshes.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/height_field.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/solid_bsp.hpp>
#include <abut/shape/tile_map.hpp>
#include <abut/shape/voxel_map.hpp>

#include <functional>
#include <string>
#include <vector>

namespace abut::test {

using detail::axis;
using detail::dot;
using detail::DVec;
using detail::length;
using detail::to_float;

/// The placement of a level in the world.
template <int D>
struct Placing {
    Vec<D> scale{1.0f};
    Pose<D> pose{};
    float radius = 0;

    View<D> operator()(const View<D>& shape) const {
        const View<D> stands = moved(mapped(shape, detail::scaling(scale)), detail::affine(pose));
        return radius > 0 ? rounded(stands, static_cast<double>(radius)) : stands;
    }
};

template <int D>
struct LevelPart {
    View<D> view;
    std::uint32_t index;
};

template <int D>
struct Level {
    AnyShape<D> shape;
    std::vector<LevelPart<D>> parts;  ///< in the shape's own frame, to which they may refer
};

/// A placed level with its placed parts.
template <int D>
struct PlacedLevel {
    PlacedLevel(Level<D> of, const Placing<D>& placing) : level(std::move(of)), view(placing(level.shape.view())) {
        for (LevelPart<D> part : level.parts) {
            part.view = placing(part.view);
            parts.push_back(part);
        }
    }

    Level<D> level;
    View<D> view;
    std::vector<LevelPart<D>> parts;
};

template <int D>
Vec<D> random_point(oracle::Random& random, double extent) {
    return to_float(random.in_cube<D>() * extent);
}
template <int D>
Pose<D> random_pose(oracle::Random& random, double extent) {
    return {random_point<D>(random, extent), random.rotation<D>()};
}

/// A random placement: none, or a rotation, a stretch (sometimes mirrored) and a radius.
template <int D>
Placing<D> random_placing(oracle::Random& random) {
    Placing<D> result;
    if (random.chance(0.3)) return result;
    result.pose = random_pose<D>(random, 2);
    if (random.chance(0.5))
        for (int i = 0; i < D; ++i)
            result.scale[i] = random.uniform_float(0.5, 2) * (random.chance(0.3) ? -1.0f : 1.0f);
    if (random.chance(0.2)) result.radius = random.uniform_float(0.01, 0.3);
    return result;
}

inline AnyShape<2> random_convex(oracle::Random& random, std::integral_constant<int, 2>, double extent, double size) {
    const auto at_random = [&] { return random_point<2>(random, extent); };
    const auto length = [&] { return random.uniform_float(0.1 * size, size); };
    const Vec2 center = at_random();
    const auto beside = [&] { return center + random_point<2>(random, size); };
    switch (random.below(6)) {
        case 0:
            return Circle{center, length()};
        case 1:
            return Capsule<2>{center, beside(), 0.3f * length()};
        case 2:
            return Box2{center, {length(), length()}, random.rotation<2>()};
        case 3:
            return *Polygon::build({beside(), beside(), beside(), beside(), beside()});
        case 4:
            return Segment2{center, beside()};
        default:
            return stretched(Circle{center, length()}, Vec2(1, 0.5f));
    }
}
inline AnyShape<3> random_convex(oracle::Random& random, std::integral_constant<int, 3>, double extent, double size) {
    const auto at_random = [&] { return random_point<3>(random, extent); };
    const auto length = [&] { return random.uniform_float(0.1 * size, size); };
    const Vec3 center = at_random();
    const auto beside = [&] { return center + random_point<3>(random, size); };
    switch (random.below(7)) {
        case 0:
            return Sphere{center, length()};
        case 1:
            return Capsule<3>{center, beside(), 0.3f * length()};
        case 2:
            return Box3{center, {length(), length(), length()}, random.rotation<3>()};
        case 3:
            return *Polyhedron::build({beside(), beside(), beside(), beside(), beside(), beside()});
        case 4:
            return Segment3{center, beside()};
        case 5:
            return Triangle3{center, beside(), beside()};
        default:
            return Cylinder{center, beside(), length()};
    }
}

inline Level<2> level_of(const Chain& chain) {
    Level<2> result{chain, {}};
    for (std::uint32_t i = 0; i < chain.size(); ++i) {
        detail::Convex<2> part = convex(chain.segment(i));
        part.one_sided = chain.one_sided();
        result.parts.push_back({part, i});
    }
    return result;
}
inline Level<2> level_of(const TileMap& map) {
    Level<2> result{map, {}};
    for (std::uint32_t i = 0; i < map.size(); ++i)
        if (map.tile(i) != Tile::empty) result.parts.push_back({map.part(i), i});
    return result;
}
inline Level<3> level_of(const HeightField& field) {
    Level<3> result{field, {}};
    for (std::uint32_t i = 0; i < field.size(); ++i)
        if (!field.is_hole(i / 2)) result.parts.push_back({convex(field.triangle(i)), i});
    return result;
}
inline Level<3> level_of(const VoxelMap& map) {
    Level<3> result{map, {}};
    for (std::uint32_t i = 0; i < map.size(); ++i)
        if (map.at(i)) result.parts.push_back({convex(map.box(i)), i});
    return result;
}
inline Level<3> level_of(const Mesh& mesh) {
    Level<3> result{mesh, {}};
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i) result.parts.push_back({convex(mesh.triangle(i)), i});
    return result;
}

template <int D>
Level<D> level_of(const SolidBsp<D>& solid) {
    Level<D> result{solid, {}};
    constexpr float max_float = std::numeric_limits<float>::max();
    each_part(solid, Aabb<D>{Vec<D>(-max_float), Vec<D>(max_float)},
              [&](const detail::Convex<D>& part, std::uint32_t index) -> bool {
                  result.parts.push_back({part, index});
                  return true;
              });
    return result;
}

/// A random polyline: steps of random length and direction, a closed loop, or ground from left to right.
inline Level<2> random_chain(oracle::Random& random) {
    const bool closed = random.chance(0.5);
    const std::uint32_t count = 3 + random.below(40);
    std::vector<Vec2> points;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (closed) {
            const DVec<2> direction = random.direction<2>();
            points.push_back(to_float(direction * random.uniform(0.5, 3)));
        } else {
            points.emplace_back(-3 + 6 * static_cast<float>(i) / static_cast<float>(count),
                                random.uniform_float(-1, 1));
        }
    }
    return level_of(*Chain::build(points, closed, {.one_sided = random.chance(0.3)}));
}

inline Level<2> random_tile_map(oracle::Random& random) {
    const std::uint32_t columns = 1 + random.below(12), rows = 1 + random.below(12);
    const double filled = random.uniform(0.1, 0.9);
    std::vector<Tile> tiles;
    for (std::uint32_t i = 0; i < columns * rows; ++i)
        tiles.push_back(random.chance(filled) ? static_cast<Tile>(1 + random.below(13)) : Tile::empty);
    return level_of(*TileMap::build(tiles, columns, Vec2(random.uniform_float(0.2, 1), random.uniform_float(0.2, 1))));
}

inline Level<3> random_voxel_map(oracle::Random& random) {
    const glm::uvec3 count(1 + random.below(6), 1 + random.below(6), 1 + random.below(6));
    const Vec3 cell(random.uniform_float(0.2, 1), random.uniform_float(0.2, 1), random.uniform_float(0.2, 1));
    const double filled = random.uniform(0.1, 0.9);
    std::vector<std::uint64_t> bits((count.x * count.y * count.z + 63) / 64);
    for (std::uint64_t& word : bits)
        for (std::uint32_t i = 0; i < 64; ++i) word |= std::uint64_t{random.chance(filled)} << i;
    return level_of(*VoxelMap::build(bits, count, cell));
}

inline Level<3> random_height_field(oracle::Random& random) {
    const std::uint32_t columns = 2 + random.below(9), rows = 2 + random.below(9);
    std::vector<float> heights;
    for (std::uint32_t i = 0; i < columns * rows; ++i) heights.push_back(random.uniform_float(-1, 1));
    std::vector<std::uint32_t> holes;
    if (random.chance(0.5))
        for (std::uint32_t i = 0; i < (columns - 1) * (rows - 1); ++i)
            if (random.chance(0.2)) holes.push_back(i);
    const Vec2 cell(random.uniform_float(0.2, 1), random.uniform_float(0.2, 1));
    return level_of(*HeightField::build(heights, columns, cell, {.holes = holes}));
}

/// A mesh with slivers, triangles of area 0, doubled faces, T-junctions, and gaps of 1e-6.
inline Surface degenerate_surface(oracle::Random& random) {
    Surface result = random_soup(random, 12, 2, 1);
    const Surface plain = result;
    const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        const auto first = static_cast<std::uint32_t>(result.points.size());
        result.points.insert(result.points.end(), {a, b, c});
        result.triangles.emplace_back(first, first + 1, first + 2);
    };
    for (const glm::uvec3& t : plain.triangles) {
        const Vec3 a = plain.points[t.x], b = plain.points[t.y], c = plain.points[t.z], middle = (a + b) * 0.5f;
        switch (random.below(6)) {
            case 0:
                add(a, b, middle);
                break;
            case 1:
                add(a, b, middle + (c - middle) * 1e-5f);
                break;
            case 2:
                result.triangles.push_back(random.chance(0.5) ? t : glm::uvec3(t.z, t.y, t.x));
                break;
            case 3:
                add(a, middle, middle + random_point<3>(random, 1));
                break;
            case 4:
                add(a + random_point<3>(random, 1e-6), b, a + random_point<3>(random, 1));
                break;
            default:
                result.triangles.emplace_back(t.x, t.x, random.chance(0.5) ? t.x : t.y);
        }
    }
    return result;
}

inline Level<3> random_mesh(oracle::Random& random) {
    if (random.chance(0.3)) return level_of(degenerate_surface(random).mesh());
    if (random.chance(0.5)) return level_of(random_soup(random, 40, 2, 1).mesh());
    return level_of(random_terrain(random, 5, 1.5).surface().mesh());
}

/// Boxes with cut corners, some of them overlapping, and some of volume 0.
template <int D>
Level<D> random_brushes(oracle::Random& random) {
    std::vector<HalfSpace<D>> sides;
    std::vector<std::uint32_t> ends;
    const std::uint32_t count = 1 + random.below(12);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec<D> center = random_point<D>(random, 2);
        const auto add = [&](const DVec<D>& out, double height) {
            const Vec<D> normal = to_float(out);
            sides.push_back({normal, dot(normal, center) + static_cast<float>(height)});
        };
        for (int axis = 0; axis < D; ++axis)
            for (const double end : {-1.0, 1.0}) add(detail::axis<D>(axis, end), random.uniform(0.05, 0.8));
        for (std::uint32_t k = random.below(4); k > 0; --k)
            add(random.direction<D>(), random.uniform(random.chance(0.05) ? -1.5 : 0.05, 0.8));
        ends.push_back(static_cast<std::uint32_t>(sides.size()));
    }
    return level_of(*SolidBsp<D>::from_brushes(sides, ends));
}

/// Overlapping outlines, sometimes reversed: the solid is then the unbounded outside.
inline Level<2> random_solid(oracle::Random& random, std::integral_constant<int, 2>) {
    std::vector<Vec2> points;
    std::vector<glm::uvec2> faces;
    const bool room = random.chance(0.1);
    const std::uint32_t outlines = 1 + random.below(3);
    for (std::uint32_t k = 0; k < outlines; ++k) {
        const auto first = static_cast<std::uint32_t>(points.size());
        const std::uint32_t count = 3 + random.below(20);
        const DVec<2> center = random.in_cube<2>();
        for (std::uint32_t i = 0; i < count; ++i) {
            const double angle = 6.28 * i / count;
            points.push_back(to_float(center + DVec<2>(std::cos(angle), std::sin(angle)) * random.uniform(0.5, 2)));
            const std::uint32_t from = first + i, to = first + (i + 1) % count;
            faces.push_back(room ? glm::uvec2(to, from) : glm::uvec2(from, to));
        }
    }
    return level_of(*SolidBsp2::build(points, faces));
}

/// Cells of a grid, overlapping boxes, or ground with an underside; sometimes with a room around them.
inline Level<3> random_solid(oracle::Random& random, std::integral_constant<int, 3>) {
    const std::uint32_t what = random.below(3);
    Surface surface = random_terrain(random, 4, 1).solid(-1);
    if (what == 0) surface = cell_surface(3, [&](int, int, int) { return random.chance(0.4); });
    if (what == 1) {
        surface = {};
        for (std::uint32_t i = 1 + random.below(5); i > 0; --i) {
            const Vec3 low = random_point<3>(random, 1.5);
            surface = joined(surface, box_surface(low, low + Vec3(0.1f) + (random_point<3>(random, 1) + Vec3(1))));
        }
    }
    if (surface.triangles.empty()) surface = box_surface(Vec3(-1), Vec3(1));
    if (random.chance(0.1)) surface = joined(surface, reversed(box_surface(Vec3(-2.5f), Vec3(4.5f))));
    return level_of(*SolidBsp3::build(surface.points, surface.triangles));
}

template <int D>
Level<D> random_level(oracle::Random& random, std::uint32_t kind);

/// A compound of convex children and a level.
template <int D>
Level<D> random_compound(oracle::Random& random) {
    std::vector<AnyShape<D>> children;
    std::vector<LevelPart<D>> parts;
    const std::uint32_t count = 1 + random.below(6);
    for (std::uint32_t i = 0; i < count; ++i) {
        children.push_back(random_convex(random, std::integral_constant<int, D>(), 2, 1));
        parts.push_back({children.back().view(), i});
    }
    if (random.chance(0.7)) {
        const Pose<D> pose = random_pose<D>(random, 1);
        const Level<D> inner = random_level<D>(random, random.below(4));
        const auto stands = at(stretched(inner.shape, Vec<D>(random.uniform_float(0.3, 1.5))), pose);
        children.push_back(stands);
        const Placing<D> placing{stands.shape.scale, pose, 0};
        for (const LevelPart<D>& part : inner.parts) parts.push_back({placing(part.view), count});
    }
    return {*Compound<D>::build(children), parts};
}

/// A level of the dimension: kinds 0 and 1 are surfaces or tiles, 2 is a compound, 3 is a SolidBsp, 4 is a voxel map.
template <int D>
Level<D> random_level(oracle::Random& random, std::uint32_t kind) {
    if (kind == 2) return random_compound<D>(random);
    if (kind == 3) {
        if (random.chance(0.5)) return random_brushes<D>(random);
        return random_solid(random, std::integral_constant<int, D>());
    }
    if constexpr (D == 2)
        return kind == 0 ? random_chain(random) : random_tile_map(random);
    else if (kind == 4)
        return random_voxel_map(random);
    else
        return kind == 0 ? random_height_field(random) : random_mesh(random);
}

/// The second shape of a query, with its parts.
template <int D>
struct Other {
    AnyShape<D> keeper;
    View<D> view;
    std::vector<LevelPart<D>> parts;
};

/// A random position for a query: the center of a part, or a corner of its box, where the surface of a solid level is.
template <int D>
Vec<D> near_some_part(oracle::Random& random, const PlacedLevel<D>& level) {
    if (level.parts.empty()) return Vec<D>(0.0f);
    const auto some = random.below(static_cast<std::uint32_t>(level.parts.size()));
    const Aabb<D> box = bounds(level.parts[some].view);
    Vec<D> place = center(box);
    if (random.chance(0.5))
        for (int i = 0; i < D; ++i) place[i] = random.chance(0.5) ? box.min[i] : box.max[i];
    return place;
}

template <int D>
Other<D> random_other(oracle::Random& random, const PlacedLevel<D>& level) {
    const Pose<D> pose{near_some_part(random, level) + random_point<D>(random, random.uniform(0, 1.5)),
                       random.rotation<D>()};
    if (random.chance(0.2)) {
        const PlacedLevel<D> other(random_level<D>(random, random.below(4)), {Vec<D>(0.5f), pose, 0});
        return {other.level.shape, other.view, other.parts};
    }
    if (random.chance(0.1)) {
        HalfSpace<D> side{to_float(random.direction<D>()), 0};
        side.offset = dot(side.normal, pose.position);
        return {Ball<D>{}, View<D>(view(side)), {{View<D>(view(side)), 0}}};
    }
    const AnyShape<D> shape = random_convex(random, std::integral_constant<int, D>(), 0.1, 1);
    const View<D> stands = moved(shape.view(), detail::affine(pose));
    return {shape, stands, {{stands, 0}}};
}

}  // namespace abut::test
