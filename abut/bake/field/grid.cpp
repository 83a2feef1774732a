#include <abut/bake/field/grid.hpp>
#include <abut/field/check.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace abut::detail {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

Problem bad(std::string message) {
    return {ProblemCode::bad_argument, std::move(message), 0};
}

template <int D>
double longest_side(const Aabb<D>& box) {
    double result = 0;
    for (int i = 0; i < D; ++i)
        result = std::max(result, static_cast<double>(box.max[i]) - static_cast<double>(box.min[i]));
    return result;
}

template <int D>
bool is_usable(const Aabb<D>& box) {
    bool result = is_finite(box.min) && is_finite(box.max);
    for (int i = 0; i < D; ++i) result = result && box.min[i] <= box.max[i];
    return result;
}

/// The largest float that is at most the number.
float float_below(double number) {
    const auto nearest = static_cast<float>(number);
    return static_cast<double>(nearest) <= number ? nearest : std::nextafter(nearest, -infinity);
}

}  // namespace

template <int D>
Result<FieldData<D>> field_grid(const Aabb<D>& surface, const FieldOptions<D>& options) {
    if (!(options.cell >= 0) || options.cell == infinity) return bad("the cell of a field is not a length");
    if (!(options.padding >= 1) || options.padding == infinity) return bad("the padding of a field is less than 1");
    if (!(options.band >= 1) || options.band == infinity) return bad("the band of a field is less than 1");
    if (options.volume && !is_usable(*options.volume)) return bad("the volume of a field is not a box");

    FieldData<D> result;
    result.store = options.store;
    result.lookup = options.lookup;
    result.surface = surface;
    result.cell = options.cell > 0 ? options.cell : static_cast<float>(longest_side(surface) / 64);
    if (!(result.cell > min_field_length)) return bad("the cell of a field is not above 2^-100");
    if (!(result.cell < max_field_length)) return bad("the cell of a field is not below 2^100");

    const double cell = static_cast<double>(result.cell), padding = static_cast<double>(options.padding) * cell;
    double samples = 1;
    for (int i = 0; i < D; ++i) {
        const double low = options.volume ? static_cast<double>(options.volume->min[i])
                                          : static_cast<double>(surface.min[i]) - padding;
        const double high = options.volume ? static_cast<double>(options.volume->max[i])
                                           : static_cast<double>(surface.max[i]) + padding;
        result.origin[i] = float_below(low);
        const float low_end = std::min(surface.min[i], result.origin[i]), high_end = surface.max[i];
        if (!(low_end > -max_field_length && high_end < max_field_length && result.origin[i] < max_field_length))
            return bad("a field, or its surface, reaches beyond 2^100");
        double cells = std::max(1.0, std::ceil((high - static_cast<double>(result.origin[i])) / cell));
        const double side = brick_cells<D>;
        if (result.store == FieldStore::sparse) cells = std::ceil(cells / side) * side;
        samples *= (result.store == FieldStore::sparse ? cells / side : cells) + 1;
        if (!(samples <= max_field_samples))
            return Problem{ProblemCode::too_large, "the field would have more than 2^31 samples", 0};
        if (!(cells <= max_cells))
            return Problem{ProblemCode::too_large, "the field would have more than 2^24 cells along an axis", 0};
        result.cells[i] = static_cast<std::uint32_t>(cells);
    }
    return result;
}

template Result<FieldData<2>> field_grid(const Aabb<2>&, const FieldOptions<2>&);
template Result<FieldData<3>> field_grid(const Aabb<3>&, const FieldOptions<3>&);

}  // namespace abut::detail
