#include <abut/convex/gjk/epa.hpp>

namespace abut::detail {
namespace {

constexpr int max_descent_steps = 64;

}  // namespace

template <int D>
void minimise_depth(const CoreDifference<D>& difference, EpaResult<D>& result) {
    DVec<D> farthest = difference.support(result.normal).position;
    double step_size = 1;
    for (int step = 0; step < max_descent_steps; ++step) {
        const DVec<D> slope = farthest - result.normal * dot(farthest, result.normal);
        const double scale = largest(farthest);
        if (!(length(slope) > 1e-12 * scale)) return;
        const DVec<D> normal = normalized(result.normal - slope * (step_size / scale));
        const DVec<D> next = difference.support(normal).position;
        const double depth = dot(normal, next);
        if (depth < result.depth) {
            result.normal = normal;
            result.depth = depth;
            farthest = next;
            step_size *= 2;
        } else {
            step_size *= 0.25;
        }
    }
}

template void minimise_depth(const CoreDifference<2>&, EpaResult<2>&);
template void minimise_depth(const CoreDifference<3>&, EpaResult<3>&);

}  // namespace abut::detail
