#include <abut/field/field_check.hpp>

#include <cmath>
#include <cstdint>

namespace abut {
namespace {

/// Of the counts, each one greater by `more`; the largest number there is where they are beyond what memory holds.
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
const char* fault_of_bricks(const FieldData<D>& data) {
    glm::vec<D, std::uint32_t> blocks;
    for (int a = 0; a < D; ++a) {
        if (data.cells[a] % brick_cells<D> != 0) return "the volume ends within a brick";
        blocks[a] = data.cells[a] / brick_cells<D>;
    }
    if (data.brick.size() != product<D>(blocks, 0)) return "there aren't as many blocks as the volume has";
    if (data.coarse.size() != product<D>(blocks, 1)) return "there aren't as many corners of blocks as the volume has";
    const std::uint64_t samples = data.samples();
    for (const std::uint32_t brick : data.brick)
        if (brick != no_brick && (std::uint64_t{brick} + 1) * brick_samples < D >> samples)
            return "a block has a brick that isn't there";
    return nullptr;
}

}  // namespace

template <int D>
const char* fault_of(const FieldData<D>& data) {
    constexpr float least = 0x1p-100f, most = 0x1p100f;
    if (!(data.cell > least && data.cell < most)) return "the cell is no length";
    for (int a = 0; a < D; ++a) {
        if (data.cells[a] < 1 || data.cells[a] > most_cells) return "the number of cells is out of range";
        if (!(std::abs(data.origin[a]) < most)) return "the volume is nowhere";
    }
    const std::uint64_t samples = data.samples();
    if (samples > std::uint64_t{1} << 31) return "there are more than 2^31 samples";
    if (!data.steps.empty() && !data.distance.empty()) return "the distances are there twice";
    if (!data.steps.empty() && !(data.step > 0 && data.step < most)) return "the step is no length";
    if (data.direction.size() != (data.lookup == FieldLookup::gradient ? samples : 0) || !data.gradient.empty())
        return "there aren't as many gradients as samples";
    if (!data.closest.empty() && data.closest.size() != samples)
        return "there aren't as many closest points as samples";
    if (data.store == FieldStore::sparse) return fault_of_bricks(data);
    if (samples != product<D>(data.cells, 1)) return "there aren't as many samples as the volume has";
    return nullptr;
}

template const char* fault_of(const FieldData<2>&);
template const char* fault_of(const FieldData<3>&);

}  // namespace abut
