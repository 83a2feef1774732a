#include <abut/query/detail/surface/surface_contacts.hpp>
#include <abut/query/detail/valid_query.hpp>
#include <abut/query/each_contact.hpp>

namespace abut::detail {

template <int D>
void each_contact_of(const View<D>& a, const View<D>& b, const QueryOptions<D>& options,
                     FunctionRef<bool(const Contact<D>&)> visit) {
    if (std::holds_alternative<Composite<D>>(a) || std::holds_alternative<Composite<D>>(b)) {
        if (!detail::is_valid_pair(a, b)) return;
        each_surface_contact<D>(a, b, options, {},
                                [&](const SurfaceContact<D>& found) { return visit(found.contact); });
    } else if (const Contact<D> only = contact(a, b, options)) {
        visit(only);
    }
}

template void each_contact_of(const View<2>&, const View<2>&, const QueryOptions<2>&,
                              FunctionRef<bool(const Contact<2>&)>);
template void each_contact_of(const View<3>&, const View<3>&, const QueryOptions<3>&,
                              FunctionRef<bool(const Contact<3>&)>);

}  // namespace abut::detail
