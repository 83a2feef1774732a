#pragma once

// The bounds of a box relative to a cell of a Grid, packed into two words, so that one subtraction compares all axes.
// For .cpp files.

#include <cstdint>

namespace abut::detail {

/// A word has a field and a flag for each axis. The field of the low word is the lower bound of the box in steps from
/// the low side of the cell; the field of the high word is the upper bound. Bounds beyond the cell are clamped to it. A
/// guard bit above every field is 1 in high words and 0 in low words. After a subtraction the guard bit is still 1 if
/// the field of the high word was not smaller. So two boxes overlap if all guard bits are set in both `high of b - low
/// of a` and `high of a - low of b`.
///
/// The home cell of a box along an axis is the cell that contains its lower bound; in later cells the box is a copy.
/// The low word has the flag of an axis if the box is a copy, the high word if the cell is its home. If both boxes are
/// copies, the subtraction clears the guard bit of the flag: an earlier cell reports the pair.
template <int D>
struct PackedBounds {
    static constexpr int field_bits[3] = {D == 2 ? 13 : 8, D == 2 ? 13 : 8, 7};
    static constexpr int field_shift[3] = {0, field_bits[0] + 1, field_bits[0] + field_bits[1] + 2};
    static constexpr int flag_shift[3] = {32 - 2 * D, 34 - 2 * D, 36 - 2 * D};
    static_assert(field_shift[D - 1] + field_bits[D - 1] + 1 == flag_shift[0]);

    /// The number of steps of a cell along each axis. The fields hold the upper bits of a step.
    static constexpr int step_bits = field_bits[0];
    static constexpr std::uint32_t steps = 1u << step_bits;

    static constexpr std::uint32_t max_field(int axis) { return (1u << field_bits[axis]) - 1; }
    static constexpr std::uint32_t field(std::uint32_t step, int axis) {
        return step >> (step_bits - field_bits[axis]) << field_shift[axis];
    }

    /// All bits of the fields of the axes whose bits are set in `axes`.
    static constexpr std::uint32_t fields(std::uint32_t axes) {
        std::uint32_t result = 0;
        for (int i = 0; i < D; ++i)
            if ((axes >> i & 1) != 0) result |= max_field(i) << field_shift[i];
        return result;
    }
    static constexpr std::uint32_t flags(std::uint32_t axes) {
        std::uint32_t result = 0;
        for (int i = 0; i < D; ++i) result |= (axes >> i & 1) << flag_shift[i];
        return result;
    }

    static constexpr std::uint32_t all_axes = (1u << D) - 1;
    static constexpr std::uint32_t all_guards() {
        std::uint32_t result = 0;
        for (int i = 0; i < D; ++i) result |= 1u << (field_shift[i] + field_bits[i]) | 2u << flag_shift[i];
        return result;
    }
    static constexpr std::uint32_t all_ones() {
        std::uint32_t result = 0;
        for (int i = 0; i < D; ++i) result |= 1u << field_shift[i];
        return result;
    }
    static constexpr std::uint32_t guards = all_guards();
    static constexpr std::uint32_t ones = all_ones();

    /// Whether the steps alone prove that two boxes overlap, given that their steps overlap: no two steps are equal.
    static bool surely_overlap(std::uint32_t low_a, std::uint32_t high_a, std::uint32_t low_b, std::uint32_t high_b) {
        return ((high_b - low_a - ones) & (high_a - low_b - ones) & guards) == guards;
    }
};

}  // namespace abut::detail
