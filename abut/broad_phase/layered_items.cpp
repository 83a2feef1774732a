// How the boxes come into their cells. Three passes: over the boxes as they were given, to find the cells; over the
// places, to write each box in the cell where it begins; over the cells, to fetch the guests from those before.

#include <abut/broad_phase/box_sides.hpp>
#include <abut/broad_phase/layered_guests.hpp>
#include <abut/broad_phase/layered_items.hpp>

#include <algorithm>
#include <bit>

namespace abut {
namespace {

constexpr std::uint32_t no_place = no_cell, stray = no_cell - 1;

/// Where a box is in units.
template <int D>
struct Units {
    std::array<std::int64_t, D> low, high;

    Units(const LayeredPlan<D>& plan, const BoxSides<D>& box) {
        for (std::size_t i = 0; i < D; ++i) {
            low[i] = plan.units(box.min[i], i);
            high[i] = plan.units(box.max[i], i);
        }
    }
    /// `plan.layers` where no layer can hold it.
    std::uint32_t layer(const LayeredPlan<D>& plan) const {
        std::uint64_t edge = 0, place = 0;
        for (std::size_t i = 0; i < D; ++i) {
            edge |= static_cast<std::uint64_t>(high[i] - low[i]);
            place |= plan.magnitude(low[i]) | plan.magnitude(high[i]);
        }
        if (place >> CellFormat<D>::range_bits != 0) return plan.layers;
        return std::max(plan.layer_of_size[static_cast<std::size_t>(std::bit_width(edge))],
                        plan.layer_of_place[static_cast<std::size_t>(std::bit_width(place))]);
    }
    std::uint64_t key(std::uint32_t layer, int cell_shift) const {
        std::array<std::int64_t, D> cell;
        for (std::size_t i = 0; i < D; ++i) cell[i] = low[i] >> cell_shift;
        return CellKey<D>::of(layer, cell);
    }
};

/// Fills the items of one LayeredItems.
template <int D>
class Filling {
public:
    using Format = CellFormat<D>;
    static constexpr std::uint32_t ways = Format::all_axes;  ///< sets of axes that a box may cross over

    Filling(LayeredItems<D>& items, const LayeredPlan<D>& plan, std::span<const Aabb<D>> given)
        : items_(items), plan_(plan), given_(given), cell_of_(items.low) {}

    void run() {
        find_cells();
        if (items_.cells.size() > items_.sorted_cells) sort_cells();
        give_places();
        write_residents();
        fetch_guests(items_, guests_);
        find_parents();
        build_trees();
    }

private:
    void find_cells() {
        for (LayeredCell& cell : items_.cells) cell.residents = 0;
        cell_of_.resize(given_.size());
        BoxSides<D> bounds = BoxSides<D>::of(Aabb<D>::empty());
        for (std::size_t i = 0; i < given_.size(); ++i) {
            const BoxSides<D> box = BoxSides<D>::of(given_[i]);
            if (!box.holds_something()) {
                cell_of_[i] = no_place;
                continue;
            }
            bounds.take_in(box);
            const Units<D> units(plan_, box);
            const std::uint32_t layer = units.layer(plan_);
            if (layer == plan_.layers) {
                cell_of_[i] = stray;
                ++strays_;
                continue;
            }
            const std::uint64_t key = units.key(layer, plan_.shift[layer] + Format::cell_bits);
            const std::uint32_t cell = items_.table.find_or_add(items_.cells, key);
            ++items_.cells[cell].residents;
            cell_of_[i] = cell;
        }
        items_.bounds = bounds.box();
    }

    /// The new cells among the old ones, of which those are left out that have been empty since the last time.
    void sort_cells() {
        auto& cells = items_.cells;
        auto& sorted = items_.spare;
        auto& moved_to = items_.guest_low;
        for (std::size_t i = 0; i < cells.size(); ++i) cells[i].first = static_cast<std::uint32_t>(i);
        const auto before = [](const LayeredCell& a, const LayeredCell& b) {
            const std::uint32_t layer_a = CellKey<D>::layer(a.key), layer_b = CellKey<D>::layer(b.key);
            if (layer_a != layer_b) return layer_a < layer_b;
            return before_on_the_way<D>(CellKey<D>::coordinates(a.key), CellKey<D>::coordinates(b.key));
        };
        const auto middle = cells.begin() + static_cast<std::ptrdiff_t>(items_.sorted_cells);
        std::sort(middle, cells.end(), before);
        moved_to.resize(cells.size());
        sorted.clear();
        for (auto old = cells.begin(), added = middle; old != middle || added != cells.end();) {
            const bool take_old = added == cells.end() || (old != middle && before(*old, *added));
            const LayeredCell& next = take_old ? *old++ : *added++;
            if (next.residents == 0 && next.guests == 0) continue;
            moved_to[next.first] = static_cast<std::uint32_t>(sorted.size());
            sorted.push_back(std::bit_cast<SpareCell>(next));
        }
        cells.resize(sorted.size());
        for (std::size_t i = 0; i < sorted.size(); ++i) cells[i] = std::bit_cast<LayeredCell>(sorted[i]);
        items_.table.assign(cells);
        items_.sorted_cells = static_cast<std::uint32_t>(cells.size());
        for (std::uint32_t& cell : cell_of_)
            if (cell < stray) cell = moved_to[cell];
    }

    void give_places() {
        std::uint32_t place = 0;
        for (LayeredCell& cell : items_.cells) {
            cell.first = place;
            place += cell.residents;
        }
        items_.with_cell = place;
        items_.index.resize(place + strays_);
        std::uint32_t next_stray = place;
        for (std::size_t i = 0; i < given_.size(); ++i) {
            const std::uint32_t cell = cell_of_[i];
            if (cell == no_place) continue;
            std::uint32_t& next = cell == stray ? next_stray : items_.cells[cell].first;
            items_.index[next++] = static_cast<std::uint32_t>(i);
        }
        for (LayeredCell& cell : items_.cells) cell.first -= cell.residents;
        const auto begins_before = [this](std::uint32_t a, std::uint32_t b) {
            const float at_a = given_[a].min[0], at_b = given_[b].min[0];
            return at_a != at_b ? at_a < at_b : a < b;
        };
        std::sort(items_.index.begin() + place, items_.index.end(), begins_before);
    }

    void write_residents() {
        const std::size_t places = items_.index.size();
        items_.boxes.resize(places);
        items_.low.resize(places + guest_slack);
        items_.high.resize(places + guest_slack);
        SpareCell none;
        none.fill(no_cell);
        items_.spare.assign(items_.cells.size(), none);
        const auto count = static_cast<std::uint32_t>(items_.cells.size());
        for (std::uint32_t cell = 0; cell < count; ++cell) {
            const LayeredCell now = items_.cells[cell];
            if (now.residents == 0) continue;
            const std::uint32_t crossed = write_residents(now);
            for (std::uint32_t axes = 1; axes <= ways; ++axes)
                if ((crossed & supersets(axes)) != 0) send_guests(cell, axes, now.key);
        }
        for (std::size_t place = items_.with_cell; place < places; ++place)
            items_.boxes[place] = given_[items_.index[place]];
    }

    /// Returns which sets of axes there are that a box goes over, as bits.
    std::uint32_t write_residents(const LayeredCell& cell) {
        constexpr std::uint32_t ahead = 24;
        const auto last = static_cast<std::uint32_t>(items_.index.size() - 1);
        const int shift = plan_.shift[CellKey<D>::layer(cell.key)];
        static constexpr std::array<std::uint8_t, 8> guests_of{0, 1, 1, 3, 1, 3, 3, 7};  // by the axes gone over
        std::uint32_t result = 0;
        for (std::uint32_t place = cell.first; place < cell.first + cell.residents; ++place) {
            __builtin_prefetch(&given_[items_.index[std::min(place + ahead, last)]]);
            const Aabb<D> box = given_[items_.index[place]];
            items_.boxes[place] = box;
            const Units<D> units(plan_, BoxSides<D>::of(box));
            std::uint32_t low = 0, high = 0, crossed = 0;
            for (std::size_t i = 0; i < D; ++i) {
                const std::int64_t begins = units.low[i] >> shift, ends = units.high[i] >> shift;
                const std::int64_t border = begins >> Format::cell_bits << Format::cell_bits;
                const int at = static_cast<int>(i) * Format::field_bits;
                low |= static_cast<std::uint32_t>(begins - border) << at;
                high |= static_cast<std::uint32_t>(ends - border) << at;
                crossed |= static_cast<std::uint32_t>((ends - border) >> Format::cell_bits) << i;
            }
            items_.low[place] = low;
            items_.high[place] = high | CellWords<D>::guards;
            result |= 1u << crossed;
            guests_ += guests_of[crossed];
        }
        return result;
    }

    /// Those sets of axes that have all of these, as bits.
    static constexpr std::uint32_t supersets(std::uint32_t axes) {
        std::uint32_t result = 0;
        for (std::uint32_t others = axes; others <= ways; ++others)
            if ((others & axes) == axes) result |= 1u << others;
        return result;
    }

    void send_guests(std::uint32_t from, std::uint32_t axes, std::uint64_t key) {
        const std::uint32_t to = items_.table.find_or_add(items_.cells, CellKey<D>::next(key, axes));
        if (to == items_.spare.size()) {
            SpareCell none;
            none.fill(no_cell);
            items_.spare.push_back(none);
        }
        items_.spare[to][axes] = from;
    }

    void find_parents() {
        std::array<bool, most_layers> occupied{};
        for (const LayeredCell& cell : items_.cells) occupied[CellKey<D>::layer(cell.key)] = true;
        for (LayeredCell& cell : items_.cells) {
            cell.parent = no_cell;
            const std::uint32_t own = CellKey<D>::layer(cell.key);
            for (std::uint32_t layer = own + 1; layer < plan_.layers && cell.parent == no_cell; ++layer)
                if (occupied[layer])
                    cell.parent = items_.table.find(
                        items_.cells, CellKey<D>::around(cell.key, layer, plan_.shift[layer] - plan_.shift[own]));
        }
    }

    void build_trees() {
        std::array<std::uint32_t, most_layers + 1> count{};
        for (const LayeredCell& cell : items_.cells) count[CellKey<D>::layer(cell.key)] += cell.residents;
        count[most_layers] = strays_;
        items_.nodes.clear();
        std::uint32_t first = 0;
        for (std::size_t i = 0; i < count.size(); ++i) {
            items_.runs[i] = build_runs(items_.boxes, first, count[i], items_.nodes);
            first += count[i];
        }
    }

    LayeredItems<D>& items_;
    const LayeredPlan<D>& plan_;
    std::span<const Aabb<D>> given_;
    std::vector<std::uint32_t>& cell_of_;  ///< by index; its memory is needed for the low words only later
    std::uint32_t strays_ = 0, guests_ = 0;
};

}  // namespace

template <int D>
void LayeredItems<D>::reserve(std::size_t count) {
    boxes.reserve(count);
    for (auto* row : {&index, &low, &high}) row->reserve(count + guest_slack);
    for (auto* row : {&guest_low, &guest_high, &guest_place}) row->reserve(2 * count + 64);
    cells.reserve(count / 2 + 1024);
    spare.reserve(count / 2 + 1024);
    table.reserve(count / 2 + 1024);
    nodes.reserve(count / (BoxRuns::width - 1) + 12 * runs.size());
}

template <int D>
void LayeredItems<D>::forget_cells() {
    cells.clear();
    sorted_cells = 0;
    table.assign(cells);
}

template <int D>
void LayeredItems<D>::fill(const LayeredPlan<D>& plan, std::span<const Aabb<D>> given) {
    Filling<D>(*this, plan, given).run();
}

template <int D>
double LayeredItems<D>::work() const {
    double result = 0;
    for (const LayeredCell& cell : cells) {
        const double all = static_cast<double>(cell.residents) + static_cast<double>(cell.guests);
        result += 0.5 * all * all;
        if (cell.parent == no_cell) continue;
        const LayeredCell& parent = cells[cell.parent];
        result += all * (static_cast<double>(parent.residents) + static_cast<double>(parent.guests));
    }
    return result;
}

template struct LayeredItems<2>;
template struct LayeredItems<3>;

}  // namespace abut
