#include <abut/convex/bucket_sort.hpp>
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

/// For each shape, the end `to` of every edge that has it as its end `from`.
Buckets adjacency_lists(std::size_t count, const std::vector<Precedence>& edges, std::uint32_t Precedence::*from,
                        std::uint32_t Precedence::*to) {
    return in_buckets(count, [&](auto add) {
        for (const Precedence& edge : edges) add(edge.*from, edge.*to);
    });
}

/// Follows the lowest blocker from shape to shape until one repeats.
std::vector<std::uint32_t> find_cycle(const Buckets& uppers, const std::vector<bool>& removed) {
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
        for (const std::uint64_t upper : uppers.bucket(at))
            if (!removed[upper]) next = std::min(next, static_cast<std::uint32_t>(upper));
        at = next;
    }
    std::rotate(path.begin(), std::min_element(path.begin(), path.end()), path.end());
    return path;
}

/// Topological sort, lowest index first: Kahn, "Topological sorting of large networks" (1962). The result depends only
/// on the precedence relation, and not on which of its edges are listed.
RemovalOrder topological_order(std::size_t count, const std::vector<Precedence>& edges) {
    const Buckets lowers = adjacency_lists(count, edges, &Precedence::upper, &Precedence::lower);
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
        for (const std::uint64_t below : lowers.bucket(next))
            if (--blocker_count[below] == 0) free.push(static_cast<std::uint32_t>(below));
    }
    if (result.order.size() < count) {
        const Buckets uppers = adjacency_lists(count, edges, &Precedence::lower, &Precedence::upper);
        result.cycle = find_cycle(uppers, removed);
    }
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
