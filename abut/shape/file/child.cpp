#include <abut/math/detail/no_index.hpp>
#include <abut/math/dvec.hpp>
#include <abut/shape/detail/removed_child.hpp>
#include <abut/shape/file.hpp>
#include <abut/shape/file/blob.hpp>
#include <abut/shape/file/child.hpp>
#include <abut/shape/file/hull.hpp>

#include <algorithm>
#include <cmath>

namespace abut::detail {
namespace {

enum class ChildKind : std::uint8_t { points, box, discs, polytope, composite, removed };

constexpr std::uint8_t similar_flag = 1, one_sided_child_flag = 2, solid_child_flag = 4, all_child_flags = 7;

template <int D>
using SavedPolytope = std::conditional_t<D == 2, Polygon, Polyhedron>;

/// A convex child: a core by itself, or a polytope, with its placement.
template <int D>
struct LoadedConvex {
    Convex<D> core;
    std::optional<SavedPolytope<D>> polytope;
};
template <int D>
Convex<D> convex(const LoadedConvex<D>& child) {
    if (!child.polytope) return child.core;
    Convex<D> result = convex(*child.polytope);
    static_cast<Placement<D>&>(result) = child.core;
    return result;
}

/// A composite child.
template <class S, int D>
struct LoadedComposite {
    S shape;
    Placement<D> placement;
    bool solid = false;
};
template <class S, int D>
Composite<D> view(const LoadedComposite<S, D>& child) {
    using abut::view;
    Composite<D> result = view(child.shape);
    static_cast<Placement<D>&>(result) = child.placement;
    if constexpr (std::is_same_v<S, Mesh>)
        if (child.solid) result.solid = &mesh_surface(child.shape);
    return result;
}

/// The object whose copies share its data, as far as a pointer shows it.
template <int D>
const void* data_of(const Composite<D>& child) {
    if constexpr (D == 3) {
        if (child.kind == CompositeKind::mesh) return &mesh_surface(*static_cast<const Mesh*>(child.object));
        if (child.kind == CompositeKind::height_field)
            return static_cast<const HeightField*>(child.object)->heights().data();
        if (child.kind == CompositeKind::voxel_map) return static_cast<const VoxelMap*>(child.object)->bits().data();
    } else {
        if (child.kind == CompositeKind::chain) return static_cast<const Chain*>(child.object)->points().data();
        if (child.kind == CompositeKind::tile_map) return static_cast<const TileMap*>(child.object)->tiles().data();
    }
    if (child.kind == CompositeKind::compound) return &static_cast<const Compound<D>*>(child.object)->child(0);
    return child.object;
}

/// The file of a composite shape; empty if no file can hold it.
template <int D>
std::vector<std::byte> saved_composite(const Composite<D>& child) {
    if constexpr (D == 3) {
        if (child.kind == CompositeKind::mesh) return save(*static_cast<const Mesh*>(child.object));
        if (child.kind == CompositeKind::height_field) return save(*static_cast<const HeightField*>(child.object));
        if (child.kind == CompositeKind::voxel_map) return save(*static_cast<const VoxelMap*>(child.object));
    } else {
        if (child.kind == CompositeKind::chain) return save(*static_cast<const Chain*>(child.object));
        if (child.kind == CompositeKind::tile_map) return save(*static_cast<const TileMap*>(child.object));
    }
    if (child.kind == CompositeKind::solid_bsp) return save(*static_cast<const SolidBsp<D>*>(child.object));
    if (child.kind == CompositeKind::compound) {
        const Result<std::vector<std::byte>> saved = save(*static_cast<const Compound<D>*>(child.object));
        if (saved) return *saved;
    }
    return {};
}

/// The file of a polytope; empty if the points are not those of one.
std::vector<std::byte> saved_polytope(const Convex<2>& child) {
    const std::span<const Vec2> corners(child.points, child.count);
    const bool has_sides = child.count >= 3 && child.sides != nullptr;
    if (fault_of_outline(corners) != nullptr || (child.sides != nullptr) != has_sides) return {};
    return saved_polygon(corners);
}
std::vector<std::byte> saved_polytope(const Convex<3>& child) {
    Hull3 hull;
    hull.points.assign(child.points, child.points + child.count);
    const auto copy = [](auto& to, const auto& from) { to.assign(from.begin(), from.end()); };
    if (child.facets != nullptr) {
        copy(hull.normals, child.facets->normals);
        copy(hull.offsets, child.facets->offsets);
        copy(hull.loops, child.facets->loops);
        copy(hull.loop_ends, child.facets->loop_ends);
        copy(hull.edges, child.facets->edges);
    }
    const Facets facets{hull.normals, hull.loops, hull.loop_ends, hull.edges, hull.offsets};
    if (fault_of_hull(hull.points, facets) != nullptr) return {};
    hull.rank = rank_of_hull(hull.points.size(), hull.normals.size());
    return saved_polyhedron(hull);
}

/// The numbers of a core that needs no file; the core may be const.
template <int D, class Core, class Visit>
void each_core_number(Core& core, ChildKind kind, Visit visit) {
    const std::uint32_t points = kind == ChildKind::points ? core.count : kind == ChildKind::discs ? 2u : 1u;
    for (std::uint32_t i = 0; i < points; ++i)
        for (int axis = 0; axis < D; ++axis) visit(core.own[i][axis]);
    if (kind == ChildKind::discs)
        for (auto& radius : core.disc_radius) visit(radius);
}

template <class Placement, class Visit>
void each_placement_number(Placement& placement, Visit visit) {
    for (auto& column : placement.place.column)
        for (int axis = 0; axis < column.length(); ++axis) visit(column[axis]);
    for (int axis = 0; axis < placement.place.offset.length(); ++axis) visit(placement.place.offset[axis]);
    visit(placement.scale);
    visit(placement.inner_radius);
    visit(placement.radius);
}

/// Lengths change by at most this factor, in either direction, or to zero, so that boxes stay in the range of floats.
constexpr double max_factor = 1e12;

/// Whether the numbers are in range, and a placement that is called similar keeps angles.
template <int D>
bool is_placement(const Placement<D>& placement) {
    constexpr double farthest = 1e18;
    bool result = placement.scale >= 0 && placement.inner_radius >= 0 && placement.radius >= 0;
    each_placement_number(placement, [&](double number) { result = result && std::abs(number) <= farthest; });
    for (const DVec<D>& column : placement.place.column) result = result && largest(column) <= max_factor;
    const double det = determinant(placement.place);
    if (det != 0)
        for (const DVec<D>& column : inverse(placement.place, det).column)
            result = result && largest(column) <= max_factor;
    if (!result || !placement.similar) return result;
    const double square = placement.scale * placement.scale;
    for (std::size_t i = 0; i < static_cast<std::size_t>(D); ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            const double product = dot(placement.place.column[i], placement.place.column[j]);
            if (!(std::abs(product - (i == j ? square : 0)) <= 1e-3 * square)) return false;
        }
    return true;
}

template <class S>
std::optional<Problem> add_loaded(Result<S> loaded, auto& shapes) {
    if (!loaded) return loaded.problem();
    shapes.push_back(*std::move(loaded));
    return std::nullopt;
}

}  // namespace

template <int D>
bool ChildWriter<D>::add(const View<D>& child) {
    const auto* convex = std::get_if<Convex<D>>(&child);
    const auto* composite = std::get_if<Composite<D>>(&child);
    const bool added = convex != nullptr ? add(*convex) : composite != nullptr && add(*composite);
    count_ += added ? 1 : 0;
    return added;
}

template <int D>
void ChildWriter<D>::write(BlobWriter& writer) const {
    std::size_t size = writer_.bytes.size() + 2 * sizeof(std::uint64_t);
    for (const std::vector<std::byte>& file : files_) size += sizeof(std::uint64_t) + file.size();
    writer.bytes.reserve(writer.bytes.size() + size);
    writer.number(static_cast<std::uint64_t>(files_.size()));
    for (const std::vector<std::byte>& file : files_) {
        writer.number(static_cast<std::uint64_t>(file.size()));
        writer.array(std::span(file));
    }
    writer.number(count_);
    writer.array(std::span(writer_.bytes));
}

template <int D>
void ChildWriter<D>::add(const Placement<D>& placement) {
    each_placement_number(placement, [&](double number) { writer_.number(number); });
}

template <int D>
template <class Save>
std::optional<std::uint32_t> ChildWriter<D>::number_of(const void* object, Save save) {
    const auto known = numbers_.find(object);
    if (known != numbers_.end()) return known->second;
    std::vector<std::byte> file = save();
    if (file.empty()) return std::nullopt;
    const auto same = std::find(files_.begin(), files_.end(), file);
    const auto number = static_cast<std::uint32_t>(same - files_.begin());
    if (same == files_.end()) files_.push_back(std::move(file));
    numbers_.emplace(object, number);
    return number;
}

template <int D>
bool ChildWriter<D>::add(const Convex<D>& child) {
    ChildKind kind = ChildKind::points;
    if (child.core == Core::function || !is_placement<D>(child)) return false;
    if (child.core == Core::box) kind = ChildKind::box;
    if (child.core == Core::discs) kind = ChildKind::discs;
    if (child.core == Core::points && child.points != nullptr) kind = ChildKind::polytope;
    std::optional<std::uint32_t> file = no_index;
    if (kind == ChildKind::polytope) file = number_of(child.points, [&] { return saved_polytope(child); });
    if (!file) return false;
    writer_.number(kind);
    writer_.number(
        static_cast<std::uint8_t>((child.similar ? similar_flag : 0) | (child.one_sided ? one_sided_child_flag : 0)));
    writer_.number(kind == ChildKind::polytope ? *file : child.count);
    add(static_cast<const Placement<D>&>(child));
    if (kind != ChildKind::polytope) each_core_number<D>(child, kind, [&](float number) { writer_.number(number); });
    return true;
}

template <int D>
bool ChildWriter<D>::add(const Composite<D>& child) {
    if (!is_placement<D>(child)) return false;
    const bool is_removed = child.kind == CompositeKind::removed_child;
    std::optional<std::uint32_t> file = 0;
    if (!is_removed) file = number_of(data_of(child), [&] { return saved_composite(child); });
    if (!file) return false;
    writer_.number(is_removed ? ChildKind::removed : ChildKind::composite);
    writer_.number(static_cast<std::uint8_t>((child.similar ? similar_flag : 0) |
                                             (child.solid != nullptr ? solid_child_flag : 0)));
    writer_.number(*file);
    add(static_cast<const Placement<D>&>(child));
    return true;
}

template <int D>
Result<std::vector<AnyShape<D>>> ChildReader<D>::read(BlobReader& reader, int nesting, std::string_view name) {
    std::uint64_t files = 0, size = 0, count = 0;
    if (!reader.number(files)) return bad_file_of(name, "is truncated");
    for (std::uint64_t i = 0; i < files; ++i) {
        std::span<const std::byte> file;
        if (!reader.number(size) || !reader.bytes(file, size)) return bad_file_of(name, "is truncated");
        if (std::optional<Problem> wrong = add_file(file, nesting)) return *std::move(wrong);
    }
    if (!reader.number(count)) return bad_file_of(name, "is truncated");
    std::vector<AnyShape<D>> children;
    for (std::uint64_t i = 0; i < count; ++i) {
        std::optional<AnyShape<D>> next = child(reader);
        if (!next) return bad_file_of(name, "is truncated, or has a child that contradicts itself", children.size());
        children.push_back(*std::move(next));
    }
    // The children refer to the files one after the other, each when it is new.
    if (used_ != shapes_.size()) return bad_file_of(name, "has files in another order than its children");
    return children;
}

template <int D>
std::optional<Problem> ChildReader<D>::add_file(std::span<const std::byte> file, int nesting) {
    switch (kind_of_shape(file)) {
        case SavedKind::polygon:
            if constexpr (D == 2) return add_loaded(load_polygon(file), shapes_);
            break;
        case SavedKind::chain:
            if constexpr (D == 2) return add_loaded(load_chain(file), shapes_);
            break;
        case SavedKind::tile_map:
            if constexpr (D == 2) return add_loaded(load_tile_map(file), shapes_);
            break;
        case SavedKind::polyhedron:
            if constexpr (D == 3) return add_loaded(load_polyhedron(file), shapes_);
            break;
        case SavedKind::mesh:
            if constexpr (D == 3) return add_loaded(load_mesh(file), shapes_);
            break;
        case SavedKind::height_field:
            if constexpr (D == 3) return add_loaded(load_height_field(file), shapes_);
            break;
        case SavedKind::voxel_map:
            if constexpr (D == 3) return add_loaded(load_voxel_map(file), shapes_);
            break;
        case SavedKind::compound_2d:
        case SavedKind::compound_3d:
            return add_loaded(load_nested<D>(file, nesting + 1), shapes_);
        case SavedKind::solid_bsp_2d:
        case SavedKind::solid_bsp_3d:
            return add_loaded(load_solid_bsp<D>(file), shapes_);
    }
    return Problem{ProblemCode::bad_format, "the file of a compound has a child of no kind that it can have"};
}

template <int D>
std::optional<AnyShape<D>> ChildReader<D>::child(BlobReader& reader) {
    std::uint8_t kind_number = 0, flags = 0;
    std::uint32_t number = 0;
    Placement<D> placement;
    bool whole = reader.number(kind_number) && reader.number(flags) && reader.number(number);
    each_placement_number(placement, [&](double& value) { whole = whole && reader.number(value); });
    const auto kind = static_cast<ChildKind>(kind_number);
    placement.similar = (flags & similar_flag) != 0;
    const bool one_sided = (flags & one_sided_child_flag) != 0, solid = (flags & solid_child_flag) != 0;
    if (!whole || kind > ChildKind::removed || flags > all_child_flags || !is_placement<D>(placement))
        return std::nullopt;
    if (kind == ChildKind::removed) {
        if (number != 0 || one_sided || solid) return std::nullopt;
        return AnyShape<D>(LoadedComposite<RemovedChild<D>, D>{{}, placement, false});
    }
    if (kind == ChildKind::polytope || kind == ChildKind::composite) {
        // Files are numbered in the order in which children refer to them.
        if (number >= shapes_.size() || number > used_) return std::nullopt;
        used_ = std::max<std::size_t>(used_, number + std::size_t{1});
        return std::visit(
            [&]<class S>(const S& shape) -> std::optional<AnyShape<D>> {
                if constexpr (std::is_same_v<S, SavedPolytope<D>>) {
                    if (kind != ChildKind::polytope || solid || one_sided) return std::nullopt;
                    LoadedConvex<D> loaded{{}, shape};
                    static_cast<Placement<D>&>(loaded.core) = placement;
                    loaded.core.disc_radius = {};
                    return AnyShape<D>(loaded);
                } else {
                    if (kind != ChildKind::composite || one_sided) return std::nullopt;
                    bool is_closed = false;
                    if constexpr (std::is_same_v<S, Mesh>) is_closed = shape.closed();
                    if (solid && !is_closed) return std::nullopt;
                    return AnyShape<D>(LoadedComposite<S, D>{shape, placement, solid});
                }
            },
            shapes_[number]);
    }
    LoadedConvex<D> loaded;
    loaded.core.disc_radius = {};
    static_cast<Placement<D>&>(loaded.core) = placement;
    loaded.core.one_sided = one_sided;
    if (number == 0 || number > 3 || (kind != ChildKind::points && number != 1) || solid) return std::nullopt;
    if (one_sided && (kind != ChildKind::points || number != D)) return std::nullopt;
    if (D == 2 && kind == ChildKind::discs) return std::nullopt;
    loaded.core.core = kind == ChildKind::points ? Core::points : kind == ChildKind::box ? Core::box : Core::discs;
    loaded.core.count = number;
    bool is_core = true;
    each_core_number<D>(loaded.core, kind, [&](float& value) { is_core = is_core && reader.number(value); });
    is_core = is_core && is_finite<D>(loaded.core);
    for (int axis = 0; axis < D && kind == ChildKind::box; ++axis) is_core = is_core && loaded.core.own[0][axis] >= 0;
    for (const float radius : loaded.core.disc_radius) is_core = is_core && radius >= 0;
    if (!is_core) return std::nullopt;
    return AnyShape<D>(loaded);
}

template class ChildWriter<2>;
template class ChildWriter<3>;
template class ChildReader<2>;
template class ChildReader<3>;

}  // namespace abut::detail
