#pragma once

// All contacts between two shapes, one for each plane on which they touch.

#include <abut/broad_phase/visit.hpp>
#include <abut/query/contact.hpp>

namespace abut::detail {

/// The query for views; the visitor returns false to stop.
template <int D>
void each_contact_of(const View<D>& a, const View<D>& b, const QueryOptions<D>& options,
                     FunctionRef<bool(const Contact<D>&)> visit);

}  // namespace abut::detail

namespace abut {

/// Calls visit(contact) for each plane on which two shapes touch, in no promised order; visit returns nothing, or false
/// to stop. The contacts of all parts on a plane are joined: of their points, a contact has the deepest and those that
/// span the largest area. A crate in a corner has a contact with the floor and one with the wall. The contacts don't
/// depend on the numbering of the parts. With a margin, parts up to that far apart count as well. The features of a
/// contact name the parts of its deepest point.
///
/// Normals are those of the whole surfaces and not those of internal edges: a box on a floor of tiles is pushed up
/// only, and there are no ghost collisions. The parts of a contact on an internal edge add the area that they have on
/// the planes. If they have none and no other contact covers theirs, it is reported with the normal and depth of the
/// surface. Edges lower than about a thousandth of the smaller shape's size don't count.
template <class A, class B, detail::Visitor<Contact<dimension<A>>> F>
requires Pair<A, B>
void each_contact(const A& a, const B& b, F&& visit, const QueryOptions<dimension<A>>& options = {}) {
    constexpr int D = dimension<A>;
    detail::with_view(a, [&](const View<D>& x) {
        detail::with_view(
            b, [&](const View<D>& y) { detail::each_contact_of<D>(x, y, options, detail::bool_visitor(visit)); });
    });
}
template <class A, class B, class F, class Why = detail::WhyNoPair<A, B>>
auto each_contact(const A& a, const B& b, F&& visit, const QueryOptions<detail::dimension_or_3<A>>& options = {});

}  // namespace abut
