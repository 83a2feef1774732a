#include <abut/convex/polygon_pair.hpp>

namespace abut {
namespace {

/// A walk takes a step or two; one that comes to so many runs in circles on rounding.
constexpr int most_steps = 3 * static_cast<int>(most_sides);

/// A walk from what was remembered takes no more than this, lest it costs more than to begin anew.
constexpr int most_steps_from_cache = 6;

/// Number by number: what is written in parts and then copied as a whole has to be waited for.
inline void set_meeting(Meeting& meeting, std::uint32_t of, const DVec<2>& normal, double gap,
                        const DVec<2>& on_reference, const DVec<2>& on_other, std::uint32_t reference_first,
                        std::uint32_t reference_second, std::uint32_t other_corner) {
    meeting.of = of;
    meeting.normal.x = normal.x;
    meeting.normal.y = normal.y;
    meeting.gap = gap;
    meeting.on_reference.x = on_reference.x;
    meeting.on_reference.y = on_reference.y;
    meeting.on_other.x = on_other.x;
    meeting.on_other.y = on_other.y;
    meeting.reference_corners[0] = reference_first;
    meeting.reference_corners[1] = reference_second;
    meeting.other_corners[0] = meeting.other_corners[1] = other_corner;
}

/// Two segments with a smaller sine than this between them may overlap for their normals and yet be apart.
constexpr double parallel = 1e-3;

}  // namespace

PolygonPair::PolygonPair(const Outline& a, const Outline& b) : outlines_{&a, &b} {
    const DVec<2> cosine_sine = a.place.transposed({b.place.cos, b.place.sin});
    const DVec<2> offset = a.place.unplaced(b.place.offset());
    const double cos = cosine_sine.x, sin = cosine_sine.y;
    seen_[0] = {cos, sin, offset.x, offset.y};
    seen_[1] = {cos, -sin, -(cos * offset.x + sin * offset.y), sin * offset.x - cos * offset.y};
}

double PolygonPair::scale() const {
    return std::abs(seen_[0].x) + std::abs(seen_[0].y) + std::abs(sides(0).x[0]) + std::abs(sides(0).y[0]) +
           std::abs(sides(1).x[0]) + std::abs(sides(1).y[0]) + 2 * (sides(0).size + sides(1).size);
}

/// The other's corner in front of a side. Lowers it while that leads nearer; on to the end of the side where that leads
/// past it.
PolygonPair::Step PolygonPair::before_side(std::uint32_t of, std::uint32_t side, std::array<std::uint32_t, 2>& corners,
                                           Meeting& meeting) const {
    const Sides &reference = sides(of), &other = sides(1 - of);
    const Rigid2 &seen = seen_[of], &back = seen_[1 - of];
    std::uint32_t& k = corners[1 - of];
    double gap = dot(reference.normal(side), seen.point(other.corner(k))) - reference.offset[side];
    if (gap < 0 && reference.count == 2) {
        side = 1 - side;
        gap = dot(reference.normal(side), seen.point(other.corner(k))) - reference.offset[side];
    }
    if (!(gap > 0)) return Step::lost;
    const DVec<2> normal = reference.normal(side), down = -back.vector(normal);
    const double length = reference.length(side);
    for (std::uint32_t i = 0; i < other.count; ++i) {
        const bool forward = dot(other.along(k), down) > 0;
        if (!forward && !(dot(other.along(other.before(k)), down) < 0)) {
            const DVec<2> corner = seen.point(other.corner(k));
            gap = dot(normal, corner) - reference.offset[side];
            if (!(gap > 0)) return Step::lost;
            set_meeting(meeting, of, normal, gap, corner - normal * gap, corner, side, reference.after(side), k);
            return Step::apart;
        }
        const std::uint32_t edge = forward ? k : other.before(k), next = forward ? other.after(k) : edge;
        const double along = dot(reference.along(side), seen.point(other.corner(next)) - reference.corner(side));
        if (along >= 0 && along <= length) {
            k = next;
            continue;
        }
        // The other's edge passes an end of the side: the end lies before the edge, or past its far corner.
        const std::uint32_t end = along < 0 ? side : reference.after(side);
        corners[of] = end;
        const DVec<2> from = back.point(reference.corner(end)) - other.corner(edge);
        const double place = dot(other.along(edge), from);
        if (forward ? place >= other.length(edge) : place <= 0) k = next;
        return Step::on;
    }
    return Step::lost;
}

bool PolygonPair::walk(std::array<std::uint32_t, 2> corners, int steps, Meeting& meeting) const {
    // After a step off a side's end the other one is asked first, or it might lead back.
    std::uint32_t first = 0;
    for (int step = 0; step < steps; ++step) {
        const DVec<2> between = other_corner(0, corners[1]) - sides(0).corner(corners[0]);
        const DVec<2> direction[2] = {between, -seen_[1].vector(between)};
        bool leans = false;
        for (std::uint32_t turn = 0; turn < 2 && !leans; ++turn) {
            const std::uint32_t of = turn == 0 ? first : 1 - first;
            const Lean to = lean(sides(of), corners[of], direction[of]);
            if (!to.leans) continue;
            leans = true;
            if (to.along >= to.length || to.along <= 0) {
                corners[of] = to.along <= 0 ? to.side : sides(of).after(to.side);
                continue;
            }
            const Step outcome = before_side(of, to.side, corners, meeting);
            if (outcome == Step::apart) return true;
            if (outcome == Step::lost) return false;
            first = 1 - of;
        }
        if (leans) continue;
        const double gap = length(between);
        if (!(gap > 0)) return false;
        set_meeting(meeting, 0, between / gap, gap, sides(0).corner(corners[0]), other_corner(0, corners[1]),
                    corners[0], corners[0], corners[1]);
        return true;
    }
    return false;
}

/// From the side with the widest gap: what is nearest lies in front of it, or past one of its ends.
bool PolygonPair::apart(const SideGap& found, Meeting& meeting) const {
    const Sides& reference = sides(found.of);
    const DVec<2> corner = other_corner(found.of, found.corner), normal = reference.normal(found.side);
    const double along = dot(reference.along(found.side), corner - reference.corner(found.side));
    const double length = reference.length(found.side);
    if (along >= 0 && along <= length) {
        set_meeting(meeting, found.of, normal, found.gap, corner - normal * found.gap, corner, found.side,
                    reference.after(found.side), found.corner);
        return true;
    }
    std::array<std::uint32_t, 2> corners{};
    corners[found.of] = along < 0 ? found.side : reference.after(found.side);
    corners[1 - found.of] = found.corner;
    return walk(corners, most_steps, meeting);
}

/// The other's lowest corner lies behind the side that it is least deep behind. Where it lies behind the line past the
/// side's end, an edge lies along the side, and one of its places lies behind that end.
bool PolygonPair::overlapping(const SideGap& found, Meeting& meeting) const {
    const Sides &reference = sides(found.of), &other = sides(1 - found.of);
    const DVec<2> normal = reference.normal(found.side), corner = other_corner(found.of, found.corner);
    const double along = dot(reference.along(found.side), corner - reference.corner(found.side));
    const double length = reference.length(found.side);
    meeting.of = found.of;
    meeting.normal = normal;
    meeting.gap = found.gap;
    meeting.reference_corners = {found.side, reference.after(found.side)};
    if (along >= 0 && along <= length) {
        meeting.on_other = corner;
        meeting.on_reference = corner - normal * found.gap;
        meeting.other_corners = {found.corner, found.corner};
        return true;
    }
    const bool before = along < 0;
    const std::uint32_t end = meeting.reference_corners[before ? 0 : 1];
    const std::uint32_t next = before ? other.before(found.corner) : other.after(found.corner);
    const DVec<2> edge = other_corner(found.of, next) - corner;
    const double slope = dot(reference.along(found.side), edge), part = ((before ? 0 : length) - along) / slope;
    if (!(part >= 0 && part <= 1)) return false;
    meeting.on_other = corner + edge * part;
    meeting.on_reference = meeting.on_other - normal * found.gap;
    meeting.reference_corners = {end, end};
    meeting.other_corners = {found.corner, next};
    return length_squared(meeting.on_reference - reference.corner(end)) <= 1e-18 * scale() * scale();
}

bool PolygonPair::sides_are_all(const SideGap& found) const {
    if (sides(0).count > 2 || sides(1).count > 2 || found.gap > 0) return true;
    return std::abs(dot(sides(1).along(0), seen_[1].vector(sides(0).normal(0)))) > parallel;
}

void PolygonPair::remember(const Meeting& meeting, Cache* cache) const {
    if (cache == nullptr) return;
    const bool a_is_reference = meeting.of == 0;
    const auto &of_a = a_is_reference ? meeting.reference_corners : meeting.other_corners,
               &of_b = a_is_reference ? meeting.other_corners : meeting.reference_corners;
    // The sides of what overlaps are all tried each time.
    cache->count = meeting.gap > 0 ? (of_a[0] != of_a[1] || of_b[0] != of_b[1] ? 2 : 1) : 0;
    for (std::size_t i = 0; i < 2; ++i) {
        cache->corner_a[i] = sides(0).corner_number(of_a[i]);
        cache->corner_b[i] = sides(1).corner_number(of_b[i]);
    }
    const DVec<2> normal = outlines_[meeting.of]->place.vector(meeting.normal);
    cache->axis = {static_cast<float>(a_is_reference ? normal.x : -normal.x),
                   static_cast<float>(a_is_reference ? normal.y : -normal.y), 0};
}

/// From the side and the corner, or the two corners, that were nearest.
bool PolygonPair::apart_by_cache(const Cache& cache, Meeting& meeting) const {
    const std::uint32_t count_a = sides(0).count, count_b = sides(1).count;
    if (cache.count == 0 || cache.count > 2 || cache.corner_a[0] >= count_a || cache.corner_b[0] >= count_b)
        return false;
    std::array<std::uint32_t, 2> corners{sides(0).corner_number(cache.corner_a[0]),
                                         sides(1).corner_number(cache.corner_b[0])};
    if (cache.count == 2) {
        const std::uint32_t of = cache.corner_a[0] != cache.corner_a[1] ? 0 : 1, side = corners[of];
        const Sides& reference = sides(of);
        const DVec<2> from = other_corner(of, corners[1 - of]) - reference.corner(side);
        const double along = dot(reference.along(side), from);
        if (along >= 0 && along <= reference.length(side)) {
            const Step step = before_side(of, side, corners, meeting);
            if (step != Step::on) return step == Step::apart;
        }
    }
    return walk(corners, most_steps_from_cache, meeting);
}

/// Whether the side that parted them last parts them still by more than `enough`. That it does is proof, whatever the
/// cache says of it.
bool PolygonPair::parted_by_cache(const Cache& cache, double enough) const {
    if (cache.count != 2) return false;
    const std::uint32_t of = cache.corner_a[0] != cache.corner_a[1] ? 0 : 1;
    const std::uint32_t first = of == 0 ? cache.corner_a[0] : cache.corner_b[0];
    const Sides &reference = sides(of), &other = sides(1 - of);
    if (first >= reference.count) return false;
    const std::uint32_t side = reference.corner_number(first);
    const DVec<2> normal = reference.normal(side), down = seen_[1 - of].vector(normal);
    double lowest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < other.count; ++i) {
        const double height = down.x * other.x[i] + down.y * other.y[i];
        lowest = height < lowest ? height : lowest;
    }
    const double gap = lowest + dot(normal, {seen_[of].x, seen_[of].y}) - reference.offset[side];
    return gap > enough + 1e-14 * scale();
}

/// The side that parts them, and the corner in front of it.
void PolygonPair::remember_side(const SideGap& found, Cache* cache) const {
    if (cache == nullptr) return;
    auto &of_reference = found.of == 0 ? cache->corner_a : cache->corner_b,
         &of_other = found.of == 0 ? cache->corner_b : cache->corner_a;
    const Sides &reference = sides(found.of), &other = sides(1 - found.of);
    cache->count = 2;
    of_reference[0] = reference.corner_number(found.side);
    of_reference[1] = reference.corner_number(reference.after(found.side));
    of_other[0] = of_other[1] = other.corner_number(found.corner);
}

PolygonPair::Answer PolygonPair::meet(double enough, Cache* cache, Meeting& meeting) const {
    const bool all = !(enough < std::numeric_limits<double>::infinity());
    if (cache != nullptr && !all && parted_by_cache(*cache, enough)) return Answer::beyond;
    if (cache == nullptr || !all || !apart_by_cache(*cache, meeting)) {
        SideGap found;
        widest_gap(sides(0), sides(1), seen_, enough, 1e-14 * scale(), found);
        if (!sides_are_all(found)) return Answer::unknown;
        if (found.gap > enough) {
            remember_side(found, cache);
            return Answer::beyond;
        }
        const bool met = found.gap > 0 ? apart(found, meeting) : overlapping(found, meeting);
        if (!met) return Answer::unknown;
    }
    remember(meeting, cache);
    return meeting.gap > enough ? Answer::beyond : Answer::within;
}

PolygonPair::Answer PolygonPair::near(double enough, Cache* cache) const {
    if (cache != nullptr && parted_by_cache(*cache, enough)) return Answer::beyond;
    SideGap found;
    widest_gap(sides(0), sides(1), seen_, enough, 1e-14 * scale(), found);
    if (!sides_are_all(found)) return Answer::unknown;
    if (found.gap <= 0) return Answer::within;
    if (found.gap > enough) {
        remember_side(found, cache);
        return Answer::beyond;
    }
    Meeting meeting;
    if (!apart(found, meeting)) return Answer::unknown;
    remember(meeting, cache);
    return meeting.gap > enough ? Answer::beyond : Answer::within;
}

}  // namespace abut
