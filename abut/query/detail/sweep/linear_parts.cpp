#include <abut/math/detail/next_float.hpp>
#include <abut/query/detail/sdf/function_motion.hpp>
#include <abut/query/detail/sweep/linear.hpp>

namespace abut::detail {
namespace {

/// The swept box of a part along the path.
template <int D>
MovingBox<D> moving_box(const Aabb<D>& box, const DVec<D>& direction, double length) {
    const DVec<D> low(box.min), high(box.max);
    return {(low + high) * 0.5, (high - low) * 0.5, direction, length};
}

/// The first impact over all pairs of parts.
template <int D>
class FirstImpact {
public:
    FirstImpact(const Path<D>& path, const SweepOptions<D>& options) : path_(path), options_(options) {}

    void search(const View<D>& a, const View<D>& b) {
        each_part_on_path(a, b, -path_.direction, [&](const Part<D>& part_a, std::uint32_t index_a) {
            each_part_on_path(b, part_a, path_.direction, [&](const Part<D>& part_b, std::uint32_t index_b) {
                test_pair(part_a, index_a, part_b, index_b);
            });
        });
    }

    bool found() const { return any_; }
    const LinearImpact<D>& first() const { return first_; }

private:
    /// Calls visit(part, index) for a shape that is one part, or for the parts of a composite shape that another shape,
    /// moving along `direction`, may touch no later than the first known impact.
    template <class Other, class Visit>
    void each_part_on_path(const View<D>& shape, const Other& other, const DVec<D>& direction, const Visit& visit) {
        const auto visit_and_reach = [&](const Convex<D>& part, std::uint32_t index) -> float {
            visit(part, index);
            return next_up(static_cast<float>(reach()));
        };
        detail::with_part(
            shape, [&](const Part<D>& part) { visit(part, 0u); },
            [&](const Composite<D>& composite) {
                const MovingBox<D> moving = moving_box(bounds(other), direction, reach());
                if (std::isfinite(length_squared(moving.half)))
                    each_part_along<D>(composite, moving, visit_and_reach);
                else
                    each_part<D>(composite, bounds(composite), [&](const Convex<D>& part, std::uint32_t index) -> bool {
                        return visit_and_reach(part, index) >= 0;
                    });
            });
    }

    double reach() const { return any_ ? first_.along : path_.length; }

    void test_pair(const Part<D>& part_a, std::uint32_t index_a, const Part<D>& part_b, std::uint32_t index_b) {
        LinearImpact<D> impact;
        if (!front_time_of_impact(part_a, path_, part_b, index_b, options_, impact)) return;
        // Of several parts hit at one distance the lowest wins, whatever the order of the visits.
        if (any_ &&
            (impact.along > first_.along ||
             (impact.along == first_.along && std::pair(index_b, index_a) >= std::pair(first_.feature.part, index_a_))))
            return;
        any_ = true;
        first_ = impact;
        index_a_ = index_a;
    }

    Path<D> path_;
    SweepOptions<D> options_;
    bool any_ = false;
    LinearImpact<D> first_;
    std::uint32_t index_a_ = 0;  ///< of the part of A
};

}  // namespace

template <int D>
bool mixed_time_of_impact(const Part<D>& a, const Path<D>& path, const Part<D>& b, std::uint32_t index,
                          const SweepOptions<D>& options, LinearImpact<D>& impact) {
    if (a.is_function() || b.is_function()) return function_time_of_impact(a, path, b, index, impact);
    if (a.is_half_space() && b.is_half_space()) return false;
    return a.is_half_space() ? time_of_impact<D>(a.half_space(), path, b.convex(), index, options, impact)
                             : time_of_impact<D>(a.convex(), path, b.half_space(), index, options, impact);
}

template <int D>
bool first_impact(const View<D>& a, const Path<D>& path, const View<D>& b, const SweepOptions<D>& options,
                  LinearImpact<D>& impact) {
    FirstImpact<D> first(path, options);
    first.search(a, b);
    if (first.found()) impact = first.first();
    return first.found();
}

#define ABUT_INSTANTIATE(D)                                                                            \
    template bool mixed_time_of_impact(const Part<D>&, const Path<D>&, const Part<D>&, std::uint32_t,  \
                                       const SweepOptions<D>&, LinearImpact<D>&);                      \
    template bool first_impact(const View<D>&, const Path<D>&, const View<D>&, const SweepOptions<D>&, \
                               LinearImpact<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
