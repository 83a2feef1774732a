// libccd in double, called directly: overlap tests and depths. It has no distances.

#include "../each_pair.hpp"
#include "../peers.hpp"
#include <abut/math/affine.hpp>

#include <cmath>
#include <memory>
#include <variant>
#include <vector>

#include <ccd/ccd.h>

namespace abut::bench {

using namespace detail;

namespace {

/// A box stores its half extents as its only point, a hull its vertices.
struct Body {
    const std::vector<DVec<3>>* points;
    Affine<3> place;
};

struct Pair {
    Body a, b;
};

std::vector<DVec<3>> points_of(const scenes::AnyConvex<3>& shape) {
    if (const Box3* box = std::get_if<Box3>(&shape)) return {DVec<3>(box->half)};
    std::vector<DVec<3>> result;
    for (const Vec3& point : std::get<Polyhedron>(shape).points()) result.push_back(DVec<3>(point));
    return result;
}

void write(const DVec<3>& from, ccd_vec3_t* to) {
    ccdVec3Set(to, from.x, from.y, from.z);
}
DVec<3> direction_in(const Body& body, const ccd_vec3_t* direction) {
    return body.place.transposed({direction->v[0], direction->v[1], direction->v[2]});
}

void support_of_box(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* result) {
    const Body& body = *static_cast<const Body*>(object);
    const DVec<3> n = direction_in(body, direction);
    const DVec<3>& half = body.points->front();
    write(body.place.point({std::copysign(half.x, n.x), std::copysign(half.y, n.y), std::copysign(half.z, n.z)}),
          result);
}
void support_of_hull(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* result) {
    const Body& body = *static_cast<const Body*>(object);
    const DVec<3> n = direction_in(body, direction);
    const DVec<3>* best = body.points->data();
    double farthest = dot(*best, n);
    for (const DVec<3>& point : *body.points) {
        const double far = dot(point, n);
        if (far > farthest) {
            farthest = far;
            best = &point;
        }
    }
    write(body.place.point(*best), result);
}
void center(const void* object, ccd_vec3_t* result) {
    write(static_cast<const Body*>(object)->place.offset, result);
}

struct Scene {
    explicit Scene(const scenes::ConvexPairs<3>& scene) {
        CCD_INIT(&settings);
        settings.support1 = settings.support2 =
            std::holds_alternative<Box3>(scene.shapes.front()) ? support_of_box : support_of_hull;
        settings.center1 = settings.center2 = center;
        settings.max_iterations = 1000;
        for (const scenes::AnyConvex<3>& shape : scene.shapes) points.push_back(points_of(shape));
        for (const auto& [a, b] : scene.pairs)
            pairs.push_back({{&points[a.shape], affine(a.pose)}, {&points[b.shape], affine(b.pose)}});
    }

    ccd_t settings;
    std::vector<std::vector<DVec<3>>> points;
    std::vector<Pair> pairs;
};

template <class Question>
Side side(const scenes::ConvexPairs<3>& scene, Question question) {
    auto own = std::make_shared<const Scene>(scene);
    const ccd_t& settings = own->settings;
    return {"libccd", each_pair(std::move(own), [question, &settings](const Pair& pair, std::size_t) -> double {
                return question(pair, settings);
            })};
}

}  // namespace

Side ccd_overlaps(const scenes::ConvexPairs<3>& scene) {
    return side(scene, [](const Pair& pair, const ccd_t& settings) {
        return ccdMPRIntersect(&pair.a, &pair.b, &settings) != 0 ? 1 : 0;
    });
}

Side ccd_depth(const scenes::ConvexPairs<3>& scene) {
    return side(scene, [](const Pair& pair, const ccd_t& settings) -> double {
        ccd_real_t depth = 0;
        ccd_vec3_t direction, position;
        return ccdGJKPenetration(&pair.a, &pair.b, &settings, &depth, &direction, &position) == 0 ? depth : -1;
    });
}

}  // namespace abut::bench
