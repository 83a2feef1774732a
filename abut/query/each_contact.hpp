#pragma once

// Where do all parts of two shapes touch?

#include <abut/broad_phase/visit.hpp>
#include <abut/query/contact.hpp>

namespace abut {

/// The same of views; the visitor returns false to stop.
template <int D>
void each_contact_of(const View<D>& a, const View<D>& b, const QueryOptions<D>& options,
                     FunctionRef<bool(const Contact<D>&)> visit);

/// visit(contact) for each pair of parts that touch, in no order that is promised; it returns nothing, or false to
/// stop. The set of contacts is the same however the parts are numbered. With a margin, for parts up to so far apart as
/// well. The features tell which parts.
///
/// Normals are those of the surfaces as they are felt from outside, not those of edges where part meets part: what lies
/// on a floor of tiles is pushed up alone. Where a pair's own normal is such an edge's, the pair is left out if another
/// tells the truth there, or else told with the normal and depth of the surface, and one point. Edges lower than about
/// a thousandth of the smaller one's size aren't felt.
template <class A, class B, Visitor<Contact<dimension<A>>> F>
requires Pair<A, B>
void each_contact(const A& a, const B& b, F&& visit, const QueryOptions<dimension<A>>& options = {}) {
    constexpr int D = dimension<A>;
    detail::with_view(a, [&](const View<D>& x) {
        detail::with_view(b, [&](const View<D>& y) { each_contact_of<D>(x, y, options, go_on_after(visit)); });
    });
}
template <class A, class B, class F, class Why = detail::WhyNoPair<A, B>>
auto each_contact(const A& a, const B& b, F&& visit, const QueryOptions<detail::dimension_or_3<A>>& options = {});

}  // namespace abut
