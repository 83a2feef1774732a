#pragma once

// Two boxes of space where they stand, without a pose on top: asked as they were given. For .cpp files.

#include <abut/query/direct.hpp>
#include <abut/shape/box.hpp>

namespace abut {

DirectAnswer direct_overlap(const Box3& a, const Box3& b);

/// False where it has no answer: `result` is as it was then.
bool direct_contact(const Box3& a, const Box3& b, double margin, Cache* cache, Contact<3>& result);

}  // namespace abut
