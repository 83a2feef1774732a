// Merges faces in a half-edge mesh.

#include <abut/convex/bucket_sort.hpp>
#include <abut/convex/hull/hull_faces.hpp>
#include <abut/math/detail/no_index.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>

namespace abut::detail {
namespace {

/// Faces with a larger angle between their normals (45 degrees) are never merged, however small they are. Otherwise the
/// two sides of a thin plate and its rim would become one face.
constexpr double min_cosine = 0.7071;

class FaceMesh {
public:
    FaceMesh(std::span<const GridPoint> points, const TriangleSurface& surface, double tolerance, double flatness)
        : points_(points),
          triangle_normals_(surface.normals),
          tolerance_(tolerance),
          flatness_(flatness),
          origin_(surface.origin),
          twin_(surface.twin),
          next_(surface.origin.size(), no_index),
          previous_(surface.origin.size(), no_index),
          face_(surface.origin.size(), no_index),
          seen_in_(points.size(), 0) {}

    void join_coplanar() {
        // Coplanar neighbours get one face number by flood fill.
        std::vector<std::uint32_t> stack;
        for (std::uint32_t seed = 0; seed < triangle_normals_.size(); ++seed) {
            if (face_[3 * seed] != no_index) continue;
            const auto face = static_cast<std::uint32_t>(area_.size());
            area_.emplace_back(0.0);
            const auto take = [&](std::uint32_t triangle) {
                for (std::uint32_t i = 0; i < 3; ++i) face_[3 * triangle + i] = face;
                area_[face] += DVec<3>(triangle_normals_[triangle]);
                stack.push_back(triangle);
            };
            take(seed);
            while (!stack.empty()) {
                const std::uint32_t triangle = stack.back();
                stack.pop_back();
                for (std::uint32_t h = 3 * triangle; h < 3 * triangle + 3; ++h)
                    if (face_[twin_[h]] == no_index && coplanar(triangle, h)) take(twin_[h] / 3);
            }
        }

        // The half-edges between different faces form the loops. A coplanar part of a convex surface has one loop,
        // which visits each of its points once.
        start_.assign(area_.size(), no_index);
        for (std::uint32_t h = 0; h < origin_.size(); ++h) {
            if (face_[h] == face_[twin_[h]]) continue;
            std::uint32_t after = following(h);
            while (face_[after] == face_[twin_[after]]) after = following(twin_[after]);
            link(h, after);
            start_[face_[h]] = h;
        }
        // A point between only two faces is collinear with its neighbours. Triangles have no such points.
        if (area_.size() == triangle_normals_.size()) return;
        for (std::uint32_t h = 0; h < origin_.size(); ++h)
            if (alive(h) && between_two_faces(h)) remove_origin(h);
    }

    void join_flat() {
        // Large faces first, because their planes are the most precise. Sorted by the exponent of the area, which is
        // below 2^58.
        constexpr std::uint32_t exponents = 60;
        const Buckets order = in_buckets(exponents, [&](auto visit) {
            for (std::uint32_t face = 0; face < start_.size(); ++face) {
                int exponent = 0;
                std::frexp(largest(area_[face]), &exponent);
                visit(exponents - 1 - static_cast<std::uint32_t>(exponent), face);
            }
        });
        std::vector<bool> done(start_.size(), false);
        for (const std::uint64_t face : order.keys)
            if (start_[face] != no_index) join_around(static_cast<std::uint32_t>(face), done);
    }

    HullFaces faces() const {
        HullFaces result;
        for (std::size_t face = 0; face < start_.size(); ++face) {
            const std::uint32_t start = start_[face];
            if (start == no_index) continue;
            result.normals.push_back(to_float(normalized(area_[face])));
            result.loops.push_back(origin_[start]);
            for (std::uint32_t h = next_[start]; h != start; h = next_[h]) result.loops.push_back(origin_[h]);
            result.loop_ends.push_back(static_cast<std::uint32_t>(result.loops.size()));
        }
        return result;
    }

private:
    DVec<3> point(std::uint32_t h) const { return DVec<3>(points_[origin_[h]]); }
    bool alive(std::uint32_t h) const { return next_[h] != no_index; }

    void link(std::uint32_t before, std::uint32_t after) {
        next_[before] = after;
        previous_[after] = before;
    }

    /// Whether the triangle across the half-edge is coplanar with the given one; exact.
    bool coplanar(std::uint32_t triangle, std::uint32_t half_edge) const {
        const GridPoint& normal = triangle_normals_[triangle];
        const std::uint32_t apex = origin_[following(following(twin_[half_edge]))];
        const GridPoint offset = points_[apex] - points_[origin_[half_edge]];
        // Below 2^28 on every axis, so that six roundings of 2^-53 are less than this.
        const DVec<3> n(normal);
        const double rounding_error = 0x1p-22 * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
        return std::abs(dot(n, DVec<3>(offset))) <= rounding_error && grid_dot(normal, offset) == 0;
    }

    bool between_two_faces(std::uint32_t h) const { return twin_[previous_[h]] == next_[twin_[h]]; }

    /// Merges the half-edge before h with h, and their twins. Requires that only two faces share the point.
    void remove_origin(std::uint32_t h) {
        const std::uint32_t before = previous_[h], back = twin_[h], back_after = next_[back];
        link(before, next_[h]);
        link(back, next_[back_after]);
        twin_[before] = back;
        twin_[back] = before;
        next_[h] = next_[back_after] = no_index;
        start_[face_[before]] = before;
        start_[face_[back]] = back;
    }

    /// Whether a loop that enters by `before` and leaves by `after`, from the same point, is convex there.
    bool convex_with(std::uint32_t before, std::uint32_t after, const DVec<3>& normal) const {
        const DVec<3> a = point(before), b = point(after), c = point(next_[after]);
        return dot(cross(b - a, c - b), normal) >= -tolerance_ * length(c - a);
    }

    /// Whether the faces on both sides of the half-edge share no points but its ends.
    bool share_only_edge(std::uint32_t h) {
        const std::uint32_t other = twin_[h];
        ++search_;
        seen_in_[origin_[h]] = search_;
        for (std::uint32_t i = next_[h]; i != h; i = next_[i]) seen_in_[origin_[i]] = search_;
        for (std::uint32_t i = next_[next_[other]]; i != other; i = next_[i])
            if (seen_in_[origin_[i]] == search_) return false;
        return true;
    }

    /// Whether the corners of the faces on both sides of the half-edge lie in a slab orthogonal to the normal. It goes
    /// around both at once, so that a small neighbour of a large face fails early.
    bool flat_together(std::uint32_t h, const DVec<3>& normal) const {
        const DVec<3> origin = point(h);
        double low = 0, high = 0;
        std::uint32_t i = next_[h], j = next_[twin_[h]];
        while (i != h || j != twin_[h]) {
            for (const std::uint32_t k : {i, j}) {
                const double height = dot(normal, point(k) - origin);
                low = std::min(low, height);
                high = std::max(high, height);
            }
            if (high - low > flatness_) return false;
            if (i != h) i = next_[i];
            if (j != twin_[h]) j = next_[j];
        }
        return true;
    }

    bool joinable(std::uint32_t h) {
        const std::uint32_t other = twin_[h];
        const DVec<3>&area = area_[face_[h]], &other_area = area_[face_[other]], both = area + other_area;
        // Rejects most edges of a round body.
        const double threshold_squared = flatness_ * flatness_ * length_squared(both);
        for (const std::uint32_t side : {h, other}) {
            const double height = dot(both, point(previous_[side]) - point(side));
            if (height * height > threshold_squared) return false;
        }
        const double cosine = dot(area, other_area) / (length(area) * length(other_area));
        if (!(cosine >= min_cosine)) return false;
        const DVec<3> normal = normalized(both);
        return convex_with(previous_[h], next_[other], normal) && convex_with(previous_[other], next_[h], normal) &&
               flat_together(h, normal) && share_only_edge(h);
    }

    void join(std::uint32_t h) {
        const std::uint32_t other = twin_[h], face = face_[h], gone = face_[other];
        for (std::uint32_t i = next_[other]; i != other; i = next_[i]) face_[i] = face;
        area_[face] += area_[gone];
        start_[gone] = no_index;
        start_[face] = next_[h];
        const std::uint32_t at_origin = next_[other], at_end = next_[h];
        link(previous_[h], at_origin);
        link(previous_[other], at_end);
        next_[h] = next_[other] = no_index;
    }

    /// Merges neighbours into a face until none fits. Of the finished neighbours it tests only those that failed when
    /// this face was smaller.
    void join_around(std::uint32_t face, std::vector<bool>& done) {
        std::uint32_t h = start_[face], last = h;
        bool changed = false, round_begins = true;
        while (round_begins || h != last) {
            round_begins = (changed || !done[face_[twin_[h]]]) && joinable(h);
            if (round_begins) {
                changed = true;
                last = next_[twin_[h]];
                join(h);
                h = last;
            } else {
                h = next_[h];
            }
        }
        done[face] = true;
    }

    std::span<const GridPoint> points_;
    const std::vector<GridPoint>& triangle_normals_;
    double tolerance_, flatness_;
    // One per half-edge; a half-edge without a next one was removed.
    std::vector<std::uint32_t> origin_, twin_, next_, previous_, face_;
    // One per face; a merged face has no start.
    std::vector<DVec<3>> area_;  ///< twice its vector area
    std::vector<std::uint32_t> start_;
    std::vector<std::uint64_t> seen_in_;  ///< one per point: the last search that visited it
    std::uint64_t search_ = 0;
};

}  // namespace

HullFaces hull_faces(std::span<const GridPoint> points, const TriangleSurface& surface, double tolerance,
                     double flatness) {
    FaceMesh mesh(points, surface, tolerance, flatness);
    mesh.join_coplanar();
    mesh.join_flat();
    return mesh.faces();
}

}  // namespace abut::detail
