#pragma once

// A box as it is seen from a cell of a Grid, in two words: three axes are compared at once. For .cpp files.

#include <cstdint>

namespace abut {

/// A word has a field for each axis, and a flag for each. The field of a low word is the place where the box begins in
/// the cell, that of a high word where it ends, in steps from the low side of the cell; where the box reaches beyond
/// the cell, the cell's own end. Above every field is a bit that is 1 in high words and 0 in low ones: after a
/// subtraction it is still 1 where the field of the high word was not the lesser. So two boxes meet where all these
/// bits stay in `high of b - low of a` and in `high of a - low of b`.
///
/// A box is a guest on an axis where it begins in a cell before. A low word has the flag of a guest, a high word that
/// of whoever isn't one: of two guests the bit above is lost as well, for their pair is told in the cell before.
template <int D>
struct GridWords {
    static constexpr int field_bits[3] = {D == 2 ? 13 : 8, D == 2 ? 13 : 8, 7};
    static constexpr int field_shift[3] = {0, field_bits[0] + 1, field_bits[0] + field_bits[1] + 2};
    static constexpr int flag_shift[3] = {32 - 2 * D, 34 - 2 * D, 36 - 2 * D};
    static_assert(field_shift[D - 1] + field_bits[D - 1] + 1 == flag_shift[0]);

    /// A cell has so many steps on each axis, of which the fields hold the upper bits.
    static constexpr int step_bits = field_bits[0];
    static constexpr std::uint32_t steps = 1u << step_bits;

    static constexpr std::uint32_t most(int axis) { return (1u << field_bits[axis]) - 1; }
    static constexpr std::uint32_t field(std::uint32_t step, int axis) {
        return step >> (step_bits - field_bits[axis]) << field_shift[axis];
    }

    /// Of the axes whose bits are set in `axes`, all bits of their fields.
    static constexpr std::uint32_t fields(std::uint32_t axes) {
        std::uint32_t result = 0;
        for (int i = 0; i < D; ++i)
            if ((axes >> i & 1) != 0) result |= most(i) << field_shift[i];
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

    /// Of two that meet, whether the steps alone prove it: none of them is the same.
    static bool surely_meet(std::uint32_t low_a, std::uint32_t high_a, std::uint32_t low_b, std::uint32_t high_b) {
        return ((high_b - low_a - ones) & (high_a - low_b - ones) & guards) == guards;
    }
};

}  // namespace abut
