#include "tool/field/field_error.hpp"

#include <algorithm>
#include <cmath>

namespace abut::tool {
namespace {

// Maximum number of samples of the second grid along the longest side of the volume.
template <int D>
constexpr double max_samples = D == 2 ? 256 : 48;

// The golden ratio: its multiples are equidistributed modulo 1, so that offsets within cells don't repeat.
constexpr double golden_ratio = 1.6180339887498949;

// The second grid's cell in units of the first: an integer plus the golden ratio's fraction.
double ratio(double wanted) {
    return std::max(std::floor(wanted), 0.0) + golden_ratio - 1;
}

class ErrorSum {
public:
    void add(double error, bool is_wrong_side) {
        squares_ += error * error;
        result_.largest = std::max(result_.largest, std::abs(error));
        result_.wrong_side += is_wrong_side;
        ++result_.points;
    }
    FieldError error() const {
        FieldError result = result_;
        if (result.points > 0) result.root_mean_square = std::sqrt(squares_ / static_cast<double>(result.points));
        return result;
    }

private:
    FieldError result_;
    double squares_ = 0;
};

}  // namespace

template <int D>
Result<FieldErrors> measure_error(const Field<D>& field, const Baker<D>& bake, Executor* executor) {
    const Aabb<D> volume = field.volume();
    double cells = 0;
    for (int i = 0; i < D; ++i)
        cells = std::max(cells, static_cast<double>(volume.max[i] - volume.min[i]) / static_cast<double>(field.cell()));
    FieldOptions<D> options;
    options.store = FieldStore::dense;
    options.cell = static_cast<float>(static_cast<double>(field.cell()) * ratio(cells / max_samples<D>));
    options.volume = volume;
    options.executor = executor;
    const Result<Field<D>> exact = bake(options);
    if (!exact) return exact.problem();

    const detail::FieldData<D>& data = exact->data();
    const double cell = static_cast<double>(field.cell());
    ErrorSum near, all;
    glm::vec<D, std::uint32_t> at(0u);
    for (const float exact_distance : data.distance) {
        Vec<D> place;
        bool is_in_volume = true;
        for (int i = 0; i < D; ++i) {
            place[i] = static_cast<float>(static_cast<double>(data.origin[i]) + static_cast<double>(data.cell) * at[i]);
            is_in_volume = is_in_volume && place[i] >= volume.min[i] && place[i] <= volume.max[i];
        }
        if (is_in_volume) {
            const double value = static_cast<double>(field.distance(place)),
                         error = value - static_cast<double>(exact_distance);
            const bool is_wrong_side = (value < 0) != (exact_distance < 0);
            all.add(error, is_wrong_side);
            if (std::abs(static_cast<double>(exact_distance)) <= cell) near.add(error, is_wrong_side);
        }
        for (int i = 0; i < D && ++at[i] > data.cells[i]; ++i) at[i] = 0;
    }
    return FieldErrors{near.error(), all.error()};
}
template Result<FieldErrors> measure_error(const Field<2>&, const Baker<2>&, Executor*);
template Result<FieldErrors> measure_error(const Field<3>&, const Baker<3>&, Executor*);

}  // namespace abut::tool
