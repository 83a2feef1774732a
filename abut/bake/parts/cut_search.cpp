#include <abut/bake/parts/cut_search.hpp>
#include <abut/bake/parts/reflex_planes.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace abut::detail {
namespace {

/// The weight of unequal volumes of the two sides. If one cut gains nothing yet, a balanced one is preferred.
constexpr double imbalance_weight = 0.02;

/// The weight of a plane without coplanar faces of at least `large_face` of the piece's area. Cuts along faces separate
/// a body into convex ones, but gain little until the last of them.
constexpr double missing_face = 0.2, large_face = 0.03;

/// The tolerance of hulls that only rank cuts. It is smaller for few points, for which hulls are cheap.
double hull_tolerance(const Piece& piece) {
    constexpr std::size_t few = 600;
    return piece.points.size() <= few ? 5e-4 : 2e-3;
}

struct Bounds {
    DVec<3> min, max;
};

Bounds bounds_of(std::span<const DVec<3>> points) {
    Bounds result{points[0], points[0]};
    for (const DVec<3>& p : points)
        for (int i = 0; i < 3; ++i) {
            result.min[i] = std::min(result.min[i], p[i]);
            result.max[i] = std::max(result.max[i], p[i]);
        }
    return result;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::vector<Edge> edges_of(const Piece& piece) {
    std::vector<Edge> edges;
    edges.reserve(3 * piece.triangles.size() + piece.cap_edges.size());
    for (const glm::uvec3& t : piece.triangles)
        for (int i = 0; i < 3; ++i) edges.push_back(std::minmax(t[i], t[(i + 1) % 3]));
    for (const CapEdge& edge : piece.cap_edges) edges.push_back(std::minmax(edge.from, edge.to));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

/// Rates parallel planes in one sweep: the hull of one side grows from plane to plane.
class PlaneSweep {
public:
    PlaneSweep(const Piece& piece, ApproximateHull& hull)
        : piece_(piece),
          hull_(hull),
          tolerance_(cut_tolerance(piece)),
          hull_tolerance_(hull_tolerance(piece)),
          edges_(edges_of(piece)) {
        for (const glm::uvec3& t : piece.triangles) area_ += area_of(t);
    }

    /// Offsets are ascending. Planes that cut nothing off are skipped.
    void rate(const DVec<3>& normal, std::vector<double> offsets, std::vector<RatedCut>& result) {
        heights_.clear();
        for (const DVec<3>& p : piece_.points) heights_.push_back(dot(normal, p));
        const auto [low, high] = std::minmax_element(heights_.begin(), heights_.end());
        const double inwards =
            piece_.closed ? 2 * tolerance_ : -2 * tolerance_;  // an outermost face of an open piece may become a part
        const double past = *high - inwards;
        double previous = *low + inwards - tolerance_;
        std::erase_if(offsets, [&](double offset) {
            if (offset <= previous + tolerance_ || offset >= past) return true;
            previous = offset;
            return false;
        });
        const std::size_t count = offsets.size();
        if (count == 0) return;
        first_.clear();
        last_.clear();
        for (const double height : heights_) {
            first_.push_back(static_cast<std::uint32_t>(
                std::lower_bound(offsets.begin(), offsets.end(), height - tolerance_) - offsets.begin()));
            last_.push_back(static_cast<std::uint32_t>(
                std::upper_bound(offsets.begin(), offsets.end(), height + tolerance_) - offsets.begin()));
        }
        // Groups points by the planes between which they lie, and adds the intersections of edges and planes.
        below_.assign(count + 1, {});
        above_.assign(count + 1, {});
        on_plane_.assign(count, {});
        has_edge_below_.assign(heights_.size(), false);
        has_edge_above_.assign(heights_.size(), false);
        for (auto [a, b] : edges_) {
            if (heights_[a] > heights_[b]) std::swap(a, b);
            if (heights_[b] - heights_[a] > tolerance_) has_edge_above_[a] = has_edge_below_[b] = true;
            for (std::uint32_t i = last_[a]; i < first_[b]; ++i) {
                const double fraction = (offsets[i] - heights_[a]) / (heights_[b] - heights_[a]);
                on_plane_[i].push_back(piece_.points[a] + (piece_.points[b] - piece_.points[a]) * fraction);
            }
        }
        faces_.assign(count, 0);
        for (const glm::uvec3& t : piece_.triangles) {
            const std::uint32_t plane = first_[t.x];
            if (plane < last_[t.x] && plane == first_[t.y] && plane < last_[t.y] && plane == first_[t.z] &&
                plane < last_[t.z])
                faces_[plane] += area_of(t);
        }
        // A point in the plane belongs only to the sides to which it has edges.
        for (std::size_t i = 0; i < heights_.size(); ++i) {
            const bool on_plane = last_[i] > first_[i];
            below_[first_[i] + (on_plane && !has_edge_below_[i] ? 1 : 0)].push_back(piece_.points[i]);
            above_[last_[i] - (on_plane && !has_edge_above_[i] ? 1 : 0)].push_back(piece_.points[i]);
        }
        const std::size_t begin = result.size();
        for (std::size_t i = 0; i < count; ++i) result.push_back({{normal, offsets[i]}, 0, 0, 0});
        points_.clear();
        for (std::size_t i = 0; i < count; ++i) result[begin + i].excess_volume = hull_size(below_[i], on_plane_[i]);
        points_.clear();
        for (std::size_t i = count; i-- > 0;) {
            RatedCut& cut = result[begin + i];
            const double below = cut.excess_volume, above = hull_size(above_[i + 1], on_plane_[i]);
            cut.excess_volume = below + above - piece_.volume;
            cut.missing_face =
                piece_.excess_volume() * missing_face * (1 - std::min(1.0, faces_[i] / (large_face * area_)));
            cut.rating = cut.excess_volume + cut.missing_face +
                         piece_.excess_volume() * imbalance_weight * std::abs(below - above) / (below + above);
        }
    }

private:
    double area_of(const glm::uvec3& t) const {
        const DVec<3>& a = piece_.points[t.x];
        return length(cross(piece_.points[t.y] - a, piece_.points[t.z] - a));
    }

    double hull_size(const std::vector<DVec<3>>& new_points, const std::vector<DVec<3>>& on_plane) {
        points_.insert(points_.end(), new_points.begin(), new_points.end());
        points_.insert(points_.end(), on_plane.begin(), on_plane.end());
        if (points_.empty()) return 0;
        hull_.build(points_, hull_tolerance_);
        hull_points_.clear();
        for (const std::uint32_t corner : hull_.corners()) hull_points_.push_back(points_[corner]);
        points_.swap(hull_points_);
        return hull_.volume() + piece_.thickness * hull_.area() / 2;
    }

    const Piece& piece_;
    ApproximateHull& hull_;
    double tolerance_;
    double hull_tolerance_;
    std::vector<Edge> edges_;
    std::vector<double> heights_;
    std::vector<std::uint32_t> first_, last_;
    double area_ = 0;
    std::vector<double> faces_;  ///< one per plane: the area of coplanar faces
    std::vector<bool> has_edge_below_, has_edge_above_;
    std::vector<std::vector<DVec<3>>> below_, above_, on_plane_;
    std::vector<DVec<3>> points_, hull_points_;
};

/// The eigenvectors of the points' covariance matrix, by Jacobi rotations.
std::array<DVec<3>, 3> principal_axes_of(std::span<const DVec<3>> points) {
    DVec<3> mean(0.0);
    for (const DVec<3>& p : points) mean += p;
    mean /= static_cast<double>(points.size());
    double m[3][3] = {};
    for (const DVec<3>& p : points) {
        const DVec<3> d = p - mean;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) m[i][j] += d[i] * d[j];
    }
    std::array<DVec<3>, 3> axes = {axis<3>(0), axis<3>(1), axis<3>(2)};
    constexpr int sweeps = 8;
    for (int sweep = 0; sweep < sweeps; ++sweep)
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                if (m[p][q] == 0) continue;
                const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
                const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + square_root(theta * theta + 1));
                const double c = 1 / square_root(t * t + 1), s = t * c;
                for (int k = 0; k < 3; ++k) {
                    const double a = m[k][p], b = m[k][q];
                    m[k][p] = c * a - s * b;
                    m[k][q] = s * a + c * b;
                }
                for (int k = 0; k < 3; ++k) {
                    const double a = m[p][k], b = m[q][k];
                    m[p][k] = c * a - s * b;
                    m[q][k] = s * a + c * b;
                }
                const DVec<3> a = axes[static_cast<std::size_t>(p)], b = axes[static_cast<std::size_t>(q)];
                axes[static_cast<std::size_t>(p)] = a * c - b * s;
                axes[static_cast<std::size_t>(q)] = a * s + b * c;
            }
    for (DVec<3>& a : axes) a = normalized(a);
    return axes;
}

/// Adds the heights between the lowest and the highest at which the surface is level, largest area first.
void add_levels(const Piece& piece, const DVec<3>& normal, double tolerance, std::vector<double>& offsets) {
    constexpr std::size_t max_count = 8;
    constexpr double level = 0.99999;
    std::vector<std::pair<double, double>> found;  // height, area
    for (const glm::uvec3& t : piece.triangles) {
        const DVec<3>& a = piece.points[t.x];
        const DVec<3> area = cross(piece.points[t.y] - a, piece.points[t.z] - a);
        const double along = std::abs(dot(area, normal));
        if (along * along >= level * level * length_squared(area) && along > 0)
            found.emplace_back(dot(normal, a), along);
    }
    std::sort(found.begin(), found.end());
    std::vector<std::pair<double, double>> merged;  // area, height
    for (const auto& [height, area] : found) {
        if (merged.empty() || height - merged.back().second > tolerance)
            merged.emplace_back(area, height);
        else
            merged.back().first += area;
    }
    std::sort(merged.rbegin(), merged.rend());
    for (std::size_t i = 0; i < std::min(max_count, merged.size()); ++i) offsets.push_back(merged[i].second);
}

std::pair<double, double> range_of(const Piece& piece, const DVec<3>& normal) {
    std::pair<double, double> result{dot(normal, piece.points[0]), dot(normal, piece.points[0])};
    for (const DVec<3>& p : piece.points) {
        const double height = dot(normal, p);
        result.first = std::min(result.first, height);
        result.second = std::max(result.second, height);
    }
    return result;
}

bool is_better(const RatedCut& a, const RatedCut& b) {
    const auto key = [](const RatedCut& cut) {
        return std::tuple(cut.rating, cut.plane.normal.x, cut.plane.normal.y, cut.plane.normal.z, cut.plane.offset);
    };
    return key(a) < key(b);
}

}  // namespace

double cut_tolerance(const Piece& piece) {
    const Bounds extent = bounds_of(piece.points);
    return 1e-5 * largest(extent.max - extent.min);
}

void measure_hull(Piece& piece, ApproximateHull& hull) {
    constexpr double tolerance = 1e-4;
    hull.build(piece.points, tolerance);
    piece.hull_volume = hull.volume() + piece.thickness * hull.area() / 2;
}

std::vector<RatedCut> best_cuts(const Piece& piece, ApproximateHull& hull, std::size_t count, int offsets_a_sweep) {
    PlaneSweep sweep_rating(piece, hull);
    const double tolerance = cut_tolerance(piece);
    std::vector<RatedCut> cuts;
    std::vector<double> offsets;
    std::vector<DVec<3>> normals = {axis<3>(0), axis<3>(1), axis<3>(2)};
    for (const DVec<3>& across : principal_axes_of(piece.points))
        if (largest(across) < 0.995) normals.push_back(across);

    std::vector<RatedCut> best_of_sweeps;
    for (const DVec<3>& normal : normals) {
        const auto [low, high] = range_of(piece, normal);
        const double spacing = (high - low) / (offsets_a_sweep + 1);
        if (!(spacing > 10 * tolerance)) continue;
        offsets.clear();
        add_levels(piece, normal, tolerance, offsets);
        std::sort(offsets.begin(), offsets.end());
        const std::size_t begin = cuts.size();
        sweep_rating.rate(normal, offsets, cuts);
        offsets.clear();
        for (int i = 1; i <= offsets_a_sweep; ++i) offsets.push_back(low + spacing * i);
        sweep_rating.rate(normal, offsets, cuts);
        if (begin == cuts.size()) continue;
        best_of_sweeps.push_back(
            *std::min_element(cuts.begin() + static_cast<std::ptrdiff_t>(begin), cuts.end(), is_better));
    }
    std::sort(best_of_sweeps.begin(), best_of_sweeps.end(), is_better);
    const std::size_t refined = offsets_a_sweep > 6 ? 2 : 0;
    for (std::size_t i = 0; i < std::min(refined, best_of_sweeps.size()); ++i) {
        if (best_of_sweeps[i].missing_face == 0) continue;
        const CutPlane& plane = best_of_sweeps[i].plane;
        const auto [low, high] = range_of(piece, plane.normal);
        const double spacing = (high - low) / (offsets_a_sweep + 1);
        offsets.clear();
        for (const int k : {-3, -2, -1, 1, 2, 3}) offsets.push_back(plane.offset + spacing * k / 4);
        sweep_rating.rate(plane.normal, offsets, cuts);
    }
    for (const auto& [normal, levels] : reflex_planes(piece)) sweep_rating.rate(normal, levels, cuts);

    std::sort(cuts.begin(), cuts.end(), is_better);
    const Bounds extent = bounds_of(piece.points);
    // The best cut of each direction comes first: cuts of different directions differ most.
    std::vector<RatedCut> result;
    for (const double min_relative_offset : {2.0, 0.04}) {
        const double min_offset_difference = min_relative_offset * largest(extent.max - extent.min);
        for (const RatedCut& cut : cuts) {
            if (result.size() >= count) break;
            const bool is_similar = std::any_of(result.begin(), result.end(), [&](const RatedCut& other) {
                return std::abs(dot(cut.plane.normal, other.plane.normal)) > 0.995 &&
                       std::abs(cut.plane.offset - other.plane.offset) < min_offset_difference;
            });
            if (!is_similar) result.push_back(cut);
        }
    }
    return result;
}

}  // namespace abut::detail
