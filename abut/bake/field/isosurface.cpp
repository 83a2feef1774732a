#include <abut/bake/field/grid.hpp>
#include <abut/bake/field/isosurface.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace abut::detail {
namespace {

template <int D>
using Counts = glm::vec<D, std::uint32_t>;

template <int D>
inline constexpr std::size_t corners_of_cell = std::size_t{1} << D;

/// The distances at the corners of a cell: corner i is the upper one along axis a if bit a of i is set.
template <int D>
using CellValues = std::array<double, corners_of_cell<D>>;

template <int D>
class CellVisitor {
public:
    explicit CellVisitor(const FieldData<D>& data) : data_(data) {}

    /// Calls visit(lowest sample, values) for each cell that has corners inside and outside.
    template <class Visit>
    void each_crossed(Visit visit) const {
        if (data_.store == FieldStore::dense) {
            each_of_box(data_.cells, Counts<D>(0u), 0, data_.cells + 1u, visit);
            return;
        }
        const Counts<D> blocks = blocks_along(data_), cells(brick_cells<D>);
        for (std::size_t block = 0; block < data_.brick.size(); ++block)
            if (data_.brick[block] != no_brick)
                each_of_box(cells, grid_index(block, blocks) * brick_cells<D>,
                            std::size_t{data_.brick[block]} * brick_samples<D>, cells + 1u, visit);
    }

private:
    double value(std::size_t sample) const {
        return data_.steps.empty() ? static_cast<double>(data_.distance[sample]) : data_.steps[sample] * step();
    }
    double step() const { return static_cast<double>(data_.step); }

    template <class Visit>
    void each_of_box(const Counts<D>& cells, const Counts<D>& first, std::size_t samples, const Counts<D>& along,
                     Visit visit) const {
        for (std::size_t number = 0; number < grid_size<D>(cells); ++number) {
            const Counts<D> cell = grid_index<D>(number, cells);
            CellValues<D> values;
            std::size_t inside = 0;
            for (std::uint32_t corner = 0; corner < values.size(); ++corner) {
                Counts<D> at = cell;
                for (int i = 0; i < D; ++i) at[i] += corner >> i & 1u;
                values[corner] = value(samples + linear_index<D>(at, along));
                inside += values[corner] <= 0;
            }
            if (inside > 0 && inside < values.size()) visit(first + cell, values);
        }
    }

    const FieldData<D>& data_;
};

/// The corners of Kuhn's simplices: each is a path from the lowest corner to the highest, one axis at a time.
template <int D>
struct Kuhn;
template <>
struct Kuhn<2> {
    static constexpr std::uint32_t simplices[2][3] = {{0, 1, 3}, {0, 2, 3}};
};
template <>
struct Kuhn<3> {
    static constexpr std::uint32_t simplices[6][4] = {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7},
                                                      {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};
};

}  // namespace

template <int D>
Aabb<D> isosurface_bounds(const FieldData<D>& data) {
    Aabb<D> result = Aabb<D>::empty();
    const SampleLattice<D> lattice = lattice_of(data);
    CellVisitor<D>(data).each_crossed([&](const Counts<D>& cell, const CellValues<D>&) {
        const Aabb<D> box{to_float(lattice.at(cell)), to_float(lattice.at(cell + 1u))};
        result = merged(result, box);
    });
    return result;
}

template <int D>
std::vector<std::array<Vec<D>, D>> isosurface(const FieldData<D>& data) {
    std::vector<std::array<Vec<D>, D>> result;
    const SampleLattice<D> lattice = lattice_of(data);
    CellVisitor<D>(data).each_crossed([&](const Counts<D>& cell, const CellValues<D>& values) {
        const auto corner_at = [&](std::uint32_t corner) {
            Counts<D> at = cell;
            for (int axis = 0; axis < D; ++axis) at[axis] += corner >> axis & 1u;
            return lattice.at(at);
        };
        for (const auto& simplex : Kuhn<D>::simplices) {
            std::array<std::uint32_t, D + 1> in{}, out{};
            std::size_t count_in = 0, count_out = 0;
            for (const std::uint32_t corner : simplex) {
                if (values[corner] <= 0)
                    in[count_in++] = corner;
                else
                    out[count_out++] = corner;
            }
            if (count_in == 0 || count_out == 0) continue;
            const auto crossing = [&](std::uint32_t i, std::uint32_t o) {
                const double fraction = values[i] / (values[i] - values[o]);
                // The samples' own coordinates are used, so neighbouring cells compute identical points.
                const DVec<D> from = corner_at(i), to = corner_at(o);
                const DVec<D> place = from + fraction * (to - from);
                return to_float(place);
            };
            if constexpr (D == 2) {
                if (count_in == 1)
                    result.push_back({crossing(in[0], out[0]), crossing(in[0], out[1])});
                else
                    result.push_back({crossing(in[0], out[0]), crossing(in[1], out[0])});
            } else if (count_in == 2) {
                const Vec3 a = crossing(in[0], out[0]), b = crossing(in[0], out[1]);
                const Vec3 c = crossing(in[1], out[1]), d = crossing(in[1], out[0]);
                result.push_back({a, b, c});
                result.push_back({a, c, d});
            } else if (count_in == 1) {
                result.push_back({crossing(in[0], out[0]), crossing(in[0], out[1]), crossing(in[0], out[2])});
            } else {
                result.push_back({crossing(in[0], out[0]), crossing(in[1], out[0]), crossing(in[2], out[0])});
            }
        }
    });
    return result;
}

template Aabb<2> isosurface_bounds(const FieldData<2>&);
template Aabb<3> isosurface_bounds(const FieldData<3>&);
template std::vector<std::array<Vec<2>, 2>> isosurface<2>(const FieldData<2>&);
template std::vector<std::array<Vec<3>, 3>> isosurface<3>(const FieldData<3>&);

}  // namespace abut::detail
