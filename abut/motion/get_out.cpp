#include <abut/motion/get_out.hpp>
#include <abut/motion/plane_solver.hpp>

#include <array>

namespace abut {
namespace {

/// The bound on pushes: each new one is of what the last one came to.
constexpr int most_pushes = 12;

template <int D>
double least_gap(std::span<const NearContact<D>> contacts) {
    double result = std::numeric_limits<double>::infinity();
    for (const NearContact<D>& contact : contacts) result = std::min(result, contact.gap);
    return result;
}

/// The least move after which all gaps are `wanted`, or as wide as they are.
template <int D>
bool push_to(std::span<const NearContact<D>> contacts, double wanted, double tolerance, DVec<D>& push) {
    std::array<MovePlane<D>, most_move_planes> planes;
    const std::size_t count = std::min(contacts.size(), most_move_planes);
    for (std::size_t i = 0; i < count; ++i) planes[i] = {contacts[i].normal, contacts[i].gap - wanted};
    return nearest_move<D>(std::span<const MovePlane<D>>(planes.data(), count), DVec<D>(0.0), tolerance, push);
}

}  // namespace

template <int D>
WayOut<D> way_out(NearSurface<D>& near, const DVec<D>& at, double enough, double wanted, double reach) {
    const double tolerance = 1e-6 * near.size();
    WayOut<D> result;
    for (int i = 0; i < most_pushes; ++i) {
        const std::span<const NearContact<D>> contacts = near.contacts(at + result.push, reach);
        if (!(least_gap(contacts) < enough)) break;
        DVec<D> push(0.0);
        // What touches has no way to go where planes leave none; the deepest alone is better than nothing.
        if (!push_to(contacts, wanted, tolerance, push) && !push_to(contacts, 2 * tolerance, tolerance, push)) {
            const auto deepest =
                std::min_element(contacts.begin(), contacts.end(),
                                 [](const NearContact<D>& a, const NearContact<D>& b) { return a.gap < b.gap; });
            if (deepest->gap >= -tolerance) break;
            push = deepest->normal * -deepest->gap;
        }
        const std::optional<FirstTouch<D>> stop = near.first_touch(at + result.push, push, 0);
        if (stop) push *= stop->fraction;
        if (length(push) < tolerance) break;
        result.push += push;
    }
    result.depth = std::max(0.0, -least_gap(near.contacts(at + result.push, reach)));
    return result;
}

template WayOut<2> way_out(NearSurface<2>&, const DVec<2>&, double, double, double);
template WayOut<3> way_out(NearSurface<3>&, const DVec<3>&, double, double, double);

}  // namespace abut
