// The data of a compound: the number of files, each file with its size before it, the number of children, the children,
// and the topology of the tree of their boxes. Polytopes and composite shapes that children share have one file. A
// child is its kind, the number of its file, its placement, and the numbers of a core that needs no file. A removed
// child has a kind of its own.

#include <abut/broad_phase/bvh/topology.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/detail/compound_data.hpp>
#include <abut/shape/file.hpp>
#include <abut/shape/file/blob.hpp>
#include <abut/shape/file/child.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace abut {

using namespace detail;

namespace {

template <int D>
constexpr SavedKind compound_kind = D == 2 ? SavedKind::compound_2d : SavedKind::compound_3d;

constexpr int max_nesting = 16;
constexpr std::uint64_t max_children = std::uint64_t{1} << 20;

Problem too_many_children() {
    return {ProblemCode::too_large, "compounds are nested more than 16 deep, or have more than 2^20 children in all"};
}

/// The number of children, where a compound counts as its own children. Zero if compounds are nested too deep.
template <int D>
std::uint64_t count_children(const Compound<D>& compound, int nesting) {
    if (nesting > max_nesting) return 0;
    std::uint64_t result = 0;
    for (std::uint32_t i = 0; i < compound.size() && result <= max_children; ++i) {
        const auto* composite = std::get_if<Composite<D>>(&compound.child(i));
        const bool nested = composite != nullptr && composite->kind == CompositeKind::compound;
        const std::uint64_t count =
            nested ? count_children(*static_cast<const Compound<D>*>(composite->object), nesting + 1) : 1;
        if (count == 0) return 0;
        result += count;
    }
    return result;
}
template <int D>
bool has_too_many_children(const Compound<D>& compound) {
    const std::uint64_t count = count_children(compound, 1);
    return count == 0 || count > max_children;
}

}  // namespace

template <int D>
Result<std::vector<std::byte>> save(const Compound<D>& compound) {
    enter_library();
    if (has_too_many_children(compound)) return too_many_children();
    ChildWriter<D> children;
    for (std::uint32_t i = 0; i < compound.size(); ++i)
        if (!children.add(compound.child(i)))
            return Problem{ProblemCode::bad_argument,
                           "child " + std::to_string(i) + " is a shape of a kind that can't be saved", i};
    BlobWriter writer = begin_shape(compound_kind<D>, 0);
    children.write(writer);
    write(writer, BvhAccess::tree(compound.data_->tree).topology());
    return end_shape(std::move(writer));
}

template <int D>
Result<Compound<D>> detail::load_nested(std::span<const std::byte> bytes, int nesting) {
    constexpr SavedKind kind = compound_kind<D>;
    BlobReader reader(bytes);
    if (std::optional<Problem> wrong = open_shape(reader, bytes, kind)) return *std::move(wrong);
    if (nesting > max_nesting) return too_many_children();
    const Result<std::vector<AnyShape<D>>> children = ChildReader<D>().read(reader, nesting, name_of(kind));
    if (!children) return children.problem();
    BvhTopology topology;
    if (!read(reader, topology)) return truncated_shape(kind);
    if (reader.left() != 0) return overlong_shape(kind);
    auto data = std::make_shared<typename Compound<D>::Data>();
    std::vector<Aabb<D>> boxes;
    if (std::optional<Problem> problem = data->set(*children, boxes)) return *std::move(problem);
    if (!BvhAccess::tree(data->tree).build(boxes, topology))
        return bad_shape(kind, "has a tree that doesn't match its children");
    Compound<D> result(std::move(data));
    if (has_too_many_children(result)) return too_many_children();
    return result;
}

template <int D>
Result<Compound<D>> load_compound(std::span<const std::byte> bytes) {
    enter_library();
    return load_nested<D>(bytes, 1);
}

template Result<std::vector<std::byte>> save(const Compound<2>&);
template Result<std::vector<std::byte>> save(const Compound<3>&);
template Result<Compound<2>> load_compound<2>(std::span<const std::byte>);
template Result<Compound<3>> load_compound<3>(std::span<const std::byte>);

}  // namespace abut
