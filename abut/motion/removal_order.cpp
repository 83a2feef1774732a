#include <abut/math/assert.hpp>
#include <abut/motion/removal_order.hpp>
#include <abut/motion/waits.hpp>

#include <algorithm>
#include <functional>
#include <queue>

namespace abut {
namespace {

/// For each shape a list of others, all in one row.
class Lists {
public:
    template <class Key, class Value>
    Lists(std::size_t count, const std::vector<Wait>& waits, Key key, Value value) : begin_(count + 1, 0) {
        for (const Wait& wait : waits) ++begin_[key(wait) + 1];
        for (std::size_t i = 0; i < count; ++i) begin_[i + 1] += begin_[i];
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        items_.resize(waits.size());
        for (const Wait& wait : waits) items_[next[key(wait)]++] = value(wait);
    }
    std::span<const std::uint32_t> operator[](std::uint32_t i) const {
        return std::span(items_).subspan(begin_[i], begin_[i + 1] - begin_[i]);
    }

private:
    std::vector<std::size_t> begin_;
    std::vector<std::uint32_t> items_;
};

/// Goes from one that is left to the lowest that blocks it, until it comes by for the second time.
std::vector<std::uint32_t> find_cycle(const Lists& uppers, const std::vector<bool>& gone) {
    std::uint32_t at = 0;
    while (gone[at]) ++at;
    std::vector<std::uint32_t> path;
    for (std::size_t step = 0; step <= gone.size(); ++step) {
        const auto seen = std::find(path.begin(), path.end(), at);
        if (seen != path.end()) {
            path.erase(path.begin(), seen);
            break;
        }
        path.push_back(at);
        std::uint32_t next = static_cast<std::uint32_t>(gone.size());
        for (const std::uint32_t upper : uppers[at])
            if (!gone[upper]) next = std::min(next, upper);
        at = next;
    }
    std::rotate(path.begin(), std::min_element(path.begin(), path.end()), path.end());
    return path;
}

/// Kahn, "Topological sorting of large networks" (1962), of those that could leave the lowest index first: an order
/// that depends only on who is above whom, and not on which of the waits were told.
RemovalOrder sorted(std::size_t count, const std::vector<Wait>& waits) {
    const auto lower = [](const Wait& wait) { return wait.lower; };
    const auto upper = [](const Wait& wait) { return wait.upper; };
    const Lists lowers(count, waits, upper, lower);
    std::vector<std::size_t> waiting_for(count, 0);
    for (const Wait& wait : waits) ++waiting_for[wait.lower];

    RemovalOrder result;
    result.order.reserve(count);
    std::vector<bool> gone(count, false);
    std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> free;
    for (std::uint32_t i = 0; i < count; ++i)
        if (waiting_for[i] == 0) free.push(i);
    while (!free.empty()) {
        const std::uint32_t next = free.top();
        free.pop();
        result.order.push_back(next);
        gone[next] = true;
        for (const std::uint32_t below : lowers[next])
            if (--waiting_for[below] == 0) free.push(below);
    }
    if (result.order.size() < count) result.cycle = find_cycle(Lists(count, waits, lower, upper), gone);
    return result;
}

}  // namespace

template <int D>
RemovalOrder removal_order(std::span<const Convex<D>> shapes, const Vec<D>& direction) {
    const bool leads_somewhere = is_finite(direction) && direction != Vec<D>(0);
    ABUT_ASSERT(leads_somewhere);
    std::vector<Convex<D>> finite;
    std::vector<std::uint32_t> index;
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
        const bool is_sound = is_finite(shapes[i]);
        ABUT_ASSERT(is_sound);
        if (!is_sound) continue;
        finite.push_back(shapes[i]);
        index.push_back(i);
    }
    std::vector<Wait> who_waits;
    if (leads_somewhere) who_waits = waits(finite, normalized(DVec<D>(direction)));
    for (Wait& wait : who_waits) wait = {index[wait.lower], index[wait.upper]};
    return sorted(shapes.size(), who_waits);
}

template RemovalOrder removal_order(std::span<const Convex<2>>, const Vec<2>&);
template RemovalOrder removal_order(std::span<const Convex<3>>, const Vec<3>&);

}  // namespace abut
