#include <abut/bake/bodies.hpp>
#include <abut/bake/solid.hpp>
#include <abut/math/dvec.hpp>
#include <abut/shape/half_edges.hpp>

namespace abut {

std::vector<Piece> bodies_of(std::span<const Vec3> points, std::span<const glm::uvec3> triangles, double thickness) {
    Piece whole;
    whole.points.assign(points.begin(), points.end());
    whole.triangles.assign(triangles.begin(), triangles.end());
    whole.closed = false;
    std::vector<Piece> bodies = connected(whole);
    for (Piece& body : bodies) {
        body.closed = edge_faults(body.triangles).closed;
        body.volume = measured_volume(body);
    }
    give_hollows(bodies);
    for (Piece& body : bodies) {
        if (body.closed && body.volume > 0) continue;
        body.closed = false;
        body.thickness = thickness;
        body.volume = measured_volume(body);
    }
    return bodies;
}

bool is_convex(const Piece& body) {
    if (!body.closed || !body.cap_edges.empty()) return false;
    std::vector<Vec3> points;
    points.reserve(body.points.size());
    for (const DVec<3>& p : body.points) points.push_back(to_float(p));
    return is_convex_solid(points, body.triangles);
}

}  // namespace abut
