// Quickhull (Barber, Dobkin, Huhdanpaa: "The quickhull algorithm for convex hulls", 1996), farthest point first, with
// an outside set per facet.

#include <abut/convex/bucket_sort.hpp>
#include <abut/convex/hull/highest_plane.hpp>
#include <abut/convex/hull/quickhull.hpp>
#include <abut/math/detail/no_index.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace abut::detail {
namespace {

double distance_squared_to_segment(const DVec<3>& p, const DVec<3>& a, const DVec<3>& b) {
    const DVec<3> along = b - a;
    const double weight = std::clamp(dot(p - a, along) / length_squared(along), 0.0, 1.0);
    return length_squared(p - a - along * weight);
}

/// An upper bound of the rounding error of a height, in steps of the grid: six roundings of a plane's normal and offset
/// and five of the point's terms, 2^-53 each, of sums below sqrt(3) 2^28.
constexpr double facet_rounding_error = 0x1p-20;

/// A bucket priority queue of facets by the height of the points above them, highest first, so that significant corners
/// come before those that are only rounding. Great heights have four levels per power of 2; small ones, below 2^-8 of
/// the extent, of which there are more, one level per power of 4. Within a level the last facet comes first: such
/// facets are near each other in space and in memory.
constexpr int great_octaves = 9, great_levels = 4 * great_octaves, small_octaves = grid_bits + 1 - great_octaves;
constexpr int levels = great_levels + small_octaves / 2 + 1;

/// 0 is the highest level.
std::size_t level_of(double height) {
    int exponent = 0;
    const double mantissa = std::frexp(height, &exponent);  // in [1/2, 1)
    const int octave = grid_bits + 1 - exponent;            // 0 is the highest
    const int level = octave < great_octaves ? 4 * octave + static_cast<int>(8 * (1 - mantissa))
                                             : great_levels + (octave - great_octaves) / 2;
    return static_cast<std::size_t>(std::clamp(level, 0, levels - 1));
}

class Quickhull {
public:
    Quickhull(std::span<const GridPoint> points, double tolerance)
        : tolerance_(tolerance), leaving_(points.size(), no_index) {
        entries_.reserve(points.size());
        for (const GridPoint& point : points) entries_.push_back({glm::vec<3, std::int32_t>(point - points[0])});
    }

    void run(std::array<std::uint32_t, 4> start) {
        // The first tetrahedron: a triangle with two sides, whose front the fourth point sees.
        const GridPoint first = grid_place(start[0]);
        if (grid_dot(grid_normal(first, grid_place(start[1]), grid_place(start[2])), grid_place(start[3]) - first) < 0)
            std::swap(start[1], start[2]);
        const std::uint32_t front = add_facet(start[0], start[1], start[2]);
        const std::uint32_t back = add_facet(start[0], start[2], start[1]);
        facets_[front].twin = {3 * back + 2, 3 * back + 1, 3 * back};
        facets_[back].twin = {3 * front + 2, 3 * front + 1, 3 * front};
        insert(start[3], front);
        cone_.insert(cone_.begin(), back);
        orphans_.resize(entries_.size());
        std::iota(orphans_.begin(), orphans_.end(), 0u);
        assign_orphans();

        // Each iteration inserts a point or finishes a facet.
        const auto next = [&] {
            return std::find_if(queue_.begin(), queue_.end(), [](auto& t) { return !t.empty(); });
        };
        for (auto bucket = next(); bucket != queue_.end(); bucket = next()) {
            const auto [facet, born] = bucket->back();
            bucket->pop_back();
            if (!alive(facet) || born_[facet] != born) continue;
            const std::uint32_t eye = next_eye(facets_[facet]);
            if (eye != no_index) insert(eye, facet);
        }
    }

    TriangleSurface surface() const {
        // In the lexicographical order of their corners, each from its lowest. The numbers don't depend on the order of
        // insertion, and neighbours are near each other.
        const auto lowest = [](const Facet& facet) {
            return static_cast<std::uint32_t>(std::min_element(facet.corner.begin(), facet.corner.end()) -
                                              facet.corner.begin());
        };
        const Buckets order = in_buckets(entries_.size(), [&](auto visit) {
            for (std::uint32_t f = 0; f < facets_.size(); ++f) {
                if (!alive(f)) continue;
                const std::uint32_t first = lowest(facets_[f]);
                visit(facets_[f].corner[first], std::uint64_t{facets_[f].corner[(first + 1) % 3]} << 32 | f);
            }
        });
        std::vector<std::uint32_t> half_edge(3 * facets_.size());
        for (std::uint32_t i = 0; i < order.keys.size(); ++i) {
            const auto f = static_cast<std::uint32_t>(order.keys[i]);
            const std::uint32_t first = lowest(facets_[f]);
            for (std::uint32_t k = 0; k < 3; ++k) half_edge[3 * f + (first + k) % 3] = 3 * i + k;
        }

        TriangleSurface result;
        result.origin.reserve(3 * order.keys.size());
        result.twin.reserve(3 * order.keys.size());
        result.normals.reserve(order.keys.size());
        for (const std::uint64_t key : order.keys) {
            const Facet& facet = facets_[static_cast<std::uint32_t>(key)];
            const std::uint32_t first = lowest(facet);
            for (std::uint32_t k = first; k < first + 3; ++k) {
                result.origin.push_back(facet.corner[k % 3]);
                result.twin.push_back(half_edge[facet.twin[k % 3]]);
            }
            result.normals.push_back(normal_of(facet));
            result.left_out = std::max(result.left_out, farthest_left_out(facet));
        }
        return result;
    }

private:
    /// A point relative to the first, in the outside set of a facet.
    struct PointEntry {
        glm::vec<3, std::int32_t> place;
        std::uint32_t next_outside = no_index;  ///< the next point above the same facet
    };
    /// Fills a cache line.
    struct alignas(64) Facet {
        Plane<3> plane;                         ///< with a unit normal
        std::array<std::uint32_t, 3> corner{};  ///< half-edge i runs from corner i to corner i + 1
        std::array<std::uint32_t, 3> twin{};
        std::uint32_t outside = no_index;   ///< the head of the linked list of points above it
        std::uint32_t farthest = no_index;  ///< of these
    };
    /// A facet in the queue; it is outdated if its slot was reused.
    struct QueueEntry {
        std::uint32_t facet, born;
    };

    std::uint32_t add_facet(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        std::uint32_t place = static_cast<std::uint32_t>(facets_.size());
        if (free_.empty()) {
            facets_.emplace_back();
            born_.emplace_back();
        } else {
            place = free_.back();
            free_.pop_back();
        }
        Facet& facet = facets_[place];
        facet.corner = {a, b, c};
        const DVec<3> normal(normal_of(facet));
        facet.plane.normal = normal * (1 / length(normal));
        facet.plane.offset = dot(facet.plane.normal, position(a));
        facet.outside = facet.farthest = no_index;
        born_[place] = births_++;
        return place;
    }

    bool alive(std::uint32_t facet) const { return facets_[facet].corner[0] != no_index; }
    GridPoint grid_place(std::uint32_t point) const { return GridPoint(entries_[point].place); }
    DVec<3> position(std::uint32_t point) const { return DVec<3>(entries_[point].place); }
    GridPoint normal_of(const Facet& facet) const {
        return grid_normal(grid_place(facet.corner[0]), grid_place(facet.corner[1]), grid_place(facet.corner[2]));
    }
    double rounded_height(const Plane<3>& plane, std::uint32_t point) const {
        return dot(plane.normal, position(point)) - plane.offset;
    }
    /// The sign is exact.
    double exact_height(const Facet& facet, std::uint32_t point) const {
        const GridPoint normal = normal_of(facet);
        return grid_dot(normal, grid_place(point) - grid_place(facet.corner[0])) / length(DVec<3>(normal));
    }

    /// The height above the facet, in steps of the grid; its sign is exact.
    double height(const Facet& facet, std::uint32_t point) const {
        const double rounded = rounded_height(facet.plane, point);
        return std::abs(rounded) > facet_rounding_error ? rounded : exact_height(facet, point);
    }

    /// The distance of a point above the facet from the triangle, not from its plane: beyond a sharp corner a point can
    /// be low above every facet and still far from all of them.
    double distance(const Facet& facet, std::uint32_t point) const {
        const DVec<3> p = position(point);
        bool over = true;
        double to_edge_squared = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < 3; ++i) {
            const DVec<3> a = position(facet.corner[i]), b = position(facet.corner[(i + 1) % 3]);
            over = over && dot(cross(facet.plane.normal, b - a), p - a) >= 0;
            to_edge_squared = std::min(to_edge_squared, distance_squared_to_segment(p, a, b));
        }
        return over ? height(facet, point) : square_root(to_edge_squared);
    }

    double farthest_left_out(const Facet& facet) const {
        double result = 0;
        for (std::uint32_t point = facet.outside; point != no_index; point = entries_[point].next_outside)
            result = std::max(result, distance(facet, point));
        return result;
    }

    /// The next point to insert above the facet; none if all are near enough to be left out. The hull only expands, so
    /// they stay near enough.
    std::uint32_t next_eye(const Facet& facet) const {
        if (facet.outside == no_index || height(facet, facet.farthest) > tolerance_) return facet.farthest;
        std::uint32_t result = no_index;
        double max_height = 0;
        for (std::uint32_t point = facet.outside; point != no_index; point = entries_[point].next_outside) {
            const double above = height(facet, point);
            if (above > max_height && distance(facet, point) > tolerance_) {
                max_height = above;
                result = point;
            }
        }
        return result;
    }

    /// Finds the facets visible from the eye point, from one of them, and the horizon. Visibility is exact, so the
    /// visible facets are connected without holes, and the horizon visits each of its points once.
    void see(std::uint32_t eye, std::uint32_t seen) {
        const auto take = [&](std::uint32_t facet) {
            facets_[facet].corner[0] = no_index;
            visible_.push_back(facet);
        };
        visible_.clear();
        horizon_.clear();
        take(seen);
        for (std::size_t i = 0; i < visible_.size(); ++i) {
            const std::array<std::uint32_t, 3> twins = facets_[visible_[i]].twin;
            for (const std::uint32_t twin : twins) {
                const std::uint32_t neighbor = twin / 3;
                if (!alive(neighbor)) continue;
                if (height(facets_[neighbor], eye) > 0)
                    take(neighbor);
                else
                    horizon_.push_back(twin);
            }
        }
    }

    /// Adds a facet from the eye point to each horizon edge.
    void raise_cone(std::uint32_t eye) {
        cone_.clear();
        for (const std::uint32_t behind : horizon_) {
            const std::uint32_t from = origin(following(behind));
            const std::uint32_t facet = add_facet(from, origin(behind), eye);
            facets_[facet].twin[0] = behind;
            facets_[behind / 3].twin[behind % 3] = 3 * facet;
            leaving_[from] = facet;
            cone_.push_back(facet);
        }
        for (const std::uint32_t facet : cone_) {
            const std::uint32_t neighbor = leaving_[facets_[facet].corner[1]];
            facets_[facet].twin[1] = 3 * neighbor + 2;
            facets_[neighbor].twin[2] = 3 * facet + 1;
        }
    }

    /// The points above the removed facets, without the eye point.
    void take_orphans(std::uint32_t eye) {
        orphans_.clear();
        for (const std::uint32_t old : visible_) {
            for (std::uint32_t point = facets_[old].outside; point != no_index; point = entries_[point].next_outside)
                if (point != eye) orphans_.push_back(point);
            free_.push_back(old);
        }
    }

    /// Moves each orphan to the outside set of the new facet that it is highest above. An orphan above none of them is
    /// inside.
    void assign_orphans() {
        const std::size_t count = orphans_.size(), capacity = count + highest_plane_padding;
        if (count == 0) return;
        if (max_heights_.size() < capacity)
            for (std::vector<double>* column : {&orphan_[0], &orphan_[1], &orphan_[2], &max_heights_, &best_facets_})
                column->resize(2 * capacity);
        for (std::size_t k = 0; k < count; ++k) {
            const DVec<3> orphan = position(orphans_[k]);
            for (int i = 0; i < 3; ++i) orphan_[i][k] = orphan[i];
        }
        cone_planes_.clear();
        for (const std::uint32_t facet : cone_) cone_planes_.push_back(facets_[facet].plane);
        highest_planes(cone_planes_, {orphan_[0].data(), orphan_[1].data(), orphan_[2].data(), count},
                       max_heights_.data(), best_facets_.data());

        cone_height_.assign(cone_.size(), 0.0);
        for (std::size_t k = 0; k < count; ++k) {
            if (max_heights_[k] < -facet_rounding_error) continue;
            auto best = static_cast<std::size_t>(best_facets_[k]);
            double above = max_heights_[k];
            if (above <= facet_rounding_error) {
                above = 0;
                for (std::size_t f = 0; f < cone_.size(); ++f) {
                    const double here = height(facets_[cone_[f]], orphans_[k]);
                    if (here <= above) continue;
                    above = here;
                    best = f;
                }
                if (above <= 0) continue;
            }
            Facet& facet = facets_[cone_[best]];
            entries_[orphans_[k]].next_outside = facet.outside;
            facet.outside = orphans_[k];
            if (above > cone_height_[best]) {
                cone_height_[best] = above;
                facet.farthest = orphans_[k];
            }
        }
        for (std::size_t f = 0; f < cone_.size(); ++f)
            if (cone_height_[f] > 0) queue_[level_of(cone_height_[f])].push_back({cone_[f], born_[cone_[f]]});
    }

    /// Replaces the facets visible from the eye point, one of them known, by the cone from the eye point to the
    /// horizon.
    void insert(std::uint32_t eye, std::uint32_t seen) {
        see(eye, seen);
        take_orphans(eye);
        raise_cone(eye);
        assign_orphans();
    }

    std::uint32_t origin(std::uint32_t half_edge) const { return facets_[half_edge / 3].corner[half_edge % 3]; }

    std::vector<PointEntry> entries_;  ///< one per point
    double tolerance_;
    std::vector<Facet> facets_;
    std::vector<std::uint32_t> born_;  ///< one per facet: its serial number
    std::uint32_t births_ = 0;
    std::vector<std::uint32_t> free_;                    ///< slots of removed facets
    std::array<std::vector<QueueEntry>, levels> queue_;  ///< the facets with points above them, by the height of those
    std::vector<std::uint32_t> leaving_;                 ///< one per point: the new facet whose horizon edge leaves it
    // For one insertion.
    std::vector<std::uint32_t> visible_;  ///< the facets visible from the new point
    std::vector<std::uint32_t> horizon_;  ///< half-edges of the facets behind the horizon
    std::vector<std::uint32_t> cone_;     ///< the new facets
    std::vector<Plane<3>> cone_planes_;
    std::vector<double> cone_height_;                ///< of the farthest point above each
    std::vector<std::uint32_t> orphans_;             ///< points that were above removed facets
    std::vector<double> orphan_[3];                  ///< their coordinates,
    std::vector<double> max_heights_, best_facets_;  ///< the maximum height of each over the new facets, and its facet
};

}  // namespace

GridPoint grid_normal(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
    const GridPoint u = b - a, v = c - a;
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

double grid_dot(const GridPoint& normal, const GridPoint& difference) {
    // normal = high 2^26 + low with 0 <= low < 2^26, so that neither sum leaves 64 bits; then the same for the result.
    constexpr int shift = 26;
    constexpr std::int64_t mask = (std::int64_t{1} << shift) - 1;
    std::int64_t high = 0, low = 0;
    for (int i = 0; i < 3; ++i) {
        high += (normal[i] >> shift) * difference[i];
        low += (normal[i] & mask) * difference[i];
    }
    high += low >> shift;
    low &= mask;
    return static_cast<double>(high) * 0x1p26 + static_cast<double>(low);
}

TriangleSurface quickhull(std::span<const GridPoint> points, const std::array<std::uint32_t, 4>& start,
                          double tolerance) {
    Quickhull hull(points, tolerance);
    hull.run(start);
    return hull.surface();
}

}  // namespace abut::detail
