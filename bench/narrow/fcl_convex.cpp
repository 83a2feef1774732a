// FCL's narrow phase, in double as Debian builds it.

#include "../each_pair.hpp"
#include "../fcl.hpp"
#include "../peers.hpp"

#include <algorithm>
#include <memory>
#include <variant>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

namespace abut::bench {

namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

Geometry geometry_of(const Sphere& sphere) {
    return std::make_shared<fcl::Sphered>(sphere.radius);
}
Geometry geometry_of(const Box3& box) {
    return std::make_shared<fcl::Boxd>(2 * to_fcl(box.half));
}
Geometry geometry_of(const Capsule3& capsule) {
    return std::make_shared<fcl::Capsuled>(capsule.radius, capsule.b.y - capsule.a.y);
}
Geometry geometry_of(const Polyhedron& hull) {
    auto points = std::make_shared<std::vector<fcl::Vector3d>>();
    for (const Vec3& point : hull.points()) points->push_back(to_fcl(point));
    auto faces = std::make_shared<std::vector<int>>();
    const detail::Facets& facets = hull.facets();
    std::uint32_t begin = 0;
    for (const std::uint32_t end : facets.loop_ends) {
        faces->push_back(static_cast<int>(end - begin));
        for (; begin < end; ++begin) faces->push_back(static_cast<int>(facets.loops[begin]));
    }
    return std::make_shared<fcl::Convexd>(points, static_cast<int>(facets.loop_ends.size()), faces);
}

/// FCL's capsules are along z, those of the scene along y.
fcl::Transform3d own_frame(const scenes::AnyConvex<3>& shape) {
    fcl::Transform3d result = fcl::Transform3d::Identity();
    if (std::holds_alternative<Capsule3>(shape)) result.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    return result;
}

struct PlacedGeometry {
    const fcl::CollisionGeometryd* geometry;
    fcl::Transform3d pose;
};

struct Pair {
    PlacedGeometry a, b;
};

struct Scene {
    explicit Scene(const std::vector<scenes::AnyConvex<3>>& all) : shapes(all) {
        for (const scenes::AnyConvex<3>& shape : shapes)
            geometries.push_back(std::visit([](const auto& s) { return geometry_of(s); }, shape));
    }
    explicit Scene(const scenes::ConvexPairs<3>& scene) : Scene(scene.shapes) {
        for (const auto& [a, b] : scene.pairs) pairs.push_back({placed(a), placed(b)});
    }

    PlacedGeometry placed(const scenes::Placed<3>& item) const {
        return {geometries[item.shape].get(), to_fcl(item.pose) * own_frame(shapes[item.shape])};
    }

    std::vector<scenes::AnyConvex<3>> shapes;
    std::vector<Geometry> geometries;
    std::vector<Pair> pairs;
};

/// Runs a query for each pair.
template <class Question>
Side side(const scenes::ConvexPairs<3>& scene, Question question) {
    return {"fcl", each_pair(std::make_shared<const Scene>(scene), std::move(question))};
}

double distance(const PlacedGeometry& a, const PlacedGeometry& b, const fcl::DistanceRequestd& request) {
    fcl::DistanceResultd result;
    fcl::distance(a.geometry, a.pose, b.geometry, b.pose, request, result);
    return result.min_distance;
}

fcl::CollisionResultd collide(const Pair& pair, const fcl::CollisionRequestd& request) {
    fcl::CollisionResultd result;
    fcl::collide(pair.a.geometry, pair.a.pose, pair.b.geometry, pair.b.pose, request, result);
    return result;
}

// Its default tolerance, 1e-6: with 1e-4 hulls take 10 % less time, and 1 % of the values are off.
fcl::DistanceRequestd with_points(bool is_signed) {
    return fcl::DistanceRequestd(true, is_signed);
}

double depth(const Pair& pair, const fcl::DistanceRequestd& request) {
    const double gap = distance(pair.a, pair.b, request);
    return gap <= 0 ? -gap : -1;
}

}  // namespace

Side fcl_closest(const scenes::ConvexPairs<3>& scene) {
    return side(scene, [request = with_points(false)](const Pair& pair, std::size_t) {
        return distance(pair.a, pair.b, request);
    });
}

Side fcl_signed_closest(const scenes::ConvexPairs<3>& scene) {
    return side(scene, [request = with_points(true)](const Pair& pair, std::size_t) {
        return distance(pair.a, pair.b, request);
    });
}

Side fcl_overlaps(const scenes::ConvexPairs<3>& scene) {
    return side(scene, [request = fcl::CollisionRequestd()](const Pair& pair, std::size_t) -> double {
        return collide(pair, request).isCollision() ? 1 : 0;
    });
}

Side fcl_contact_of_boxes(const scenes::ConvexPairs<3>& scene) {
    return side(scene, [request = fcl::CollisionRequestd(4, true)](const Pair& pair, std::size_t) {
        const fcl::CollisionResultd result = collide(pair, request);
        double depth = -1;
        for (std::size_t i = 0; i < result.numContacts(); ++i)
            depth = std::max(depth, result.getContact(i).penetration_depth);
        return depth;
    });
}

Side fcl_depth(const scenes::ConvexPairs<3>& scene) {
    return side(scene, [request = with_points(true)](const Pair& pair, std::size_t) { return depth(pair, request); });
}

Side fcl_depth_of_few(const scenes::ConvexPairs<3>& scene) {
    return side(scene, [request = with_points(true)](const Pair& pair, std::size_t) {
        return collide(pair, fcl::CollisionRequestd()).isCollision() ? depth(pair, request) : -1;
    });
}

Side fcl_closest_to_mesh(const MeshScene& scene) {
    struct Shared {
        Scene scene;
        fcl::BVHModel<fcl::OBBRSSd> mesh;
        std::vector<PlacedGeometry> placed;
    };
    auto all = std::make_shared<Shared>(Shared{Scene(scene.shapes), {}, {}});
    std::vector<fcl::Vector3d> points;
    for (const Vec3& point : scene.terrain.points) points.push_back(to_fcl(point));
    std::vector<fcl::Triangle> triangles;
    for (const glm::uvec3& t : scene.terrain.triangles) triangles.emplace_back(t.x, t.y, t.z);
    all->mesh.beginModel();
    all->mesh.addSubModel(points, triangles);
    all->mesh.endModel();
    for (const scenes::Placed<3>& item : scene.placed) all->placed.push_back(all->scene.placed(item));

    return {"fcl", [all, request = with_points(false)](std::span<double> values) {
                const PlacedGeometry mesh{&all->mesh, fcl::Transform3d::Identity()};
                for (std::size_t i = 0; i < values.size(); ++i) values[i] = distance(all->placed[i], mesh, request);
            }};
}

}  // namespace abut::bench
