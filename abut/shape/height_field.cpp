#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/detail/grid_hierarchy.hpp>
#include <abut/shape/height_field.hpp>

#include <algorithm>
#include <optional>
#include <vector>

namespace abut {

using namespace detail;

namespace {

/// The range of heights in a block.
struct HeightRange {
    float min = std::numeric_limits<float>::infinity();
    float max = -std::numeric_limits<float>::infinity();
};
HeightRange merged(const HeightRange& a, const HeightRange& b) {
    return {std::min(a.min, b.min), std::max(a.max, b.max)};
}

Aabb3 box_of(const Triangle3& t) {
    return merged(merged(Aabb3{t.a, t.a}, Aabb3{t.b, t.b}), Aabb3{t.c, t.c});
}

std::optional<Problem> not_finite(std::span<const float> heights) {
    const auto found = std::ranges::find_if_not(heights, [](float height) { return std::isfinite(height); });
    if (found == heights.end()) return std::nullopt;
    const auto i = static_cast<std::size_t>(found - heights.begin());
    return Problem{ProblemCode::not_finite, "height " + std::to_string(i) + " is not finite", i};
}

}  // namespace

struct HeightField::Data {
    std::vector<float> heights;
    std::uint32_t columns = 0, rows = 0;  ///< of heights
    Vec2 cell{};
    std::vector<bool> holes;  ///< by cell; empty: no holes
    GridHierarchy<HeightRange> blocks;

    std::uint32_t cell_columns() const { return columns - 1; }
    std::uint32_t cell_rows() const { return rows - 1; }
    std::uint32_t cell_count() const { return cell_columns() * cell_rows(); }
    std::uint32_t cell_at(std::uint32_t x, std::uint32_t y) const { return x + y * cell_columns(); }
    bool is_hole(std::uint32_t index) const { return !holes.empty() && holes[index]; }

    float height(std::uint32_t x, std::uint32_t y) const { return heights[std::size_t{y} * columns + x]; }
    Vec3 corner(std::uint32_t x, std::uint32_t y) const {
        return {static_cast<float>(x) * cell.x, static_cast<float>(y) * cell.y, height(x, y)};
    }
    HeightRange of_cell(std::uint32_t x, std::uint32_t y) const {
        if (is_hole(cell_at(x, y))) return {};
        const float a = height(x, y), b = height(x + 1, y), c = height(x + 1, y + 1), d = height(x, y + 1);
        return {std::min(std::min(a, b), std::min(c, d)), std::max(std::max(a, b), std::max(c, d))};
    }
    HeightRange of_cell(const glm::uvec2& place) const { return of_cell(place.x, place.y); }
    Aabb3 box_of_block(std::uint32_t level, const glm::uvec2& place) const {
        const HeightRange z = level == 0 ? of_cell(place) : blocks.at(level, place);
        if (!(z.min <= z.max)) return Aabb3::empty();
        const Vec2 low = Vec2(blocks.first_cell(level, place)) * cell,
                   high = Vec2(blocks.first_cell(level, place + 1u)) * cell;
        return {{low, z.min}, {high, z.max}};
    }
    Triangle3 triangle(std::uint32_t x, std::uint32_t y, std::uint32_t which) const {
        return which == 0 ? Triangle3{corner(x, y), corner(x + 1, y), corner(x + 1, y + 1)}
                          : Triangle3{corner(x, y), corner(x + 1, y + 1), corner(x, y + 1)};
    }

    /// Calls visit(triangle, index) for the triangles whose boxes are within reach; it returns the new reach.
    template <class Reach, class Visit>
    void each_within(Reach reach, Visit&& visit) const {
        const auto visit_cell = [&](const glm::uvec2& place) {
            for (std::uint32_t which = 0; which < 2 && !reach.is_exhausted(); ++which) {
                const Triangle3 t = triangle(place.x, place.y, which);
                double measure;
                if (reach.measure(box_of(t), measure)) reach.shrink(visit(t, 2 * cell_at(place.x, place.y) + which));
            }
        };
        blocks.traverse(
            reach, [this](std::uint32_t level, const glm::uvec2& place) { return box_of_block(level, place); },
            visit_cell);
    }
};

Result<HeightField> HeightField::build(std::span<const float> heights, std::uint32_t columns, const Vec2& cell,
                                       const HeightFieldOptions& options) {
    detail::enter_library();
    if (heights.empty()) return Problem{ProblemCode::empty_input, "a height field needs heights", 0};
    if (columns < 2)
        return Problem{ProblemCode::bad_argument,
                       "a height field needs at least two columns, and there are " + std::to_string(columns), 0};
    if (heights.size() % columns != 0)
        return Problem{
            ProblemCode::bad_argument,
            std::to_string(heights.size()) + " heights are no whole number of rows of " + std::to_string(columns), 0};
    const std::size_t rows = heights.size() / columns;
    if (rows < 2)
        return Problem{ProblemCode::bad_argument, "a height field needs at least two rows, and there is 1", 0};
    constexpr std::size_t max_cells = std::size_t{1} << 30;
    if ((columns - 1) * (rows - 1) > max_cells)
        return Problem{ProblemCode::too_large, "a height field has at most 2^30 cells", max_cells};
    if (std::optional<Problem> problem = not_finite(heights)) return *std::move(problem);
    const Vec2 extent(cell.x * static_cast<float>(columns - 1), cell.y * static_cast<float>(rows - 1));
    if (!(cell.x > 0 && cell.y > 0 && is_finite(extent)))
        return Problem{ProblemCode::bad_argument, "the cells' sizes must be above zero, and their places finite", 0};
    auto data = std::make_shared<Data>();
    data->heights.assign(heights.begin(), heights.end());
    data->columns = columns;
    data->rows = static_cast<std::uint32_t>(rows);
    data->cell = cell;
    if (!options.holes.empty()) data->holes.resize(data->cell_count());
    for (std::size_t i = 0; i < options.holes.size(); ++i) {
        if (options.holes[i] >= data->cell_count())
            return Problem{ProblemCode::index_out_of_range,
                           "hole " + std::to_string(i) + " names cell " + std::to_string(options.holes[i]) + " of " +
                               std::to_string(data->cell_count()),
                           i};
        data->holes[options.holes[i]] = true;
    }
    data->blocks.build({data->cell_columns(), data->cell_rows()},
                       [&](const glm::uvec2& place) { return data->of_cell(place); });
    return HeightField(std::move(data));
}

Result<HeightField> HeightField::build(std::span<const float> heights, std::uint32_t columns, float cell,
                                       const HeightFieldOptions& options) {
    return build(heights, columns, Vec2(cell, cell), options);
}

/// The data, of which a copy is made if they are shared.
HeightField::Data& HeightField::own_data() {
    if (data_.use_count() > 1) data_ = std::make_shared<Data>(*data_);
    return *data_;
}

std::optional<Problem> HeightField::set(std::uint32_t column, std::uint32_t row, std::uint32_t block_columns,
                                        std::span<const float> heights) {
    detail::enter_library();
    if (heights.empty()) return std::nullopt;
    if (block_columns == 0 || heights.size() % block_columns != 0)
        return Problem{
            ProblemCode::bad_argument,
            std::to_string(heights.size()) + " heights are no whole number of rows of " + std::to_string(block_columns),
            0};
    const std::size_t block_rows = heights.size() / block_columns;
    if (column > columns() || block_columns > columns() - column || row > rows() || block_rows > rows() - row)
        return Problem{ProblemCode::index_out_of_range,
                       std::to_string(block_columns) + " by " + std::to_string(block_rows) + " heights at column " +
                           std::to_string(column) + " and row " + std::to_string(row) + " reach beyond a field of " +
                           std::to_string(columns()) + " by " + std::to_string(rows()),
                       0};
    if (std::optional<Problem> problem = not_finite(heights)) return problem;
    Data& data = own_data();
    for (std::size_t j = 0; j < block_rows; ++j)
        std::ranges::copy(heights.subspan(j * block_columns, block_columns),
                          data.heights.begin() + static_cast<std::ptrdiff_t>((row + j) * columns() + column));
    // The cells around these heights.
    const glm::uvec2 first(column - std::min(column, 1u), row - std::min(row, 1u));
    const glm::uvec2 end(std::min(column + block_columns, data.cell_columns()),
                         std::min(row + static_cast<std::uint32_t>(block_rows), data.cell_rows()));
    update_cells(first, end);
    return std::nullopt;
}

void HeightField::set_hole(std::uint32_t cell, bool hole) {
    detail::enter_library();
    ABUT_ASSERT(cell < data_->cell_count());
    if (cell >= data_->cell_count() || is_hole(cell) == hole) return;
    Data& data = own_data();
    data.holes.resize(data.cell_count());
    data.holes[cell] = hole;
    const glm::uvec2 place(cell % data.cell_columns(), cell / data.cell_columns());
    update_cells(place, place + 1u);
}

void HeightField::update_cells(const glm::uvec2& first, const glm::uvec2& end) {
    const Aabb3 before = bounds(*this);
    data_->blocks.update(first, end, [this](const glm::uvec2& place) { return data_->of_cell(place); });
    const Aabb3 after = bounds(*this);
    const Vec2 low = Vec2(first) * cell(), high = Vec2(end) * cell();
    changed_.add({{low, std::min(before.min.z, after.min.z)}, {high, std::max(before.max.z, after.max.z)}});
}

std::span<const float> HeightField::heights() const {
    return data_->heights;
}
std::uint32_t HeightField::columns() const {
    return data_->columns;
}
std::uint32_t HeightField::rows() const {
    return data_->rows;
}
Vec2 HeightField::cell() const {
    detail::enter_library();
    return data_->cell;
}
std::uint32_t HeightField::size() const {
    return 2 * data_->cell_count();
}

Triangle3 HeightField::triangle(std::uint32_t index) const {
    detail::enter_library();
    ABUT_ASSERT(index < size());
    const std::uint32_t in = index / 2, columns = data_->cell_columns();
    return data_->triangle(in % columns, in / columns, index % 2);
}

bool HeightField::is_hole(std::uint32_t cell) const {
    ABUT_ASSERT(cell < data_->cell_count());
    return data_->is_hole(cell);
}

std::uint32_t HeightField::neighbour(std::uint32_t triangle, std::uint32_t edge) const {
    ABUT_ASSERT(triangle < size() && edge < 3);
    const Data& data = *data_;
    const std::uint32_t in = triangle / 2, x = in % data.cell_columns(), y = in / data.cell_columns();
    if (data.is_hole(in)) return no_neighbour;
    const auto beyond = [&](bool exists, std::uint32_t cell, std::uint32_t which) {
        return exists && !data.is_hole(cell) ? 2 * cell + which : no_neighbour;
    };
    if (triangle % 2 == 0) {
        if (edge == 0) return beyond(y > 0, in - data.cell_columns(), 1);
        return edge == 1 ? beyond(x + 1 < data.cell_columns(), in + 1, 1) : triangle + 1;
    }
    if (edge == 0) return triangle - 1;
    return edge == 1 ? beyond(y + 1 < data.cell_rows(), in + data.cell_columns(), 0) : beyond(x > 0, in - 1, 0);
}

Aabb3 bounds(const HeightField& field) {
    detail::enter_library();
    Aabb3 result = Aabb3::empty();
    const HeightField::Data& data = *field.data_;
    const HeightRange& all = data.blocks.all();
    if (!(all.min <= all.max)) return result;
    result.min = Vec3(0, 0, all.min);
    result.max = data.corner(data.columns - 1, data.rows - 1);
    result.max.z = all.max;
    return result;
}

Aabb3 take_changed(HeightField& field) {
    return field.changed_.take();
}

void each_part(const HeightField& field, const Aabb3& box,
               FunctionRef<bool(const Triangle3& part, std::uint32_t index)> visit) {
    detail::enter_library();
    const HeightField::Data& data = *field.data_;
    const Aabb3 query = usable(box);
    if (!overlaps(query, bounds(field))) return;
    const glm::uvec2 count(data.cell_columns(), data.cell_rows());
    const CellRange<2> cells({Vec2(query.min), Vec2(query.max)}, data.cell, count);
    if (cells.size() > static_cast<double>(max_direct_cells)) {
        constexpr float on = std::numeric_limits<float>::infinity();
        data.each_within(BoxReach<3>(query, 0),
                         [&](const Triangle3& t, std::uint32_t index) { return visit(t, index) ? on : -on; });
        return;
    }
    each_place<2>(cells.begin, cells.end, [&](const glm::uvec2& place) {
        if (!overlaps(query, data.box_of_block(0, place))) return true;
        for (std::uint32_t which = 0; which < 2; ++which) {
            const Triangle3 t = data.triangle(place.x, place.y, which);
            if (overlaps(query, box_of(t)) && !visit(t, 2 * data.cell_at(place.x, place.y) + which)) return false;
        }
        return true;
    });
}

void each_part_along(const HeightField& field, const MovingBox<3>& box,
                     FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit) {
    detail::enter_library();
    field.data_->each_within(RayReach<3>::of_box(box), visit);
}

void each_part_near(const HeightField& field, const Aabb3& box,
                    FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit) {
    detail::enter_library();
    constexpr float any = std::numeric_limits<float>::infinity();
    field.data_->each_within(BoxReach<3>(box, any), visit);
}

}  // namespace abut
