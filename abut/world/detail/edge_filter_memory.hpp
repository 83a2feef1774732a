#pragma once

// The owner of the memory of a world's filter of internal edges.

#include <memory>

namespace abut::detail {

template <int D>
struct EdgeFilterState;

template <int D>
struct DeleteEdgeFilterState {
    void operator()(EdgeFilterState<D>* state) const;
};

/// It serves one update at a time, so a copy has none yet.
template <int D>
struct EdgeFilterMemory : std::unique_ptr<EdgeFilterState<D>, DeleteEdgeFilterState<D>> {
    EdgeFilterMemory() = default;
    EdgeFilterMemory(const EdgeFilterMemory&) noexcept : EdgeFilterMemory() {}
    EdgeFilterMemory& operator=(const EdgeFilterMemory&) noexcept { return *this; }
    EdgeFilterMemory(EdgeFilterMemory&&) noexcept = default;
    EdgeFilterMemory& operator=(EdgeFilterMemory&&) noexcept = default;
};

extern template struct DeleteEdgeFilterState<2>;
extern template struct DeleteEdgeFilterState<3>;

}  // namespace abut::detail
