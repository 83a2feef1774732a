// libccd in double: GJK with EPA, and Minkowski portal refinement (MPR). It returns no gaps.

#include "peers.hpp"

#include <ccd/ccd.h>

namespace abut::differential {

using namespace detail;

namespace {

/// Both shapes are relative to the center of A, which avoids cancellation far from the origin.
struct Body {
    const PeerShape& shape;
    DVec<3> offset;
};

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* result) {
    const Body& body = *static_cast<const Body*>(object);
    const DVec<3> n(direction->v[0], direction->v[1], direction->v[2]);
    const DVec<3>* best = &body.shape.points.front();
    for (const DVec<3>& point : body.shape.points)
        if (dot(point, n) > dot(*best, n)) best = &point;
    const DVec<3> there = body.offset + *best + normalized(n) * body.shape.radius;
    ccdVec3Set(result, there.x, there.y, there.z);
}
void center(const void* object, ccd_vec3_t* result) {
    const Body& body = *static_cast<const Body*>(object);
    DVec<3> sum(0.0);
    for (const DVec<3>& point : body.shape.points) sum += point;
    const DVec<3> there = body.offset + sum / static_cast<double>(body.shape.points.size());
    ccdVec3Set(result, there.x, there.y, there.z);
}

/// The tolerances of libccd are lengths; its default is 1e-4 for all sizes.
ccd_t settings(double smaller) {
    ccd_t result;
    CCD_INIT(&result);
    result.support1 = result.support2 = support;
    result.center1 = result.center2 = center;
    result.max_iterations = 1000;
    result.epa_tolerance = result.mpr_tolerance = 1e-6 * smaller;
    return result;
}

using Intersect = int (*)(const void*, const void*, const ccd_t*);
using Penetrate = int (*)(const void*, const void*, const ccd_t*, ccd_real_t*, ccd_vec3_t*, ccd_vec3_t*);

PeerAnswer query(const PeerShape& a, const PeerShape& b, double smaller, Intersect intersect, Penetrate penetrate) {
    const Body in_a{a, DVec<3>(0.0)}, in_b{b, b.center - a.center};
    const ccd_t ccd = settings(smaller);
    PeerAnswer answer{PeerAnswer::State::answered, intersect(&in_a, &in_b, &ccd) != 0, false, 0};
    if (!answer.overlap) return answer;
    ccd_real_t depth = 0;
    ccd_vec3_t direction, position;
    if (penetrate(&in_a, &in_b, &ccd, &depth, &direction, &position) != 0) return {PeerAnswer::State::refused};
    answer.knows_distance = true;
    answer.distance = -depth;
    return answer;
}

}  // namespace

PeerAnswer query_ccd_epa(const PeerShape& a, const PeerShape& b, double smaller) {
    return query(a, b, smaller, ccdGJKIntersect, ccdGJKPenetration);
}
PeerAnswer query_ccd_mpr(const PeerShape& a, const PeerShape& b, double smaller) {
    return query(a, b, smaller, ccdMPRIntersect, ccdMPRPenetration);
}

}  // namespace abut::differential
