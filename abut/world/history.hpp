#pragma once

// The past of a world, for lag compensation: a shot is judged by where the shooter saw the others.

#include <abut/world/world.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace abut {

struct HistoryOptions {
    /// The items on one of these layers are recorded. All others are, at every tick, as at the last record.
    std::uint64_t layers = ~std::uint64_t{0};
};

/// Records a world at each tick, and answers queries as the world would have then. A query of the past has the same
/// bits as that of a world rebuilt from the shapes, poses and options of that tick.
///
/// An item takes memory and time for each tick only while it moves or changes, and as long after as a tick before the
/// change is held: 32 bytes a tick in 3D, 20 in 2D. Once it has seen a scene of this size, it allocates nothing.
///
/// A copy has the same past and records the same world. The world must outlive the history, at its address.
template <int D>
class History {
public:
    /// It holds the last `ticks` records, at least one.
    History(const World<D>& world, std::size_t ticks, const HistoryOptions& options = {});
    History(const World<D>&& world, std::size_t ticks, const HistoryOptions& options = {}) = delete;

    /// Records the world as it is now, and returns the number of this tick: 0, 1, 2 and so on. It forgets the oldest
    /// tick if it holds as many as it may.
    ///
    /// The cost is a comparison for each item of the world, and a copy of the pose for each that moved of late.
    std::uint64_t record();

    /// The oldest and the newest tick that are held; 0 before the first record.
    std::uint64_t first_tick() const { return recorded_ - size(); }
    std::uint64_t last_tick() const { return std::max<std::uint64_t>(recorded_, 1) - 1; }
    /// The number of ticks that are held.
    std::size_t size() const { return static_cast<std::size_t>(std::min<std::uint64_t>(recorded_, ticks_)); }
    bool contains(std::uint64_t tick) const { return first_tick() <= tick && tick < recorded_; }

    /// The world at a tick, for any number of queries, on many threads at once; valid until the next `at` or `record`.
    /// It has the ids of that tick: items that were added since are absent, and those that were removed are back. There
    /// are no events, contacts or impacts until a copy of it is updated.
    ///
    /// With a fraction, each item is on its way to its pose at the next tick, at
    /// `pose_at(Motion<D>::between(pose, next_pose), fraction)`; all else is as at the tick itself. After the last tick
    /// nothing moves.
    ///
    /// A tick that isn't held, or a fraction outside [0, 1], trips ABUT_ASSERT; in release it is the nearest one.
    ///
    /// The cost is proportional to the number of recorded items that moved or changed between the oldest tick and the
    /// last one.
    const World<D>& at(std::uint64_t tick, float fraction = 0);

private:
    using Item = detail::WorldItem<D>;
    static constexpr std::uint32_t none = Item::none;

    /// An item but for its pose.
    struct Version {
        Item item;
        std::uint32_t entries = 0;  ///< the number of entries with it; 0 if it is free
    };
    /// What a slot of the world has at a tick.
    struct Entry {
        std::uint32_t version = none;  ///< none: the slot is free
        Pose<D> pose{};
    };
    /// The entries of a slot whose item moved or changed.
    struct Track {
        std::uint32_t slot = none;        ///< none: the track is free
        std::uint64_t last_change = 0;    ///< the last tick whose entry differs from the one before
        std::uint64_t last_recorded = 0;  ///< the last tick with an item that is to be recorded
    };

    bool is_recorded(const Item* item) const { return item != nullptr && (item->layers & options_.layers) != 0; }
    Entry& entry(std::uint32_t track, std::uint64_t tick) { return entries_[track * ticks_ + tick % ticks_]; }
    void grow();
    void record_slot(std::uint32_t slot, std::uint64_t tick);
    void begin_track(std::uint32_t slot, std::uint64_t tick);
    void end_track(std::uint32_t track);
    std::uint32_t add_version(const Item& item);
    void set_entry(Entry& entry, const Entry& value);
    bool is_same_item(const Entry& a, const Entry& b) const;
    void show(std::uint32_t slot, const Item* shown);
    void move(std::uint32_t slot, const Pose<D>& pose);
    void update_box(std::uint32_t slot);

    const World<D>* world_;
    std::size_t ticks_;
    HistoryOptions options_;
    std::uint64_t recorded_ = 0;  // the number of records
    World<D> past_;               // slots without a track are as at the last record, the others as at the last `at`
    std::vector<std::uint32_t> track_of_;  // by slot
    std::vector<Track> tracks_;
    std::vector<Entry> entries_;  // ticks_ for each track
    std::vector<Version> versions_;
    std::vector<std::uint32_t> free_tracks_, free_versions_;
    std::size_t changed_boxes_ = 0;  // since the broad phases of past_ were brought up to date
};

using History2 = History<2>;
using History3 = History<3>;

extern template class History<2>;
extern template class History<3>;

}  // namespace abut
