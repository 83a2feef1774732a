// The data of a polygon: the number of its corners, and the corners.

#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/file.hpp>
#include <abut/shape/file/blob.hpp>
#include <abut/shape/file/hull.hpp>

#include <optional>
#include <utility>

namespace abut {

using namespace detail;

std::vector<std::byte> detail::saved_polygon(std::span<const Vec2> corners) {
    BlobWriter writer = begin_shape(SavedKind::polygon, corners.size_bytes());
    writer.number(static_cast<std::uint64_t>(corners.size()));
    writer.array(corners);
    return end_shape(std::move(writer));
}

std::vector<std::byte> save(const Polygon& polygon) {
    return saved_polygon(polygon.points());
}

Result<Polygon> load_polygon(std::span<const std::byte> bytes) {
    enter_library();
    constexpr SavedKind kind = SavedKind::polygon;
    std::uint64_t count = 0;
    Polygon result;
    const auto read = [&](BlobReader& reader) { return reader.number(count) && reader.array(result.points_, count); };
    if (std::optional<Problem> wrong = read_shape(bytes, kind, read)) return *std::move(wrong);
    if (const char* fault = fault_of_outline(result.points_)) return bad_shape(kind, fault);
    result.write_sides();
    return result;
}

}  // namespace abut
