#include <abut/query/detail/surface/surface_manifold.hpp>

#include <tuple>

namespace abut::detail {
namespace {

/// The largest angle between the normals of one plane, and its cosine.
constexpr double max_plane_angle = 5e-3, min_plane_cosine = 1 - 0.5 * max_plane_angle * max_plane_angle;

/// A face that is this thin is an edge, and so is one a little less thin.
constexpr float max_thinness = 1e-5f;

/// An area shorter than this fraction of the smaller shape's size is a sliver.
constexpr double min_extent = 1e-2;

/// A number for a feature of a pair of parts: equal for equal arguments, and by all odds different for others.
std::uint32_t feature_hash(std::uint32_t kind, std::uint32_t part, std::uint32_t other_part, std::uint32_t name) {
    std::uint64_t hash = 0;
    for (const std::uint32_t word : {kind, part, other_part, name}) {
        hash = (hash ^ word) * 0x9E3779B97F4A7C15u;
        hash ^= hash >> 32;
    }
    return static_cast<std::uint32_t>(hash);
}
std::uint32_t corner_feature(bool of_a, std::uint32_t part, std::uint32_t corner) {
    return feature_hash(of_a ? 1 : 2, part, 0, corner);
}

/// A clipped point is named by the sides that meet in it, a corner of the incident face by itself.
constexpr std::uint32_t first_clipped_name = 1u << 16;

/// Names the deepest point by the corner of a shape that it is, if it is one.
template <int D>
std::uint32_t deepest_feature(const PairDistance<D>& pair, ManifoldNames names) {
    const ClosestCorners<D>& corners = pair.distance.corners;
    const std::uint32_t own_name = corners.a[0] << 8 ^ corners.b[0];
    if (names == ManifoldNames::single_parts) return own_name;
    const bool a_is_level = names == ManifoldNames::level_is_a;
    const auto is_corner = [&](const CornerIndices<D>& of) {
        for (std::size_t i = 1; i < corners.count; ++i)
            if (of[i] != of[0]) return false;
        return true;
    };
    const CornerIndices<D>&first = a_is_level ? corners.b : corners.a, &second = a_is_level ? corners.a : corners.b;
    if (is_corner(first)) return corner_feature(!a_is_level, a_is_level ? pair.index_b : pair.index_a, first[0]);
    if (is_corner(second)) return corner_feature(a_is_level, a_is_level ? pair.index_a : pair.index_b, second[0]);
    return feature_hash(3, pair.index_a, pair.index_b, own_name);
}

/// Orders points of equal rank by all their members.
template <int D>
bool is_less(const ManifoldPoint<D>& a, const ManifoldPoint<D>& b) {
    if (const int by_place = compare(a.position, b.position)) return by_place < 0;
    return std::tie(a.depth, a.feature) < std::tie(b.depth, b.feature);
}

/// Directions off those of most edges, for an order of the points along an edge.
constexpr std::array<std::array<double, 2>, 4> quadrant{{{8, 1}, {7, 4}, {5, 6}, {2, 7}}};

/// The position along the directions, as seen along the normal.
std::array<double, 2> along_directions(const DVec<2>& position, const DVec<2>& normal) {
    const double along = dot(position, perpendicular(normal));
    return {along, -along};
}
std::array<double, 16> along_directions(const DVec<3>& position, const DVec<3>& normal) {
    const int up = longest_axis(normal);
    const int u = (up + 1) % 3, v = (up + 2) % 3;
    const double x = position[u] - position[up] * (normal[u] / normal[up]);
    const double y = position[v] - position[up] * (normal[v] / normal[up]);
    std::array<double, 16> result;
    for (std::size_t i = 0; i < 4; ++i) {
        const double forward = quadrant[i][0] * x + quadrant[i][1] * y, aside = quadrant[i][0] * y - quadrant[i][1] * x;
        result[i] = forward;
        result[i + 4] = aside;
        result[i + 8] = -forward;
        result[i + 12] = -aside;
    }
    return result;
}

}  // namespace

template <int D>
int compare(const SignedDistance<D>& a, const SignedDistance<D>& b) {
    if (a.distance != b.distance) return a.distance < b.distance ? -1 : 1;
    // Twice the point midway.
    const int by_place = compare(a.on_a + a.on_b(), b.on_a + b.on_b());
    return by_place != 0 ? by_place : compare(a.normal, b.normal);
}

template <int D>
bool ContactPlane<D>::has(const SignedDistance<D>& distance) const {
    return dot(normal, distance.normal) >= min_plane_cosine && has(distance.on_a, distance.on_b());
}
template <int D>
bool ContactPlane<D>::has(const DVec<D>& point_a, const DVec<D>& point_b) const {
    const auto is_on = [&](const DVec<D>& offset) {
        return std::abs(dot(normal, offset)) <= step + max_plane_angle * length(offset);
    };
    return is_on(point_b - on_b) || is_on(point_a - on_a);
}

template <int D>
std::optional<DVec<D>> face_normal(const Part<D>& part_a, const Part<D>& part_b, const SurfaceNormalFlags& flags,
                                   const ContactPlane<D>& plane) {
    const auto of = [&](const Part<D>& part, const DVec<D>& out, const DVec<D>& on_plane) -> std::optional<DVec<D>> {
        if (!part.is_convex() || !FaceNormals<D>(part).may_face(out)) return std::nullopt;
        const Face<D> face = face_along(part.convex(), out);
        if (!face.flat() || dot(face.normal, out) < aligned) return std::nullopt;
        const DVec<D> offset = face.points[0] + face.normal * part.convex().radius - on_plane;
        if (std::abs(dot(face.normal, offset)) > plane.step + max_plane_angle * length(offset)) return std::nullopt;
        return face.normal;
    };
    if (!flags.a)
        if (const auto of_b = of(part_b, -plane.normal, plane.on_b)) return -*of_b;
    return flags.b ? std::nullopt : of(part_a, plane.normal, plane.on_a);
}

template <int D>
FaceNormals<D>::FaceNormals(const Part<D>& part) {
    if (!part.is_convex()) return;
    const Convex<D>& set = part.convex();
    if (set.core == Core::box && set.similar) {
        const Vec<D>& half = set.own[0];
        float shortest = half[0], longest = half[0];
        for (int i = 1; i < D; ++i) {
            shortest = std::min(shortest, half[i]);
            longest = std::max(longest, half[i]);
        }
        if (!(shortest > 2 * max_thinness * longest)) return;
        for (const DVec<D>& column : set.place.column) normals_[count_++] = column;
    }
    if constexpr (D == 3)
        if (set.core == Core::points && set.count == 3) {
            const auto corner = [&](std::uint32_t i) { return set.place.point(DVec<3>(set.vertices()[i])); };
            const DVec<3> ab = corner(1) - corner(0), ac = corner(2) - corner(0), area = cross(ab, ac);
            const double longest = std::max(length_squared(ab), length_squared(ac));
            if (length_squared(area) > 16 * max_thinness * max_thinness * longest * longest) normals_[count_++] = area;
        }
}

template <int D>
bool FaceNormals<D>::may_face(const DVec<D>& direction) const {
    const auto used = std::span(normals_).first(count_);
    return used.empty() || std::any_of(used.begin(), used.end(), [&](const DVec<D>& normal) {
               const double along = dot(normal, direction);
               return along * along >= aligned * aligned * (1 - 1e-12) * length_squared(normal);
           });
}

template <int D>
void ExtremePoints<D>::add(const ManifoldPoint<D>& point, const DVec<D>& normal) {
    const std::array<double, directions> along = along_directions(point.position, normal);
    const bool is_first = count_++ == 0;
    for (std::size_t i = 0; i < directions; ++i) {
        if (!is_first && (along[i] < along_[i] || (along[i] == along_[i] && !is_less(point, extreme_[i])))) continue;
        along_[i] = along[i];
        extreme_[i] = point;
    }
    if (is_first || point.depth > deepest_.depth || (point.depth == deepest_.depth && is_less(point, deepest_)))
        deepest_ = point;
}

template <int D>
ManifoldCandidates<D> ExtremePoints<D>::distinct(double tolerance) const {
    ManifoldCandidates<D> result;
    if (count_ == 0) return result;
    if (count_ == 1) {
        result.push_back(deepest_);
        return result;
    }
    for (const ManifoldPoint<D>& point : extreme_) {
        const auto end = result.points.begin() + static_cast<std::ptrdiff_t>(result.count);
        const bool is_new = std::none_of(result.points.begin(), end, [&](const ManifoldPoint<D>& other) {
            return length_squared(point.position - other.position) <= tolerance * tolerance;
        });
        if (is_new) result.push_back(point);
    }
    const auto end = result.points.begin() + static_cast<std::ptrdiff_t>(result.count);
    const bool is_deeper = std::all_of(result.points.begin(), end, [&](const ManifoldPoint<D>& other) {
        return other.depth < deepest_.depth - tolerance;
    });
    if (is_deeper) result.push_back(deepest_);
    return result;
}

template <int D>
bool ExtremePoints<D>::extend_beyond(double length) const {
    if (count_ < 2) return false;
    for (const ManifoldPoint<D>& a : extreme_)
        for (const ManifoldPoint<D>& b : extreme_)
            if (length_squared(a.position - b.position) > length * length) return true;
    return false;
}

template <int D>
bool SurfaceManifold<D>::has_extent() const {
    return points_.extend_beyond(min_extent / surface_probe_scale * plane_.step);
}

template <int D>
void SurfaceManifold<D>::begin(const PairDistance<D>& first, double step, ManifoldNames names, double margin) {
    plane_ = ContactPlane<D>(first.distance, step);
    margin_ = margin;
    tolerance_ = 1e-6 / surface_probe_scale * step;
    names_ = names;
    points_.clear();
}

template <int D>
void SurfaceManifold<D>::add(const ManifoldCandidates<D>& points) {
    for (const ManifoldPoint<D>& point : std::span(points.points).first(points.count))
        points_.add(point, plane_.normal);
}

/// The deepest point is on no face if the two shapes touch in an edge or a corner alone.
template <int D>
void SurfaceManifold<D>::add(const Part<D>& part_a, const Part<D>& part_b, const PairDistance<D>& pair) {
    if (!are_convex<D>(part_a, part_b)) return add_points_of_mixed(part_a, part_b, pair);
    const ManifoldCandidates<D> points = area(part_a, part_b, pair.index_a, pair.index_b);
    add(points);
    const auto used = std::span(points.points).first(points.count);
    const double threshold = -pair.distance.distance - tolerance_;
    if (std::none_of(used.begin(), used.end(), [&](const ManifoldPoint<D>& p) { return p.depth >= threshold; }))
        add_deepest(pair);
}

template <int D>
void SurfaceManifold<D>::add_points_of_mixed(const Part<D>& part_a, const Part<D>& part_b,
                                             const PairDistance<D>& pair) {
    PartContact<D> own;
    if (!mixed_contact<D>(part_a, part_b, margin_, margin_, own)) return;
    for (ManifoldPoint<D> point : std::span(own.manifold.points).first(own.manifold.count)) {
        const bool of_function = part_a.is_function() || part_b.is_function();
        point.feature = of_function              ? feature_hash(4, pair.index_a, pair.index_b, point.feature)
                        : part_a.is_half_space() ? corner_feature(false, pair.index_b, point.feature)
                                                 : corner_feature(true, pair.index_a, point.feature);
        points_.add(point, plane_.normal);
    }
}

template <int D>
void SurfaceManifold<D>::add_deepest(const PairDistance<D>& pair) {
    const double depth = -pair.distance.distance;
    points_.add({pair.distance.on_a - pair.distance.normal * (0.5 * depth), depth, deepest_feature(pair, names_)},
                plane_.normal);
}

/// A point deeper than the deepest contact is none of this surface.
template <int D>
ManifoldCandidates<D> SurfaceManifold<D>::area(const Part<D>& part_a, const Part<D>& part_b, std::uint32_t index_a,
                                               std::uint32_t index_b) const {
    ManifoldCandidates<D> result;
    if (!are_convex<D>(part_a, part_b)) return result;
    const ReferenceFace reference = names_ == ManifoldNames::level_is_b ? ReferenceFace::of_b : ReferenceFace::of_a;
    const ContactArea<D> all = contact_area(part_a.convex(), part_b.convex(), reference, plane_.normal,
                                            std::numeric_limits<double>::infinity(), margin_);
    for (ManifoldPoint<D> point : std::span(all.points.points).first(all.points.count)) {
        const DVec<D> to_a = plane_.normal * (0.5 * point.depth);
        if (point.depth > plane_.depth + plane_.step || !plane_.has(point.position + to_a, point.position - to_a))
            continue;
        point.depth = std::min(point.depth, plane_.depth);
        if (names_ != ManifoldNames::single_parts)
            point.feature =
                point.feature < first_clipped_name
                    ? corner_feature(!all.a_is_reference, all.a_is_reference ? index_b : index_a, point.feature)
                    : feature_hash(all.a_is_reference ? 5 : 6, index_a, index_b, point.feature);
        result.push_back(point);
    }
    return result;
}

template <int D>
void SurfaceManifold<D>::write(Contact<D>& contact) const {
    const Manifold<D> manifold = reduced_manifold(points_.distinct(tolerance_), plane_.normal, tolerance_);
    contact.normal = to_float(plane_.normal);
    contact.points.clear();
    double depth = -std::numeric_limits<double>::infinity();
    for (const ManifoldPoint<D>& point : std::span(manifold.points).first(manifold.count)) {
        // Parts of one child of a compound shape share an index.
        std::uint32_t feature = point.feature;
        while (std::any_of(contact.points.begin(), contact.points.end(),
                           [&](const ContactPoint<D>& other) { return other.feature == feature; }))
            ++feature;
        contact.points.push_back({to_float(point.position), static_cast<float>(point.depth), feature});
        depth = std::max(depth, point.depth);
    }
    // The deepest point may differ from the deepest contact by rounding.
    contact.depth = static_cast<float>(depth >= plane_.depth - tolerance_ ? plane_.depth : depth);
}

#define ABUT_INSTANTIATE(D)                                                                                \
    template int compare(const SignedDistance<D>&, const SignedDistance<D>&);                              \
    template std::optional<DVec<D>> face_normal(const Part<D>&, const Part<D>&, const SurfaceNormalFlags&, \
                                                const ContactPlane<D>&);                                   \
    template struct ContactPlane<D>;                                                                       \
    template class FaceNormals<D>;                                                                         \
    template class SurfaceManifold<D>;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
