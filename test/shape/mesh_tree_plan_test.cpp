// Trees of meshes rebuilt from their stored topology.

#include "../oracle/random.hpp"
#include "meshes.hpp"
#include <abut/math/detail/coincident.hpp>
#include <abut/shape/mesh/tree_topology.hpp>
#include <abut/shape/weld.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;
using test::Surface;

MeshTree tree_of(const Welded& mesh) {
    return build_mesh_tree(mesh.points, mesh.triangles, first_coincident(mesh.points));
}

void expect_same(const MeshTree& a, const MeshTree& b) {
    ASSERT_EQ(a.nodes.size(), b.nodes.size());
    ASSERT_EQ(a.leaves.size(), b.leaves.size());
    for (std::size_t i = 0; i < a.nodes.size(); ++i)
        ASSERT_EQ(std::memcmp(&a.nodes[i], &b.nodes[i], sizeof(MeshNode)), 0) << i;
    for (std::size_t i = 0; i < a.leaves.size(); ++i)
        ASSERT_EQ(std::memcmp(&a.leaves[i], &b.leaves[i], offsetof(MeshLeaf, extent) + sizeof(float)), 0) << i;
    EXPECT_EQ(a.order, b.order);
    EXPECT_EQ(a.roots[0].ref, b.roots[0].ref);
    EXPECT_EQ(a.roots[0].box, b.roots[0].box);
    EXPECT_EQ(a.roots[1].ref, b.roots[1].ref);
    EXPECT_EQ(a.middle, b.middle);
    EXPECT_EQ(a.off_center, b.off_center);
    EXPECT_EQ(a.spread, b.spread);
}

/// Checks that every triangle is in one leaf, and within all boxes above it; returns the depth.
int checked_depth(const MeshTree& tree, std::uint32_t ref, const Aabb3& box, const Welded& mesh,
                  std::vector<int>& found) {
    if (!detail::is_leaf(ref)) {
        int deepest = 0;
        for (std::uint32_t lane = 0; lane < mesh_lanes; ++lane) {
            const MeshNode& node = tree.node(ref);
            if (node.child[lane] == detail::bvh_none) continue;
            EXPECT_EQ(merged(box, node.box(lane)), box);
            deepest = std::max(deepest, checked_depth(tree, node.child[lane], node.box(lane), mesh, found));
        }
        return deepest + 1;
    }
    const MeshLeaf& leaf = tree.leaf(ref);
    for (std::uint32_t lane = 0; lane < leaf.count(); ++lane) {
        const std::uint32_t item = tree.order[leaf.first + lane];
        ++found[item];
        const Triangle3 t = leaf.at(lane);
        const glm::uvec3& points = mesh.triangles[item];
        EXPECT_EQ(t.a, mesh.points[points.x]);
        EXPECT_EQ(t.b, mesh.points[points.y]);
        EXPECT_EQ(t.c, mesh.points[points.z]);
        for (const Vec3& corner : {t.a, t.b, t.c}) EXPECT_TRUE(contains(box, corner));
    }
    return 0;
}

TEST(MeshTreeTopology, MakesTheSameTreeAgain) {
    Random random(11);
    std::vector<Welded> meshes;
    const Surface box = test::box_surface({-1, 0, 2}, {1, 3, 3}),
                  hills = test::random_terrain(random, 50, 0.8).surface();
    meshes.push_back({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    meshes.push_back(weld(box.points, box.triangles));
    meshes.push_back(weld(hills.points, hills.triangles));
    for (int i = 0; i < 40; ++i) {
        const int count = 1 + static_cast<int>(random.below(60));
        const Surface soup = test::random_soup(random, count, 10, random.power_of_two(-4, 4));
        meshes.push_back(weld(soup.points, soup.triangles));
    }
    for (const Welded& mesh : meshes) {
        SCOPED_TRACE(std::to_string(mesh.triangles.size()) + " triangles");
        const MeshTree tree = tree_of(mesh);
        const std::optional<MeshTree> again = build_mesh_tree(mesh.points, mesh.triangles, topology_of(tree));
        ASSERT_TRUE(again);
        expect_same(tree, *again);
    }
}

TEST(MeshTreeTopology, AnyOtherPlanMakesASoundTreeOrNone) {
    constexpr std::uint64_t seed = 5;
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Surface hills = test::random_terrain(random, 8, 0.8).surface();
    const Welded mesh = weld(hills.points, hills.triangles);
    const MeshTreeTopology whole = topology_of(tree_of(mesh));
    ASSERT_GT(whole.children.size(), 8u);
    std::size_t made = 0, refused = 0;
    for (int i = 0; i < 20000; ++i) {
        MeshTreeTopology plan = whole;
        const auto one_of = [&](const auto& list) { return random.below(static_cast<std::uint32_t>(list.size())); };
        for (std::uint32_t change = 0; change < 1 + random.below(2); ++change) switch (random.below(5)) {
                case 0:
                    plan.order[one_of(plan.order)] = one_of(plan.order);
                    break;
                case 1:
                    plan.corners[one_of(plan.corners)] ^= static_cast<std::uint16_t>(1u << random.below(11));
                    break;
                case 2:
                    plan.counts[one_of(plan.counts)] = static_cast<std::uint8_t>(random.below(10));
                    break;
                case 3: {
                    const std::uint32_t a = one_of(plan.children), b = one_of(plan.children);
                    std::swap(plan.children[a], plan.children[b]);
                    break;
                }
                default:
                    plan.children[one_of(plan.children)] =
                        random.chance(0.5) ? random.below(12) : detail::bvh_leaf_bit | random.below(40);
            }
        const std::optional<MeshTree> tree = build_mesh_tree(mesh.points, mesh.triangles, plan);
        (tree ? made : refused) += 1;
        if (!tree) continue;
        std::vector<int> found(mesh.triangles.size(), 0);
        const Aabb3 all{Vec3(-1e9f), Vec3(1e9f)};
        EXPECT_LE(checked_depth(*tree, tree->root(0).ref, all, mesh, found), detail::bvh_depth);
        ASSERT_EQ(found, std::vector<int>(mesh.triangles.size(), 1));
    }
    EXPECT_GT(made, 200u);
    EXPECT_GT(refused, 10000u);
}

TEST(MeshTreeTopology, AreAsLongAsTheyShouldBeAndNotTooDeep) {
    Random random(3);
    const Surface hills = test::random_terrain(random, 20, 0.8).surface();
    const Welded mesh = weld(hills.points, hills.triangles);
    const MeshTreeTopology whole = topology_of(tree_of(mesh));
    const auto is_made = [&](const MeshTreeTopology& plan) {
        return build_mesh_tree(mesh.points, mesh.triangles, plan).has_value();
    };
    EXPECT_TRUE(is_made(whole));
    const auto changed = [&](auto&& change) {
        MeshTreeTopology plan = whole;
        change(plan);
        return is_made(plan);
    };
    EXPECT_FALSE(changed([](MeshTreeTopology& plan) { plan.order.pop_back(); }));
    EXPECT_FALSE(changed([](MeshTreeTopology& plan) { plan.corners.pop_back(); }));
    EXPECT_FALSE(changed([](MeshTreeTopology& plan) { plan.counts.pop_back(); }));
    EXPECT_FALSE(changed([](MeshTreeTopology& plan) { plan.counts.push_back(0); }));
    EXPECT_FALSE(changed([](MeshTreeTopology& plan) { plan.children.pop_back(); }));
    EXPECT_FALSE(changed([](MeshTreeTopology& plan) { plan.children.resize(plan.children.size() - 8); }));
    EXPECT_FALSE(changed([](MeshTreeTopology& plan) { plan.children.clear(); }));
    EXPECT_FALSE(changed([](MeshTreeTopology& plan) { plan = {}; }));

    // Each node has a leaf and the next node: the maximum depth, up to the stack of the searches.
    for (const std::uint32_t nodes :
         {static_cast<std::uint32_t>(detail::bvh_depth), static_cast<std::uint32_t>(detail::bvh_depth) + 1}) {
        Welded few = mesh;
        few.triangles.resize(nodes + 1);
        MeshTreeTopology chain;
        for (std::uint32_t i = 0; i <= nodes; ++i) {
            chain.order.push_back(i);
            chain.corners.push_back(0 | 1 << 3 | 2 << 6);
            chain.counts.push_back(1);
            if (i == nodes) break;
            std::vector<std::uint32_t> children(8, detail::bvh_none);
            children[0] = detail::bvh_leaf_bit | i;
            children[1] = i + 1 < nodes ? i + 1 : detail::bvh_leaf_bit | nodes;
            chain.children.insert(chain.children.end(), children.begin(), children.end());
        }
        EXPECT_EQ(build_mesh_tree(few.points, few.triangles, chain).has_value(), nodes == detail::bvh_depth) << nodes;
    }
}

}  // namespace
}  // namespace abut
