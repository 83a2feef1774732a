#include <abut/shape/file/blob.hpp>

#include <array>
#include <utility>

namespace abut::detail {
namespace {

using Signature = std::array<char, 8>;

constexpr Signature shape_signature{'a', 'b', 'u', 't', 's', 'h', 'p', '\n'};

/// Several sums, since the checksum of a mesh takes longer than its copy otherwise.
constexpr std::size_t shape_checksum_sums = 8;

struct KindOfFile {
    SavedKind kind;
    std::uint32_t version;
    std::string_view name;
};

constexpr std::array kinds{
    KindOfFile{SavedKind::mesh, 1, "a mesh"},
    KindOfFile{SavedKind::polyhedron, 1, "a polyhedron"},
    KindOfFile{SavedKind::polygon, 1, "a polygon"},
    KindOfFile{SavedKind::height_field, 1, "a height field"},
    KindOfFile{SavedKind::tile_map, 1, "a tile map"},
    KindOfFile{SavedKind::chain, 1, "a chain"},
    KindOfFile{SavedKind::compound_2d, 1, "a 2D compound"},
    KindOfFile{SavedKind::compound_3d, 1, "a 3D compound"},
    KindOfFile{SavedKind::solid_bsp_2d, 1, "a 2D solid level"},
    KindOfFile{SavedKind::solid_bsp_3d, 1, "a 3D solid level"},
    KindOfFile{SavedKind::voxel_map, 1, "a voxel map"},
};

const KindOfFile* kind_of(std::uint32_t number) {
    return number >= 1 && number <= kinds.size() ? &kinds[number - 1] : nullptr;
}
const KindOfFile& kind_of(SavedKind kind) {
    return kinds[static_cast<std::size_t>(kind) - 1];
}

/// Other files of this library.
constexpr std::array<std::pair<Signature, std::string_view>, 4> other_files{{
    {{'a', 'b', 'u', 't', 'f', 'l', 'd', '\n'}, "a field"},
    {{'a', 'b', 'u', 't', 'w', 'l', 'k', '\n'}, "a walk mesh"},
    {{'a', 'b', 'u', 't', 'w', 'l', 'd', '\n'}, "a snapshot of a world"},
    {{'a', 'b', 'u', 't', 'w', 's', 'h', '\n'}, "a world with its shapes"},
}};

Problem bad_file(std::string message) {
    return {ProblemCode::bad_format, std::move(message)};
}
Problem not_a_shape(std::string_view name, const char* why) {
    return bad_file("this is not " + std::string(name) + ": " + why);
}
Problem another_file(std::string_view what, std::string_view name) {
    return bad_file("this is " + std::string(what) + ", not " + std::string(name));
}

}  // namespace

std::string_view name_of(SavedKind kind) {
    return kind_of(kind).name;
}

SavedKind kind_of_shape(std::span<const std::byte> bytes) {
    BlobReader reader(bytes);
    Signature start{};
    bool whole = true;
    for (char& c : start) whole = whole && reader.number(c);
    std::uint32_t number = 0;
    if (!whole || start != shape_signature || !reader.number(number) || kind_of(number) == nullptr) return SavedKind{};
    return static_cast<SavedKind>(number);
}

BlobWriter begin_shape(SavedKind kind, std::size_t size) {
    BlobWriter writer;
    writer.bytes.reserve(size + 64);
    for (const char c : shape_signature) writer.number(c);
    writer.number(kind);
    writer.number(kind_of(kind).version);
    return writer;
}

std::vector<std::byte> end_shape(BlobWriter&& writer) {
    writer.checksum<shape_checksum_sums>();
    return std::move(writer.bytes);
}

std::optional<Problem> open_shape(BlobReader& reader, std::span<const std::byte> bytes, SavedKind kind) {
    const KindOfFile& wanted = kind_of(kind);
    Signature start{};
    for (char& c : start)
        if (!reader.number(c)) return not_a_shape(wanted.name, "its signature is truncated");
    for (const auto& [signature, name] : other_files)
        if (start == signature) return another_file(name, wanted.name);
    if (start != shape_signature) return not_a_shape(wanted.name, "its signature is wrong");
    std::uint32_t number = 0;
    if (!reader.number(number)) return truncated_shape(kind);
    if (number != static_cast<std::uint32_t>(kind)) {
        const KindOfFile* other = kind_of(number);
        if (other == nullptr) return not_a_shape(wanted.name, "its kind is unknown");
        return another_file(other->name, wanted.name);
    }
    if (!reader.number(number)) return truncated_shape(kind);
    if (number != wanted.version)
        return bad_file("a file of " + std::string(wanted.name) + " has version " + std::to_string(number) + ", not " +
                        std::to_string(wanted.version));
    if (reader.left() < sizeof(std::uint64_t)) return truncated_shape(kind);
    if (!reader.checksum<shape_checksum_sums>(bytes)) return bad_shape(kind, "is damaged: its checksum is wrong");
    return std::nullopt;
}

Problem truncated_shape(SavedKind kind) {
    return bad_shape(kind, "is truncated");
}
Problem overlong_shape(SavedKind kind) {
    return bad_shape(kind, "has extra bytes at its end");
}
Problem bad_shape(SavedKind kind, std::string_view what, std::size_t index) {
    return bad_file_of(name_of(kind), what, index);
}
Problem bad_file_of(std::string_view name, std::string_view what, std::size_t index) {
    return {ProblemCode::bad_format, "the file of " + std::string(name) + " " + std::string(what), index};
}

}  // namespace abut::detail
