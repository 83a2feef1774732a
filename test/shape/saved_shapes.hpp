#pragma once

// Random shapes of every kind that files hold, their loaders, and queries of them.

#include "../oracle/random.hpp"
#include "brushes.hpp"
#include "meshes.hpp"
#include "solid_levels.hpp"
#include <abut/math/detail/blob.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/file.hpp>
#include <abut/shape/solid_mesh.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::test {

using Bytes = std::vector<std::byte>;

inline Bytes file_of(const auto& shape) {
    return save(shape);
}
template <int D>
Bytes file_of(const Compound<D>& shape) {
    return *save(shape);
}

/// The loader of a type.
template <class S>
inline constexpr Result<S> (*load)(std::span<const std::byte>) = nullptr;
template <>
inline constexpr auto load<Mesh> = &load_mesh;
template <>
inline constexpr auto load<Polyhedron> = &load_polyhedron;
template <>
inline constexpr auto load<Polygon> = &load_polygon;
template <>
inline constexpr auto load<HeightField> = &load_height_field;
template <>
inline constexpr auto load<TileMap> = &load_tile_map;
template <>
inline constexpr auto load<VoxelMap> = &load_voxel_map;
template <>
inline constexpr auto load<Chain> = &load_chain;
template <int D>
inline constexpr auto load<SolidBsp<D>> = &load_solid_bsp<D>;
template <int D>
inline constexpr auto load<Compound<D>> = &load_compound<D>;

/// Calls visit.operator()<S>() for every type.
template <class Visit>
void each_saved_type(const Visit& visit) {
    visit.template operator()<Mesh>();
    visit.template operator()<Polyhedron>();
    visit.template operator()<Polygon>();
    visit.template operator()<HeightField>();
    visit.template operator()<TileMap>();
    visit.template operator()<VoxelMap>();
    visit.template operator()<Chain>();
    visit.template operator()<SolidBsp2>();
    visit.template operator()<SolidBsp3>();
    visit.template operator()<Compound2>();
    visit.template operator()<Compound3>();
}

/// Points on a lattice, a sphere, a plane or a line; some of them far apart.
template <int D>
std::vector<Vec<D>> random_points(oracle::Random& random) {
    const std::uint32_t count = 1 + random.below(40), kind = random.below(4);
    std::vector<Vec<D>> result;
    for (std::uint32_t i = 0; i < count; ++i) {
        detail::DVec<D> p = kind == 1 ? random.direction<D>() : random.in_cube<D>();
        for (int axis = 0; axis < D; ++axis) {
            if (kind == 0) p[axis] = random.below(4);
            if (kind == 2 && axis == 0) p[axis] = 0.5;
            if (kind == 3 && axis > 0) p[axis] = p[0];
        }
        result.push_back(to_float(p));
    }
    return result;
}

template <class S>
S random_shape(oracle::Random& random);

template <>
inline Polygon random_shape<Polygon>(oracle::Random& random) {
    HullOptions options;
    if (random.chance(0.3)) options.max_vertices = 3 + random.below(4);
    return *Polygon::build(random_points<2>(random), options);
}
template <>
inline Polyhedron random_shape<Polyhedron>(oracle::Random& random) {
    HullOptions options;
    if (random.chance(0.3)) options.max_vertices = 4 + random.below(8);
    return *Polyhedron::build(random_points<3>(random), options);
}

/// Few different coordinates, so that points, edges and triangles repeat; or a closed surface, or a terrain.
template <>
inline Mesh random_shape<Mesh>(oracle::Random& random) {
    if (random.chance(0.2)) return box_surface({-1, -2, -1}, {1, 1, random.uniform_float(0, 2)}).mesh();
    Surface soup;
    if (random.chance(0.3)) {
        const std::uint32_t side = 2 + random.below(20);
        for (std::uint32_t y = 0; y <= side; ++y)
            for (std::uint32_t x = 0; x <= side; ++x)
                soup.points.emplace_back(static_cast<float>(x), random.uniform_float(-1, 1), static_cast<float>(y));
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x) {
                const std::uint32_t a = x + y * (side + 1), b = a + side + 1;
                soup.triangles.emplace_back(a, b, a + 1);
                soup.triangles.emplace_back(a + 1, b, b + 1);
            }
        return soup.mesh();
    }
    const std::uint32_t points = 3 + random.below(20);
    for (std::uint32_t i = 0; i < points; ++i) {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<float>(random.below(4)) - 1.5f;
        soup.points.push_back(p * random.uniform_float(0.9, 1.1));
        if (random.chance(0.5)) soup.points.back() = p;
    }
    const std::uint32_t triangles = 1 + random.below(60);
    for (std::uint32_t i = 0; i < triangles; ++i)
        soup.triangles.push_back(glm::uvec3{random.below(points), random.below(points), random.below(points)});
    return soup.mesh();
}

template <>
inline HeightField random_shape<HeightField>(oracle::Random& random) {
    const std::uint32_t columns = 2 + random.below(12), rows = 2 + random.below(12);
    std::vector<float> heights;
    for (std::uint32_t i = 0; i < columns * rows; ++i) heights.push_back(random.uniform_float(-1, 1));
    std::vector<std::uint32_t> holes;
    for (std::uint32_t i = 0; i < (columns - 1) * (rows - 1); ++i)
        if (random.chance(0.2)) holes.push_back(i);
    if (random.chance(0.5)) holes.clear();
    return *HeightField::build(heights, columns, Vec2(0.5f, random.uniform_float(0.2, 1)), {.holes = holes});
}

template <>
inline TileMap random_shape<TileMap>(oracle::Random& random) {
    const std::uint32_t columns = 1 + random.below(12), rows = 1 + random.below(12);
    std::vector<Tile> tiles;
    for (std::uint32_t i = 0; i < columns * rows; ++i)
        tiles.push_back(random.chance(0.4) ? Tile::empty : static_cast<Tile>(random.below(14)));
    return *TileMap::build(tiles, columns, random.uniform_float(0.2, 1));
}

template <>
inline VoxelMap random_shape<VoxelMap>(oracle::Random& random) {
    const glm::uvec3 count{1 + random.below(6), 1 + random.below(6), 1 + random.below(6)};
    const std::uint32_t size = count.x * count.y * count.z;
    std::vector<std::uint64_t> bits((size + 63) / 64);
    for (std::uint64_t& word : bits) word = random.bits() & random.bits();
    if (size % 64 != 0) bits.back() &= (std::uint64_t{1} << size % 64) - 1;
    return *VoxelMap::build(bits, count, Vec3(0.5f, random.uniform_float(0.2, 1), 0.3f));
}

template <>
inline Chain random_shape<Chain>(oracle::Random& random) {
    std::vector<Vec2> points;
    const std::uint32_t count = 3 + random.below(80);
    for (std::uint32_t i = 0; i < count; ++i) points.push_back(to_float(random.in_cube<2>() * 3.0));
    const bool closed = random.chance(0.5), one_sided = random.chance(0.3);
    return *Chain::build(points, closed, {.one_sided = one_sided});
}

template <int D>
SolidBsp<D> random_brushes(oracle::Random& random) {
    std::vector<Box<D>> boxes;
    const std::uint32_t count = 1 + random.below(8);
    for (std::uint32_t i = 0; i < count; ++i) {
        Vec<D> half;
        for (int axis = 0; axis < D; ++axis) half[axis] = random.chance(0.05) ? 0 : random.uniform_float(0.2, 1);
        boxes.push_back({to_float(random.in_cube<D>() * 2.0), half, {}});
    }
    return solid_of_boxes<D>(boxes);
}
template <>
inline SolidBsp2 random_shape<SolidBsp2>(oracle::Random& random) {
    if (random.chance(0.4)) return random_brushes<2>(random);
    Level<2> level;
    const std::uint32_t stars = 1 + random.below(3);
    for (std::uint32_t i = 0; i < stars; ++i) {
        const int corners = 3 + static_cast<int>(random.below(9));
        const Vec2 center = to_float(random.in_cube<2>());
        add_outline(level, star(random, corners, center, 0.3, 2));
    }
    if (random.chance(0.3)) turn_around(level);
    return *SolidBsp2::build(level.points, level.faces);
}
template <>
inline SolidBsp3 random_shape<SolidBsp3>(oracle::Random& random) {
    if (random.chance(0.4)) return random_brushes<3>(random);
    const Vec3 low = to_float(random.in_cube<3>());
    Surface surface = box_surface(low, low + Vec3(1, random.uniform_float(0.1, 2), 1));
    if (random.chance(0.5)) surface = joined(surface, box_surface({-0.5f, -0.5f, -0.5f}, {0.5f, 2, 0.25f}));
    if (random.chance(0.3)) surface = reversed(surface);
    return *SolidBsp3::build(surface.points, surface.triangles);
}

template <int D>
Pose<D> random_pose(oracle::Random& random) {
    return {to_float(random.in_cube<D>() * 2.0), random.rotation<D>()};
}

/// Adds children that are placed, rounded and stretched, and some that share their data.
template <int D, class S>
void add_children(const S& shape, oracle::Random& random, std::vector<AnyShape<D>>& children) {
    const std::uint32_t count = random.below(3);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto placed = at(shape, random_pose<D>(random));
        Vec<D> scale(1.0f);
        scale[0] = random.chance(0.2) ? -1.0f : random.uniform_float(0.5, 2);
        const std::uint32_t kind = random.below(4);
        if (kind == 0) children.emplace_back(shape);
        if (kind == 1) children.emplace_back(placed);
        if (kind == 2) children.emplace_back(stretched(placed, scale));
        if (kind == 3) children.emplace_back(rounded(placed, 0.1f));
    }
}
template <class S, int D>
S random_compound(oracle::Random& random, bool nested) {
    std::vector<AnyShape<D>> children{Ball<D>{to_float(random.in_cube<D>()), 0.5f}};
    add_children<D>(Box<D>{to_float(random.in_cube<D>()), Vec<D>(0.5f), random.rotation<D>()}, random, children);
    add_children<D>(Capsule<D>{to_float(random.in_cube<D>()), to_float(random.in_cube<D>()), 0.25f}, random, children);
    add_children<D>(random_shape<SolidBsp<D>>(random), random, children);
    if constexpr (D == 2) {
        add_children<2>(random_shape<Polygon>(random), random, children);
        add_children<2>(random_shape<Chain>(random), random, children);
        add_children<2>(random_shape<TileMap>(random), random, children);
    } else {
        const Mesh mesh = random_shape<Mesh>(random);
        add_children<3>(random_shape<Polyhedron>(random), random, children);
        add_children<3>(Cylinder{{0, 0, 0}, {0, 1, 0}, 0.5f}, random, children);
        add_children<3>(mesh, random, children);
        if (random.chance(0.5)) children.emplace_back(solid(mesh));
        add_children<3>(random_shape<HeightField>(random), random, children);
        add_children<3>(random_shape<VoxelMap>(random), random, children);
    }
    if (nested) add_children<D>(random_compound<S, D>(random, random.chance(0.3)), random, children);
    Compound<D> result = *Compound<D>::build(children);
    if (children.size() > 1 && random.chance(0.3)) result.remove(random.below(result.size()));
    return result;
}
template <>
inline Compound2 random_shape<Compound2>(oracle::Random& random) {
    return random_compound<Compound2, 2>(random, true);
}
template <>
inline Compound3 random_shape<Compound3>(oracle::Random& random) {
    return random_compound<Compound3, 3>(random, true);
}

/// A hash of the bits of answers.
class AnswerHash {
public:
    void add(std::uint64_t word) { detail::add_to_checksum(state_, word); }
    void add(float number) { add(std::uint64_t{std::bit_cast<std::uint32_t>(number)}); }
    template <int D>
    void add(const glm::vec<D, float>& v) {
        for (int axis = 0; axis < D; ++axis) add(v[axis]);
    }
    void add(const Feature& feature) {
        add(std::uint64_t{feature.part});
        add(std::uint64_t{feature.index});
        add(static_cast<std::uint64_t>(feature.kind));
    }
    std::uint64_t value() const { return state_; }

private:
    std::uint64_t state_ = 1;
};

/// The order of the parts in a tree counts.
template <class V, int D>
void each_part_of(const V&, const Aabb<D>&, AnswerHash&) {}
template <int D>
void each_part_of(const detail::Composite<D>& shape, const Aabb<D>& box, AnswerHash& hash) {
    detail::each_part<D>(shape, box, [&](const detail::Convex<D>&, std::uint32_t index) {
        hash.add(std::uint64_t{index});
        return true;
    });
}

/// Calls the queries with a few shapes near `shape`, and returns a hash of the answers. Counts the shapes that touch
/// it.
template <class S>
std::uint64_t answers_of(const S& shape, oracle::Random& random, int count, int& touching) {
    constexpr int D = dimension<S>;
    AnswerHash hash;
    Aabb<D> box = bounds(view(shape));
    for (int axis = 0; axis < D; ++axis) {
        box.min[axis] = std::clamp(box.min[axis], -1e6f, 1e6f);
        box.max[axis] = std::clamp(box.max[axis], -1e6f, 1e6f);
    }
    const auto place = [&] {
        Vec<D> result;
        for (int axis = 0; axis < D; ++axis)
            result[axis] = random.uniform_float(static_cast<double>(box.min[axis]) - 0.5,
                                                static_cast<double>(box.max[axis]) + 0.5);
        return result;
    };
    const auto query = [&](const auto& other, const Vec<D>& motion) {
        const bool touches = overlaps(other, shape);
        touching += touches ? 1 : 0;
        hash.add(std::uint64_t{touches});
        const Closest<D> near = closest(other, shape);
        hash.add(near.distance);
        hash.add(near.normal);
        hash.add(near.on_a);
        hash.add(near.on_b);
        hash.add(near.feature_b);
        const Contact<D> found = contact(other, shape);
        if (found) {
            hash.add(found.depth);
            hash.add(found.normal);
            for (const ContactPoint<D>& point : found.points) hash.add(point.position);
        }
        if (const auto hit = sweep(other, motion, shape)) {
            hash.add(hit->fraction);
            hash.add(hit->normal);
            hash.add(hit->feature);
        }
    };
    for (int i = 0; i < count; ++i) {
        const Vec<D> from = place(), to = place();
        if (const auto hit = raycast(Ray<D>::between(from, to), shape)) {
            hash.add(hit->fraction);
            hash.add(hit->normal);
            hash.add(hit->feature);
        }
        hash.add(std::uint64_t{contains(shape, to)});
        query(Ball<D>{from, 0.25f}, to - from);
        query(Box<D>{to, Vec<D>(0.25f), random.rotation<D>()}, from - to);
    }
    each_part_of(view(shape), box, hash);
    return hash.value();
}

}  // namespace abut::test
