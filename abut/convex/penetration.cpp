#include <abut/convex/penetration.hpp>

namespace abut {
namespace {

constexpr int most_descents = 64;

}  // namespace

template <int D>
void descend(const CoreDifference<D>& difference, Penetration<D>& found) {
    DVec<D> farthest = difference.support(found.normal).position;
    double pace = 1;
    for (int step = 0; step < most_descents; ++step) {
        const DVec<D> slope = farthest - found.normal * dot(farthest, found.normal);
        const double scale = largest(farthest);
        if (!(length(slope) > 1e-12 * scale)) return;
        const DVec<D> normal = normalized(found.normal - slope * (pace / scale));
        const DVec<D> next = difference.support(normal).position;
        const double depth = dot(normal, next);
        if (depth < found.depth) {
            found.normal = normal;
            found.depth = depth;
            farthest = next;
            pace *= 2;
        } else {
            pace *= 0.25;
        }
    }
}

template void descend(const CoreDifference<2>&, Penetration<2>&);
template void descend(const CoreDifference<3>&, Penetration<3>&);

}  // namespace abut
