#include <abut/convex/gjk/epa.hpp>

namespace abut::detail {
namespace {

/// A convex polygon inside A - B, counter-clockwise: the expanding polytope in 2D.
struct ExpandingPolygon {
    std::array<DifferencePoint<2>, epa_max_iterations + 4> points;
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

    /// The point of the boundary nearest to `target`.
    Simplex<2> boundary_near(const DVec<2>& target) const {
        Simplex<2> best;
        double smallest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < count; ++i) {
            const Simplex<2> edge = closest_subsimplex({points[i], after(i)}, target);
            const double distance = length_squared(edge.combine(&DifferencePoint<2>::position) - target);
            if (distance >= smallest) continue;
            smallest = distance;
            best = edge;
        }
        return best;
    }
};

void record(const ExpandingPolygon& polygon, std::size_t edge, double distance, double extent, Trace<2>* trace) {
    if (trace == nullptr) return;
    PenetrationStep<2> step;
    step.points = {to_float(polygon.points[edge].position), to_float(polygon.after(edge).position)};
    step.normal = to_float(polygon.outward(edge));
    step.distance = static_cast<float>(distance);
    step.extent = static_cast<float>(extent);
    trace->steps.push_back(step);
}

}  // namespace

EpaResult<2> epa(const CoreDifference<2>& difference, const SearchOptions<2>& options, const Simplex<2>*) {
    EpaResult<2> result;

    // 1. Find two distant points. A difference without extent is a point.
    DifferencePoint<2> low = difference.support(DVec<2>(-1, 0)), high = difference.support(DVec<2>(1, 0));
    const DifferencePoint<2> bottom = difference.support(DVec<2>(0, -1)), top = difference.support(DVec<2>(0, 1));
    if (length_squared(top.position - bottom.position) > length_squared(high.position - low.position)) {
        low = bottom;
        high = top;
    }
    const DVec<2> base = high.position - low.position;
    const double scale = std::max(largest(low.position), largest(high.position));
    const double tolerance = 1e-13 * std::max({scale, largest(low.on_a), largest(low.on_b)});

    // 2. Find the support points on both sides of their line. A difference without any is a segment.
    const DVec<2> right = length(base) <= tolerance ? DVec<2>(1, 0) : normalized(DVec<2>(base.y, -base.x));
    const DifferencePoint<2> rightmost = difference.support(right), leftmost = difference.support(-right);
    const double right_height = dot(rightmost.position - low.position, right);
    const double left_height = dot(low.position - leftmost.position, right);
    if (right_height + left_height <= tolerance) {
        const double to_right = dot(rightmost.position, right), to_left = -dot(leftmost.position, right);
        result.exit = EpaExit::flat;
        result.normal = to_left < to_right ? -right : right;
        result.depth = std::min(to_left, to_right);
        result.face = closest_subsimplex({low, high}, DVec<2>(0.0));
        return result;
    }
    ExpandingPolygon polygon;
    polygon.points[polygon.count++] = low;
    if (right_height > tolerance) polygon.points[polygon.count++] = rightmost;
    polygon.points[polygon.count++] = high;
    if (left_height > tolerance) polygon.points[polygon.count++] = leftmost;

    // 3. Expand the edge nearest to the origin until it is an edge of A - B.
    result.depth = std::numeric_limits<double>::infinity();
    for (std::size_t step = 0; step < epa_max_iterations; ++step) {
        std::size_t nearest = 0;
        double smallest = 0;
        for (std::size_t i = 0; i < polygon.count; ++i) {
            const double distance = dot(polygon.outward(i), polygon.points[i].position);
            if (i == 0 || distance < smallest) {
                smallest = distance;
                nearest = i;
            }
        }
        const DVec<2> normal = polygon.outward(nearest);
        const DifferencePoint<2> next = difference.support(normal);
        const double extent = dot(normal, next.position);
        record(polygon, nearest, smallest, extent, options.trace);
        result.lower_bound = smallest;
        if (extent < result.depth) {
            result.normal = normal;
            result.depth = extent;
        }
        if (result.depth - smallest <= tolerance + epa_tolerance * std::abs(result.depth)) {
            result.exit = EpaExit::exact;
            break;
        }
        if (next.position == polygon.points[nearest].position || next.position == polygon.after(nearest).position) {
            result.exit = EpaExit::no_progress;
            break;
        }
        polygon.insert_after(nearest, next);
    }
    // An edge inside A - B may have given the normal first.
    result.face = polygon.boundary_near(result.normal * result.depth);
    return result;
}

}  // namespace abut::detail
