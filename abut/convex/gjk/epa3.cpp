#include <abut/convex/gjk/epa.hpp>

#include <optional>

namespace abut::detail {
namespace {

/// It has no initialisers, so that the unused capacity of a polytope costs nothing.
struct PolytopeFace {
    std::array<std::uint32_t, 3> corner;    ///< counter-clockwise seen from outside
    std::array<std::uint32_t, 3> neighbor;  ///< the face across the edge from corner i to i + 1
    DVec<3> normal;
    double distance;  ///< from the origin to its plane, below zero if the origin is outside
    bool alive;
    bool flat;  ///< a sliver, whose plane is undefined
};

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Edge {
    std::uint32_t from, to, beyond;  ///< `beyond`: the face on the other side, which stays
};

/// A convex polytope of triangles inside A - B: the expanding polytope of EPA.
class ExpandingPolytope {
public:
    ExpandingPolytope(const std::array<DifferencePoint<3>, 4>& corners, double tolerance)
        : tolerance_(tolerance), point_count_(4) {
        std::copy(corners.begin(), corners.end(), points_.begin());
        const DVec<3> normal =
            cross(corners[1].position - corners[0].position, corners[2].position - corners[0].position);
        if (dot(normal, corners[3].position - corners[0].position) > 0) std::swap(points_[1], points_[2]);
        add_face(0, 1, 2, {1, 2, 3});
        add_face(0, 3, 1, {3, 2, 0});
        add_face(1, 3, 2, {1, 3, 0});
        add_face(0, 2, 3, {0, 2, 1});
    }

    const PolytopeFace& face(std::uint32_t i) const { return faces_[i]; }
    const DVec<3>& corner(std::uint32_t face, std::size_t i) const { return points_[faces_[face].corner[i]].position; }

    /// The nearest face that is not a sliver; it is invalid if there is none.
    std::uint32_t nearest() const {
        std::uint32_t best = 0;
        for (std::uint32_t i = 1; i < face_count_; ++i)
            if (distances_[i] < distances_[best]) best = i;
        return best;
    }
    bool valid(std::uint32_t face) const { return distances_[face] < infinity; }

    /// Adds a point in front of the face. Returns false if rounding or the capacity prevents it.
    bool expand(std::uint32_t first, const DifferencePoint<3>& point) {
        if (point_count_ == points_.size()) return false;
        if (!find_horizon(first, point.position)) return false;
        if (face_count_ + horizon_count_ > faces_.size()) return false;
        const std::uint32_t apex = static_cast<std::uint32_t>(point_count_);
        points_[point_count_++] = point;
        const std::uint32_t first_new = face_count_;
        const std::uint32_t fan = horizon_count_;
        for (std::uint32_t i = 0; i < fan; ++i) {
            const Edge& edge = horizon_[i];
            const std::uint32_t added = face_count_;
            add_face(edge.from, edge.to, apex,
                     {edge.beyond, first_new + (i + 1) % fan, first_new + (i + fan - 1) % fan});
            for (std::size_t j = 0; j < 3; ++j)
                if (faces_[edge.beyond].corner[j] == edge.to && faces_[edge.beyond].corner[(j + 1) % 3] == edge.from)
                    faces_[edge.beyond].neighbor[j] = added;
        }
        return true;
    }

    /// The point of a face nearest to `target`.
    Simplex<3> closest_on_face(std::uint32_t face, const DVec<3>& target) const {
        const auto& [a, b, c] = faces_[face].corner;
        return closest_subsimplex({points_[a], points_[b], points_[c]}, target);
    }

    /// The point of the surface nearest to `target`. Removed faces lie inside the polytope, or fill the hole that a
    /// failed expansion left.
    Simplex<3> closest_on_surface(const DVec<3>& target) const {
        Simplex<3> best;
        double smallest = infinity;
        for (std::uint32_t i = 0; i < face_count_; ++i) {
            const double height = dot(faces_[i].normal, target) - faces_[i].distance;
            if (height * height >= smallest) continue;
            const Simplex<3> face = closest_on_face(i, target);
            const double distance = length_squared(face.combine(&DifferencePoint<3>::position) - target);
            if (distance >= smallest) continue;
            smallest = distance;
            best = face;
        }
        return best;
    }

    /// Stores the face and the fourth point whose tetrahedron contains the origin with the largest margin.
    void store(std::uint32_t face, Cache& cache) const {
        const auto& [a, b, c] = faces_[face].corner;
        const DVec<3>&p = points_[a].position, &q = points_[b].position, &r = points_[c].position;
        const DVec<3> ab = cross(p, q), bc = cross(q, r), ca = cross(r, p);
        std::size_t best = point_count_;
        double largest_margin = 0;
        for (std::size_t i = 0; i < point_count_; ++i) {
            // The volumes of the tetrahedra of each edge of the face, the origin and the point.
            const DVec<3>& point = points_[i].position;
            const double smallest = -std::max({dot(ab, point), dot(bc, point), dot(ca, point)});
            if (smallest <= largest_margin) continue;
            largest_margin = smallest;
            best = i;
        }
        if (best == point_count_) return;
        cache.count = 0;
        for (const std::size_t i : {std::size_t{a}, std::size_t{b}, std::size_t{c}, best}) {
            cache.corner_a[cache.count] = points_[i].index_a;
            cache.corner_b[cache.count++] = points_[i].index_b;
        }
        for (std::size_t i = 0; i < 3; ++i)
            cache.axis[i] = static_cast<float>(faces_[face].normal[static_cast<int>(i)]);
    }

private:
    static constexpr std::size_t max_faces = 6 * epa_max_iterations;

    void add_face(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::array<std::uint32_t, 3> neighbor) {
        PolytopeFace& face = faces_[face_count_++];
        const DVec<3>& origin = points_[a].position;
        const DVec<3> ab = points_[b].position - origin, ac = points_[c].position - origin;
        const DVec<3> normal = cross(ab, ac);
        const double area = length(normal);
        const double longest_squared = std::max({length_squared(ab), length_squared(ac), length_squared(ac - ab)});
        const bool flat = !(area * area > tolerance_ * tolerance_ * longest_squared);
        const DVec<3> unit = flat ? DVec<3>(0.0) : normal / area;
        face = PolytopeFace{{a, b, c}, neighbor, unit, dot(unit, origin), true, flat};
        distances_[face_count_ - 1] = flat ? infinity : face.distance;
    }

    bool is_visible(std::uint32_t face, const DVec<3>& position) const {
        const PolytopeFace& f = faces_[face];
        return !f.flat && dot(f.normal, position - points_[f.corner[0]].position) > tolerance_;
    }

    /// Removes the faces visible from the point, starting at a visible face, and lists the horizon edges in order.
    bool find_horizon(std::uint32_t first, const DVec<3>& position) {
        horizon_count_ = 0;
        std::size_t depth = 0;
        const auto enter = [&](std::uint32_t face, std::uint32_t edge) {
            faces_[face].alive = false;
            distances_[face] = infinity;
            stack_[depth++] = {face, edge, 0};
        };
        enter(first, 0);
        // Depth-first search. It visits the edges of a face counter-clockwise from the entry edge, which chains the
        // horizon.
        while (depth > 0) {
            Visit& visit = stack_[depth - 1];
            if (visit.done == 3) {
                --depth;
                continue;
            }
            const std::size_t edge = (visit.entry + visit.done++) % 3;
            const PolytopeFace& face = faces_[visit.face];
            const std::uint32_t beyond = face.neighbor[edge];
            if (!faces_[beyond].alive) continue;
            const std::uint32_t from = face.corner[edge], to = face.corner[(edge + 1) % 3];
            if (is_visible(beyond, position)) {
                std::uint32_t shared = 0;
                while (shared < 3 && faces_[beyond].corner[shared] != to) ++shared;
                if (shared == 3 || depth == stack_.size()) return false;
                enter(beyond, shared);
            } else {
                if (horizon_count_ == horizon_.size()) return false;
                horizon_[horizon_count_++] = {from, to, beyond};
            }
        }
        if (horizon_count_ < 3) return false;
        for (std::uint32_t i = 0; i < horizon_count_; ++i)
            if (horizon_[i].to != horizon_[(i + 1) % horizon_count_].from) return false;
        return true;
    }

    struct Visit {
        std::uint32_t face, entry, done;
    };

    double tolerance_;
    std::array<DifferencePoint<3>, epa_max_iterations + 4> points_;
    std::size_t point_count_;
    std::array<PolytopeFace, max_faces> faces_;
    std::array<double, max_faces> distances_;  ///< of the faces that can be expanded; infinite for the others
    std::uint32_t face_count_ = 0;
    std::array<Edge, 2 * epa_max_iterations> horizon_;
    std::uint32_t horizon_count_ = 0;
    std::array<Visit, 2 * epa_max_iterations> stack_;
};

/// An affinely independent start: 4 points of a volume, 3 of a flat difference, 2 of a segment or 1.
struct Start {
    std::array<DifferencePoint<3>, 4> corners;
    std::size_t count = 1;
    DVec<3> normal{1, 0, 0};  ///< orthogonal to the span of the points if count < 4
    double tolerance = 0;
};

Start spanning_points(const CoreDifference<3>& difference) {
    Start start;
    double longest = -1, scale = 0;
    for (int i = 0; i < 3; ++i) {
        const DifferencePoint<3> low = difference.support(axis<3>(i, -1)), high = difference.support(axis<3>(i, 1));
        scale = std::max({scale, largest(low.on_a), largest(low.on_b), largest(high.on_a), largest(high.on_b)});
        const double extent = length_squared(high.position - low.position);
        if (extent > longest) {
            longest = extent;
            start.corners[0] = low;
            start.corners[1] = high;
        }
    }
    start.tolerance = 1e-13 * scale;
    const DVec<3> origin = start.corners[0].position;
    const DVec<3> line = start.corners[1].position - origin;
    if (length(line) <= start.tolerance) return start;
    start.count = 2;
    start.normal = perpendicular(line);
    const DVec<3> along = normalized(line), across = cross(along, start.normal);
    double widest = start.tolerance;
    for (const DVec<3>& direction : {start.normal, -start.normal, across, -across}) {
        const DifferencePoint<3> point = difference.support(direction);
        const double width = length(cross(along, point.position - origin));
        if (width > widest) {
            widest = width;
            start.corners[2] = point;
            start.count = 3;
        }
    }
    if (start.count == 2) return start;
    start.normal = normalized(cross(line, start.corners[2].position - origin));
    double highest = start.tolerance;
    for (const DVec<3>& direction : {start.normal, -start.normal}) {
        const DifferencePoint<3> point = difference.support(direction);
        const double height = dot(direction, point.position - origin);
        if (height > highest) {
            highest = height;
            start.corners[3] = point;
            start.count = 4;
        }
    }
    return start;
}

/// The points of a simplex that has a volume.
std::optional<Start> start_from_simplex(const Simplex<3>& simplex) {
    if (simplex.count < 4) return std::nullopt;
    Start start;
    start.count = 4;
    start.corners = simplex.points;
    double scale = 0;
    for (const DifferencePoint<3>& point : simplex.points)
        scale = std::max({scale, largest(point.on_a), largest(point.on_b)});
    start.tolerance = 1e-13 * scale;
    const DVec<3>& a = simplex.points[0].position;
    const DVec<3> ab = simplex.points[1].position - a, ac = simplex.points[2].position - a,
                  ad = simplex.points[3].position - a;
    const double longest = std::max({largest(ab), largest(ac), largest(ad)});
    if (!(std::abs(dot(cross(ab, ac), ad)) > 1e-6 * longest * longest * longest)) return std::nullopt;
    return start;
}

EpaResult<3> flat_result(const CoreDifference<3>& difference, const Start& start) {
    EpaResult<3> result;
    result.exit = EpaExit::flat;
    const double up = dot(start.normal, difference.support(start.normal).position);
    const double down = -dot(start.normal, difference.support(-start.normal).position);
    result.normal = down < up ? -start.normal : start.normal;
    result.depth = std::min(up, down);
    for (std::size_t i = 0; i < start.count; ++i) result.face.points[result.face.count++] = start.corners[i];
    reduce_to_closest(result.face);
    return result;
}

void record(const ExpandingPolytope& polytope, std::uint32_t nearest, double extent, Trace<3>* trace) {
    if (trace == nullptr) return;
    PenetrationStep<3> step;
    for (std::size_t i = 0; i < 3; ++i) step.points[i] = to_float(polytope.corner(nearest, i));
    step.normal = to_float(polytope.face(nearest).normal);
    step.distance = static_cast<float>(polytope.face(nearest).distance);
    step.extent = static_cast<float>(extent);
    trace->steps.push_back(step);
}

}  // namespace

EpaResult<3> epa(const CoreDifference<3>& difference, const SearchOptions<3>& options, const Simplex<3>* simplex) {
    const std::optional<Start> from_simplex = simplex != nullptr ? start_from_simplex(*simplex) : std::nullopt;
    const Start start = from_simplex ? *from_simplex : spanning_points(difference);
    if (start.count < 4) return flat_result(difference, start);

    EpaResult<3> result;
    result.depth = infinity;
    ExpandingPolytope polytope(start.corners, start.tolerance);
    std::uint32_t nearest = 0;
    for (std::size_t step = 0; step < epa_max_iterations; ++step) {
        nearest = polytope.nearest();
        if (!polytope.valid(nearest)) break;
        const PolytopeFace& face = polytope.face(nearest);
        const DifferencePoint<3> next = difference.support(face.normal);
        const double extent = dot(face.normal, next.position);
        record(polytope, nearest, extent, options.trace);
        result.lower_bound = face.distance;
        if (extent < result.depth) {
            result.normal = face.normal;
            result.depth = extent;
        }
        if (result.depth - face.distance <= start.tolerance + epa_tolerance * std::abs(result.depth)) {
            result.exit = EpaExit::exact;
            break;
        }
        if (!polytope.expand(nearest, next)) {
            result.exit = EpaExit::no_progress;
            break;
        }
    }
    if (!std::isfinite(result.depth)) return flat_result(difference, start);
    const DVec<3> target = result.normal * result.depth;
    if (result.exit == EpaExit::exact) {
        if (options.cache != nullptr) polytope.store(nearest, *options.cache);
        result.face = polytope.closest_on_face(nearest, target);
        const double residual = length(result.face.combine(&DifferencePoint<3>::position) - target);
        if (residual <= 10 * start.tolerance + epa_tolerance * std::abs(result.depth)) return result;
    }
    // The point lies beside the last face, or a face inside A - B gave the normal.
    result.face = polytope.closest_on_surface(target);
    return result;
}

}  // namespace abut::detail
