#include <abut/field/quantise.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

template <int D>
void quantise(FieldData<D>& data) {
    if (!data.steps.empty()) return;
    constexpr double most_steps = std::numeric_limits<std::int16_t>::max();
    float most = 0;
    for (const float distance : data.distance) most = std::max(most, std::abs(distance));
    // Where there are no distances, or those that are can't be told from 0, any step will do.
    const auto least = static_cast<float>(static_cast<double>(most) / most_steps);
    const float step = least > 0x1p-100f ? least : data.cell;
    data.step = step;
    data.steps.reserve(data.distance.size());
    for (const float distance : data.distance) {
        const double whole = std::floor(static_cast<double>(distance) / static_cast<double>(step) + 0.5);
        const double steps = std::clamp(whole, -most_steps, most_steps);
        data.steps.push_back(static_cast<std::int16_t>(steps));
    }
    data.distance = {};
}

template void quantise(FieldData<2>&);
template void quantise(FieldData<3>&);

}  // namespace abut
