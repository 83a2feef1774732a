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

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
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

    std::span<const std::vector<std::byte>> files() const { return files_; }
    std::span<const std::byte> bytes() const { return writer_.bytes; }

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
};

template <int D>
using SavedShape = std::conditional_t<D == 2, std::variant<Polygon, Chain, TileMap, Compound<2>, SolidBsp<2>>,
                                      std::variant<Polyhedron, Mesh, HeightField, Compound<3>, SolidBsp<3>>>;

/// Reads what a ChildWriter has written.
template <int D>
class ChildReader {
public:
    std::optional<Problem> add_file(std::span<const std::byte> file, int nesting);
    std::optional<AnyShape<D>> child(BlobReader& reader);
    /// Whether the children refer to the files one after the other, each when it is new.
    bool are_all_used() const { return used_ == shapes_.size(); }

private:
    std::vector<SavedShape<D>> shapes_;
    std::size_t used_ = 0;
};

}  // namespace abut::detail
