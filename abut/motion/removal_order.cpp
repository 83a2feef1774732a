#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/motion/order/precedence.hpp>
#include <abut/motion/removal_order.hpp>
#include <abut/query/detail/valid_query.hpp>

#include <algorithm>
#include <functional>
#include <queue>

namespace abut {

using namespace detail;

namespace {

/// An adjacency list for each shape, in one array.
class AdjacencyLists {
public:
    template <class Key, class Value>
    AdjacencyLists(std::size_t count, const std::vector<Precedence>& edges, Key key, Value value)
        : begin_(count + 1, 0) {
        for (const Precedence& edge : edges) ++begin_[key(edge) + 1];
        for (std::size_t i = 0; i < count; ++i) begin_[i + 1] += begin_[i];
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        items_.resize(edges.size());
        for (const Precedence& edge : edges) items_[next[key(edge)]++] = value(edge);
    }
    std::span<const std::uint32_t> operator[](std::uint32_t i) const {
        return std::span(items_).subspan(begin_[i], begin_[i + 1] - begin_[i]);
    }

private:
    std::vector<std::size_t> begin_;
    std::vector<std::uint32_t> items_;
};

/// Follows the lowest blocker from shape to shape until one repeats.
std::vector<std::uint32_t> find_cycle(const AdjacencyLists& uppers, const std::vector<bool>& removed) {
    std::uint32_t at = 0;
    while (removed[at]) ++at;
    std::vector<std::uint32_t> path;
    for (std::size_t step = 0; step <= removed.size(); ++step) {
        const auto repeated = std::find(path.begin(), path.end(), at);
        if (repeated != path.end()) {
            path.erase(path.begin(), repeated);
            break;
        }
        path.push_back(at);
        std::uint32_t next = static_cast<std::uint32_t>(removed.size());
        for (const std::uint32_t upper : uppers[at])
            if (!removed[upper]) next = std::min(next, upper);
        at = next;
    }
    std::rotate(path.begin(), std::min_element(path.begin(), path.end()), path.end());
    return path;
}

/// Topological sort, lowest index first: Kahn, "Topological sorting of large networks" (1962). The result depends only
/// on the precedence relation, and not on which of its edges are listed.
RemovalOrder topological_order(std::size_t count, const std::vector<Precedence>& edges) {
    const auto lower = [](const Precedence& edge) { return edge.lower; };
    const auto upper = [](const Precedence& edge) { return edge.upper; };
    const AdjacencyLists lowers(count, edges, upper, lower);
    std::vector<std::size_t> blocker_count(count, 0);
    for (const Precedence& edge : edges) ++blocker_count[edge.lower];

    RemovalOrder result;
    result.order.reserve(count);
    std::vector<bool> removed(count, false);
    std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> free;
    for (std::uint32_t i = 0; i < count; ++i)
        if (blocker_count[i] == 0) free.push(i);
    while (!free.empty()) {
        const std::uint32_t next = free.top();
        free.pop();
        result.order.push_back(next);
        removed[next] = true;
        for (const std::uint32_t below : lowers[next])
            if (--blocker_count[below] == 0) free.push(below);
    }
    if (result.order.size() < count) result.cycle = find_cycle(AdjacencyLists(count, edges, lower, upper), removed);
    return result;
}

}  // namespace

template <int D>
RemovalOrder removal_order(std::span<const Convex<D>> shapes, const Vec<D>& direction) {
    detail::enter_library();
    const bool is_direction = is_finite(direction) && direction != Vec<D>(0);
    ABUT_ASSERT(is_direction);
    std::vector<Convex<D>> finite;
    std::vector<std::uint32_t> index;
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
        if (!detail::is_valid_query(shapes[i])) continue;
        finite.push_back(shapes[i]);
        index.push_back(i);
    }
    std::vector<Precedence> edges;
    if (is_direction) edges = precedences(finite, normalized(DVec<D>(direction)));
    for (Precedence& edge : edges) edge = {index[edge.lower], index[edge.upper]};
    return topological_order(shapes.size(), edges);
}

template RemovalOrder removal_order(std::span<const Convex<2>>, const Vec<2>&);
template RemovalOrder removal_order(std::span<const Convex<3>>, const Vec<3>&);

}  // namespace abut
