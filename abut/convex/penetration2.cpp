#include <abut/convex/penetration.hpp>

namespace abut {
namespace {

/// A convex polygon inside A - B, counter-clockwise.
struct GrowingPolygon {
    std::array<DifferencePoint<2>, penetration_most_steps + 4> points;
    std::size_t count = 0;

    const DifferencePoint<2>& after(std::size_t i) const { return points[i + 1 == count ? 0 : i + 1]; }

    DVec<2> outward(std::size_t i) const {
        const DVec<2> along = after(i).position - points[i].position;
        return normalized(DVec<2>(along.y, -along.x));
    }

    void insert_after(std::size_t i, const DifferencePoint<2>& point) {
        for (std::size_t j = count; j > i + 1; --j) points[j] = points[j - 1];
        points[i + 1] = point;
        ++count;
    }

    /// The place on the outline nearest to `target`.
    Simplex<2> outline_near(const DVec<2>& target) const {
        Simplex<2> best;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < count; ++i) {
            const Simplex<2> edge = face_near({points[i], after(i)}, target);
            const double distance = length_squared(edge.combine(&DifferencePoint<2>::position) - target);
            if (distance >= least) continue;
            least = distance;
            best = edge;
        }
        return best;
    }
};

void record(const GrowingPolygon& polygon, std::size_t edge, double distance, double extent, Trace<2>* trace) {
    if (trace == nullptr) return;
    PenetrationStep<2> step;
    step.points = {to_float(polygon.points[edge].position), to_float(polygon.after(edge).position)};
    step.normal = to_float(polygon.outward(edge));
    step.distance = static_cast<float>(distance);
    step.extent = static_cast<float>(extent);
    trace->steps.push_back(step);
}

}  // namespace

Penetration<2> penetration(const CoreDifference<2>& difference, const SearchOptions<2>& options, const Simplex<2>*) {
    Penetration<2> result;

    // 1. Two points far apart; a difference without extent is a point.
    DifferencePoint<2> low = difference.support(DVec<2>(-1, 0)), high = difference.support(DVec<2>(1, 0));
    const DifferencePoint<2> bottom = difference.support(DVec<2>(0, -1)), top = difference.support(DVec<2>(0, 1));
    if (length_squared(top.position - bottom.position) > length_squared(high.position - low.position)) {
        low = bottom;
        high = top;
    }
    const DVec<2> base = high.position - low.position;
    const double scale = std::max(largest(low.position), largest(high.position));
    const double noise = 1e-13 * std::max({scale, largest(low.on_a), largest(low.on_b)});

    // 2. What lies farthest to either side of their line; nothing does where the difference is a segment.
    const DVec<2> right = length(base) <= noise ? DVec<2>(1, 0) : normalized(DVec<2>(base.y, -base.x));
    const DifferencePoint<2> rightmost = difference.support(right), leftmost = difference.support(-right);
    const double right_height = dot(rightmost.position - low.position, right);
    const double left_height = dot(low.position - leftmost.position, right);
    if (right_height + left_height <= noise) {
        const double to_right = dot(rightmost.position, right), to_left = -dot(leftmost.position, right);
        result.exit = PenetrationExit::flat;
        result.normal = to_left < to_right ? -right : right;
        result.depth = std::min(to_left, to_right);
        result.face = face_near({low, high}, DVec<2>(0.0));
        return result;
    }
    GrowingPolygon polygon;
    polygon.points[polygon.count++] = low;
    if (right_height > noise) polygon.points[polygon.count++] = rightmost;
    polygon.points[polygon.count++] = high;
    if (left_height > noise) polygon.points[polygon.count++] = leftmost;

    // 3. Grow at the edge nearest to the origin, until it is an edge of A - B.
    result.depth = std::numeric_limits<double>::infinity();
    for (std::size_t step = 0; step < penetration_most_steps; ++step) {
        std::size_t nearest = 0;
        double least = 0;
        for (std::size_t i = 0; i < polygon.count; ++i) {
            const double distance = dot(polygon.outward(i), polygon.points[i].position);
            if (i == 0 || distance < least) {
                least = distance;
                nearest = i;
            }
        }
        const DVec<2> normal = polygon.outward(nearest);
        const DifferencePoint<2> next = difference.support(normal);
        const double extent = dot(normal, next.position);
        record(polygon, nearest, least, extent, options.trace);
        result.at_least = least;
        if (extent < result.depth) {
            result.normal = normal;
            result.depth = extent;
        }
        if (result.depth - least <= noise + penetration_doubt * std::abs(result.depth)) {
            result.exit = PenetrationExit::exact;
            break;
        }
        if (next.position == polygon.points[nearest].position || next.position == polygon.after(nearest).position) {
            result.exit = PenetrationExit::no_progress;
            break;
        }
        polygon.insert_after(nearest, next);
    }
    // The edge that first gave the normal may have been an inner one.
    result.face = polygon.outline_near(result.normal * result.depth);
    return result;
}

}  // namespace abut
