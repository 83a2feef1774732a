// The data of a polyhedron: its rank, the numbers of corners, faces, corners of all faces and edges, its centroid,
// volume and area, and the members of its hull. The rest follows from them.

#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/detail/polyhedron_data.hpp>
#include <abut/shape/file.hpp>
#include <abut/shape/file/blob.hpp>
#include <abut/shape/file/hull.hpp>

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace abut {

using namespace detail;

std::vector<std::byte> detail::saved_polyhedron(const Hull3& hull) {
    BlobWriter writer =
        begin_shape(SavedKind::polyhedron, 128 + hull.points.size() * sizeof(Vec3) + hull.normals.size() * 28 +
                                               hull.loops.size() * 4 + hull.edges.size() * sizeof(FacetEdge));
    writer.number(static_cast<std::uint32_t>(hull.rank));
    for (const std::size_t count : {hull.points.size(), hull.normals.size(), hull.loops.size(), hull.edges.size()})
        writer.number(static_cast<std::uint64_t>(count));
    for (int axis = 0; axis < 3; ++axis) writer.number(hull.centroid[axis]);
    writer.number(hull.volume);
    writer.number(hull.area);
    writer.array(std::span(hull.points));
    writer.array(std::span(hull.normals));
    writer.array(std::span(hull.offsets));
    writer.array(std::span(hull.loop_ends));
    writer.array(std::span(hull.loops));
    writer.array(std::span(hull.edges));
    return end_shape(std::move(writer));
}

std::vector<std::byte> save(const Polyhedron& polyhedron) {
    if (polyhedron.data_) return saved_polyhedron(polyhedron.data_->hull);
    Hull3 point;
    point.points = {Vec3(0.0f)};
    return saved_polyhedron(point);
}

Result<Polyhedron> load_polyhedron(std::span<const std::byte> bytes) {
    enter_library();
    constexpr SavedKind kind = SavedKind::polyhedron;
    Hull3 hull;
    std::uint32_t rank = 0;
    std::uint64_t points = 0, faces = 0, loops = 0, edges = 0;
    const auto read = [&](BlobReader& reader) {
        bool whole = reader.number(rank);
        for (std::uint64_t* count : {&points, &faces, &loops, &edges}) whole = whole && reader.number(*count);
        for (int axis = 0; axis < 3; ++axis) whole = whole && reader.number(hull.centroid[axis]);
        return whole && reader.number(hull.volume) && reader.number(hull.area) && reader.array(hull.points, points) &&
               reader.array(hull.normals, faces) && reader.array(hull.offsets, faces) &&
               reader.array(hull.loop_ends, faces) && reader.array(hull.loops, loops) &&
               reader.array(hull.edges, edges);
    };
    if (std::optional<Problem> wrong = read_shape(bytes, kind, read)) return *std::move(wrong);
    const Facets facets{hull.normals, hull.loops, hull.loop_ends, hull.edges, hull.offsets};
    if (const char* fault = fault_of_hull(hull.points, facets)) return bad_shape(kind, fault);
    hull.rank = rank_of_hull(hull.points.size(), hull.normals.size());
    if (rank != static_cast<std::uint32_t>(hull.rank)) return bad_shape(kind, "has another rank than its corners");
    if (!is_finite<3>(hull.centroid) || !std::isfinite(hull.volume) || !std::isfinite(hull.area))
        return Problem{ProblemCode::not_finite, "a number of the polyhedron is NaN or infinite"};
    Polyhedron result;
    result.data_ = std::make_shared<const Polyhedron::Data>(std::move(hull));
    return result;
}

}  // namespace abut
