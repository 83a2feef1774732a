// Decomposes any rings: an exact oracle confirms the parts, or the result is a Problem with a message.

#include "../oracle/bake/outline_parts.hpp"
#include "bytes.hpp"
#include <abut/bake/decompose_outline.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace {

using namespace abut;
using fuzz::require;

/// Bytes as numbers: cells of a small grid, where many points are collinear, or any floats.
class Numbers {
public:
    explicit Numbers(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    bool any_left() const { return !bytes_.empty(); }
    std::uint8_t byte() {
        if (bytes_.empty()) return 0;
        const std::uint8_t result = bytes_.front();
        bytes_ = bytes_.subspan(1);
        return result;
    }
    float coordinate(bool on_grid) {
        if (on_grid) return static_cast<float>(byte() % 16);
        std::uint32_t bits = 0;
        for (int i = 0; i < 4; ++i) bits = bits << 8 | byte();
        return std::bit_cast<float>(bits);
    }

private:
    std::span<const std::uint8_t> bytes_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > 600) return 0;
    Numbers numbers({data, size});
    const std::uint8_t kind = numbers.byte();
    const bool on_grid = (kind & 3) != 0;
    std::vector<std::vector<Vec2>> rings(1);
    while (numbers.any_left()) {
        if (on_grid && numbers.byte() % 8 == 7) rings.emplace_back();
        const float x = numbers.coordinate(on_grid);
        rings.back().emplace_back(x, numbers.coordinate(on_grid));
    }
    const std::vector<std::vector<Vec2>> holes(rings.begin() + 1, rings.end());

    OutlineReport report;
    const bool conforming = (kind & 4) != 0;
    const auto parts = decompose(rings[0], holes, {.conforming = conforming, .report = &report});
    if (!parts) {
        require(!parts.problem().message.empty());
        return 0;
    }
    require(!parts->empty() && report.pieces == parts->size() && report.min_pieces <= parts->size());
    const oracle::OutlineParts oracle(rings[0], holes, *parts);
    require(oracle.fault_of_corners().empty());
    require(oracle.fault_of_overlaps().empty());
    require(oracle.fault_of_middles().empty());
    if (conforming) require(oracle.fault_of_junctions().empty());
    if (on_grid)
        for (float y = 0.25f; y < 16; ++y)
            for (float x = 0.375f; x < 16; ++x) require(oracle.fault_at({x, y}).empty());

    const auto shallow = decompose(rings[0], holes, {.concavity = 2, .report = &report});
    require(static_cast<bool>(shallow) && shallow->size() <= parts->size());
    return 0;
}
