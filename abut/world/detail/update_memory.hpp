#pragma once

// The owner of the memory that a world needs during an update.

#include <memory>

namespace abut::detail {

template <int D>
struct UpdateState;

template <int D>
struct DeleteUpdateState {
    void operator()(UpdateState<D>* state) const;
};

/// It serves one update at a time, so a copy has none yet.
template <int D>
struct UpdateMemory : std::unique_ptr<UpdateState<D>, DeleteUpdateState<D>> {
    UpdateMemory() = default;
    UpdateMemory(const UpdateMemory&) noexcept : UpdateMemory() {}
    UpdateMemory& operator=(const UpdateMemory&) noexcept { return *this; }
    UpdateMemory(UpdateMemory&&) noexcept = default;
    UpdateMemory& operator=(UpdateMemory&&) noexcept = default;
};

extern template struct DeleteUpdateState<2>;
extern template struct DeleteUpdateState<3>;

}  // namespace abut::detail
