#include <abut/convex/manifold/reduce.hpp>
#include <abut/math/simd/square_root.hpp>
#include <abut/query/detail/solid/contact_area.hpp>
#include <abut/query/detail/solid/interior_overlap.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace abut::detail {
namespace {

/// Faces whose normals differ by less than about 1/700 have the same one.
constexpr double same_direction = 1 - 1e-6;

DVec<3> front_of(const Corners& t) {
    return normalized<3>(cross(t[1] - t[0], t[2] - t[0]));
}

/// A point of the area, and the names of what touches there.
struct TouchPoint {
    DVec<3> position{0.0};
    std::uint32_t id = 0;
    Feature a, b;
};

std::uint32_t mixed(std::uint32_t x, std::uint32_t y) {
    std::uint32_t hash = x * 0x9e3779b1u ^ (y + 0x7f4a7c15u) * 0x85ebca6bu;
    hash ^= hash >> 15;
    return hash * 0xc2b2ae35u;
}

/// Points of the area, each once. If there are too many, those remain that span the largest area.
class TouchPoints {
public:
    TouchPoints(const DVec<3>& normal, double tolerance) : tolerance_(tolerance), x_(perpendicular(normal)) {
        y_ = cross(normal, x_);
    }

    void add(const TouchPoint& point) {
        for (std::size_t i = 0; i < count_; ++i)
            if (length(points_[i].position - point.position) <= tolerance_) return;
        if (count_ == points_.size()) reduce();
        points_[count_++] = point;
    }
    bool empty() const { return count_ == 0; }
    /// At most four points.
    std::span<const TouchPoint> corners() {
        if (count_ > 4) reduce();
        for (std::size_t i = 0; i < count_; ++i) {
            if (!is_between_others(i)) continue;
            std::move(points_.begin() + static_cast<std::ptrdiff_t>(i + 1),
                      points_.begin() + static_cast<std::ptrdiff_t>(count_),
                      points_.begin() + static_cast<std::ptrdiff_t>(i));
            --count_;
            --i;
        }
        return {points_.data(), count_};
    }

private:
    /// Whether a point lies between two others, and so is no corner.
    bool is_between_others(std::size_t i) const {
        for (std::size_t j = 0; j < count_; ++j)
            for (std::size_t k = 0; k < j; ++k) {
                if (j == i || k == i) continue;
                const DVec<3> along = points_[k].position - points_[j].position,
                              from = points_[i].position - points_[j].position;
                const double squared = length_squared(along), t = dot(from, along);
                if (t > 0 && t < squared && length(from - along * (t / squared)) <= tolerance_) return true;
            }
        return false;
    }

    void reduce() {
        std::array<double, capacity> x, y;
        std::size_t first = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            x[i] = dot(x_, points_[i].position);
            y[i] = dot(y_, points_[i].position);
            if (x[i] < x[first] || (x[i] == x[first] && y[i] < y[first])) first = i;
        }
        std::array<std::size_t, 4> best = largest_quadrilateral({x.data(), count_}, {y.data(), count_}, first);
        std::sort(best.begin(), best.end());
        const auto end = std::unique(best.begin(), best.end());
        count_ = 0;
        for (auto i = best.begin(); i != end; ++i) points_[count_++] = points_[*i];
    }

    static constexpr std::size_t capacity = 64;
    double tolerance_;
    DVec<3> x_, y_;
    std::array<TouchPoint, capacity> points_;
    std::size_t count_ = 0;
};

/// Up to three corners of a triangle that lie in the plane of another, clipped to that triangle.
class ClippedCorners {
public:
    struct Point {
        DVec<3> position{0.0};
        std::uint32_t id = 0;
    };

    void add(const DVec<3>& position, std::uint32_t id) { points_[count_++] = {position, id}; }
    std::span<const Point> all() const { return {points_.data(), count_}; }

    void clip(const Corners& to, const DVec<3>& normal, double tolerance) {
        for (std::size_t i = 0; i < 3 && count_ > 0; ++i) {
            const DVec<3> edge = to[(i + 1) % 3] - to[i];
            clip(to[i], normalized<3>(cross(edge, normal)), static_cast<std::uint32_t>(i), tolerance);
        }
    }

private:
    /// Removes what lies outside of an edge (Sutherland and Hodgman, "Reentrant polygon clipping", 1974).
    void clip(const DVec<3>& corner, const DVec<3>& outward, std::uint32_t edge, double tolerance) {
        std::array<Point, capacity> result;
        std::size_t count = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const Point &from = points_[i], &to = points_[(i + 1) % count_];
            const double start = dot(outward, from.position - corner) - tolerance,
                         end = dot(outward, to.position - corner) - tolerance;
            if (start <= 0 && count < capacity) result[count++] = from;
            if (start * end < 0 && count < capacity)
                result[count++] = {from.position + (to.position - from.position) * (start / (start - end)),
                                   mixed(from.id ^ to.id, edge)};
        }
        points_ = result;
        count_ = count;
    }

    static constexpr std::size_t capacity = 12;
    std::array<Point, capacity> points_;
    std::size_t count_ = 0;
};

class AreaSearch {
public:
    AreaSearch(const PlacedSolid& a, const PlacedSolid& b, const DVec<3>& normal, double tolerance)
        : a_(a), b_(b), normal_(normal), tolerance_(tolerance), points_(normal, tolerance) {}

    /// Adds the points at which two triangles touch.
    void add(std::uint32_t index_a, const Corners& a, std::uint32_t index_b, const Corners& b, bool any_normal) {
        const DVec<3> front_a = front_of(a), front_b = front_of(b);
        const bool a_faces = dot(front_a, normal_) > same_direction, b_faces = dot(front_b, normal_) < -same_direction;
        if (a_faces || any_normal) add_corners(index_a, a, front_a, index_b, b, false);
        if ((b_faces && !a_faces) || any_normal) add_corners(index_b, b, front_b, index_a, a, true);
        if (!a_faces && !b_faces) add_edges(index_a, a, index_b, b, any_normal);
    }
    TouchPoints& points() { return points_; }

private:
    /// Adds the corners of one triangle that touch the face of the other.
    void add_corners(std::uint32_t face_index, const Corners& face, const DVec<3>& front, std::uint32_t index,
                     const Corners& corners, bool face_is_of_b) {
        ClippedCorners clipped;
        const PlacedSolid& solid = face_is_of_b ? a_ : b_;
        for (std::size_t i = 0; i < 3; ++i)
            if (std::abs(dot(front, corners[i] - face[0])) <= tolerance_)
                clipped.add(corners[i], mixed(solid.point_index(index, i), face_is_of_b ? 1 : 2));
        const std::size_t in_plane = clipped.all().size();
        clipped.clip(face, front, 0.1 * tolerance_);
        const Feature of_face{face_index, 0, FeatureKind::face}, of_corner{index, 0,
                                                                           in_plane == 3   ? FeatureKind::face
                                                                           : in_plane == 2 ? FeatureKind::edge
                                                                                           : FeatureKind::vertex};
        for (const ClippedCorners::Point& point : clipped.all())
            points_.add(
                {point.position, point.id, face_is_of_b ? of_corner : of_face, face_is_of_b ? of_face : of_corner});
    }

    /// Adds the points at which edges cross.
    void add_edges(std::uint32_t index_a, const Corners& a, std::uint32_t index_b, const Corners& b, bool any_normal) {
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                const std::size_t next_i = (i + 1) % 3, next_j = (j + 1) % 3;
                const DVec<3> along_a = a[next_i] - a[i], along_b = b[next_j] - b[j], between = b[j] - a[i];
                const DVec<3> across = cross(along_a, along_b);
                const double squared = length_squared(across);
                if (!(squared > 1e-12 * length_squared(along_a) * length_squared(along_b))) continue;
                const double size = square_root(squared);
                if (!any_normal && std::abs(dot(across, normal_)) < same_direction * size) continue;
                if (std::abs(dot(across, between)) > tolerance_ * size) continue;
                const double s = dot(cross(between, along_b), across) / squared,
                             t = dot(cross(between, along_a), across) / squared;
                if (s < 0 || s > 1 || t < 0 || t > 1) continue;
                const auto edge = [](const PlacedSolid& solid, std::uint32_t triangle, std::size_t from,
                                     std::size_t to) {
                    const std::uint32_t p = solid.point_index(triangle, from), q = solid.point_index(triangle, to);
                    return mixed(std::min(p, q), std::max(p, q));
                };
                const auto name = [](std::uint32_t triangle, std::size_t from, std::size_t to) {
                    return Feature{triangle,
                                   edge_index(static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to)),
                                   FeatureKind::edge};
                };
                points_.add({a[i] + along_a * s, mixed(edge(a_, index_a, i, next_i), edge(b_, index_b, j, next_j)),
                             name(index_a, i, next_i), name(index_b, j, next_j)});
            }
    }

    const PlacedSolid &a_, &b_;
    DVec<3> normal_;
    double tolerance_;
    TouchPoints points_;
};

/// How two triangles touch, the most certain normals first.
enum class Touch : std::uint8_t { faces, face, edges };

/// The directions in which one triangle may leave another that it touches.
template <class Visit>
void each_leaving_direction(const Corners& a, const Corners& b, Touch touch, const Visit& visit) {
    if (touch != Touch::edges) {
        const DVec<3> front_a = front_of(a), front_b = front_of(b);
        if (touch == Touch::faces && dot(front_a, front_b) > -same_direction) return;
        visit(front_a);
        visit(-front_b);
        return;
    }
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const DVec<3> along_a = a[(i + 1) % 3] - a[i], along_b = b[(j + 1) % 3] - b[j],
                          across = cross(along_a, along_b);
            if (length_squared(across) <= 1e-12 * length_squared(along_a) * length_squared(along_b)) continue;
            const DVec<3> direction = normalized<3>(across);
            visit(direction);
            visit(-direction);
        }
}

/// How far B's triangle is in front of A's along a direction.
double gap_along(const DVec<3>& direction, const Corners& a, const Corners& b) {
    double last = -std::numeric_limits<double>::infinity(), first = -last;
    for (std::size_t i = 0; i < 3; ++i) {
        last = std::max(last, dot(direction, a[i] - a[0]));
        first = std::min(first, dot(direction, b[i] - a[0]));
    }
    return first - last;
}

/// Searches the area of one normal, or of any.
SolidContactArea area_of(const PlacedSolid& a, const PlacedSolid& moved, const DVec<3>& normal, double tolerance,
                         bool any_normal) {
    AreaSearch search(a, moved, normal, tolerance);
    each_triangle_pair(
        a, moved, static_cast<float>(tolerance),
        [&](std::uint32_t index_a, const Corners& corners_a, std::uint32_t index_b, const Corners& corners_b) {
            search.add(index_a, corners_a, index_b, corners_b, any_normal);
            return true;
        });
    SolidContactArea result;
    const std::span<const TouchPoint> corners = search.points().corners();
    for (const TouchPoint& corner : corners)
        result.manifold.points[result.manifold.count++] = {corner.position, 0, corner.id};
    if (!corners.empty()) {
        result.feature_a = corners[0].a;
        result.feature_b = corners[0].b;
    }
    return result;
}

/// The normals of faces that touch, each once.
class TouchNormals {
public:
    TouchNormals(const DVec<3>& known, double tolerance) : tolerance_(tolerance) { normals_[count_++] = known; }

    /// Adds the normals of the faces of two triangles, from A to B.
    void add(const Corners& a, const Corners& b) {
        const DVec<3> front_a = front_of(a), front_b = front_of(b);
        if (touches_face(a, front_a, b, front_b)) add(front_a);
        if (touches_face(b, front_b, a, front_a)) add(-front_b);
    }
    /// Without the one that was known.
    std::span<const DVec<3>> all() const { return {normals_.data() + 1, count_ - 1}; }

private:
    /// Whether a triangle is in front of another one, and touches it.
    bool touches_face(const Corners& face, const DVec<3>& front, const Corners& other,
                      const DVec<3>& other_front) const {
        ClippedCorners touching;
        for (const DVec<3>& corner : other) {
            const double height = dot(front, corner - face[0]);
            if (height < -tolerance_) return false;
            if (height <= tolerance_) touching.add(corner, 0);
        }
        if (touching.all().empty() || (touching.all().size() == 3 && dot(front, other_front) > 0)) return false;
        touching.clip(face, front, 0.1 * tolerance_);
        return !touching.all().empty();
    }
    void add(const DVec<3>& normal) {
        const auto same = [&](const DVec<3>& other) { return dot(normal, other) > same_direction; };
        if (count_ == normals_.size() || std::any_of(normals_.data(), normals_.data() + count_, same)) return;
        normals_[count_++] = normal;
    }

    double tolerance_;
    std::array<DVec<3>, 33> normals_;
    std::size_t count_ = 0;
};

}  // namespace

SolidContactArea contact_area(const PlacedSolid& a, const PlacedSolid& b, const DVec<3>& move, const DVec<3>& normal,
                              double tolerance) {
    const PlacedSolid moved = b.moved(move);
    const SolidContactArea result = area_of(a, moved, normal, tolerance, false);
    return result.manifold.count > 0 ? result : area_of(a, moved, normal, tolerance, true);
}

void each_contact_area(const PlacedSolid& a, const PlacedSolid& b, const DVec<3>& move, const DVec<3>& normal,
                       double tolerance, FunctionRef<bool(const DVec<3>& normal, const SolidContactArea& area)> visit) {
    const PlacedSolid moved = b.moved(move);
    const SolidContactArea first = area_of(a, moved, normal, tolerance, false);
    if (first.manifold.count > 0 && !visit(normal, first)) return;
    TouchNormals normals(normal, tolerance);
    each_triangle_pair(a, moved, static_cast<float>(tolerance),
                       [&](std::uint32_t, const Corners& corners_a, std::uint32_t, const Corners& corners_b) {
                           normals.add(corners_a, corners_b);
                           return true;
                       });
    for (const DVec<3>& other : normals.all()) {
        const SolidContactArea area = area_of(a, moved, other, tolerance, false);
        if (area.manifold.count > 0 && !visit(other, area)) return;
    }
    if (first.manifold.count == 0 && normals.all().empty()) visit(normal, area_of(a, moved, normal, tolerance, true));
}

DVec<3> touching_normal(const PlacedSolid& a, const PlacedSolid& b, double step) {
    std::optional<DVec<3>> any;
    for (const Touch touch : {Touch::faces, Touch::face, Touch::edges}) {
        std::optional<DVec<3>> found;
        int tests = 0;
        each_triangle_pair(a, b, static_cast<float>(step),
                           [&](std::uint32_t, const Corners& corners_a, std::uint32_t, const Corners& corners_b) {
                               each_leaving_direction(corners_a, corners_b, touch, [&](const DVec<3>& direction) {
                                   if (found || std::abs(gap_along(direction, corners_a, corners_b)) > step) return;
                                   if (!any) any = direction;
                                   if (++tests <= 32 && !interiors_overlap(a, b.moved(direction * step)))
                                       found = direction;
                               });
                               return !found;
                           });
        if (found) return *found;
    }
    return any.value_or(axis<3>(0));
}

}  // namespace abut::detail
