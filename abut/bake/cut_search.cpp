#include <abut/bake/cut_search.hpp>
#include <abut/bake/reflex_planes.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace abut {
namespace {

/// Weighs how far halves differ: where a body has to be cut twice before anything is gained, it had better be halved.
constexpr double unlike_halves = 0.02;

/// Weighs that a plane has no face of the piece in it, of `large_face` of its area: where there are faces along which a
/// body comes apart into convex ones, each cut along them gains little until the last.
constexpr double no_face = 0.2, large_face = 0.03;

/// What hulls may leave out that only rank cuts: less where there are few points, which is quick anyway.
double roughness(const Piece& piece) {
    constexpr std::size_t few = 600;
    return piece.points.size() <= few ? 5e-4 : 2e-3;
}

struct Extent {
    DVec<3> least, greatest;
};

Extent extent_of(std::span<const DVec<3>> points) {
    Extent result{points[0], points[0]};
    for (const DVec<3>& p : points)
        for (int i = 0; i < 3; ++i) {
            result.least[i] = std::min(result.least[i], p[i]);
            result.greatest[i] = std::max(result.greatest[i], p[i]);
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

/// Rates parallel planes together: hulls grow from one to the next.
class Sweeper {
public:
    Sweeper(const Piece& piece, RoughHull& hull)
        : piece_(piece),
          hull_(hull),
          margin_(cut_margin(piece)),
          roughness_(roughness(piece)),
          edges_(edges_of(piece)) {
        for (const glm::uvec3& t : piece.triangles) area_ += area_of(t);
    }

    /// Offsets ascending. Those that cut nothing off are left out.
    void rate(const DVec<3>& normal, std::vector<double> offsets, std::vector<RatedCut>& result) {
        heights_.clear();
        for (const DVec<3>& p : piece_.points) heights_.push_back(dot(normal, p));
        const auto [low, high] = std::minmax_element(heights_.begin(), heights_.end());
        const double inwards =
            piece_.closed ? 2 * margin_ : -2 * margin_;  // an outermost face is a part where it is open
        const double past = *high - inwards;
        double previous = *low + inwards - margin_;
        std::erase_if(offsets, [&](double offset) {
            if (offset <= previous + margin_ || offset >= past) return true;
            previous = offset;
            return false;
        });
        const std::size_t count = offsets.size();
        if (count == 0) return;
        first_.clear();
        last_.clear();
        for (const double height : heights_) {
            first_.push_back(static_cast<std::uint32_t>(
                std::lower_bound(offsets.begin(), offsets.end(), height - margin_) - offsets.begin()));
            last_.push_back(static_cast<std::uint32_t>(
                std::upper_bound(offsets.begin(), offsets.end(), height + margin_) - offsets.begin()));
        }
        // Points that come with a plane, and where edges meet it.
        below_.assign(count + 1, {});
        above_.assign(count + 1, {});
        on_.assign(count, {});
        leads_down_.assign(heights_.size(), false);
        leads_up_.assign(heights_.size(), false);
        for (auto [a, b] : edges_) {
            if (heights_[a] > heights_[b]) std::swap(a, b);
            if (heights_[b] - heights_[a] > margin_) leads_up_[a] = leads_down_[b] = true;
            for (std::uint32_t i = last_[a]; i < first_[b]; ++i) {
                const double share = (offsets[i] - heights_[a]) / (heights_[b] - heights_[a]);
                on_[i].push_back(piece_.points[a] + (piece_.points[b] - piece_.points[a]) * share);
            }
        }
        faces_.assign(count, 0);
        for (const glm::uvec3& t : piece_.triangles) {
            const std::uint32_t plane = first_[t.x];
            if (plane < last_[t.x] && plane == first_[t.y] && plane < last_[t.y] && plane == first_[t.z] &&
                plane < last_[t.z])
                faces_[plane] += area_of(t);
        }
        // A point of the plane is only on the sides that it has edges to.
        for (std::size_t i = 0; i < heights_.size(); ++i) {
            const bool on = last_[i] > first_[i];
            below_[first_[i] + (on && !leads_down_[i] ? 1 : 0)].push_back(piece_.points[i]);
            above_[last_[i] - (on && !leads_up_[i] ? 1 : 0)].push_back(piece_.points[i]);
        }
        const std::size_t begin = result.size();
        for (std::size_t i = 0; i < count; ++i) result.push_back({{normal, offsets[i]}, 0, 0, 0});
        gathered_.clear();
        for (std::size_t i = 0; i < count; ++i) result[begin + i].extra = grown(below_[i], on_[i]);
        gathered_.clear();
        for (std::size_t i = count; i-- > 0;) {
            RatedCut& cut = result[begin + i];
            const double below = cut.extra, above = grown(above_[i + 1], on_[i]);
            cut.extra = below + above - piece_.volume;
            cut.no_face = piece_.extra() * no_face * (1 - std::min(1.0, faces_[i] / (large_face * area_)));
            cut.rating =
                cut.extra + cut.no_face + piece_.extra() * unlike_halves * std::abs(below - above) / (below + above);
        }
    }

private:
    double area_of(const glm::uvec3& t) const {
        const DVec<3>& a = piece_.points[t.x];
        return length(cross(piece_.points[t.y] - a, piece_.points[t.z] - a));
    }

    double grown(const std::vector<DVec<3>>& come, const std::vector<DVec<3>>& on) {
        gathered_.insert(gathered_.end(), come.begin(), come.end());
        gathered_.insert(gathered_.end(), on.begin(), on.end());
        if (gathered_.empty()) return 0;
        hull_.build(gathered_, roughness_);
        kept_.clear();
        for (const std::uint32_t corner : hull_.corners()) kept_.push_back(gathered_[corner]);
        gathered_.swap(kept_);
        return hull_.volume() + piece_.thickness * hull_.area() / 2;
    }

    const Piece& piece_;
    RoughHull& hull_;
    double margin_;
    double roughness_;
    std::vector<Edge> edges_;
    std::vector<double> heights_;
    std::vector<std::uint32_t> first_, last_;
    double area_ = 0;
    std::vector<double> faces_;  ///< one a plane: the area of those in it
    std::vector<bool> leads_down_, leads_up_;
    std::vector<std::vector<DVec<3>>> below_, above_, on_;
    std::vector<DVec<3>> gathered_, kept_;
};

/// The eigenvectors of a symmetric matrix, by Jacobi's rotations.
std::array<DVec<3>, 3> main_axes(std::span<const DVec<3>> points) {
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
                const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
                const double c = 1 / std::sqrt(t * t + 1), s = t * c;
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

/// Heights between the lowest and the highest at which the surface is level, the largest areas first.
void add_levels(const Piece& piece, const DVec<3>& normal, double margin, std::vector<double>& offsets) {
    constexpr std::size_t most = 8;
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
    std::vector<std::pair<double, double>> joined;  // area, height
    for (const auto& [height, area] : found) {
        if (joined.empty() || height - joined.back().second > margin)
            joined.emplace_back(area, height);
        else
            joined.back().first += area;
    }
    std::sort(joined.rbegin(), joined.rend());
    for (std::size_t i = 0; i < std::min(most, joined.size()); ++i) offsets.push_back(joined[i].second);
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

bool better(const RatedCut& a, const RatedCut& b) {
    const auto key = [](const RatedCut& cut) {
        return std::tuple(cut.rating, cut.plane.normal.x, cut.plane.normal.y, cut.plane.normal.z, cut.plane.offset);
    };
    return key(a) < key(b);
}

}  // namespace

double cut_margin(const Piece& piece) {
    const Extent extent = extent_of(piece.points);
    return 1e-5 * largest(extent.greatest - extent.least);
}

void measure_hull(Piece& piece, RoughHull& hull) {
    constexpr double fine = 1e-4;
    hull.build(piece.points, fine);
    piece.hull_volume = hull.volume() + piece.thickness * hull.area() / 2;
}

std::vector<RatedCut> rated_cuts(const Piece& piece, RoughHull& hull, std::size_t count, int offsets_a_sweep) {
    Sweeper sweeper(piece, hull);
    const double margin = cut_margin(piece);
    std::vector<RatedCut> cuts;
    std::vector<double> offsets;
    std::vector<DVec<3>> normals = {axis<3>(0), axis<3>(1), axis<3>(2)};
    for (const DVec<3>& across : main_axes(piece.points))
        if (largest(across) < 0.995) normals.push_back(across);

    std::vector<RatedCut> best_of_sweeps;
    for (const DVec<3>& normal : normals) {
        const auto [low, high] = range_of(piece, normal);
        const double spacing = (high - low) / (offsets_a_sweep + 1);
        if (!(spacing > 10 * margin)) continue;
        offsets.clear();
        add_levels(piece, normal, margin, offsets);
        std::sort(offsets.begin(), offsets.end());
        const std::size_t begin = cuts.size();
        sweeper.rate(normal, offsets, cuts);
        offsets.clear();
        for (int i = 1; i <= offsets_a_sweep; ++i) offsets.push_back(low + spacing * i);
        sweeper.rate(normal, offsets, cuts);
        if (begin == cuts.size()) continue;
        best_of_sweeps.push_back(
            *std::min_element(cuts.begin() + static_cast<std::ptrdiff_t>(begin), cuts.end(), better));
    }
    std::sort(best_of_sweeps.begin(), best_of_sweeps.end(), better);
    const std::size_t refined = offsets_a_sweep > 6 ? 2 : 0;
    for (std::size_t i = 0; i < std::min(refined, best_of_sweeps.size()); ++i) {
        if (best_of_sweeps[i].no_face == 0) continue;
        const CutPlane& plane = best_of_sweeps[i].plane;
        const auto [low, high] = range_of(piece, plane.normal);
        const double spacing = (high - low) / (offsets_a_sweep + 1);
        offsets.clear();
        for (const int k : {-3, -2, -1, 1, 2, 3}) offsets.push_back(plane.offset + spacing * k / 4);
        sweeper.rate(plane.normal, offsets, cuts);
    }
    for (const auto& [normal, levels] : reflex_planes(piece)) sweeper.rate(normal, levels, cuts);

    std::sort(cuts.begin(), cuts.end(), better);
    const Extent extent = extent_of(piece.points);
    // The best across each direction first: that is where cuts differ most.
    std::vector<RatedCut> result;
    for (const double least_distance : {2.0, 0.04}) {
        const double near = least_distance * largest(extent.greatest - extent.least);
        for (const RatedCut& cut : cuts) {
            if (result.size() >= count) break;
            const bool alike = std::any_of(result.begin(), result.end(), [&](const RatedCut& other) {
                return std::abs(dot(cut.plane.normal, other.plane.normal)) > 0.995 &&
                       std::abs(cut.plane.offset - other.plane.offset) < near;
            });
            if (!alike) result.push_back(cut);
        }
    }
    return result;
}

}  // namespace abut
