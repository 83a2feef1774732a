// Compiled once for each kind of vector unit by Highway, which takes the best of them when the program runs. The guests
// come in the same order from all of them. Whole vectors are written, of which the next ones overwrite what is not
// wanted: so the cells' guests are fetched one cell after the other.

#include <abut/broad_phase/layered_guests.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/broad_phase/layered_guests.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<std::uint32_t, guest_slack>;
using Vector = hn::Vec<Lanes>;
constexpr Lanes d;
constexpr std::uint32_t lanes = static_cast<std::uint32_t>(hn::MaxLanes(d));

/// Those residents of a cell that go on over these axes; `next` is where they are written. Returns where they end.
template <int D>
std::uint32_t fetch_from(LayeredItems<D>& items, const LayeredCell& from, std::uint32_t axes, std::uint32_t next) {
    using Format = CellFormat<D>;
    const Vector crossed = hn::Set(d, Format::fields(1u << Format::cell_bits, axes));
    const Vector fields = hn::Set(d, Format::fields(Format::field, axes));
    const Vector flags = hn::Set(d, axes << Format::first_flag), end = hn::Set(d, from.first + from.residents);
    for (std::uint32_t place = from.first; place < from.first + from.residents; place += lanes) {
        const Vector low = hn::LoadU(d, items.low.data() + place), high = hn::LoadU(d, items.high.data() + place);
        const Vector places = hn::Iota(d, place);
        const auto goes_on = hn::And(hn::Eq(hn::And(high, crossed), crossed), hn::Lt(places, end));
        const Vector guest_low = hn::Or(hn::AndNot(fields, low), flags), guest_high = hn::Sub(high, crossed);
        hn::StoreU(hn::Compress(guest_low, goes_on), d, items.guest_low.data() + next);
        hn::StoreU(hn::Compress(guest_high, goes_on), d, items.guest_high.data() + next);
        hn::StoreU(hn::Compress(places, goes_on), d, items.guest_place.data() + next);
        next += static_cast<std::uint32_t>(hn::CountTrue(d, goes_on));
    }
    return next;
}

template <int D>
void fetch(LayeredItems<D>& items, std::uint32_t count) {
    for (auto* row : {&items.guest_low, &items.guest_high, &items.guest_place}) row->resize(count + guest_slack);
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < items.cells.size(); ++i) {
        LayeredCell& cell = items.cells[i];
        cell.first_guest = next;
        for (std::uint32_t axes = 1; axes < 1u << D; ++axes)
            if (items.spare[i][axes] != no_cell)
                next = fetch_from(items, items.cells[items.spare[i][axes]], axes, next);
        cell.guests = next - cell.first_guest;
    }
}
void fetch_2(LayeredItems<2>& items, std::uint32_t count) {
    fetch<2>(items, count);
}
void fetch_3(LayeredItems<3>& items, std::uint32_t count) {
    fetch<3>(items, count);
}

}  // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(fetch_2);
HWY_EXPORT(fetch_3);

void fetch_guests(LayeredItems<2>& items, std::uint32_t count) {
    HWY_DYNAMIC_DISPATCH(fetch_2)(items, count);
}
void fetch_guests(LayeredItems<3>& items, std::uint32_t count) {
    HWY_DYNAMIC_DISPATCH(fetch_3)(items, count);
}

}  // namespace abut
#endif
