#pragma once

// Height field: terrain as heights over a regular grid.

#include <abut/math/result.hpp>
#include <abut/shape/detail/changed_box.hpp>
#include <abut/shape/triangle.hpp>
#include <abut/shape/view/view.hpp>

#include <memory>
#include <optional>
#include <span>

namespace abut {

struct HeightFieldOptions {
    /// Indices of cells without triangles: column + row * (columns - 1).
    std::span<const std::uint32_t> holes{};
};

/// The union of the triangles over the cells of a grid, of zero thickness. Height (i, j), the i-th of row j, lies over
/// the point (i * cell.x, j * cell.y). Heights are along z; `at` rotates them to any other up axis. Each cell has two
/// triangles, counter-clockwise seen from above, divided by the diagonal from (i, j) to (i + 1, j + 1). Part 2 * cell
/// is the triangle beside the x axis, part 2 * cell + 1 the other. Copies share the data until one of them changes.
/// Memory: the heights, and about 0.6 bytes a cell.
class HeightField {
public:
    /// `columns` is the number of heights in a row; `cell` is their spacing along x and y. Returns a Problem if there
    /// are fewer than two rows or columns, if the last row is incomplete, if a height isn't finite (index: the height),
    /// if `cell` isn't positive or makes a coordinate infinite, or if a hole is out of range (index: the hole).
    static Result<HeightField> build(std::span<const float> heights, std::uint32_t columns, const Vec2& cell,
                                     const HeightFieldOptions& options = {});
    static Result<HeightField> build(std::span<const float> heights, std::uint32_t columns, float cell,
                                     const HeightFieldOptions& options = {});

    /// Replaces a block of heights, `block_columns` wide, whose first one is at (column, row). All answers are those of
    /// a field that is built with them. The time is linear in the block's size, and that of a copy if another field
    /// shares the data. Returns a Problem if the block's last row is incomplete, if it reaches beyond the field, or if
    /// a height isn't finite (index: in the block); the field is then unchanged. In a World: World::edit_shape.
    std::optional<Problem> set(std::uint32_t column, std::uint32_t row, std::uint32_t block_columns,
                               std::span<const float> heights);
    /// Removes the triangles of a cell, or adds them again.
    void set_hole(std::uint32_t cell, bool hole);

    std::span<const float> heights() const;
    std::uint32_t columns() const;  ///< number of heights in a row
    std::uint32_t rows() const;
    Vec2 cell() const;

    std::uint32_t size() const;  ///< number of triangles, including those of holes
    Triangle3 triangle(std::uint32_t index) const;
    bool is_hole(std::uint32_t cell) const;

    /// The adjacent triangle across edge i, from corner i to the next; no_neighbour at the boundary and beside a hole.
    std::uint32_t neighbour(std::uint32_t triangle, std::uint32_t edge) const;

private:
    struct Data;
    explicit HeightField(std::shared_ptr<Data> data) : data_(std::move(data)) {}
    Data& own_data();
    void update_cells(const glm::uvec2& first, const glm::uvec2& end);

    friend Aabb3 bounds(const HeightField& field);
    friend Aabb3 take_changed(HeightField& field);
    friend void each_part(const HeightField& field, const Aabb3& box,
                          FunctionRef<bool(const Triangle3& part, std::uint32_t index)> visit);
    friend void each_part_along(const HeightField& field, const MovingBox<3>& box,
                                FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit);
    friend void each_part_near(const HeightField& field, const Aabb3& box,
                               FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit);

    std::shared_ptr<Data> data_;  // of this field alone before it changes
    detail::ChangedBox<3> changed_;
};

/// The bounding box; empty if all cells are holes.
Aabb3 bounds(const HeightField& field);

/// The box outside of which no answer has changed since the last call, for World::edit_shape.
Aabb3 take_changed(HeightField& field);

/// Visits the triangles whose boxes overlap `box`; the visitor returns false to stop.
void each_part(const HeightField& field, const Aabb3& box,
               FunctionRef<bool(const Triangle3& part, std::uint32_t index)> visit);

/// Visits the triangles whose boxes the moving box overlaps, roughly front to back. The visitor returns the new,
/// shorter reach.
void each_part_along(const HeightField& field, const MovingBox<3>& box,
                     FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit);

/// Visits the triangles, roughly nearest first by the distance of their boxes to `box`. The visitor returns the new,
/// shorter reach.
void each_part_near(const HeightField& field, const Aabb3& box,
                    FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit);

inline std::uint32_t part_neighbour(const HeightField& field, std::uint32_t part, std::uint32_t side) {
    return field.neighbour(part, side);
}

namespace detail {

template <>
inline constexpr CompositeKind composite_kind<HeightField> = CompositeKind::height_field;

}  // namespace detail

}  // namespace abut
