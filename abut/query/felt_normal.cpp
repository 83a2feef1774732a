#include <abut/convex/pairs/round3.hpp>
#include <abut/query/felt_normal.hpp>
#include <abut/query/function_there.hpp>

namespace abut {
namespace {

/// By how much of s a part must be nearer, to be.
constexpr double nearer_by = 1e-8;

/// Below this part of s, there is no telling which way a surface looks.
constexpr double clear_of = 0.1;

template <int D>
Convex<D> point_part(const DVec<D>& point) {
    Convex<D> result = round_points<D>({Vec<D>(0.0f)}, 0);
    result.place.offset = point;
    return result;
}

/// What float arithmetic makes of coordinates that should be the same, in parts of s; and how far it turns a normal.
constexpr double rounding = 1e-2, turned_by_rounding = 1e-3;

/// A face may look turned by this much where a point just beside it is taken for one on it.
constexpr double face_turned_by = 1e-5;

/// How far along a part its normal is looked for where it is covered by others, in parts of s: so far at first, and so
/// many times as far each time, up to the middle of what feels it.
constexpr double first_reach = 3, next_reach = 8;

/// So often at most, which is much farther than to the middle of a thing that a level is large for.
constexpr int most_reaches = 12;

/// A point within the part and off all its edges, as far as it has an inside.
template <int D>
DVec<D> inner_point(const Convex<D>& part, const DVec<D>& beside) {
    if (part.core != Core::points) return middle_of(part, beside);
    DVec<D> sum(0.0);
    for (std::uint32_t i = 0; i < part.count; ++i) sum += DVec<D>(part.vertices()[i]);
    return part.place.point(sum / static_cast<double>(part.count));
}
template <int D>
DVec<D> inner_point(const HalfSpaceView<D>&, const DVec<D>& beside) {
    return beside;
}
template <int D>
DVec<D> inner_point(const DistanceFunction<D>&, const DVec<D>& beside) {
    return beside;
}

/// Whether it is solid with flat sides, which may be narrow.
template <int D>
bool has_flat_sides(const Convex<D>& part) {
    if (part.radius > 0 || part.inner_radius > 0) return false;
    return part.core == Core::box || (part.core == Core::points && part.count > static_cast<std::uint32_t>(D));
}
template <int D>
bool has_flat_sides(const HalfSpaceView<D>&) {
    return false;
}
template <int D>
bool has_flat_sides(const DistanceFunction<D>&) {
    return false;
}

/// Whether the part has a face there, and not an edge: seen from a bit farther along it, it is as far. A solid one's
/// has some width as well: from a bit aside of there it is as far, to one side or the other. So it is along no edge,
/// and over nothing as narrow as what is left between two pieces that should have met.
template <int D, class Part>
bool is_face(const Part& part, const FeltPlace<D>& place, const DVec<D>& beside, double own) {
    const auto is_as_far = [&](const DVec<D>& point) {
        return std::abs(foot_on(part, point).distance - own) <= 3 * face_turned_by * place.scale;
    };
    const auto has_width = [&](const DVec<D>& point, const DVec<D>& way) {
        const DVec<D> step = normalized(way) * (0.3 * place.scale);
        return is_as_far(point + step) || is_as_far(point - step);
    };
    const DVec<D> to_middle = inner_point(part, beside) - beside;
    DVec<D> along = to_middle - place.out * dot(to_middle, place.out);
    DVec<D> farther = beside;
    const double way = length(along);
    if (way > nearer_by * place.scale) {
        farther += along * (std::min(first_reach * place.scale, way) / way);
        if (!is_as_far(farther)) return false;
    } else {
        along = perpendicular(place.out);
    }
    if (!has_flat_sides(part)) return true;
    if constexpr (D == 3)
        if (!has_width(farther, cross(place.out, along))) return false;
    return has_width(farther, along);
}

/// Whether a part is met from its front alone, and not from there. What is about on it is at its front.
template <int D>
bool is_behind(const Foot<D>& foot, double scale) {
    return foot.behind > rounding * scale;
}

/// Whether the part, which is `own` from p + s n, is what is nearest to there. Where rounding leaves that open, a face
/// is, and an edge isn't.
template <int D, class Part>
bool is_free(const Part& part, const FeltPlace<D>& place, const DVec<D>& beside, double own, EachFoot<D> each_foot) {
    const double nearer = own - nearer_by * place.scale - 1e-14 * largest(beside);
    const double surely_nearer = own - rounding * place.scale;
    bool covered = false, doubtful = false;
    each_foot(beside, own + rounding * place.scale, [&](const Foot<D>& foot) {
        const double still_wanted = own + rounding * place.scale;
        if (is_behind(foot, place.scale)) return still_wanted;
        covered = covered || foot.distance < surely_nearer;
        if (covered) return no_others;
        // Another normal, about as near.
        const DVec<D> to_foot = beside - foot.point;
        const DVec<D> aside = to_foot - place.out * dot(to_foot, place.out);
        doubtful = doubtful || foot.distance < nearer || length(aside) > turned_by_rounding * place.scale;
        return still_wanted;
    });
    return !covered && (!doubtful || is_face(part, place, beside, own));
}

/// Of two feet equally near, whatever the order in which they are told.
template <int D>
bool is_before(const DVec<D>& a, const DVec<D>& b) {
    for (int i = 0; i < D; ++i)
        if (a[i] != b[i]) return a[i] < b[i];
    return false;
}

}  // namespace

template <int D>
bool find_foot(const Convex<D>& part, const DVec<D>& point, double within, Foot<D>& foot) {
    if constexpr (D == 3) {
        if (is_round_points(part, 3)) {
            const TriangleClosest answer = closest_point_on_triangle(part, point, within, foot.distance, foot.point);
            if (answer == TriangleClosest::beyond) return false;
            if (answer == TriangleClosest::found) {
                foot.behind = part.one_sided ? dot(normalized(front(part)), foot.point - point) : 0;
                return foot.distance <= within;
            }
        }
    }
    const SignedDistance<D> distance = part_distance<D>(point_part(point), part, {});
    foot = {distance.distance, distance.on_b()};
    if (part.one_sided) foot.behind = dot(normalized(front(part)), foot.point - point);
    return foot.distance <= within;
}

template <int D>
Foot<D> foot_on(const Convex<D>& part, const DVec<D>& point) {
    Foot<D> result;
    find_foot(part, point, std::numeric_limits<double>::infinity(), result);
    return result;
}
template <int D>
Foot<D> foot_on(const HalfSpaceView<D>& part, const DVec<D>& point) {
    const double distance = dot(part.normal, point) - part.offset;
    return {distance, point - part.normal * distance};
}

template <int D>
Foot<D> foot_on(const DistanceFunction<D>& part, const DVec<D>& point) {
    const FunctionThere<D> seen(part);
    const double distance = seen.at(point);
    if (!std::isfinite(distance)) return {};
    return {distance, point - seen.normal(point, seen.step(point, 1e-2 * std::abs(distance))) * distance};
}

template <int D>
Foot<D> nearest_foot(EachFoot<D> each_foot, const DVec<D>& point, double within, double scale, double near_enough) {
    Foot<D> result;
    each_foot(point, within, [&](const Foot<D>& foot) {
        const bool is_farther = is_behind(foot, scale) || foot.distance > result.distance;
        if (!is_farther && (foot.distance < result.distance || is_before(foot.point, result.point))) result = foot;
        return result.distance <= near_enough ? no_others : std::min(within, result.distance);
    });
    return result;
}

template <int D>
void each_foot_on(const View<D>& shape, const DVec<D>& point, double within, ClosestPointVisitor<D> visit) {
    if (const auto* convex = std::get_if<Convex<D>>(&shape)) {
        const Foot<D> foot = foot_on(*convex, point);
        if (foot.distance <= within) visit(foot);
        return;
    }
    const Convex<D> as_part = point_part(point);
    each_part_near(shape, as_part, static_cast<float>(within), [&](const auto& part, std::uint32_t) {
        Foot<D> foot;
        if (find_foot(part, point, within, foot)) within = visit(foot);
        return within > no_others;
    });
}

template <int D, class Part>
bool is_felt(const Part& part, const FeltPlace<D>& place, EachFoot<D> each_foot) {
    const DVec<D> beside = place.point + place.out * place.scale;
    const double own = foot_on(part, beside).distance;
    if (is_free(part, place, beside, own, each_foot)) return true;
    const DVec<D> to_middle = place.middle - place.point;
    const DVec<D> along = to_middle - place.out * dot(to_middle, place.out);
    const double way = length(along);
    if (!(way > place.scale)) return false;
    double reach = first_reach * place.scale;
    for (int i = 0; i < most_reaches; ++i, reach *= next_reach) {
        const DVec<D> farther = beside + along * (std::min(reach, way) / way);
        const double own_there = foot_on(part, farther).distance;
        // Another normal there: the surface has a bend.
        if (!(std::abs(own_there - own) <= nearer_by * place.scale)) return false;
        if (is_free(part, place, farther, own_there, each_foot)) return true;
        if (!(reach < way)) return false;
    }
    return false;
}

template <int D, class Part>
bool has_normal(const Part& part, const FeltPlace<D>& place) {
    return foot_on(part, place.point + place.out * place.scale).distance > (1 - rounding) * place.scale;
}

template <int D, class Part>
bool is_felt_there(const Part& part, const FeltPlace<D>& place, EachFoot<D> each_foot) {
    const DVec<D> beside = place.point + place.out * place.scale;
    const double own = foot_on(part, beside).distance;
    return own > (1 - rounding) * place.scale && is_free(part, place, beside, own, each_foot);
}

template <int D, class Part>
std::optional<FeltPlane<D>> felt_plane(const Part& part, const FeltPlace<D>& place, EachFoot<D> each_foot,
                                       SeenFromMiddle<D>& seen) {
    const double clear = clear_of * place.scale;
    const auto plane_at = [&](const DVec<D>& point, Foot<D> foot) -> std::optional<FeltPlane<D>> {
        if (!(foot.distance > clear) || !std::isfinite(foot.distance)) return std::nullopt;
        const Foot<D> own = foot_on(part, point);
        const bool is_nearest = own.distance <= foot.distance + nearer_by * place.scale;
        if (is_nearest && !is_behind(own, place.scale)) foot = own;
        return FeltPlane<D>{normalized(point - foot.point), foot.point};
    };
    const DVec<D> to_middle = place.middle - place.point;
    const double way = length(to_middle);
    if (!(way > place.scale)) return std::nullopt;
    const DVec<D> beside = place.point + to_middle * (place.scale / way);
    if (const auto plane = plane_at(beside, nearest_foot(each_foot, beside, 2 * place.scale, place.scale, clear)))
        return plane;
    const double within = 1.001 * way;
    if (!std::isfinite(seen.foot.distance) && within > seen.within) {
        seen.foot = nearest_foot(each_foot, place.middle, within, place.scale, clear);
        seen.within = within;
    }
    return plane_at(place.middle, seen.foot.distance <= within ? seen.foot : Foot<D>());
}

#define ABUT_INSTANTIATE(D)                                                                                       \
    template bool find_foot(const Convex<D>&, const DVec<D>&, double, Foot<D>&);                                  \
    template Foot<D> foot_on(const Convex<D>&, const DVec<D>&);                                                   \
    template Foot<D> foot_on(const HalfSpaceView<D>&, const DVec<D>&);                                            \
    template Foot<D> foot_on(const DistanceFunction<D>&, const DVec<D>&);                                         \
    template bool has_normal(const DistanceFunction<D>&, const FeltPlace<D>&);                                    \
    template bool is_felt_there(const DistanceFunction<D>&, const FeltPlace<D>&, EachFoot<D>);                    \
    template bool is_felt(const DistanceFunction<D>&, const FeltPlace<D>&, EachFoot<D>);                          \
    template std::optional<FeltPlane<D>> felt_plane(const DistanceFunction<D>&, const FeltPlace<D>&, EachFoot<D>, \
                                                    SeenFromMiddle<D>&);                                          \
    template Foot<D> nearest_foot(EachFoot<D>, const DVec<D>&, double, double, double);                           \
    template void each_foot_on(const View<D>&, const DVec<D>&, double, ClosestPointVisitor<D>);                   \
    template bool has_normal(const Convex<D>&, const FeltPlace<D>&);                                              \
    template bool has_normal(const HalfSpaceView<D>&, const FeltPlace<D>&);                                       \
    template bool is_felt_there(const Convex<D>&, const FeltPlace<D>&, EachFoot<D>);                              \
    template bool is_felt_there(const HalfSpaceView<D>&, const FeltPlace<D>&, EachFoot<D>);                       \
    template bool is_felt(const Convex<D>&, const FeltPlace<D>&, EachFoot<D>);                                    \
    template bool is_felt(const HalfSpaceView<D>&, const FeltPlace<D>&, EachFoot<D>);                             \
    template std::optional<FeltPlane<D>> felt_plane(const Convex<D>&, const FeltPlace<D>&, EachFoot<D>,           \
                                                    SeenFromMiddle<D>&);                                          \
    template std::optional<FeltPlane<D>> felt_plane(const HalfSpaceView<D>&, const FeltPlace<D>&, EachFoot<D>,    \
                                                    SeenFromMiddle<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
