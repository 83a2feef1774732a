#pragma once

// Contacts of two shapes that have others beside them. For .cpp files.

#include <abut/query/contact.hpp>
#include <abut/query/felt_contact.hpp>

namespace abut {

/// As each_contact, where the others are part of the surfaces; also told whether the contact stands in for a normal
/// that isn't felt.
template <int D>
void each_contact_among(const View<D>& a, const View<D>& b, const QueryOptions<D>& options, const Others<D>& others,
                        FunctionRef<bool(const Contact<D>&, const FeltBy&)> visit);

template <int D>
struct ContactAmong {
    Contact<D> contact;  ///< none: nothing of the surfaces as they are felt touches
    bool touch = false;  ///< whether the shapes themselves do
    FeltBy felt;         ///< not, where it stands in for a normal that isn't felt
};

/// As contact: the deepest of each_contact_among.
template <int D>
ContactAmong<D> contact_among(const View<D>& a, const View<D>& b, const Others<D>& others);

}  // namespace abut
