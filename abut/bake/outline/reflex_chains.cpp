#include <abut/bake/outline/reflex_chains.hpp>
#include <abut/math/predicates.hpp>

namespace abut::outline {

using detail::no_index;

std::uint32_t ReflexChains::add(std::uint32_t point, std::uint32_t below, std::uint32_t above, Link link) {
    const auto node = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({point, below, above, link});
    if (below != no_index) nodes_[below].above = node;
    if (above != no_index) nodes_[above].below = node;
    return node;
}

ReflexChain ReflexChains::begin(std::uint32_t point) {
    const std::uint32_t node = add(point, no_index, no_index, no_index);
    return {node, node, node};
}

void ReflexChains::join_twins(std::uint32_t half_edge, Link link) {
    if (link == no_index) return;
    std::uint32_t other = link;
    if (link >= open) {
        std::uint32_t& first = open_links_[link - open];
        if (first == no_index) {
            first = half_edge;
            return;
        }
        other = first;
    }
    made_.twins[half_edge] = other;
    made_.twins[other] = half_edge;
}

bool ReflexChains::cut(std::uint32_t middle) {
    const Node node = nodes_[middle];
    Node &below = nodes_[node.below], &above = nodes_[node.above];
    if (orientation(made_.points[below.point], made_.points[node.point], made_.points[above.point]) >= 0) return false;
    const auto first = static_cast<std::uint32_t>(made_.origins.size());
    for (const std::uint32_t origin : {below.point, above.point, node.point}) {
        made_.origins.push_back(origin);
        made_.twins.push_back(no_index);
    }
    join_twins(first + 1, node.link);
    join_twins(first + 2, below.link);
    below.link = first;
    below.above = node.above;
    above.below = node.below;
    return true;
}

void ReflexChains::cut_below(std::uint32_t node) {
    while (nodes_[node].below != no_index && nodes_[nodes_[node].below].below != no_index && cut(nodes_[node].below)) {
    }
}

void ReflexChains::cut_above(std::uint32_t node) {
    while (nodes_[node].above != no_index && nodes_[nodes_[node].above].above != no_index && cut(nodes_[node].above)) {
    }
}

void ReflexChains::add_on_top(ReflexChain& chain, std::uint32_t point) {
    chain.top = chain.last = add(point, chain.top, no_index, no_index);
    cut_below(chain.top);
}

void ReflexChains::add_at_bottom(ReflexChain& chain, std::uint32_t point) {
    chain.bottom = chain.last = add(point, no_index, chain.bottom, no_index);
    cut_above(chain.bottom);
}

ReflexChain ReflexChains::split(ReflexChain& chain, std::uint32_t point) {
    const Link link = open + static_cast<Link>(open_links_.size());
    open_links_.push_back(no_index);
    const std::uint32_t last = chain.last, after = nodes_[last].above;
    ReflexChain upper{no_index, chain.top, no_index};
    const std::uint32_t again = add(nodes_[last].point, no_index, after, nodes_[last].link);
    if (chain.top == last) upper.top = again;
    upper.bottom = upper.last = add(point, no_index, again, link);
    cut_above(upper.bottom);

    nodes_[last].link = link;
    chain.top = chain.last = add(point, last, no_index, no_index);
    cut_below(chain.top);
    return upper;
}

void ReflexChains::join(ReflexChain& lower, const ReflexChain& upper) {
    const Node& seam = nodes_[upper.bottom];
    nodes_[lower.top].link = seam.link;
    nodes_[lower.top].above = seam.above;
    if (seam.above != no_index) nodes_[seam.above].below = lower.top;
    lower.last = lower.top;
    if (upper.top != upper.bottom) lower.top = upper.top;
}

}  // namespace abut::outline
