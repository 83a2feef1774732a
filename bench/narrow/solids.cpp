// Closed meshes as solids: pieces of a kit, and bumpy balls of about 1,000 triangles.

#include "../../scenes/bumpy_ball.hpp"
#include "../../scenes/kit.hpp"
#include "narrow.hpp"
#include <abut/shape/capsule.hpp>
#include <abut/shape/solid_mesh.hpp>

#include <algorithm>
#include <limits>

namespace abut::bench {

namespace {

struct SolidPair {
    std::size_t a, b;
    Pose3 pose_a, pose_b;
};

struct SolidPairs {
    std::vector<Mesh> meshes;
    std::vector<SolidPair> pairs;

    auto placed_a(const SolidPair& pair) const { return at(solid(meshes[pair.a]), pair.pose_a); }
    auto placed_b(const SolidPair& pair) const { return at(solid(meshes[pair.b]), pair.pose_b); }
    bool touch(const SolidPair& pair) const { return overlaps(placed_a(pair), placed_b(pair)); }
};

/// Pairs of pieces on a grid, or off it by a little, whose surfaces overlap or touch.
SolidPairs kit_pairs() {
    oracle::Random random(seed);
    SolidPairs result;
    for (const scenes::KitPiece& piece : scenes::kit())
        result.meshes.push_back(*Mesh::build(piece.points, piece.triangles));
    const auto count = static_cast<std::uint32_t>(result.meshes.size());
    while (result.pairs.size() < pair_count) {
        const Vec3 near = scenes::kit_position(random, Vec3(0), 2);
        const SolidPair pair{random.below(count), random.below(count), {near}, {scenes::kit_position(random, near, 2)}};
        if (result.touch(pair)) result.pairs.push_back(pair);
    }
    return result;
}

/// Turned balls of 960 triangles, a tenth to nine tenths of their size in one another.
SolidPairs bumpy_pairs() {
    oracle::Random random(seed);
    SolidPairs result;
    for (int i = 0; i < 4; ++i) {
        const scenes::BumpyBall ball = scenes::bumpy_ball(16, 0.3, 0.01, random);
        result.meshes.push_back(*Mesh::build(ball.points, ball.triangles));
    }
    while (result.pairs.size() < 16) {
        const SolidPair pair{
            random.below(4),
            random.below(4),
            {{}, random.rotation<3>()},
            {detail::to_float(random.direction<3>() * random.uniform(0.5, 1.9)), random.rotation<3>()}};
        if (result.touch(pair)) result.pairs.push_back(pair);
    }
    return result;
}

/// Whether each depth is a move that parts the pair, and no longer than one out of the bounding boxes.
bool are_right(const SolidPairs& scene) {
    return std::all_of(scene.pairs.begin(), scene.pairs.end(), [&](const SolidPair& pair) {
        const auto a = scene.placed_a(pair), b = scene.placed_b(pair);
        const Closest<3> nearest = closest(a, b);
        if (nearest.distance >= 0) return nearest.distance == 0;
        const Aabb3 box_a = bounds(a), box_b = bounds(b);
        float out = std::numeric_limits<float>::infinity();
        for (int i = 0; i < 3; ++i) out = std::min({out, box_a.max[i] - box_b.min[i], box_b.max[i] - box_a.min[i]});
        Pose3 away = pair.pose_b;
        away.position += nearest.normal * -nearest.distance;
        return -nearest.distance <= out * 1.0001f &&
               closest(a, at(solid(scene.meshes[pair.b]), away)).distance > -1e-5f;
    });
}

/// The questions of a scene, whose depths are verified first.
template <class Question>
Job solids(SolidPairs scene, Question question) {
    if (!are_right(scene)) scene.pairs.clear();
    const std::size_t count = scene.pairs.size();
    const Side ours{"abut",
                    [scene = std::make_shared<const SolidPairs>(std::move(scene)), question](std::span<double> values) {
                        for (std::size_t i = 0; i < values.size(); ++i) {
                            const SolidPair& pair = scene->pairs[i];
                            values[i] = question(scene->placed_a(pair), scene->placed_b(pair));
                        }
                    }};
    return {.items = count, .values = count, .sides = {ours}};
}

const auto overlap = [](const auto& a, const auto& b) -> double { return overlaps(a, b) ? 1 : 0; };
const auto distance = [](const auto& a, const auto& b) -> double { return closest(a, b).distance; };
const auto depth = [](const auto& a, const auto& b) -> double { return contact(a, b).depth; };
/// A capsule at the place of the second solid.
const auto capsule = [](const auto& a, const auto& b) -> double {
    const Vec3 place = b.pose.position;
    return closest(a, Capsule3{place, place + Vec3(0, 0.5f, 0), 0.25f}).distance;
};

}  // namespace

std::vector<Bench> solid_benches() {
    return {
        {"narrow/solids/kit/overlaps", [] { return solids(kit_pairs(), overlap); }},
        {"narrow/solids/kit/closest", [] { return solids(kit_pairs(), distance); }},
        {"narrow/solids/kit/contact", [] { return solids(kit_pairs(), depth); }},
        {"narrow/solids/kit/capsule", [] { return solids(kit_pairs(), capsule); }},
        {"narrow/solids/mesh1k/overlaps", [] { return solids(bumpy_pairs(), overlap); }},
        {"narrow/solids/mesh1k/closest", [] { return solids(bumpy_pairs(), distance); }},
        {"narrow/solids/mesh1k/contact", [] { return solids(bumpy_pairs(), depth); }},
        {"narrow/solids/mesh1k/capsule", [] { return solids(bumpy_pairs(), capsule); }},
    };
}

}  // namespace abut::bench
