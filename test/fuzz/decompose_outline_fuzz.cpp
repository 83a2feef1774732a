// Decomposes any rings: an exact oracle confirms the parts, or the result is a Problem with a message.

#include "../oracle/bake/outline_parts.hpp"
#include "bytes.hpp"
#include <abut/bake/decompose_outline.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

using namespace abut;
using fuzz::require;

/// A cell of a small grid, where many points are collinear, or any float.
float coordinate(fuzz::Bytes& bytes, bool on_grid) {
    if (on_grid) return static_cast<float>(bytes.byte() % 16);
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) bits = bits << 8 | bytes.byte();
    return std::bit_cast<float>(bits);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > 600) return 0;
    fuzz::Bytes bytes(data, size);
    const std::uint8_t kind = bytes.byte();
    const bool on_grid = (kind & 3) != 0;
    std::vector<std::vector<Vec2>> rings(1);
    while (!bytes.empty()) {
        if (on_grid && bytes.byte() % 8 == 7) rings.emplace_back();
        const float x = coordinate(bytes, on_grid);
        rings.back().emplace_back(x, coordinate(bytes, on_grid));
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
