#pragma once

// Walks over meshes at random, hashed. The surfaces and steps are integers, so that no arithmetic of this file affects
// the answers.

#include "../oracle/random.hpp"
#include "../query/hash.hpp"
#include "../shape/meshes.hpp"
#include <abut/walk/walk_mesh.hpp>

#include <cstdint>
#include <optional>
#include <utility>

namespace abut::test {

inline float whole_number(oracle::Random& random, int most) {
    return static_cast<float>(static_cast<int>(random.below(static_cast<std::uint32_t>(2 * most + 1))) - most);
}

/// A mesh with borders, holes and folds; some of its triangles are reversed.
inline Surface rough_ground(oracle::Random& random) {
    constexpr std::uint32_t columns = 20;
    Surface result;
    for (std::uint32_t row = 0; row <= columns; ++row)
        for (std::uint32_t column = 0; column <= columns; ++column)
            result.points.emplace_back(4 * static_cast<float>(column), whole_number(random, 3),
                                       4 * static_cast<float>(row));
    for (std::uint32_t row = 0; row < columns; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            if (random.below(12) == 0) continue;
            const std::uint32_t a = row * (columns + 1) + column, b = a + 1, c = b + columns + 1, d = c - 1;
            result.triangles.emplace_back(a, c, b);
            result.triangles.emplace_back(a, d, c);
            if (random.below(20) == 0) std::swap(result.triangles.back().x, result.triangles.back().y);
        }
    return result;
}

inline void add_turn(Hash& hash, const WalkTurn& turn, const Vec3& vector) {
    hash.add<3>(turn * vector);
    hash.add(turn.in_plane().cos);
    hash.add(turn.in_plane().sin);
    for (int i = 0; i < 4; ++i) hash.add(turn.in_space()[i]);
    hash.add(std::uint64_t{turn.mirrored()});
}

inline void add_place(Hash& hash, const WalkPoint& place) {
    hash.add(std::uint64_t{place.triangle});
    hash.add<3>(place.weights);
}

/// Adds all that walks over the mesh of a surface return.
inline void add_walks(Hash& hash, const WalkMesh& mesh, const Surface& surface, std::uint64_t seed, int walks) {
    oracle::Random random(seed);
    WalkPoint place;
    for (int i = 0; i < walks; ++i) {
        if (i % 8 == 0) {
            place.triangle = random.below(static_cast<std::uint32_t>(surface.triangles.size()));
            if (!mesh.is_walkable(place.triangle)) place.triangle = 0;
            for (int k = 0; k < 3; ++k) place.weights[k] = static_cast<float>(random.below(4));
            if (place.weights == Vec3(0)) place.weights.x = 1;
        }
        Vec3 step;
        for (int k = 0; k < 3; ++k) step[k] = whole_number(random, 64);
        const auto size = static_cast<float>(1u << random.below(8));
        const Walked walked = mesh.walk(place, step / size);
        add_place(hash, walked.place);
        hash.add(walked.length);
        hash.add(walked.lost);
        hash.add(static_cast<std::uint64_t>(walked.met));
        hash.add(std::uint64_t{walked.side.triangle} << 2 | walked.side.side);
        hash.add(std::uint64_t{walked.crossings});
        add_turn(hash, walked.turn, step);
        hash.add<3>(mesh.to_world(walked.place));
        hash.add<3>(mesh.normal(walked.place));
        hash.add<3>(mesh.smooth_normal(walked.place));
        const WalkedInTriangle inner = mesh.walk_in_triangle(place, step);
        add_place(hash, inner.end);
        hash.add(inner.fraction);
        hash.add(std::uint64_t{inner.side});
        if (const std::optional<EdgeCrossing> crossing = mesh.cross_edge(inner.end)) {
            add_place(hash, crossing->place);
            add_turn(hash, crossing->rotation, step);
        }
        place = walked.place;
    }
}

}  // namespace abut::test
