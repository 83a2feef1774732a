#pragma once

// Linear sweeps for callers that filter the normal of the first of many hits. For .cpp files.

#include <abut/query/hit.hpp>
#include <abut/shape/view/view.hpp>

#include <optional>

namespace abut::detail {

/// Like abut::sweep against a shape at rest. The normal is that of the part that was hit, which may be one of an
/// internal edge, except between solids.
template <int D>
std::optional<Hit<D>> sweep_unfiltered(const View<D>& a, const Vec<D>& motion, const View<D>& b);

}  // namespace abut::detail
