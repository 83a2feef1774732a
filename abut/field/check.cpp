#include <abut/field/check.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

namespace abut::detail {
namespace {

constexpr std::size_t no_item = std::numeric_limits<std::size_t>::max();

Problem bad(const char* message, std::size_t index = 0) {
    return {ProblemCode::bad_format, message, index};
}

/// The product of the counts, each increased by `more`, saturated at the largest integer if it exceeds any memory.
template <int D>
std::uint64_t product(const glm::vec<D, std::uint32_t>& counts, std::uint32_t more) {
    constexpr std::uint64_t limit = std::uint64_t{1} << 40;
    std::uint64_t result = 1;
    for (int a = 0; a < D; ++a) {
        result *= std::uint64_t{counts[a]} + more;
        if (result > limit) return UINT64_MAX;
    }
    return result;
}

template <int D>
std::optional<Problem> fault_of_bricks(const FieldData<D>& data) {
    glm::vec<D, std::uint32_t> blocks;
    for (int a = 0; a < D; ++a) {
        if (data.cells[a] % brick_cells<D> != 0) return bad("the volume ends within a brick");
        blocks[a] = data.cells[a] / brick_cells<D>;
    }
    if (data.brick.size() != product<D>(blocks, 0)) return bad("the number of blocks doesn't match the volume");
    if (data.coarse.size() != product<D>(blocks, 1)) return bad("the number of block corners doesn't match the volume");
    const std::uint64_t samples = data.samples();
    for (std::size_t i = 0; i < data.brick.size(); ++i)
        if (data.brick[i] != no_brick && (std::uint64_t{data.brick[i]} + 1) * brick_samples < D >> samples)
            return bad("a block names a brick that doesn't exist", i);
    return std::nullopt;
}

/// The index of the first number that is NaN or exceeds the limit in magnitude.
std::size_t first_beyond(const std::vector<float>& numbers, float limit) {
    bool within = true;
    for (const float number : numbers) within &= std::abs(number) <= limit;  // without a branch, for SIMD
    if (within) return no_item;
    const auto is_beyond = [&](float number) { return !(std::abs(number) <= limit); };
    return static_cast<std::size_t>(std::find_if(numbers.begin(), numbers.end(), is_beyond) - numbers.begin());
}
template <int D>
std::size_t first_beyond(const std::vector<Vec<D>>& points, float limit) {
    for (std::size_t i = 0; i < points.size(); ++i)
        for (int a = 0; a < D; ++a)
            if (!(std::abs(points[i][a]) <= limit)) return i;
    return no_item;
}

/// True for the empty box, and for boxes with valid corners.
template <int D>
bool is_box(const Aabb<D>& box) {
    if (box == Aabb<D>::empty()) return true;
    for (int a = 0; a < D; ++a)
        if (!(box.min[a] > -max_field_length && box.max[a] < max_field_length && box.min[a] <= box.max[a]))
            return false;
    return true;
}

}  // namespace

template <int D>
std::optional<Problem> fault_of_numbers(const FieldData<D>& data) {
    const float limit = std::min(max_field_length, data.cell * max_field_slope);
    const auto fault_at = [&](std::size_t i, bool is_number, const char* beyond) {
        if (is_number) return bad(beyond, i);
        return Problem{ProblemCode::not_finite, "a number of the field is NaN or infinite", i};
    };
    for (const std::vector<float>* distances : {&data.coarse, &data.distance})
        if (const std::size_t i = first_beyond(*distances, limit); i != no_item)
            return fault_at(i, std::isfinite((*distances)[i]), "a sample is beyond 2^60 cells");
    if (!data.steps.empty()) {
        if (!(data.step <= limit)) return bad("the step is beyond 2^60 cells");
        // Quantisation may round up by one step.
        const float max_steps = std::floor(limit / data.step) + 1;
        if (max_steps < 32768)
            for (std::size_t i = 0; i < data.steps.size(); ++i)
                if (static_cast<float>(std::abs(int{data.steps[i]})) > max_steps)
                    return bad("a sample is beyond 2^60 cells", i);
    }
    if (const std::size_t i = first_beyond<D>(data.closest, max_field_length); i != no_item)
        return fault_at(i, is_finite<D>(data.closest[i]), "a closest point is beyond 2^100");
    return std::nullopt;
}

template <int D>
std::optional<Problem> fault_of(const FieldData<D>& data) {
    if (!(data.cell > min_field_length && data.cell < max_field_length))
        return bad("the cell's length is out of range");
    for (int a = 0; a < D; ++a) {
        if (data.cells[a] < 1 || data.cells[a] > max_cells) return bad("the number of cells is out of range");
        if (!(std::abs(data.origin[a]) < max_field_length)) return bad("the origin of the volume is beyond 2^100");
    }
    if (!is_box(data.surface)) return bad("the bounds of the field's surface are invalid");
    const std::uint64_t samples = data.samples();
    if (samples > std::uint64_t{1} << 31) return bad("there are more than 2^31 samples");
    if (!data.steps.empty() && !data.distance.empty()) return bad("the distances are stored twice");
    if (!data.steps.empty() && !(data.step > 0)) return bad("the step is not positive");
    if (data.direction.size() != (data.lookup == FieldLookup::gradient ? samples : 0) || !data.gradient.empty())
        return bad("the number of gradients doesn't match the samples");
    if (!data.closest.empty() && data.closest.size() != samples)
        return bad("the number of closest points doesn't match the samples");
    if (data.store == FieldStore::sparse) {
        if (std::optional<Problem> fault = fault_of_bricks(data)) return fault;
    } else if (samples != product<D>(data.cells, 1)) {
        return bad("the number of samples doesn't match the volume");
    }
    return fault_of_numbers(data);
}

template std::optional<Problem> fault_of(const FieldData<2>&);
template std::optional<Problem> fault_of(const FieldData<3>&);
template std::optional<Problem> fault_of_numbers(const FieldData<2>&);
template std::optional<Problem> fault_of_numbers(const FieldData<3>&);

}  // namespace abut::detail
