#include <abut/math/detail/radix_sort.hpp>
#include <abut/math/simd/float4-inl.h>
#include <abut/shape/mesh/build.hpp>
#include <abut/shape/mesh/leaf_split.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace abut::detail {
namespace {

/// An accumulating bounding box.
class GrowingBox {
public:
    void add(const BvhItem& item) {
        low_ = float4::min(low_, float4::load(item.min));
        high_ = float4::max(high_, float4::load(item.max));
    }
    float area() const {
        const float4::Floats extent = high_ - low_;
        const float4::Floats sides = extent * __builtin_shufflevector(extent, extent, 1, 2, 0, 3);
        return sides[0] + sides[1] + sides[2];
    }
    Aabb3 box() const { return {{low_[0], low_[1], low_[2]}, {high_[0], high_[1], high_[2]}}; }

private:
    float4::Floats low_ = float4::broadcast(std::numeric_limits<float>::infinity());
    float4::Floats high_ = float4::broadcast(-std::numeric_limits<float>::infinity());
};

/// The number of set bits, by arithmetic. std::popcount is a function call on targets without the instruction.
int popcount(std::uint64_t bits) {
    bits -= bits >> 1 & 0x5555555555555555;
    bits = (bits & 0x3333333333333333) + (bits >> 2 & 0x3333333333333333);
    bits = (bits + (bits >> 4)) & 0x0F0F0F0F0F0F0F0F;
    return static_cast<int>(bits * 0x0101010101010101 >> 56);
}

bool fits_one_leaf(std::uint32_t count, std::uint64_t corners) {
    return count <= mesh_lanes && popcount(corners) <= static_cast<int>(mesh_lanes);
}

/// An estimate of the leaves that a set of triangles with these vertices needs.
float estimated_leaves(std::uint32_t count, std::uint64_t corners) {
    return fits_one_leaf(count, corners) ? 1.0f : std::max(2.0f, 0.2f * static_cast<float>(count));
}

constexpr std::uint8_t no_vertex = 255;

/// A sort key: orders by the float, then by the index.
std::uint64_t key(float place, std::uint32_t index) {
    return std::uint64_t{key_of(place)} << 32 | index;
}

/// Sorts by counting ranks in O(n^2), without branches; fast for few keys. No two keys are equal.
void sort(const std::array<std::uint64_t, max_small_set>& keys, std::uint32_t count,
          std::array<std::uint8_t, max_small_set>& order) {
    std::array<std::uint32_t, max_small_set> rank{};
    for (std::uint32_t i = 1; i < count; ++i) {
        std::uint32_t before = 0;
        for (std::uint32_t j = 0; j < i; ++j) {
            const std::uint32_t is_before = keys[j] < keys[i] ? 1 : 0;
            before += is_before;
            rank[j] += 1 - is_before;
        }
        rank[i] = before;
    }
    for (std::uint32_t i = 0; i < count; ++i) order[rank[i]] = static_cast<std::uint8_t>(i);
}

/// The extent |x| + |y| + |z| of the box of a leaf's vertices, rounded up.
float extent_of(const MeshLeaf& leaf) {
    float result = 0;
    for (const auto& row : leaf.corner) {
        const float4::Floats a = float4::load(row), b = float4::load(row + 4);
        result += (float4::max_lane(float4::max(a, b)) - float4::min_lane(float4::min(a, b))) * (1 + 1e-6f);
    }
    // Products that underflow aren't bounded by their factors.
    return result > 1e-9f && result < 1e12f ? result : std::numeric_limits<float>::infinity();
}

/// The square of twice the area of a leaf's largest triangle.
float largest_squared_area(const MeshLeaf& leaf) {
    float result = 0;
    for (std::uint32_t rest = leaf.used; rest != 0; rest &= rest - 1) {
        const Triangle3 t = leaf.at(static_cast<std::uint32_t>(std::countr_zero(rest)));
        const Vec3 ab = t.b - t.a, ac = t.c - t.a;
        const Vec3 normal{ab.y * ac.z - ab.z * ac.y, ab.z * ac.x - ab.x * ac.z, ab.x * ac.y - ab.y * ac.x};
        result = std::max(result, normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
    }
    return result;
}

}  // namespace

void set_sizes(MeshLeaf& leaf) {
    leaf.extent = extent_of(leaf);
    // The second term also covers the rounding of the first.
    leaf.min_area = 4e-3f * std::sqrt(largest_squared_area(leaf)) + 1.1e-5f * leaf.extent * leaf.extent;
}

SmallTriangleSet::SmallTriangleSet(std::span<const BvhItem> items, std::span<const glm::uvec3> triangles,
                                   std::span<const std::uint32_t> same)
    : count_(static_cast<std::uint32_t>(items.size())) {
    std::array<std::uint8_t, 256> table;
    table.fill(no_vertex);
    for (std::uint32_t i = 0; i < count_; ++i) {
        items_[i] = items[i];
        const glm::uvec3& t = triangles[items[i].index];
        triangle_vertices_[i] = {vertex_number(same[t.x], table), vertex_number(same[t.y], table),
                                 vertex_number(same[t.z], table)};
        vertex_bits_[i] = VertexBits{1} << triangle_vertices_[i][0] | VertexBits{1} << triangle_vertices_[i][1] |
                          VertexBits{1} << triangle_vertices_[i][2];
    }
}

/// The vertex number of a point, found by a hash table with linear probing. Branch-free at the end, since new points
/// are unpredictable.
std::uint8_t SmallTriangleSet::vertex_number(std::uint32_t point, std::array<std::uint8_t, 256>& table) {
    std::uint32_t place = point * 0x9E3779B1u >> 24;
    while (table[place] != no_vertex && vertices_[table[place]] != point) place = (place + 1) & 255;
    const bool is_new = table[place] == no_vertex;
    const auto result = static_cast<std::uint8_t>(is_new ? vertex_count_ : table[place]);
    table[place] = result;
    vertices_[result] = point;
    vertex_count_ += is_new ? 1 : 0;
    return result;
}

SmallTriangleSet::Part SmallTriangleSet::all() const {
    Part result;
    result.count = count_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::array<std::uint64_t, max_small_set> keys;
        for (std::uint32_t i = 0; i < count_; ++i)
            keys[i] = key(items_[i].min[axis] + items_[i].max[axis], items_[i].index);
        sort(keys, count_, result.order[axis]);
    }
    return result;
}

bool SmallTriangleSet::fits_leaf(const Part& part) const {
    if (part.count > mesh_lanes) return false;
    VertexBits corners = 0;
    for (std::uint32_t i = 0; i < part.count; ++i) corners |= vertex_bits_[part.order[0][i]];
    return fits_one_leaf(part.count, corners);
}

void SmallTriangleSet::fill(const Part& part, std::span<const Vec3> points, MeshLeaf& leaf,
                            std::uint32_t* order) const {
    std::array<std::uint64_t, max_small_set> keys;
    VertexBits corners = 0;
    for (std::uint32_t i = 0; i < part.count; ++i) {
        const std::uint8_t item = part.order[0][i];
        keys[i] = std::uint64_t{items_[item].index} << 32 | item;
        corners |= vertex_bits_[item];
    }
    std::array<std::uint8_t, max_small_set> by_index;
    sort(keys, part.count, by_index);
    std::array<std::uint32_t, 3 * max_small_set> number;
    std::uint32_t count = 0;
    Vec3 position{};
    for (VertexBits rest = corners; rest != 0; rest &= rest - 1) {
        const auto known = static_cast<std::uint32_t>(std::countr_zero(rest));
        position = points[vertices_[known]];
        for (int axis = 0; axis < 3; ++axis) leaf.corner[axis][count] = position[axis];
        number[known] = count++;
    }
    for (; count < mesh_lanes; ++count)
        for (int axis = 0; axis < 3; ++axis) leaf.corner[axis][count] = position[axis];
    for (std::uint32_t lane = 0; lane < part.count; ++lane) {
        const auto item = static_cast<std::uint32_t>(keys[by_index[lane]] & 0xFFFFFFFF);
        const auto& c = triangle_vertices_[item];
        leaf.triangle[lane] = static_cast<std::uint16_t>(number[c[0]] | number[c[1]] << 3 | number[c[2]] << 6);
        order[lane] = items_[item].index;
    }
    for (std::uint32_t lane = part.count; lane < mesh_lanes; ++lane) leaf.triangle[lane] = 0;
    leaf.used = (1u << part.count) - 1;
    set_sizes(leaf);
}

Aabb3 SmallTriangleSet::box(const Part& part) const {
    GrowingBox result;
    for (std::uint32_t i = 0; i < part.count; ++i) result.add(items_[part.order[0][i]]);
    return result.box();
}

void SmallTriangleSet::split(const Part& part, Part& left, Part& right) const {
    const std::uint32_t count = part.count;
    std::size_t best_axis = 0;
    std::uint32_t best_count = 0;
    float best_cost = std::numeric_limits<float>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto& order = part.order[axis];
        std::array<float, max_small_set> right_cost;
        GrowingBox after, before;
        VertexBits used_vertices = 0;
        for (std::uint32_t i = count - 1; i > 0; --i) {
            after.add(items_[order[i]]);
            used_vertices |= vertex_bits_[order[i]];
            right_cost[i] = after.area() * estimated_leaves(count - i, used_vertices);
        }
        used_vertices = 0;
        for (std::uint32_t i = 1; i < count; ++i) {
            before.add(items_[order[i - 1]]);
            used_vertices |= vertex_bits_[order[i - 1]];
            const float cost = before.area() * estimated_leaves(i, used_vertices) + right_cost[i];
            if (cost < best_cost || best_count == 0) {
                best_cost = cost;
                best_axis = axis;
                best_count = i;
            }
        }
    }
    std::uint32_t on_left = 0;
    for (std::uint32_t i = 0; i < best_count; ++i) on_left |= 1u << part.order[best_axis][i];
    left.count = best_count;
    right.count = count - best_count;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::uint32_t to_left = 0, to_right = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint8_t item = part.order[axis][i];
            // Written to both sides: the side is unpredictable.
            const std::uint32_t is_left = on_left >> item & 1u;
            left.order[axis][to_left] = item;
            right.order[axis][to_right] = item;
            to_left += is_left;
            to_right += 1 - is_left;
        }
    }
}

}  // namespace abut::detail
