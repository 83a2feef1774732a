// Quickhull (Barber, Dobkin, Huhdanpaa: "The quickhull algorithm for convex hulls", 1996), farthest point first, with
// the points outside of each facet in a list of its own.

#include <abut/convex/buckets.hpp>
#include <abut/convex/highest_plane.hpp>
#include <abut/convex/quickhull.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace abut {
namespace {

constexpr std::uint32_t none = 0xffffffffu;

double distance_squared_to_segment(const DVec<3>& p, const DVec<3>& a, const DVec<3>& b) {
    const DVec<3> along = b - a;
    const double weight = std::clamp(dot(p - a, along) / length_squared(along), 0.0, 1.0);
    return length_squared(p - a - along * weight);
}

/// What rounding can make of a height at most, in steps of the grid: six roundings of a plane's normal and offset and
/// five of the point's own terms, 2^-53 each, of sums below sqrt(3) 2^28.
constexpr double doubt = 0x1p-20;

/// Facets have their turn in the order of how high the points above them reach, the highest first: so corners that
/// matter come before those that only rounding made. Great heights are told apart by quarters of a power of 2, those
/// below 2^-8 of the extent, of which there are more, by powers of 4. Among those of a level the last facet comes
/// first: near each other in space, such facets are near in memory.
constexpr int great_octaves = 9, great_levels = 4 * great_octaves, small_octaves = grid_bits + 1 - great_octaves;
constexpr int levels = great_levels + small_octaves / 2 + 1;

/// From 0, the highest.
std::size_t level_of(double height) {
    int exponent = 0;
    const double mantissa = std::frexp(height, &exponent);  // from 1/2 on, below 1
    const int octave = grid_bits + 1 - exponent;            // from 0, the highest
    const int level = octave < great_octaves ? 4 * octave + static_cast<int>(8 * (1 - mantissa))
                                             : great_levels + (octave - great_octaves) / 2;
    return static_cast<std::size_t>(std::clamp(level, 0, levels - 1));
}

class Quickhull {
public:
    Quickhull(std::span<const GridPoint> points, double tolerance);

    void run(std::array<std::uint32_t, 4> start);
    TriangleSurface surface() const;

private:
    /// A point, seen from the first, in the list of a facet.
    struct Seat {
        glm::vec<3, std::int32_t> place;
        std::uint32_t next_outside = none;  ///< the next that is above the same facet
    };
    /// Fills a line of the cache.
    struct alignas(64) Facet {
        OrientedPlane plane;                    ///< its normal is of length 1
        std::array<std::uint32_t, 3> corner{};  ///< half-edge i runs from corner i to corner i + 1
        std::array<std::uint32_t, 3> twin{};
        std::uint32_t outside = none;   ///< the first of the points above it, linked by their seats
        std::uint32_t farthest = none;  ///< of those
    };
    /// A facet that waits for its turn, unless its place was given to another since.
    struct Turn {
        std::uint32_t facet, born;
    };

    std::uint32_t add_facet(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    bool alive(std::uint32_t facet) const { return facets_[facet].corner[0] != none; }
    GridPoint grid_place(std::uint32_t point) const { return GridPoint(seats_[point].place); }
    DVec<3> position(std::uint32_t point) const { return DVec<3>(seats_[point].place); }
    GridPoint normal_of(const Facet& facet) const {
        return grid_normal(grid_place(facet.corner[0]), grid_place(facet.corner[1]), grid_place(facet.corner[2]));
    }
    double rounded_height(const OrientedPlane& plane, std::uint32_t point) const {
        return dot(plane.normal, position(point)) - plane.offset;
    }
    double exact_height(const Facet& facet, std::uint32_t point) const;
    double height(const Facet& facet, std::uint32_t point) const;
    double distance(const Facet& facet, std::uint32_t point) const;
    double farthest_left_out(const Facet& facet) const;
    std::uint32_t next_eye(const Facet& facet) const;
    void see(std::uint32_t eye, std::uint32_t seen);
    void raise_cone(std::uint32_t eye);
    void take_orphans(std::uint32_t eye);
    void assign_orphans();
    void insert(std::uint32_t eye, std::uint32_t seen);
    std::uint32_t origin(std::uint32_t half_edge) const { return facets_[half_edge / 3].corner[half_edge % 3]; }

    std::vector<Seat> seats_;  ///< one a point
    double tolerance_;
    std::vector<Facet> facets_;
    std::vector<std::uint32_t> born_;  ///< one a facet: when
    std::uint32_t births_ = 0;
    std::vector<std::uint32_t> free_;              ///< places of facets that are gone
    std::array<std::vector<Turn>, levels> turns_;  ///< of facets with points above them, by how high those reach
    std::vector<std::uint32_t> leaving_;  ///< one a point: the new facet on the edge of the horizon that leaves it
    // For one insertion.
    std::vector<std::uint32_t> visible_;  ///< the facets that the new point sees
    std::vector<std::uint32_t> horizon_;  ///< half-edges of the facets behind the horizon
    std::vector<std::uint32_t> cone_;     ///< the new facets
    std::vector<OrientedPlane> cone_planes_;
    std::vector<double> cone_height_;     ///< of the farthest above each
    std::vector<std::uint32_t> orphans_;  ///< points that were above what is gone
    std::vector<double> orphan_[3];       ///< their coordinates,
    std::vector<double> most_, best_;     ///< and how high each is above which of the new facets
};

Quickhull::Quickhull(std::span<const GridPoint> points, double tolerance)
    : tolerance_(tolerance), leaving_(points.size(), none) {
    seats_.reserve(points.size());
    for (const GridPoint& point : points) seats_.push_back({glm::vec<3, std::int32_t>(point - points[0])});
}

std::uint32_t Quickhull::add_facet(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
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
    facet.outside = facet.farthest = none;
    born_[place] = births_++;
    return place;
}

/// Of the exact sign.
double Quickhull::exact_height(const Facet& facet, std::uint32_t point) const {
    const GridPoint normal = normal_of(facet);
    return grid_dot(normal, grid_place(point) - grid_place(facet.corner[0])) / length(DVec<3>(normal));
}

/// Above the facet, in steps of the grid; of the exact sign.
double Quickhull::height(const Facet& facet, std::uint32_t point) const {
    const double rounded = rounded_height(facet.plane, point);
    return std::abs(rounded) > doubt ? rounded : exact_height(facet, point);
}

/// From a point above the facet to the triangle itself, not to its plane alone: beyond a sharp corner a point can be
/// low above every facet and still far from all of them.
double Quickhull::distance(const Facet& facet, std::uint32_t point) const {
    const DVec<3> p = position(point);
    bool over = true;
    double to_edge_squared = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const DVec<3> a = position(facet.corner[i]), b = position(facet.corner[(i + 1) % 3]);
        over = over && dot(cross(facet.plane.normal, b - a), p - a) >= 0;
        to_edge_squared = std::min(to_edge_squared, distance_squared_to_segment(p, a, b));
    }
    return over ? height(facet, point) : std::sqrt(to_edge_squared);
}

/// The point above the facet to go on with; none where all are near enough to be left out. A hull only grows, so they
/// stay near enough.
std::uint32_t Quickhull::next_eye(const Facet& facet) const {
    if (facet.outside == none || height(facet, facet.farthest) > tolerance_) return facet.farthest;
    std::uint32_t result = none;
    double most = 0;
    for (std::uint32_t point = facet.outside; point != none; point = seats_[point].next_outside) {
        const double above = height(facet, point);
        if (above > most && distance(facet, point) > tolerance_) {
            most = above;
            result = point;
        }
    }
    return result;
}

/// Finds the facets that the eye sees, one of them known, and their outline. What a facet is seen by is exact, so they
/// are one piece without holes, and the outline passes each of its points once.
void Quickhull::see(std::uint32_t eye, std::uint32_t seen) {
    const auto take = [&](std::uint32_t facet) {
        facets_[facet].corner[0] = none;
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

/// What was above the facets that are gone, but for the eye.
void Quickhull::take_orphans(std::uint32_t eye) {
    orphans_.clear();
    for (const std::uint32_t old : visible_) {
        for (std::uint32_t point = facets_[old].outside; point != none; point = seats_[point].next_outside)
            if (point != eye) orphans_.push_back(point);
        free_.push_back(old);
    }
}

/// A facet from the eye over each edge of the outline.
void Quickhull::raise_cone(std::uint32_t eye) {
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

/// Puts each orphan on the list of the new facet that it is highest above; one above none of them is inside.
void Quickhull::assign_orphans() {
    const std::size_t count = orphans_.size(), room = count + highest_plane_padding;
    if (count == 0) return;
    if (most_.size() < room)
        for (std::vector<double>* column : {&orphan_[0], &orphan_[1], &orphan_[2], &most_, &best_})
            column->resize(2 * room);
    for (std::size_t k = 0; k < count; ++k) {
        const DVec<3> orphan = position(orphans_[k]);
        for (int i = 0; i < 3; ++i) orphan_[i][k] = orphan[i];
    }
    cone_planes_.clear();
    for (const std::uint32_t facet : cone_) cone_planes_.push_back(facets_[facet].plane);
    highest_planes(cone_planes_, {orphan_[0].data(), orphan_[1].data(), orphan_[2].data(), count}, most_.data(),
                   best_.data());

    cone_height_.assign(cone_.size(), 0.0);
    for (std::size_t k = 0; k < count; ++k) {
        if (most_[k] < -doubt) continue;
        auto best = static_cast<std::size_t>(best_[k]);
        double above = most_[k];
        if (above <= doubt) {
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
        seats_[orphans_[k]].next_outside = facet.outside;
        facet.outside = orphans_[k];
        if (above > cone_height_[best]) {
            cone_height_[best] = above;
            facet.farthest = orphans_[k];
        }
    }
    for (std::size_t f = 0; f < cone_.size(); ++f)
        if (cone_height_[f] > 0) turns_[level_of(cone_height_[f])].push_back({cone_[f], born_[cone_[f]]});
}

/// Replaces the facets that the eye sees, one of them known, by the cone from the eye over their outline.
void Quickhull::insert(std::uint32_t eye, std::uint32_t seen) {
    see(eye, seen);
    take_orphans(eye);
    raise_cone(eye);
    assign_orphans();
}

void Quickhull::run(std::array<std::uint32_t, 4> start) {
    // A triangle with two sides, of which the fourth point sees the front, makes the first tetrahedron.
    const GridPoint first = grid_place(start[0]);
    if (grid_dot(grid_normal(first, grid_place(start[1]), grid_place(start[2])), grid_place(start[3]) - first) < 0)
        std::swap(start[1], start[2]);
    const std::uint32_t front = add_facet(start[0], start[1], start[2]);
    const std::uint32_t back = add_facet(start[0], start[2], start[1]);
    facets_[front].twin = {3 * back + 2, 3 * back + 1, 3 * back};
    facets_[back].twin = {3 * front + 2, 3 * front + 1, 3 * front};
    insert(start[3], front);
    cone_.insert(cone_.begin(), back);
    orphans_.resize(seats_.size());
    std::iota(orphans_.begin(), orphans_.end(), 0u);
    assign_orphans();

    // Each turn takes a point into the hull or leaves the facet for good.
    const auto next = [&] { return std::find_if(turns_.begin(), turns_.end(), [](auto& t) { return !t.empty(); }); };
    for (auto turns = next(); turns != turns_.end(); turns = next()) {
        const auto [facet, born] = turns->back();
        turns->pop_back();
        if (!alive(facet) || born_[facet] != born) continue;
        const std::uint32_t eye = next_eye(facets_[facet]);
        if (eye != none) insert(eye, facet);
    }
}

double Quickhull::farthest_left_out(const Facet& facet) const {
    double result = 0;
    for (std::uint32_t point = facet.outside; point != none; point = seats_[point].next_outside)
        result = std::max(result, distance(facet, point));
    return result;
}

TriangleSurface Quickhull::surface() const {
    // In the lexicographical order of their corners, each from its lowest: whatever way the hull was found, the numbers
    // are the same, and neighbours lie near each other.
    const auto lowest = [](const Facet& facet) {
        return static_cast<std::uint32_t>(std::min_element(facet.corner.begin(), facet.corner.end()) -
                                          facet.corner.begin());
    };
    const Buckets order = in_buckets(seats_.size(), [&](auto visit) {
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

}  // namespace abut
