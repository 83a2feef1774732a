// The file of a world with its shapes: "abutwsh\n", the version, the dimension, the half-spaces, the files of shapes
// with many numbers, the other shapes (as the children of a compound), the snapshot, and a checksum.

#include <abut/math/detail/blob.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/detail/content_hash.hpp>
#include <abut/shape/file/blob.hpp>
#include <abut/shape/file/child.hpp>
#include <abut/world/file.hpp>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>

namespace abut {

using namespace detail;

namespace {

constexpr std::array<char, 8> signature{'a', 'b', 'u', 't', 'w', 's', 'h', '\n'};
constexpr std::uint32_t file_version = 1;
constexpr std::size_t checksum_sums = 8;

Problem truncated() {
    return bad_file_of("a world", "is truncated");
}

template <int D>
void write(BlobWriter& writer, const HalfSpaceView<D>& half_space) {
    for (int axis = 0; axis < D; ++axis) writer.number(half_space.normal[axis]);
    writer.number(half_space.offset);
}

template <int D>
std::optional<HalfSpaceView<D>> read_half_space(BlobReader& reader) {
    HalfSpaceView<D> result;
    bool whole = true;
    for (int axis = 0; axis < D; ++axis) whole = whole && reader.number(result.normal[axis]);
    whole = whole && reader.number(result.offset);
    constexpr double rounding = 1e-9;
    if (!whole || !(std::abs(dot(result.normal, result.normal) - 1) < rounding) || !std::isfinite(result.offset))
        return std::nullopt;
    return result;
}

/// Checks the beginning and the checksum, and moves the reader to what follows.
template <int D>
std::optional<Problem> open(BlobReader& reader, std::span<const std::byte> bytes) {
    for (const char expected : signature) {
        char c = 0;
        if (!reader.number(c) || c != expected)
            return Problem{ProblemCode::bad_format, "this is not the file of a world: its signature is wrong"};
    }
    std::uint32_t version = 0, dimension = 0;
    if (!reader.number(version) || !reader.number(dimension)) return truncated();
    if (version != file_version || dimension != D)
        return bad_file_of("a world", "has version " + std::to_string(version) + " and dimension " +
                                          std::to_string(dimension) + ", not " + std::to_string(file_version) +
                                          " and " + std::to_string(D));
    if (!reader.checksum<checksum_sums>(bytes)) return bad_file_of("a world", "is damaged: its checksum is wrong");
    return std::nullopt;
}

/// Adds the shapes to a world, as items from which a snapshot takes them.
template <int D>
std::optional<Problem> add_shapes(BlobReader& reader, World<D>& world) {
    std::uint64_t half_spaces = 0;
    if (!reader.number(half_spaces)) return truncated();
    for (std::uint64_t i = 0; i < half_spaces; ++i) {
        const std::optional<HalfSpaceView<D>> half_space = read_half_space<D>(reader);
        if (!half_space) return bad_file_of("a world", "is truncated, or has a half-space without a normal");
        world.add(Unowned<D>{View<D>(*half_space)});
    }
    const Result<std::vector<AnyShape<D>>> children = ChildReader<D>().read(reader, 0, "a world");
    if (!children) return children.problem();
    for (const AnyShape<D>& child : *children) world.add(child);
    return std::nullopt;
}

}  // namespace

template <int D>
Result<std::vector<std::byte>> save_with_shapes(World<D>& world) {
    enter_library();
    BlobWriter half_spaces;
    ChildWriter<D> children;
    std::uint64_t half_space_count = 0;
    std::unordered_set<std::uint64_t> saved;
    std::optional<Problem> problem;
    world.each_item([&](Id id) {
        const AnyShape<D> shape = world.any_shape(id);
        const View<D> view = shape.view();
        if (!saved.insert(content_hash(view)).second) return true;
        if (const auto* half_space = std::get_if<HalfSpaceView<D>>(&view)) {
            write(half_spaces, *half_space);
            ++half_space_count;
            return true;
        }
        if (children.add(view)) return true;
        problem = {ProblemCode::bad_argument,
                   "item " + std::to_string(id.index) + " has a shape of a kind that can't be saved", id.index};
        return false;
    });
    if (problem) return *std::move(problem);

    BlobWriter writer;
    for (const char c : signature) writer.number(c);
    writer.number(file_version);
    writer.number(static_cast<std::uint32_t>(D));
    writer.number(half_space_count);
    writer.array(std::span<const std::byte>(half_spaces.bytes));
    children.write(writer);
    const std::vector<std::byte> snapshot = world.save();
    writer.number(static_cast<std::uint64_t>(snapshot.size()));
    writer.array(std::span(snapshot));
    writer.checksum<checksum_sums>();
    return std::move(writer.bytes);
}

template <int D>
Result<World<D>> load_world(std::span<const std::byte> bytes, const WorldOptions& options) {
    enter_library();
    BlobReader reader(bytes);
    if (std::optional<Problem> problem = open<D>(reader, bytes)) return *std::move(problem);
    World<D> world(options);
    if (std::optional<Problem> problem = add_shapes(reader, world)) return *std::move(problem);
    std::uint64_t size = 0;
    std::span<const std::byte> snapshot;
    if (!reader.number(size) || !reader.bytes(snapshot, size)) return truncated();
    if (reader.left() != 0) return bad_file_of("a world", "has extra bytes at its end");
    if (std::optional<Problem> problem = world.restore(snapshot)) return *std::move(problem);
    return world;
}

template Result<std::vector<std::byte>> save_with_shapes(World<2>&);
template Result<std::vector<std::byte>> save_with_shapes(World<3>&);
template Result<World<2>> load_world(std::span<const std::byte>, const WorldOptions&);
template Result<World<3>> load_world(std::span<const std::byte>, const WorldOptions&);

}  // namespace abut
