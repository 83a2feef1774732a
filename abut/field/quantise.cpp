#include <abut/field/quantise.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::detail {

template <int D>
void quantise(FieldData<D>& data) {
    if (!data.steps.empty()) return;
    constexpr double max_steps = std::numeric_limits<std::int16_t>::max();
    float max_distance = 0;
    for (const float distance : data.distance) max_distance = std::max(max_distance, std::abs(distance));
    // Without distances, or with ones that are nearly 0, any step is valid.
    const auto min_step = static_cast<float>(static_cast<double>(max_distance) / max_steps);
    const float step = min_step > 0x1p-100f ? min_step : data.cell;
    data.step = step;
    data.steps.reserve(data.distance.size());
    for (const float distance : data.distance) {
        const double rounded = std::floor(static_cast<double>(distance) / static_cast<double>(step) + 0.5);
        const double steps = std::clamp(rounded, -max_steps, max_steps);
        data.steps.push_back(static_cast<std::int16_t>(steps));
    }
    data.distance = {};
}

template void quantise(FieldData<2>&);
template void quantise(FieldData<3>&);

}  // namespace abut::detail
