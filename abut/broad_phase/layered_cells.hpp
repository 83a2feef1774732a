#pragma once

// The parts of a LayeredGrid: its cells, how they are numbered, and how boxes are written in them. Not for users.

#include <abut/math/aabb.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// How a box is written in a cell that it touches: two words, `low` and `high`, with a field for each axis that holds
/// where it begins and ends, counted in units from the lower border of the cell. It ends in the next cell at the
/// latest, for no box is longer than a cell. In a cell where it is a guest along an axis, for it begins in the cell
/// before, it begins at 0, and `low` has the flag of that axis. Above each field lies one more bit, set in every `high`
/// and in no `low`: `high - low` of two boxes leaves it set where the first ends behind the beginning of the other, or
/// at it.
template <int D>
struct CellFormat {
    static constexpr int cell_bits = D == 2 ? 13 : 7;         ///< a cell has 2^cell_bits units along each axis
    static constexpr int field_bits = cell_bits + 2;          ///< two cells, and the bit above
    static constexpr int first_flag = D * field_bits;         ///< in `low`; one for each axis
    static constexpr int coordinate_bits = D == 2 ? 28 : 19;  ///< of the number of a cell along an axis
    static constexpr int range_bits = 47;  ///< of the largest coordinate in units of the finest layer

    /// The value in each of the fields whose axes are in the mask.
    static constexpr std::uint32_t fields(std::uint32_t value, std::uint32_t axes) {
        std::uint32_t result = 0;
        for (int i = 0; i < D; ++i)
            if ((axes >> i & 1) != 0) result |= value << (i * field_bits);
        return result;
    }
    static constexpr std::uint32_t all_axes = (1u << D) - 1;
    static constexpr std::uint32_t field = (1u << (cell_bits + 1)) - 1;
    static constexpr std::uint32_t flags = all_axes << first_flag;
};

/// What a CellFormat has in each of its fields.
template <int D>
struct CellWords {
    using Format = CellFormat<D>;
    static constexpr std::uint32_t guards = Format::fields(1u << (Format::cell_bits + 1), Format::all_axes);
    static constexpr std::uint32_t ones = Format::fields(1, Format::all_axes);
};

static_assert(CellFormat<3>::first_flag + 3 <= 32 && CellFormat<2>::first_flag + 2 <= 32);

inline constexpr std::uint32_t no_cell = 0xffffffffu;
inline constexpr std::uint32_t most_layers = 16;

/// A cell of some layer that holds something.
struct LayeredCell {
    std::uint64_t key;          ///< CellKey
    std::uint32_t first;        ///< the first of its residents, the items that begin in it
    std::uint32_t residents;    ///< how many
    std::uint32_t first_guest;  ///< the first of its guests
    std::uint32_t guests;       ///< how many
    std::uint32_t parent;       ///< the cell of the next coarser layer that has one around this; or no_cell
    std::uint32_t unused = 0;
};
static_assert(sizeof(LayeredCell) == 32);

/// The layer and the coordinates of a cell in one number: no two cells of a world have the same.
template <int D>
struct CellKey {
    static constexpr int bits = CellFormat<D>::coordinate_bits;

    /// What is added to a coordinate, for there are negative ones.
    static constexpr std::int64_t middle = std::int64_t{1} << (bits - 1);

    static std::uint64_t of(std::uint32_t layer, const std::array<std::int64_t, D>& cell) {
        std::uint64_t result = layer;
        for (std::size_t i = D; i-- > 0;) result = result << bits | static_cast<std::uint64_t>(cell[i] + middle);
        return result;
    }
    static std::uint32_t layer(std::uint64_t key) { return static_cast<std::uint32_t>(key >> (D * bits)); }
    static std::int64_t coordinate(std::uint64_t key, std::size_t axis) {
        return static_cast<std::int64_t>(key >> (static_cast<int>(axis) * bits) & ((1u << bits) - 1)) - middle;
    }
    static std::array<std::int64_t, D> coordinates(std::uint64_t key) {
        std::array<std::int64_t, D> result;
        for (std::size_t i = 0; i < D; ++i) result[i] = coordinate(key, i);
        return result;
    }
    /// The cell by one farther along each axis in the mask.
    static std::uint64_t next(std::uint64_t key, std::uint32_t axes) {
        for (int i = 0; i < D; ++i) key += static_cast<std::uint64_t>(axes >> i & 1) << (i * bits);
        return key;
    }
    /// The cell of a coarser layer around it, whose edge is 2^shift times as long.
    static std::uint64_t around(std::uint64_t key, std::uint32_t coarser_layer, int shift) {
        auto cell = coordinates(key);
        for (std::int64_t& coordinate : cell) coordinate >>= shift;
        return of(coarser_layer, cell);
    }
};

/// Whether a comes before b on the way that goes through each cell of twice the edge before the next (Morton 1966).
template <int D>
bool before_on_the_way(const std::array<std::int64_t, D>& a, const std::array<std::int64_t, D>& b) {
    std::size_t axis = 0;
    std::uint64_t most = 0;
    for (std::size_t i = D; i-- > 0;) {
        const auto differs = static_cast<std::uint64_t>(a[i] ^ b[i]);
        if (most < differs && most < (most ^ differs)) {  // the highest bit that differs is higher
            most = differs;
            axis = i;
        }
    }
    return a[axis] < b[axis];
}

/// The cells by their keys: open addressing in a table of at least twice as many slots.
class CellTable {
public:
    /// Room for so many cells without allocating.
    void reserve(std::size_t cells);
    /// Forgets all, and takes these. No two have the same key.
    void assign(const std::vector<LayeredCell>& cells);
    /// Its number, or no_cell.
    std::uint32_t find(const std::vector<LayeredCell>& cells, std::uint64_t key) const {
        for (std::size_t slot = first_slot(key);; slot = (slot + 1) & mask_) {
            const std::uint32_t cell = slots_[slot];
            if (cell == no_cell || cells[cell].key == key) return cell;
        }
    }
    /// Its number; a new one at the end of the cells where it was not there.
    std::uint32_t find_or_add(std::vector<LayeredCell>& cells, std::uint64_t key) {
        for (std::size_t slot = first_slot(key);; slot = (slot + 1) & mask_) {
            const std::uint32_t cell = slots_[slot];
            if (cell == no_cell) return add(cells, key, slot);
            if (cells[cell].key == key) return cell;
        }
    }

private:
    std::size_t first_slot(std::uint64_t key) const {
        return static_cast<std::size_t>((key ^ key >> 32) * 0x9e3779b97f4a7c15u >> shift_);
    }
    std::uint32_t add(std::vector<LayeredCell>& cells, std::uint64_t key, std::size_t slot);
    void insert(std::uint64_t key, std::uint32_t cell);

    std::vector<std::uint32_t> slots_{std::vector<std::uint32_t>(4, no_cell)};
    std::size_t mask_ = 3;
    int shift_ = 62;
};

/// How a world is cut into layers. The unit of the finest is 2^cell_bits to its edge; all coordinates are counted in
/// it.
template <int D>
struct LayeredPlan {
    double scale = 1;                               ///< units in a length of 1, a power of two
    std::array<double, D> offset{};                 ///< so that x * scale + offset rounds to the unit in its last bit
    std::uint32_t layers = 0;                       ///< from the finest
    std::array<std::uint8_t, most_layers> shift{};  ///< a unit of the layer is 2^shift of the finest
    std::array<std::uint8_t, 65> layer_of_size{};   ///< by the bits of the longest edge; `layers` where none is enough
    std::array<std::uint8_t, 65> layer_of_place{};  ///< by the bits of the largest coordinate, the same

    /// A double from 2^52 to 2^53 has whole numbers for its last bits.
    static constexpr double whole_numbers = 0x1.8p52;

    /// A coordinate in units, rounded. It never falls where x rises, and far out it is far out, if no more.
    std::int64_t units(float x, std::size_t axis) const {
        const double shifted = std::max(static_cast<double>(x) * scale + offset[axis], 0.0);
        return std::bit_cast<std::int64_t>(shifted) - std::bit_cast<std::int64_t>(whole_numbers);
    }
    /// By its bits one can tell how large a number is, negative or not.
    static std::uint64_t magnitude(std::int64_t units) { return static_cast<std::uint64_t>(units ^ units >> 63); }
};

/// Chooses the layers for these boxes, from a sample of them. Allocates nothing.
template <int D>
LayeredPlan<D> plan_layers(std::span<const Aabb<D>> boxes);

}  // namespace abut
