// Decompositions with their reports.

#include "decompose.h"

#include "json.hpp"
#include <abut/bake.hpp>
#include <abut/c/detail/rings.hpp>

#include <span>

using namespace abut::detail;
using abut::play::Json;

namespace {

Json& number(Json& json, std::string_view name, double value) {
    return json.key(name).number(static_cast<float>(value));
}
Json& flag(Json& json, std::string_view name, bool value) {
    return json.key(name).count(value ? 1 : 0);
}

void write(Json& json, const abut::DecomposeReport& report) {
    json.begin('{');
    flag(json, "closed", report.closed);
    number(json, "mesh_volume", report.mesh_volume);
    number(json, "parts_volume", report.parts_volume);
    number(json, "farthest", report.farthest);
    json.key("vertices").count(report.vertices);
    json.key("concavity").begin('[');
    for (const double concavity : report.concavity) json.number(static_cast<float>(concavity));
    json.end(']').end('}');
}
void write(Json& json, const abut::OutlineReport& report) {
    json.begin('{');
    json.key("repeated_points").count(report.repeated_points).key("touching_points").count(report.touching_points);
    json.key("cancelled_edges").count(report.cancelled_edges).key("idle_holes").count(report.idle_holes);
    json.key("filled_holes").count(report.filled_holes).key("reflex_corners").count(report.reflex_corners);
    json.key("pieces").count(report.pieces).key("min_pieces").count(report.min_pieces);
    json.key("thin_pieces").count(report.thin_pieces);
    flag(json, "optimal", report.optimal);
    number(json, "area", report.area);
    number(json, "area_added", report.area_added);
    json.end('}');
}

void write(Json& json, const abut::Polygon& part) {
    json.begin('{').key("points").vecs<2>(part.points());
    json.key("centroid").vec<2>(part.centroid()).end('}');
}
void write(Json& json, const abut::Polyhedron& part) {
    json.begin('{').key("points").vecs<3>(part.points()).key("triangles").begin('[');
    const Facets& facets = part.facets();
    for (std::size_t face = 0; face < facets.loop_ends.size(); ++face) {
        const auto loop = facets.loop(face);
        for (std::size_t i = 2; i < loop.size(); ++i) json.count(loop[0]).count(loop[i - 1]).count(loop[i]);
    }
    json.end(']').key("centroid").vec<3>(part.centroid());
    number(json, "volume", part.volume()).end('}');
}

/// Writes what decompose(report) returns.
template <class Report, class Decompose>
abut_code decomposed(abut_buffer& out, const Decompose& decompose) {
    Report own;
    const auto parts = decompose(own);
    if (!parts) return report(parts.problem());
    Json json;
    json.begin('{').key("report");
    write(json, own);
    json.key("parts").begin('[');
    for (const auto& part : *parts) write(json, part);
    json.end(']').end('}').write(out);
    return ABUT_OK;
}

}  // namespace

abut_code abut_play_decompose_mesh(const abut_shape3* mesh, const abut_decompose_options* options, abut_buffer* out) {
    return entry({present(mesh, "mesh"), present(out, "out")}, [&] {
        const auto* surface = std::get_if<abut::Mesh>(&mesh->source);
        if (surface == nullptr) return report(Fault{ABUT_WRONG_SHAPE, "mesh", "is no mesh"});
        return decomposed<abut::DecomposeReport>(*out, [&](abut::DecomposeReport& own) {
            abut::DecomposeOptions chosen{.report = &own};
            if (options != nullptr) {
                chosen.max_parts = options->max_parts;
                chosen.max_vertices = options->max_vertices;
                chosen.concavity = options->concavity;
            }
            return abut::decompose(*surface, chosen);
        });
    });
}

abut_code abut_play_decompose_outline(const abut_vec2* points, uint32_t stride, uint32_t point_count,
                                      const uint32_t* ends, uint32_t ring_count, bool conforming, double concavity,
                                      abut_buffer* out) {
    const Strided points_of(points, stride, point_count, "points");
    return entry({points_of.fault(), fault_of_ends(ends, ring_count, point_count), present(out, "out")}, [&] {
        const auto rings = rings_of(points_of, ends, ring_count);
        const std::span<const std::vector<abut::Vec2>> holes(rings.data() + 1, rings.size() - 1);
        return decomposed<abut::OutlineReport>(*out, [&](abut::OutlineReport& own) {
            return abut::decompose(rings[0], holes, {.concavity = concavity, .conforming = conforming, .report = &own});
        });
    });
}
