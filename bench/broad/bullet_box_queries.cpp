// Queries of Bullet's btDbvt.

#include "../bullet.hpp"
#include "box_queries.hpp"
#include "broad_peers.hpp"

#include <algorithm>
#include <memory>
#include <vector>

namespace abut::bench {

namespace {

struct Tree {
    explicit Tree(std::span<const Aabb3> all) : boxes(all.begin(), all.end()) {
        for (std::size_t i = 0; i < boxes.size(); ++i) tree.insert(to_bullet(boxes[i]), reinterpret_cast<void*>(i));
        tree.optimizeTopDown();
    }

    std::vector<Aabb3> boxes;
    btDbvt tree;
};

struct CountLeaves : btDbvt::ICollide {
    void Process(const btDbvtNode*) override { ++count; }
    std::size_t count = 0;
};

/// The tree visits every box that the ray hits: it can't shorten the ray.
struct FirstHit : btDbvt::ICollide {
    FirstHit(std::span<const Aabb3> all, const Ray3& query) : boxes(all), ray(query), reach(query.length) {}
    void Process(const btDbvtNode* leaf) override {
        reach = std::min(reach, entry(ray, boxes[reinterpret_cast<std::uintptr_t>(leaf->data)]));
    }

    std::span<const Aabb3> boxes;
    const RayToBox ray;
    float reach;
};

void cast(const btDbvt& tree, const Ray3& ray, btDbvt::ICollide& visitor) {
    const Vec3 end = ray.origin + ray.length * ray.direction;
    btDbvt::rayTest(tree.m_root, to_bullet(ray.origin), to_bullet(end), visitor);
}

}  // namespace

Side bullet_regions(std::span<const Aabb3> boxes, std::span<const Aabb3> regions) {
    const auto tree = std::make_shared<const Tree>(boxes);
    return each_query("bullet", regions, [tree](const Aabb3& region) {
        CountLeaves leaves;
        tree->tree.collideTV(tree->tree.m_root, to_bullet(region), leaves);
        return static_cast<double>(leaves.count);
    });
}

Side bullet_rays(std::span<const Aabb3> boxes, std::span<const Ray3> rays) {
    const auto tree = std::make_shared<const Tree>(boxes);
    return each_query("bullet", rays, [tree](const Ray3& ray) {
        CountLeaves leaves;
        cast(tree->tree, ray, leaves);
        return static_cast<double>(leaves.count);
    });
}

Side bullet_first_hits(std::span<const Aabb3> boxes, std::span<const Ray3> rays) {
    const auto tree = std::make_shared<const Tree>(boxes);
    return each_query("bullet", rays, [tree](const Ray3& ray) {
        FirstHit hit(tree->boxes, ray);
        cast(tree->tree, ray, hit);
        return static_cast<double>(hit.reach);
    });
}

}  // namespace abut::bench
