// The parts of a solid level: their number, their origins, their numbers in the level, their hulls, and the topology of
// the tree of their boxes. Hulls: in 2D the number of corners of each and their sum, then the corners; in 3D the
// numbers of corners, faces, corners of all faces and edges of each, the sums of these, then the members of all hulls.

#include <abut/broad_phase/bvh/topology.hpp>
#include <abut/convex/point_soa.hpp>
#include <abut/convex/polygon_soa.hpp>
#include <abut/math/detail/blob.hpp>
#include <abut/shape/file/hull.hpp>
#include <abut/shape/solid_bsp/parts.hpp>

#include <limits>

namespace abut::detail {
namespace {

constexpr const char* parts_end = "is truncated";

/// Takes the first items off a span. False if there are fewer.
template <class T>
bool take(std::span<T>& rest, std::size_t count, std::span<T>& taken) {
    if (count > rest.size()) return false;
    taken = rest.first(count);
    rest = rest.subspan(count);
    return true;
}

}  // namespace

void SolidHulls<2>::save(BlobWriter& writer) const {
    for (const Hull& hull : hulls_) writer.number(hull.points);
    writer.number(static_cast<std::uint64_t>(points_.size()));
    writer.array(std::span(points_));
}

const char* SolidHulls<2>::load(BlobReader& reader, std::size_t count) {
    std::vector<std::uint32_t> corners;
    std::uint64_t points = 0;
    if (!reader.array(corners, count) || !reader.number(points) || !reader.array(points_, points)) return parts_end;
    std::span<const Vec2> rest = points_, loop;
    for (const std::uint32_t number : corners) {
        if (number < 2 || !take(rest, number, loop)) return "has a part without corners";
        if (const char* fault = fault_of_outline(loop)) return fault;
        const auto first = static_cast<std::uint32_t>(loop.data() - points_.data());
        hulls_.push_back({first, number, static_cast<std::uint32_t>(sides_.size())});
        if (number == 2 || number > max_soa_edges) continue;
        sides_.resize(sides_.size() + soa_size(number));
        write_polygon_soa(loop, sides_.data() + hulls_.back().first_number);
    }
    return rest.empty() ? nullptr : "has corners of no part";
}

void SolidHulls<3>::save(BlobWriter& writer) const {
    for (std::size_t i = 0; i < hulls_.size(); ++i) {
        const Hull& from = hulls_[i];
        const Hull to = i + 1 < hulls_.size() ? hulls_[i + 1] : end();
        for (const std::size_t number :
             {to.point - from.point, to.face - from.face, to.loop - from.loop, to.edge - from.edge})
            writer.number(static_cast<std::uint32_t>(number));
    }
    for (const std::size_t sum : {points_.size(), normals_.size(), loops_.size(), edges_.size()})
        writer.number(static_cast<std::uint64_t>(sum));
    writer.array(std::span(points_));
    writer.array(std::span(normals_));
    writer.array(std::span(offsets_));
    writer.array(std::span(loop_ends_));
    writer.array(std::span(loops_));
    writer.array(std::span(edges_));
}

const char* SolidHulls<3>::load(BlobReader& reader, std::size_t count) {
    std::vector<glm::vec<4, std::uint32_t>> sizes;
    std::uint64_t points = 0, faces = 0, loops = 0, edges = 0;
    bool whole = reader.array(sizes, count);
    for (std::uint64_t* sum : {&points, &faces, &loops, &edges}) whole = whole && reader.number(*sum);
    whole = whole && reader.array(points_, points) && reader.array(normals_, faces) && reader.array(offsets_, faces) &&
            reader.array(loop_ends_, faces) && reader.array(loops_, loops) && reader.array(edges_, edges);
    if (!whole) return parts_end;
    std::span<const Vec3> points_left = points_, normals_left = normals_, corners;
    std::span<const double> offsets_left = offsets_;
    std::span<const std::uint32_t> ends_left = loop_ends_, loops_left = loops_;
    std::span<const FacetEdge> edges_left = edges_;
    std::size_t columns = 0;
    for (const auto& size : sizes) {
        hulls_.push_back({points_.size() - points_left.size(), columns, normals_.size() - normals_left.size(),
                          loops_.size() - loops_left.size(), edges_.size() - edges_left.size()});
        Facets facets;
        if (size[0] < 3 || !take(points_left, size[0], corners) || !take(normals_left, size[1], facets.normals) ||
            !take(offsets_left, size[1], facets.offsets) || !take(ends_left, size[1], facets.loop_ends) ||
            !take(loops_left, size[2], facets.loops) || !take(edges_left, size[3], facets.edges))
            return "has a part without corners";
        if (const char* fault = fault_of_hull(corners, facets)) return fault;
        columns += 3 * padded_count(corners.size());
    }
    if (!points_left.empty() || !normals_left.empty() || !loops_left.empty() || !edges_left.empty())
        return "has corners of no part";
    columns_.resize(columns);
    return nullptr;
}

template <int D>
void SolidParts<D>::save(BlobWriter& writer) const {
    writer.number(static_cast<std::uint64_t>(size()));
    for (const Place& place : places_)
        for (int axis = 0; axis < D; ++axis) writer.number(place.origin[axis]);
    for (const Place& place : places_) writer.number(place.number);
    hulls_.save(writer);
    write(writer, BvhAccess::tree(tree_).topology());
}

template <int D>
const char* SolidParts<D>::load(BlobReader& reader) {
    constexpr double largest_float = static_cast<double>(std::numeric_limits<float>::max());
    std::uint64_t count = 0;
    std::vector<DVec<D>> origins;
    std::vector<std::uint32_t> numbers;
    if (!reader.number(count) || !reader.array(origins, count) || !reader.array(numbers, count)) return parts_end;
    for (std::size_t i = 0; i < origins.size(); ++i) {
        if (!(largest(origins[i]) <= largest_float)) return "has a part that is not finite";
        if (i > 0 && numbers[i] <= numbers[i - 1]) return "has parts out of order";
        places_.push_back({origins[i], numbers[i]});
    }
    if (const char* fault = hulls_.load(reader, places_.size())) return fault;
    BvhTopology topology;
    if (!read(reader, topology)) return parts_end;
    hulls_.finish();
    const std::vector<Aabb<D>> all = boxes();
    // Coordinates may be finite and their sums not.
    for (const Aabb<D>& box : all)
        for (int axis = 0; axis < D; ++axis)
            if (!(box.min[axis] <= box.max[axis])) return "has a part that is not finite";
    if (!BvhAccess::tree(tree_).build(all, topology)) return "has a tree that doesn't match its parts";
    return nullptr;
}

template void SolidParts<2>::save(BlobWriter&) const;
template void SolidParts<3>::save(BlobWriter&) const;
template const char* SolidParts<2>::load(BlobReader&);
template const char* SolidParts<3>::load(BlobReader&);

}  // namespace abut::detail
