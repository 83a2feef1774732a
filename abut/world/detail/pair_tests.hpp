#pragma once

// The tests of a world's near pairs in an update. For .cpp files.

#include <abut/world/detail/update_state.hpp>
#include <abut/world/world.hpp>

#include <array>
#include <cstdint>
#include <span>

namespace abut {

/// The tests of consecutive near pairs, with their contacts filtered. Several may run at the same time: they change
/// their own memory and results alone, except for what Neighbourhoods says.
template <int D>
class World<D>::PairTests {
public:
    PairTests(World& world, detail::PairTestMemory<D>& memory, detail::PairResults<D>& results, bool is_first_part)
        : world_(world), memory_(memory), results_(results), is_first_part_(is_first_part) {}

    /// Tests near_[begin] to near_[end - 1], a part of the results.
    void run(std::size_t begin, std::size_t end);

private:
    /// Two items, in the order of their ids.
    struct Pair {
        detail::SlotPair slots;
        const Item &a, &b;

        bool has_sensor() const { return (a.sensor | b.sensor) != 0; }
        IdPair ids() const { return {{slots.a + 1, a.generation}, {slots.b + 1, b.generation}}; }
    };
    Pair pair_of(const detail::SlotPair& slots) const { return {slots, items_[slots.a], items_[slots.b]}; }

    /// A measured test of the balls: readings of the clock, two at once before and one after it.
    struct BallSample {
        std::array<std::uint64_t, 3> clock;
        bool overlap;
    };
    static constexpr int ball_repetitions = 16;

    void test_pair(const Pair& pair);
    bool test_touch(const Pair& pair);
    void test_motion(const Pair& pair, bool touch);
    void repeat_last(const Pair& pair);
    bool balls_apart(const Pair& pair) const;
    bool test_shapes(const Pair& pair);
    BallSample measure_balls(const Pair& pair) const;
    void add_sample(detail::BallEarlyOuts::Entry& entry, const BallSample& sample, bool touch);

    // The filter of internal edges.
    bool find_contact(const Pair& pair);
    bool find_surface_contacts(const Pair& pair);
    void filter_contacts();
    bool needs_filter(std::uint32_t slot);
    bool find_sides_to_filter(const WorldContact<D>& found, detail::UnfilteredContact<D>& unfiltered);
    bool is_center_covered(std::uint32_t slot);
    /// One of the two items of a contact, with its neighbours near the contact if they are known.
    struct ContactSide {
        std::uint32_t slot, other;
        bool is_filtered;
        const detail::NearNeighbours<D>* near = nullptr;
    };
    template <class Visit>
    void each_closest_point_beside(const ContactSide& side, const detail::DVec<D>& point, double within,
                                   const Visit& visit);
    template <class Use>
    void with_neighbours(const ContactSide& a, const ContactSide& b, const Use& use);
    void set_found(std::size_t index, const detail::SurfaceContact<D>& filtered);

    /// Relative to frame_.
    const View<D>& placed_view(std::uint32_t slot) {
        const auto place = [&] { return items_[slot].stored.placed(items_[slot].pose); };
        View<D>& view = memory_.views.of(slot, place);
        if (is_large_) move_to_frame(slot, view);
        return view;
    }
    void move_to_frame(std::uint32_t slot, View<D>& view);
    void set_frame(std::uint32_t slot) {
        if (is_large_) frame_ = world_.positions_.of(slot);
    }
    /// Of two items at the same time.
    std::pair<const View<D>&, const View<D>&> placed_views(const detail::SlotPair& slots) {
        const View<D>* first = &placed_view(slots.a);
        if (memory_.views.share_place(slots.a, slots.b)) first = std::construct_at(&memory_.first, *first);
        return {*first, placed_view(slots.b)};
    }

    World& world_;
    const std::span<const Item> items_ = world_.items_;
    detail::Neighbourhoods<D>& neighbours_ = world_.memory_->neighbours;
    detail::PairTestMemory<D>& memory_;
    detail::PairResults<D>& results_;
    bool is_first_part_;
    const bool is_large_ = world_.positions_.are_used();  ///< positions are doubles
    /// The position that contacts and all that is tested are relative to: that of item A if positions are doubles.
    detail::DVec<D> frame_{0.0};
};

}  // namespace abut
