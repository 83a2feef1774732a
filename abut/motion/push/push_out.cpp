#include <abut/motion/push/plane_solver.hpp>
#include <abut/motion/push/push_out.hpp>

#include <array>

namespace abut::detail {
namespace {

/// Maximum number of pushes; each one uses the contacts after the last one.
constexpr int max_pushes = 12;

template <int D>
double min_gap(std::span<const NearContact<D>> contacts) {
    double result = std::numeric_limits<double>::infinity();
    for (const NearContact<D>& contact : contacts) result = std::min(result, contact.gap);
    return result;
}

/// The minimal move after which all gaps are at least `target` or unchanged.
template <int D>
bool push_to(std::span<const NearContact<D>> contacts, double target, double tolerance, DVec<D>& push) {
    std::array<MovePlane<D>, max_move_planes> planes;
    const std::size_t count = std::min(contacts.size(), max_move_planes);
    for (std::size_t i = 0; i < count; ++i) planes[i] = {contacts[i].normal, contacts[i].gap - target};
    return nearest_move<D>(std::span<const MovePlane<D>>(planes.data(), count), DVec<D>(0.0), tolerance, push);
}

}  // namespace

template <int D>
PushOut<D> push_out(NearbySurface<D>& near, const DVec<D>& at, double trigger, double target, double reach) {
    const double tolerance = 1e-6 * near.size();
    PushOut<D> result;
    for (int i = 0; i < max_pushes; ++i) {
        const std::span<const NearContact<D>> contacts = near.contacts(at + result.push, reach);
        if (!(min_gap(contacts) < trigger)) break;
        DVec<D> push(0.0);
        // If the planes leave no solution, the deepest contact alone is resolved.
        if (!push_to(contacts, target, tolerance, push) && !push_to(contacts, 2 * tolerance, tolerance, push)) {
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
    result.depth = std::max(0.0, -min_gap(near.contacts(at + result.push, reach)));
    return result;
}

template PushOut<2> push_out(NearbySurface<2>&, const DVec<2>&, double, double, double);
template PushOut<3> push_out(NearbySurface<3>&, const DVec<3>&, double, double, double);

}  // namespace abut::detail
