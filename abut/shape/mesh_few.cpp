#include <abut/broad_phase/four_floats-inl.h>
#include <abut/shape/mesh_few.hpp>
#include <abut/shape/mesh_tree_parts.hpp>

#include <algorithm>
#include <bit>
#include <limits>

namespace abut {
namespace {

/// A box that grows.
class Grown {
public:
    void add(const BvhItem& item) {
        low_ = four::less(low_, four::loaded(item.min));
        high_ = four::greater(high_, four::loaded(item.max));
    }
    float area() const {
        const four::Floats extent = high_ - low_;
        const four::Floats sides = extent * __builtin_shufflevector(extent, extent, 1, 2, 0, 3);
        return sides[0] + sides[1] + sides[2];
    }
    Aabb3 box() const { return {{low_[0], low_[1], low_[2]}, {high_[0], high_[1], high_[2]}}; }

private:
    four::Floats low_ = four::all(std::numeric_limits<float>::infinity());
    four::Floats high_ = four::all(-std::numeric_limits<float>::infinity());
};

/// How many bits are set; where there is no instruction for it, std::popcount is a call.
int count_of(std::uint64_t bits) {
    bits -= bits >> 1 & 0x5555555555555555;
    bits = (bits & 0x3333333333333333) + (bits >> 2 & 0x3333333333333333);
    bits = (bits + (bits >> 4)) & 0x0F0F0F0F0F0F0F0F;
    return static_cast<int>(bits * 0x0101010101010101 >> 56);
}

bool fit_one(std::uint32_t count, std::uint64_t corners) {
    return count <= mesh_lanes && count_of(corners) <= static_cast<int>(mesh_lanes);
}

/// About how many leaves so many triangles with these corners become.
float leaves_of(std::uint32_t count, std::uint64_t corners) {
    return fit_one(count, corners) ? 1.0f : std::max(2.0f, 0.2f * static_cast<float>(count));
}

constexpr std::uint8_t not_known = 255;

/// Numbers in the order of the places, and where they are equal of the indices.
std::uint64_t key(float place, std::uint32_t index) {
    const auto bits = std::bit_cast<std::uint32_t>(place + 0.0f);  // no zero below zero
    const std::uint32_t sign = bits >> 31;
    return static_cast<std::uint64_t>(bits ^ ((0 - sign) | 0x80000000)) << 32 | index;
}

/// Their order; no two are equal. Each is compared with each: where they are few that is quicker than to guess.
void sort(const std::array<std::uint64_t, mesh_few>& keys, std::uint32_t count,
          std::array<std::uint8_t, mesh_few>& order) {
    std::array<std::uint32_t, mesh_few> rank{};
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

}  // namespace

float extent_of(const MeshLeaf& leaf) {
    float result = 0;
    for (const auto& row : leaf.corner) {
        const four::Floats a = four::loaded(row), b = four::loaded(row + 4);
        result += (four::greatest(four::greater(a, b)) - four::least(four::less(a, b))) * (1 + 1e-6f);
    }
    // Products that underflow have no bound by their factors.
    return result > 1e-9f && result < 1e12f ? result : std::numeric_limits<float>::infinity();
}

FewTriangles::FewTriangles(std::span<const BvhItem> items, std::span<const glm::uvec3> triangles,
                           std::span<const std::uint32_t> same)
    : count_(static_cast<std::uint32_t>(items.size())) {
    std::array<std::uint8_t, 256> table;
    table.fill(not_known);
    for (std::uint32_t i = 0; i < count_; ++i) {
        items_[i] = items[i];
        const glm::uvec3& t = triangles[items[i].index];
        corner_[i] = {number_of(same[t.x], table), number_of(same[t.y], table), number_of(same[t.z], table)};
        corners_[i] = Corners{1} << corner_[i][0] | Corners{1} << corner_[i][1] | Corners{1} << corner_[i][2];
    }
}

/// The place of a point among those known, of which a table tells a few by their hash. Without a branch where it can be
/// done so: whether a point is a new one can't be guessed.
std::uint8_t FewTriangles::number_of(std::uint32_t point, std::array<std::uint8_t, 256>& table) {
    std::uint32_t place = point * 0x9E3779B1u >> 24;
    while (table[place] != not_known && known_[table[place]] != point) place = (place + 1) & 255;
    const bool is_new = table[place] == not_known;
    const auto result = static_cast<std::uint8_t>(is_new ? known_count_ : table[place]);
    table[place] = result;
    known_[result] = point;
    known_count_ += is_new ? 1 : 0;
    return result;
}

FewTriangles::Part FewTriangles::all() const {
    Part result;
    result.count = count_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::array<std::uint64_t, mesh_few> keys;
        for (std::uint32_t i = 0; i < count_; ++i)
            keys[i] = key(items_[i].min[axis] + items_[i].max[axis], items_[i].index);
        sort(keys, count_, result.order[axis]);
    }
    return result;
}

bool FewTriangles::fit(const Part& part) const {
    if (part.count > mesh_lanes) return false;
    Corners corners = 0;
    for (std::uint32_t i = 0; i < part.count; ++i) corners |= corners_[part.order[0][i]];
    return fit_one(part.count, corners);
}

void FewTriangles::fill(const Part& part, std::span<const Vec3> points, MeshLeaf& leaf, std::uint32_t* order) const {
    std::array<std::uint64_t, mesh_few> keys;
    Corners corners = 0;
    for (std::uint32_t i = 0; i < part.count; ++i) {
        const std::uint8_t item = part.order[0][i];
        keys[i] = std::uint64_t{items_[item].index} << 32 | item;
        corners |= corners_[item];
    }
    std::array<std::uint8_t, mesh_few> by_index;
    sort(keys, part.count, by_index);
    std::array<std::uint32_t, 3 * mesh_few> number;
    std::uint32_t count = 0;
    Vec3 position{};
    for (Corners rest = corners; rest != 0; rest &= rest - 1) {
        const auto known = static_cast<std::uint32_t>(std::countr_zero(rest));
        position = points[known_[known]];
        for (int axis = 0; axis < 3; ++axis) leaf.corner[axis][count] = position[axis];
        number[known] = count++;
    }
    for (; count < mesh_lanes; ++count)
        for (int axis = 0; axis < 3; ++axis) leaf.corner[axis][count] = position[axis];
    for (std::uint32_t lane = 0; lane < part.count; ++lane) {
        const auto item = static_cast<std::uint32_t>(keys[by_index[lane]] & 0xFFFFFFFF);
        const auto& c = corner_[item];
        leaf.triangle[lane] = static_cast<std::uint16_t>(number[c[0]] | number[c[1]] << 3 | number[c[2]] << 6);
        order[lane] = items_[item].index;
    }
    for (std::uint32_t lane = part.count; lane < mesh_lanes; ++lane) leaf.triangle[lane] = 0;
    leaf.used = (1u << part.count) - 1;
    leaf.extent = extent_of(leaf);
}

Aabb3 FewTriangles::box(const Part& part) const {
    Grown result;
    for (std::uint32_t i = 0; i < part.count; ++i) result.add(items_[part.order[0][i]]);
    return result.box();
}

void FewTriangles::split(const Part& part, Part& left, Part& right) const {
    const std::uint32_t count = part.count;
    std::size_t best_axis = 0;
    std::uint32_t best_count = 0;
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto& order = part.order[axis];
        std::array<float, mesh_few> right_cost;
        Grown after, before;
        Corners seen = 0;
        for (std::uint32_t i = count - 1; i > 0; --i) {
            after.add(items_[order[i]]);
            seen |= corners_[order[i]];
            right_cost[i] = after.area() * leaves_of(count - i, seen);
        }
        seen = 0;
        for (std::uint32_t i = 1; i < count; ++i) {
            before.add(items_[order[i - 1]]);
            seen |= corners_[order[i - 1]];
            const float cost = before.area() * leaves_of(i, seen) + right_cost[i];
            if (cost < least || best_count == 0) {
                least = cost;
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
            // Written to both, as which one it is can't be guessed.
            const std::uint32_t is_left = on_left >> item & 1u;
            left.order[axis][to_left] = item;
            right.order[axis][to_right] = item;
            to_left += is_left;
            to_right += 1 - is_left;
        }
    }
}

}  // namespace abut
