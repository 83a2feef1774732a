// Strips of triangles of a walk mesh.

#include "walk_strip.h"

#include "json.hpp"
#include <abut/walk/path/search.hpp>
#include <abut/walk/path/shorten.hpp>

using namespace abut::detail;
using abut::play::Json;

namespace {

using abut::WalkMesh;
using abut::WalkPoint;
using abut::WalkSide;

WalkPoint from_c(const abut_walk_point& place) {
    return {place.triangle, same_bytes<abut::Vec3>(place.weights)};
}
Fault valid(const abut_walk_mesh* mesh, const abut_walk_point& place, const char* name) {
    if (mesh == nullptr || mesh->tag != abut_walk_mesh::own_tag) return {};  // another fault
    const bool is_there = place.triangle < mesh->mesh.triangles().size() && mesh->mesh.is_walkable(place.triangle);
    return is_there ? finite(place.weights, name) : Fault{ABUT_INDEX_OUT_OF_RANGE, name, "is in no triangle"};
}

struct PlacedTriangle {
    std::uint32_t triangle = 0;
    std::array<DVec<2>, 3> corners;

    DVec<2> operator()(const abut::Vec3& weights) const {
        const WalkWeights own = normalised_weights(weights);
        return corners[0] + (corners[1] - corners[0]) * own.second + (corners[2] - corners[0]) * own.third;
    }
};

/// The triangle beyond a side, in the same plane. `mirrored` says whether a triangle lies upside down there.
PlacedTriangle placed_beyond(const WalkMeshData& data, const PlacedTriangle& here, std::uint32_t side, bool& mirrored) {
    const WalkTriangle& walk = data.walk[here.triangle];
    const WalkLink link = walk.link[side];
    const std::uint32_t leaving = left_leaving(side, mirrored);
    const DVec<2> left = here.corners[leaving];
    const DVec<2> right = here.corners[leaving == side ? next_corner(side) : side];
    const DVec<2> apex = beyond_side(walk, side, mirrored, left, right);
    mirrored = mirrored != link.mirrored();
    const std::uint32_t entering = left_entering(link.side(), mirrored);
    PlacedTriangle next{link.triangle(), {apex, apex, apex}};
    next.corners[entering] = left;
    next.corners[entering == link.side() ? next_corner(link.side()) : link.side()] = right;
    return next;
}

std::vector<PlacedTriangle> unfolded(const WalkMeshData& data, std::uint32_t first, std::span<const WalkSide> sides) {
    const WalkFrame frame(data.walk[first]);
    std::vector<PlacedTriangle> result{{first, {frame.corner(0), frame.corner(1), frame.corner(2)}}};
    bool mirrored = false;
    for (const WalkSide& side : sides) result.push_back(placed_beyond(data, result.back(), side.side, mirrored));
    return result;
}

/// Moves the plane so that a point becomes the origin and a direction the second axis.
class Map {
public:
    Map(const DVec<2>& origin, const DVec<2>& ahead, bool from_below)
        : origin_(origin),
          ahead_(length(ahead) > 0 ? normalized(ahead) : DVec<2>(0, 1)),
          right_(from_below ? DVec<2>(-ahead_.y, ahead_.x) : DVec<2>(ahead_.y, -ahead_.x)) {}

    abut::Vec2 operator()(const DVec<2>& point) const {
        return to_float(DVec<2>(dot(point - origin_, right_), dot(point - origin_, ahead_)));
    }

private:
    DVec<2> origin_, ahead_, right_;
};

struct Strip {
    std::vector<PlacedTriangle> triangles;
    std::vector<DVec<2>> line;
    std::vector<abut::Vec3> space;
};

void write(const WalkMesh& mesh, const Strip& strip, const Map& map, abut_buffer& out) {
    Json json;
    json.begin('{').key("triangles").begin('[');
    for (const PlacedTriangle& each : strip.triangles) {
        json.begin('{').key("triangle").count(each.triangle).key("corners").begin('[');
        for (const DVec<2>& corner : each.corners) json.vec<2>(map(corner));
        json.end(']').end('}');
    }
    json.end(']').key("borders").begin('[');
    for (const PlacedTriangle& each : strip.triangles)
        for (std::uint32_t side = 0; side < 3; ++side) {
            if (mesh.beyond({each.triangle, side})) continue;
            json.vec<2>(map(each.corners[side])).vec<2>(map(each.corners[next_corner(side)]));
        }
    json.end(']').key("line").begin('[');
    for (const DVec<2>& point : strip.line) json.vec<2>(map(point));
    json.end(']').key("space").vecs<3>(strip.space).end('}').write(out);
}

/// The places after parts of a step, in the unfolded triangles. A walk that slides may come back to a triangle; the
/// later of its copies is meant then.
Strip strip_of_walk(const WalkMesh& mesh, const WalkPoint& place, const abut::Vec3& step) {
    constexpr int parts = 256;
    std::vector<WalkSide> sides;
    const auto record = [&](const WalkSide& from, const WalkSide&) {
        sides.push_back(from);
        return true;
    };
    mesh.walk(place, step, {.allow = record});
    Strip strip{unfolded(mesh.data(), place.triangle, sides), {}, {}};
    std::size_t at = 0;
    for (int part = 0; part <= parts; ++part) {
        const WalkPoint here = mesh.walk(place, step * (static_cast<float>(part) / parts)).place;
        std::size_t next = at;
        while (next < strip.triangles.size() && strip.triangles[next].triangle != here.triangle) ++next;
        if (next == strip.triangles.size()) continue;
        at = next;
        strip.line.push_back(strip.triangles[at](here.weights));
        strip.space.push_back(mesh.to_world(here));
    }
    return strip;
}

}  // namespace

abut_code abut_play_walk_strip(const abut_walk_mesh* mesh, abut_walk_point place, abut_vec3 step, bool from_below,
                               abut_buffer* out) {
    return entry({present(mesh, "mesh"), valid(mesh, place, "place"), finite(step, "step"), present(out, "out")}, [&] {
        const WalkMesh& own = mesh->mesh;
        const Strip strip = strip_of_walk(own, from_c(place), same_bytes<abut::Vec3>(step));
        const DVec<2> ahead(own.to_plane(place.triangle, same_bytes<abut::Vec3>(step)));
        write(own, strip, Map(strip.line.front(), ahead, from_below), *out);
    });
}

abut_code abut_play_path_strip(const abut_walk_mesh* mesh, abut_walk_point from, abut_walk_point to, bool from_below,
                               abut_buffer* out) {
    return entry({present(mesh, "mesh"), valid(mesh, from, "from"), valid(mesh, to, "to"), present(out, "out")}, [&] {
        const WalkMesh& own = mesh->mesh;
        const auto path = own.find_path(from_c(from), from_c(to));
        if (!path) {
            write(own, {}, Map(DVec<2>(0.0), DVec<2>(0.0), from_below), *out);
            return;
        }
        const abut::WalkPathOptions options;
        const WalkPathRules rules(own.data(), options);
        const WalkTautPath taut = shorten_path(rules, *find_strip(rules, from_c(from), from_c(to)));
        Strip strip{unfolded(own.data(), taut.strip.from.triangle, taut.strip.sides), {}, path->points};
        for (const WalkKnot& knot : taut.knots) strip.line.push_back(knot.at);
        write(own, strip, Map(strip.line.front(), strip.line[1] - strip.line.front(), from_below), *out);
    });
}

abut_code abut_play_walk_edges(const abut_walk_mesh* mesh, bool border, abut_buffer* out) {
    return entry({present(mesh, "mesh"), present(out, "out")}, [&] {
        const WalkMesh& own = mesh->mesh;
        std::vector<abut::Vec3> ends;
        for (std::uint32_t triangle = 0; triangle < own.triangles().size(); ++triangle) {
            if (!own.is_walkable(triangle)) continue;
            const glm::uvec3& corners = own.triangles()[triangle];
            for (std::uint32_t side = 0; side < 3; ++side) {
                const auto beyond = own.beyond({triangle, side});
                if (beyond.has_value() == border || (beyond && beyond->triangle < triangle)) continue;
                for (const std::uint32_t corner : {side, next_corner(side)})
                    ends.push_back(own.points()[corners[static_cast<glm::length_t>(corner)]]);
            }
        }
        const auto bytes = std::as_bytes(std::span(ends));
        out->bytes.assign(bytes.begin(), bytes.end());
    });
}
