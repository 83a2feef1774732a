#include <abut/convex/pairs/polygon2.hpp>

namespace abut::detail {
namespace {

/// A walk takes a step or two. One that reaches this bound cycles on rounding.
constexpr int max_steps = 3 * static_cast<int>(max_soa_edges);

/// A walk from cached features ends after this number of steps, because a new search is cheaper.
constexpr int max_steps_from_cache = 6;

/// Member by member: copying a structure as a whole right after its parts were written stalls.
inline void set_closest(ClosestFeatures2& closest, std::uint32_t of, const DVec<2>& normal, double gap,
                        const DVec<2>& on_reference, const DVec<2>& on_other, std::uint32_t reference_first,
                        std::uint32_t reference_second, std::uint32_t other_corner) {
    closest.of = of;
    closest.normal.x = normal.x;
    closest.normal.y = normal.y;
    closest.gap = gap;
    closest.on_reference.x = on_reference.x;
    closest.on_reference.y = on_reference.y;
    closest.on_other.x = on_other.x;
    closest.on_other.y = on_other.y;
    closest.reference_corners[0] = reference_first;
    closest.reference_corners[1] = reference_second;
    closest.other_corners[0] = closest.other_corners[1] = other_corner;
}

/// Two segments with a smaller sine between them may overlap along their normals and yet be disjoint.
constexpr double parallel = 1e-3;

}  // namespace

PolygonPair::PolygonPair(const PlacedPolygon& a, const PlacedPolygon& b) : polygons_{&a, &b} {
    const DVec<2> cosine_sine = a.place.transposed({b.place.cos, b.place.sin});
    const DVec<2> offset = a.place.inverse_point(b.place.offset());
    const double cos = cosine_sine.x, sin = cosine_sine.y;
    seen_[0] = {cos, sin, offset.x, offset.y};
    seen_[1] = {cos, -sin, -(cos * offset.x + sin * offset.y), sin * offset.x - cos * offset.y};
}

double PolygonPair::scale() const {
    return std::abs(seen_[0].x) + std::abs(seen_[0].y) + std::abs(sides(0).x[0]) + std::abs(sides(0).y[0]) +
           std::abs(sides(1).x[0]) + std::abs(sides(1).y[0]) + 2 * (sides(0).size + sides(1).size);
}

/// The other's corner in front of an edge. Moves to lower corners while they are nearer, and on to the end of the edge
/// if the lower corner lies past it.
PolygonPair::Step PolygonPair::step_to_edge(std::uint32_t of, std::uint32_t side, std::array<std::uint32_t, 2>& corners,
                                            ClosestFeatures2& closest) const {
    const PolygonSoa &reference = sides(of), &other = sides(1 - of);
    const Rigid2 &seen = seen_[of], &back = seen_[1 - of];
    std::uint32_t& k = corners[1 - of];
    double gap = dot(reference.normal(side), seen.point(other.corner(k))) - reference.offset[side];
    if (gap < 0 && reference.count == 2) {
        side = 1 - side;
        gap = dot(reference.normal(side), seen.point(other.corner(k))) - reference.offset[side];
    }
    if (!(gap > 0)) return Step::failed;
    const DVec<2> normal = reference.normal(side), down = -back.vector(normal);
    const double length = reference.length(side);
    for (std::uint32_t i = 0; i < other.count; ++i) {
        const bool forward = dot(other.along(k), down) > 0;
        if (!forward && !(dot(other.along(other.before(k)), down) < 0)) {
            const DVec<2> corner = seen.point(other.corner(k));
            gap = dot(normal, corner) - reference.offset[side];
            if (!(gap > 0)) return Step::failed;
            set_closest(closest, of, normal, gap, corner - normal * gap, corner, side, reference.after(side), k);
            return Step::found;
        }
        const std::uint32_t edge = forward ? k : other.before(k), next = forward ? other.after(k) : edge;
        const double along = dot(reference.along(side), seen.point(other.corner(next)) - reference.corner(side));
        if (along >= 0 && along <= length) {
            k = next;
            continue;
        }
        // The other's edge passes an end of the edge: the end lies in front of the other's edge, or past its far
        // corner.
        const std::uint32_t end = along < 0 ? side : reference.after(side);
        corners[of] = end;
        const DVec<2> from = back.point(reference.corner(end)) - other.corner(edge);
        const double place = dot(other.along(edge), from);
        if (forward ? place >= other.length(edge) : place <= 0) k = next;
        return Step::moved;
    }
    return Step::failed;
}

bool PolygonPair::walk_regions(std::array<std::uint32_t, 2> corners, int steps, ClosestFeatures2& closest) const {
    // After a step to an end of an edge the other polygon is tested first, or the walk might return.
    std::uint32_t first = 0;
    for (int step = 0; step < steps; ++step) {
        const DVec<2> between = other_corner(0, corners[1]) - sides(0).corner(corners[0]);
        const DVec<2> direction[2] = {between, -seen_[1].vector(between)};
        bool outside = false;
        for (std::uint32_t turn = 0; turn < 2 && !outside; ++turn) {
            const std::uint32_t of = turn == 0 ? first : 1 - first;
            const VertexRegion to = vertex_region_of(sides(of), corners[of], direction[of]);
            if (!to.outside) continue;
            outside = true;
            if (to.along >= to.length || to.along <= 0) {
                corners[of] = to.along <= 0 ? to.side : sides(of).after(to.side);
                continue;
            }
            const Step outcome = step_to_edge(of, to.side, corners, closest);
            if (outcome == Step::found) return true;
            if (outcome == Step::failed) return false;
            first = 1 - of;
        }
        if (outside) continue;
        const double gap = length(between);
        if (!(gap > 0)) return false;
        set_closest(closest, 0, between / gap, gap, sides(0).corner(corners[0]), other_corner(0, corners[1]),
                    corners[0], corners[0], corners[1]);
        return true;
    }
    return false;
}

/// From the edge with the widest gap: the closest point lies in front of it, or past one of its ends.
bool PolygonPair::closest_when_apart(const EdgeGap& found, ClosestFeatures2& closest) const {
    const PolygonSoa& reference = sides(found.of);
    const DVec<2> corner = other_corner(found.of, found.corner), normal = reference.normal(found.side);
    const double along = dot(reference.along(found.side), corner - reference.corner(found.side));
    const double length = reference.length(found.side);
    if (along >= 0 && along <= length) {
        set_closest(closest, found.of, normal, found.gap, corner - normal * found.gap, corner, found.side,
                    reference.after(found.side), found.corner);
        return true;
    }
    std::array<std::uint32_t, 2> corners{};
    corners[found.of] = along < 0 ? found.side : reference.after(found.side);
    corners[1 - found.of] = found.corner;
    return walk_regions(corners, max_steps, closest);
}

/// The other's lowest corner lies behind the edge of minimum depth. If it lies past an end of that edge, an edge of the
/// other runs along it, and one of its points lies behind that end.
bool PolygonPair::closest_when_overlapping(const EdgeGap& found, ClosestFeatures2& closest) const {
    const PolygonSoa &reference = sides(found.of), &other = sides(1 - found.of);
    const DVec<2> normal = reference.normal(found.side), corner = other_corner(found.of, found.corner);
    const double along = dot(reference.along(found.side), corner - reference.corner(found.side));
    const double length = reference.length(found.side);
    closest.of = found.of;
    closest.normal = normal;
    closest.gap = found.gap;
    closest.reference_corners = {found.side, reference.after(found.side)};
    if (along >= 0 && along <= length) {
        closest.on_other = corner;
        closest.on_reference = corner - normal * found.gap;
        closest.other_corners = {found.corner, found.corner};
        return true;
    }
    const bool before = along < 0;
    const std::uint32_t end = closest.reference_corners[before ? 0 : 1];
    const std::uint32_t next = before ? other.before(found.corner) : other.after(found.corner);
    const DVec<2> edge = other_corner(found.of, next) - corner;
    const double slope = dot(reference.along(found.side), edge), part = ((before ? 0 : length) - along) / slope;
    if (!(part >= 0 && part <= 1)) return false;
    closest.on_other = corner + edge * part;
    closest.on_reference = closest.on_other - normal * found.gap;
    closest.reference_corners = {end, end};
    closest.other_corners = {found.corner, next};
    return length_squared(closest.on_reference - reference.corner(end)) <= 1e-18 * scale() * scale();
}

bool PolygonPair::edges_suffice(const EdgeGap& found) const {
    if (sides(0).count > 2 || sides(1).count > 2 || found.gap > 0) return true;
    return std::abs(dot(sides(1).along(0), seen_[1].vector(sides(0).normal(0)))) > parallel;
}

void PolygonPair::store(const ClosestFeatures2& closest, Cache* cache) const {
    if (cache == nullptr) return;
    const bool a_is_reference = closest.of == 0;
    const auto &of_a = a_is_reference ? closest.reference_corners : closest.other_corners,
               &of_b = a_is_reference ? closest.other_corners : closest.reference_corners;
    // For overlapping polygons all edges are tested each time.
    cache->count = closest.gap > 0 ? (of_a[0] != of_a[1] || of_b[0] != of_b[1] ? 2 : 1) : 0;
    for (std::size_t i = 0; i < 2; ++i) {
        cache->corner_a[i] = sides(0).corner_number(of_a[i]);
        cache->corner_b[i] = sides(1).corner_number(of_b[i]);
    }
    const DVec<2> normal = polygons_[closest.of]->place.vector(closest.normal);
    cache->axis = {static_cast<float>(a_is_reference ? normal.x : -normal.x),
                   static_cast<float>(a_is_reference ? normal.y : -normal.y), 0};
}

/// Warm start from the closest edge and corner, or from the two closest corners.
bool PolygonPair::closest_by_cache(const Cache& cache, ClosestFeatures2& closest) const {
    const std::uint32_t count_a = sides(0).count, count_b = sides(1).count;
    if (cache.count == 0 || cache.count > 2 || cache.corner_a[0] >= count_a || cache.corner_b[0] >= count_b)
        return false;
    std::array<std::uint32_t, 2> corners{sides(0).corner_number(cache.corner_a[0]),
                                         sides(1).corner_number(cache.corner_b[0])};
    if (cache.count == 2) {
        const std::uint32_t of = cache.corner_a[0] != cache.corner_a[1] ? 0 : 1, side = corners[of];
        const PolygonSoa& reference = sides(of);
        const DVec<2> from = other_corner(of, corners[1 - of]) - reference.corner(side);
        const double along = dot(reference.along(side), from);
        if (along >= 0 && along <= reference.length(side)) {
            const Step step = step_to_edge(of, side, corners, closest);
            if (step != Step::moved) return step == Step::found;
        }
    }
    return walk_regions(corners, max_steps_from_cache, closest);
}

/// Warm start: whether the last separating edge still separates them by more than `max_distance`. The test is a proof,
/// whatever the cache contains.
bool PolygonPair::separated_by_cache(const Cache& cache, double max_distance) const {
    if (cache.count != 2) return false;
    const std::uint32_t of = cache.corner_a[0] != cache.corner_a[1] ? 0 : 1;
    const std::uint32_t first = of == 0 ? cache.corner_a[0] : cache.corner_b[0];
    const PolygonSoa &reference = sides(of), &other = sides(1 - of);
    if (first >= reference.count) return false;
    const std::uint32_t side = reference.corner_number(first);
    const DVec<2> normal = reference.normal(side), down = seen_[1 - of].vector(normal);
    double lowest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < other.count; ++i) {
        const double height = down.x * other.x[i] + down.y * other.y[i];
        lowest = height < lowest ? height : lowest;
    }
    const double gap = lowest + dot(normal, {seen_[of].x, seen_[of].y}) - reference.offset[side];
    return gap > max_distance + 1e-14 * scale();
}

/// The separating edge, and the corner in front of it.
void PolygonPair::store_edge(const EdgeGap& found, Cache* cache) const {
    if (cache == nullptr) return;
    auto &of_reference = found.of == 0 ? cache->corner_a : cache->corner_b,
         &of_other = found.of == 0 ? cache->corner_b : cache->corner_a;
    const PolygonSoa &reference = sides(found.of), &other = sides(1 - found.of);
    cache->count = 2;
    of_reference[0] = reference.corner_number(found.side);
    of_reference[1] = reference.corner_number(reference.after(found.side));
    of_other[0] = of_other[1] = other.corner_number(found.corner);
}

PolygonPair::Answer PolygonPair::find_closest(double max_distance, Cache* cache, ClosestFeatures2& closest) const {
    const bool all = !(max_distance < std::numeric_limits<double>::infinity());
    if (cache != nullptr && !all && separated_by_cache(*cache, max_distance)) return Answer::beyond;
    if (cache == nullptr || !all || !closest_by_cache(*cache, closest)) {
        EdgeGap found;
        widest_edge_gap(sides(0), sides(1), seen_, max_distance, 1e-14 * scale(), found);
        if (!edges_suffice(found)) return Answer::unknown;
        if (found.gap > max_distance) {
            store_edge(found, cache);
            return Answer::beyond;
        }
        const bool found_closest =
            found.gap > 0 ? closest_when_apart(found, closest) : closest_when_overlapping(found, closest);
        if (!found_closest) return Answer::unknown;
    }
    store(closest, cache);
    return closest.gap > max_distance ? Answer::beyond : Answer::within;
}

PolygonPair::Answer PolygonPair::near(double max_distance, Cache* cache) const {
    if (cache != nullptr && separated_by_cache(*cache, max_distance)) return Answer::beyond;
    EdgeGap found;
    widest_edge_gap(sides(0), sides(1), seen_, max_distance, 1e-14 * scale(), found);
    if (!edges_suffice(found)) return Answer::unknown;
    if (found.gap <= 0) return Answer::within;
    if (found.gap > max_distance) {
        store_edge(found, cache);
        return Answer::beyond;
    }
    ClosestFeatures2 closest;
    if (!closest_when_apart(found, closest)) return Answer::unknown;
    store(closest, cache);
    return closest.gap > max_distance ? Answer::beyond : Answer::within;
}

}  // namespace abut::detail
