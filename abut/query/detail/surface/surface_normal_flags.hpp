#pragma once

// Whether the normal of a contact is a surface normal.

namespace abut::detail {

/// `a`: the normal between A and B is one of B's surface, so that A needs no replacement. `b`: it is one of A's
/// surface.
struct SurfaceNormalFlags {
    bool a = true, b = true;

    explicit operator bool() const { return a && b; }
};

}  // namespace abut::detail
