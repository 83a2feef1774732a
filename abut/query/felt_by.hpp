#pragma once

// Who feels the normal of a contact.

namespace abut {

/// Whether the normal between A and B is one of B's surface for A, and one of A's surface for B.
struct FeltBy {
    bool a = true, b = true;

    explicit operator bool() const { return a && b; }
};

}  // namespace abut
