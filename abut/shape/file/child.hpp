#pragma once

// The children of a compound in its file. For .cpp files.

#include <abut/math/detail/blob.hpp>
#include <abut/math/result.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/height_field.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/solid_bsp.hpp>
#include <abut/shape/tile_map.hpp>
#include <abut/shape/voxel_map.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace abut::detail {

/// As load_compound, inside of so many compounds, counting its own.
template <int D>
Result<Compound<D>> load_nested(std::span<const std::byte> bytes, int nesting);

/// Writes children, and the files of the shapes that they refer to.
template <int D>
class ChildWriter {
public:
    /// Returns false if no file can hold it.
    bool add(const View<D>& child);
    /// Appends the files, each with its size, and the children.
    void write(BlobWriter& writer) const;

private:
    bool add(const Convex<D>& child);
    bool add(const Composite<D>& child);
    void add(const Placement<D>& placement);
    /// The number of a file, which is made if there is none of the same object or with the same bytes.
    template <class Save>
    std::optional<std::uint32_t> number_of(const void* object, Save save);

    std::vector<std::vector<std::byte>> files_;
    std::map<const void*, std::uint32_t> numbers_;
    BlobWriter writer_;
    std::uint64_t count_ = 0;
};

template <int D>
using SavedShape = std::conditional_t<D == 2, std::variant<Polygon, Chain, TileMap, Compound<2>, SolidBsp<2>>,
                                      std::variant<Polyhedron, Mesh, HeightField, VoxelMap, Compound<3>, SolidBsp<3>>>;

/// Reads what a ChildWriter has written.
template <int D>
class ChildReader {
public:
    /// The children of a file of what has this name, inside of so many compounds, counting its own.
    Result<std::vector<AnyShape<D>>> read(BlobReader& reader, int nesting, std::string_view name);

private:
    std::optional<Problem> add_file(std::span<const std::byte> file, int nesting);
    std::optional<AnyShape<D>> child(BlobReader& reader);

    std::vector<SavedShape<D>> shapes_;
    std::size_t used_ = 0;
};

}  // namespace abut::detail
