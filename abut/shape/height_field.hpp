#pragma once

// Ground as heights over a grid: level geometry in 3D that needs no indices and no tree.

#include <abut/math/result.hpp>
#include <abut/shape/triangle.hpp>
#include <abut/shape/view.hpp>

#include <memory>
#include <span>

namespace abut {

struct HeightFieldOptions {
    /// Cells without ground, by their numbers: column + row * (columns - 1), counted from the first corner.
    std::span<const std::uint32_t> holes{};
};

/// The union of the triangles over the cells of a grid, of zero thickness. Height (i, j), the i-th of row j, is over
/// the point (i * cell.x, j * cell.y): heights go along z, and `at` turns that to where it is wanted. Each cell is two
/// triangles, counter-clockwise seen from above, cut from its lowest corner (i, j) to (i + 1, j + 1): part 2 * cell is
/// the one beside the x axis, 2 * cell + 1 the other. Immutable: copies share the data. Memory: the heights, and about
/// 0.6 bytes a cell.
class HeightField {
public:
    /// `columns` heights a row; `cell` is how far apart they are, above zero and not the same along x and y unless you
    /// want it. A Problem where there are fewer than two rows or columns, the last row isn't whole, a height isn't
    /// finite (its index is the height's), `cell` isn't above zero or makes a coordinate infinite, or a hole is no cell
    /// (its index is the hole's).
    static Result<HeightField> build(std::span<const float> heights, std::uint32_t columns, const Vec2& cell,
                                     const HeightFieldOptions& options = {});
    static Result<HeightField> build(std::span<const float> heights, std::uint32_t columns, float cell,
                                     const HeightFieldOptions& options = {});

    std::span<const float> heights() const;
    std::uint32_t columns() const;  ///< of heights
    std::uint32_t rows() const;
    Vec2 cell() const;

    std::uint32_t size() const;  ///< of triangles, those of holes counted
    Triangle3 triangle(std::uint32_t index) const;
    bool is_hole(std::uint32_t cell) const;

    /// The triangle beyond the edge from a corner to the next; no_neighbour at the border and beside a hole.
    std::uint32_t neighbour(std::uint32_t triangle, std::uint32_t edge) const;

private:
    struct Data;
    explicit HeightField(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

    friend Aabb3 bounds(const HeightField& field);
    friend void each_part(const HeightField& field, const Aabb3& box,
                          FunctionRef<bool(const Triangle3& part, std::uint32_t index)> visit);
    friend void each_part_along(const HeightField& field, const MovingBox<3>& box,
                                FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit);
    friend void each_part_near(const HeightField& field, const Aabb3& box,
                               FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit);

    std::shared_ptr<const Data> data_;
};

/// Empty where all cells are holes.
Aabb3 bounds(const HeightField& field);

/// Visits the triangles whose boxes overlap `box`; the visitor returns false to stop.
void each_part(const HeightField& field, const Aabb3& box,
               FunctionRef<bool(const Triangle3& part, std::uint32_t index)> visit);

/// Visits the triangles whose boxes the moving box meets, roughly in the order in which it does; the visitor returns
/// the new, shorter reach.
void each_part_along(const HeightField& field, const MovingBox<3>& box,
                     FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit);

/// Visits the triangles, roughly those first whose boxes are nearest to `box`; the visitor returns the new, shorter
/// reach.
void each_part_near(const HeightField& field, const Aabb3& box,
                    FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit);

inline std::uint32_t part_neighbour(const HeightField& field, std::uint32_t part, std::uint32_t side) {
    return field.neighbour(part, side);
}

}  // namespace abut
