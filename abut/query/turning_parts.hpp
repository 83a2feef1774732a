#pragma once

// When any part of one shape first meets any part of another, both on rigid paths. For .cpp files.

#include <abut/query/turning_search.hpp>
#include <abut/shape/view/view.hpp>

namespace abut {

/// As `first_meeting` of two parts; the feature names the part of B.
template <int D>
bool first_meeting(const View<D>& a, const RigidPath<D>& path_a, const View<D>& b, const RigidPath<D>& path_b,
                   const SearchOptions<D>& options, Meeting<D>& meeting);

}  // namespace abut
