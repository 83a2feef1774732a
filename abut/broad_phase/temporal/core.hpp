#pragma once

// The part of Temporal<D> that does not depend on the inner broad phase. Not for users.

#include <abut/broad_phase/temporal/search_window.hpp>
#include <abut/broad_phase/temporal/timed_pairs.hpp>
#include <abut/broad_phase/visit.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/function_ref.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The work of a Temporal, and that of a broad phase that tests everything in each update.
struct TemporalCounts {
    std::uint64_t updates = 0;
    std::uint64_t searches = 0;        ///< searches for the neighbours of an item
    std::uint64_t looks = 0;           ///< tests of a pair: found by a search, or due
    std::uint64_t plain_searches = 0;  ///< one an item and update
    std::uint64_t plain_looks = 0;     ///< one a pair and update, of the pairs that are held
    std::uint64_t too_fast = 0;        ///< items found farther away than their top speed allows
};

namespace detail {

/// Items of like speed are searched for together: a group. Group 0 is searched in each update.
inline constexpr std::uint32_t temporal_groups = 8;

/// The inner structures, one a group.
template <int D>
class TemporalSearch {
public:
    using Found = FunctionRef<void(std::uint32_t, std::uint32_t)>;

    /// `anew` if these are other items than before.
    virtual void set(std::uint32_t group, std::span<const Aabb<D>> boxes, bool anew) = 0;
    virtual void each_pair(std::uint32_t group, Found found) const = 0;
    virtual void each_pair(std::uint32_t group, std::uint32_t other, Found found) const = 0;

protected:
    ~TemporalSearch() = default;
};

template <int D>
struct BoxLanes;

template <int D>
class TemporalCore {
public:
    void build(std::span<const Aabb<D>> boxes, std::span<const float> top_speeds, TemporalSearch<D>& search);
    void update(std::span<const Aabb<D>> boxes, double time, TemporalSearch<D>& search);
    void set_top_speed(std::uint32_t item, float speed);
    void jumped(std::uint32_t item);
    float top_speed(std::uint32_t item) const { return wanted_[item]; }

    void visit_pairs(PairsCall visit, Executor* executor) const;

    std::size_t size() const { return items_.size(); }
    const TemporalCounts& counts() const { return counts_; }

private:
    struct Item {
        Aabb<D> box;  ///< at the group's last search
        float speed;  ///< that no face has exceeded since; infinity in group 0
        std::uint32_t group;
    };
    struct Group {
        std::vector<std::uint32_t> members;  ///< ascending, except those added since the last search
        double start = 0, end = 0;           ///< of the time for which the last search is valid
        float fastest = 0;                   ///< of the members' top speeds at the last search
        float elapsed = 0;                   ///< since the start
        SearchWindow window;
        double waited = 0;     ///< searches made in group 0 for items that belong here
        bool changed = false;  ///< the members differ from those at the last search
        bool left = false;     ///< its tables may have pairs of items that have left
        bool due = false;
    };
    struct Table {
        TimedPairs pairs;
        double start = 0;
    };

    Table& table(std::uint32_t a, std::uint32_t b) { return tables_[a * temporal_groups + b]; }
    void start(std::span<const Aabb<D>> boxes, TemporalSearch<D>& search);
    std::uint32_t group_for(float speed) const;
    std::uint32_t home_of(std::uint32_t item) const;
    void leave(std::uint32_t item);
    void check(const Item& item, const BoxLanes<D>& box);
    void advance(double time);
    void count_waiting();
    void choose_due();
    void test_due(std::span<const Aabb<D>> boxes);
    void remove_left();
    void regroup();
    void search_due(std::span<const Aabb<D>> boxes, TemporalSearch<D>& search);
    void grow(Group& group, std::span<const Aabb<D>> boxes);
    void fill(std::uint32_t a, std::uint32_t b, std::span<const Aabb<D>> boxes, const TemporalSearch<D>& search);
    void count_held();

    std::vector<Item> items_;
    std::vector<float> wanted_;  // the top speeds as they were given last
    std::vector<Aabb<D>> grown_;
    std::array<Group, temporal_groups> groups_;
    std::array<Table, temporal_groups * temporal_groups> tables_;  // of group a with group b, a <= b
    TemporalCounts counts_;
    double now_ = 0, step_ = 0;
    int fastest_ = 0;  // the binary exponent of the top speeds of group 1
};

extern template class TemporalCore<2>;
extern template class TemporalCore<3>;

}  // namespace detail
}  // namespace abut
