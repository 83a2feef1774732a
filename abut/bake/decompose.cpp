#include <abut/bake/decompose.hpp>
#include <abut/bake/parts/concavity.hpp>
#include <abut/bake/parts/cut_search.hpp>
#include <abut/bake/parts/merge_parts.hpp>
#include <abut/bake/parts/piece.hpp>
#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/hull_input.hpp>
#include <abut/math/dvec.hpp>
#include <abut/shape/weld.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace abut {

using namespace detail;

namespace {

/// Pieces per part: the body is cut into more pieces than there may be parts, and merging finds the needless cuts.
constexpr double pieces_per_part = 1.75;

/// As a share of half the longest side of the mesh's bounding box.
constexpr double shell_thickness = 0.01;

/// The precision of hull distances: 0.003 of half the longest side, or a tenth of the permitted distance if that is
/// larger.
double distance_precision(double half, double concavity) {
    return std::max(0.003 * half, 0.1 * concavity);
}

struct Candidate {
    Piece piece;
    bool is_convex_component = false;
    bool done = false;
};

class Decomposer {
public:
    Decomposer(const Welded& mesh, const DecomposeOptions& options) : options_(options) {
        half_ = extent<3>(mesh.points) / 2;
        concavity_ = options.concavity * half_;
        for (Piece& component : components_of(mesh.points, mesh.triangles, shell_thickness * half_)) {
            const bool is_convex_component = is_convex(component);
            closed_ = closed_ && component.closed;
            if (component.closed) mesh_volume_ += component.volume;
            add(std::move(component), is_convex_component);
        }
    }

    Result<std::vector<Polyhedron>> run() {
        const std::size_t components = candidates_.size();
        const auto max_pieces = components + static_cast<std::size_t>(pieces_per_part * options_.max_parts);
        for (std::size_t cuts = 0; candidates_.size() < max_pieces && cuts < 2 * max_pieces; ++cuts) {
            constexpr double share_of_cutting = 0.9;
            const double done =
                static_cast<double>(candidates_.size() - components) / static_cast<double>(max_pieces - components);
            if (is_cancelled(done * share_of_cutting)) return cancelled();
            const std::size_t least_convex = least_convex_candidate();
            if (least_convex == candidates_.size()) break;
            split(least_convex);
        }
        if (is_cancelled(0.9)) return cancelled();
        std::vector<MergePart> parts_to_merge;
        for (Candidate& candidate : candidates_) {
            Piece& piece = candidate.piece;
            const double distance = candidate.is_convex_component ? 0 : distance_to_hull(piece);
            parts_to_merge.push_back({std::move(piece.points), piece.volume, piece.hull_volume, piece.thickness,
                                      distance, candidate.is_convex_component});
        }
        merge_parts(parts_to_merge, options_.max_parts, {concavity_, distance_precision(half_, concavity_)}, hull_);
        if (is_cancelled(1)) return cancelled();
        return parts_of(parts_to_merge);
    }

private:
    bool is_cancelled(double done) const { return options_.progress && !(*options_.progress)(done); }

    static Problem cancelled() { return {ProblemCode::cancelled, "the decomposition was cancelled", 0}; }

    void add(Piece piece, bool is_convex_component) {
        Candidate& candidate = candidates_.emplace_back();
        candidate.piece = std::move(piece);
        measure_hull(candidate.piece, hull_);
        candidate.is_convex_component = candidate.done = is_convex_component;
        if (is_convex_component) return;
        candidate.done = volume_as_length(candidate.piece.excess_volume()) <= concavity_ &&
                         distance_to_hull(candidate.piece) <= concavity_;
    }

    /// The distance of the piece's hull from the piece.
    double distance_to_hull(const Piece& piece) {
        return farthest_distance(piece, approximate_hull_surface(piece.points, hull_),
                                 {concavity_, distance_precision(half_, concavity_)});
    }

    /// The candidate whose hull adds the most volume. The number of candidates if all are within the concavity.
    std::size_t least_convex_candidate() const {
        std::size_t least_convex = candidates_.size();
        for (std::size_t i = 0; i < candidates_.size(); ++i)
            if (!candidates_[i].done &&
                (least_convex == candidates_.size() ||
                 candidates_[i].piece.excess_volume() > candidates_[least_convex].piece.excess_volume()))
                least_convex = i;
        return least_convex;
    }

    std::vector<Piece> cut_by(const Piece& piece, const CutPlane& plane) {
        std::vector<Piece> parts = cut(piece, plane, cut_tolerance(piece));
        for (Piece& part : parts) measure_hull(part, hull_);
        return parts;
    }

    /// The volume that the hulls will add to the piece after each part is cut once more (a lookahead of one cut).
    double excess_volume_after_cuts(const std::vector<Piece>& parts) {
        constexpr int offsets = 5;
        double result = 0;
        for (const Piece& part : parts) {
            const std::vector<RatedCut> next = best_cuts(part, hull_, 1, offsets);
            result += next.empty() ? part.excess_volume() : std::min(part.excess_volume(), next.front().excess_volume);
        }
        return result;
    }

    void split(std::size_t number) {
        constexpr int offsets = 11;
        constexpr std::size_t large = 1500, small = 500;
        Candidate& candidate = candidates_[number];
        const std::size_t points = candidate.piece.points.size();
        constexpr std::size_t max_lookaheads = 4;
        constexpr double decisive_gain = 0.3;
        constexpr double unchanged_share = 0.999;  // above it, the part cut off was empty
        std::vector<RatedCut> cuts = best_cuts(candidate.piece, hull_, max_lookaheads, offsets);
        std::size_t lookaheads = points > large ? 1 : points > small ? 2 : max_lookaheads;
        if (!cuts.empty() && cuts.front().excess_volume > (1 - decisive_gain) * candidate.piece.excess_volume())
            lookaheads = max_lookaheads;
        if (cuts.size() > lookaheads) cuts.resize(lookaheads);
        std::vector<Piece> best;
        double best_excess_volume = 0;
        for (const RatedCut& rated : cuts) {
            std::vector<Piece> parts = cut_by(candidate.piece, rated.plane);
            if (parts.empty() ||
                (parts.size() == 1 && parts[0].hull_volume > unchanged_share * candidate.piece.hull_volume))
                continue;
            // Of cuts with nearly equal lookahead, the one with the smaller immediate volume wins.
            constexpr double immediate_weight = 0.02, improvement = 1e-3;
            const double remaining = lookaheads == 1 ? 0
                                                     : excess_volume_after_cuts(parts) +
                                                           immediate_weight * rated.excess_volume + rated.missing_face;
            if (!best.empty() && remaining >= best_excess_volume - improvement * candidate.piece.excess_volume())
                continue;
            best_excess_volume = remaining;
            best = std::move(parts);
        }
        if (best.empty()) {
            candidate.done = true;
            return;
        }
        candidates_.erase(candidates_.begin() + static_cast<std::ptrdiff_t>(number));
        for (Piece& part : best) add(std::move(part), false);
    }

    Result<std::vector<Polyhedron>> parts_of(const std::vector<MergePart>& parts_to_merge) const {
        DecomposeReport report;
        report.closed = closed_;
        report.mesh_volume = mesh_volume_;
        std::vector<Polyhedron> parts;
        for (const MergePart& part_to_merge : parts_to_merge) {
            std::vector<Vec3> points;
            points.reserve(part_to_merge.points.size());
            double rounding = 0;
            for (const DVec<3>& p : part_to_merge.points) {
                points.push_back(to_float(p));
                rounding = std::max(rounding, length(p - DVec<3>(points.back())));
            }
            Result<Polyhedron> built = Polyhedron::build(points, {.max_vertices = options_.max_vertices});
            if (!built) return built.problem();
            const Polyhedron& part = parts.emplace_back(*std::move(built));
            report.parts_volume += part.volume();
            report.vertices += part.points().size();
            report.farthest = std::max(report.farthest, rounding + hull_tolerance * extent<3>(points));
            report.concavity.push_back(std::max(part_to_merge.hull_distance,
                                                volume_as_length(part_to_merge.hull_volume - part_to_merge.volume)) /
                                       half_);
        }
        if (options_.report != nullptr) *options_.report = std::move(report);
        return parts;
    }

    const DecomposeOptions& options_;
    ApproximateHull hull_;
    std::vector<Candidate> candidates_;
    double half_ = 0;       ///< half the longest side of the mesh's bounding box
    double concavity_ = 0;  ///< as a length
    double mesh_volume_ = 0;
    bool closed_ = true;
};

std::optional<Problem> problem_of(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                  const DecomposeOptions& options) {
    if (options.max_parts == 0) return Problem{ProblemCode::bad_argument, "max_parts is 0", 0};
    if (options.max_vertices > 0 && options.max_vertices < 4)
        return Problem{ProblemCode::bad_argument, "max_vertices is below 4", 0};
    if (!(options.concavity >= 0) || !std::isfinite(options.concavity))
        return Problem{ProblemCode::bad_argument, "concavity is not a finite number of at least 0", 0};
    if (triangles.empty()) return Problem{ProblemCode::empty_input, "there are no triangles", 0};
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (int i = 0; i < 3; ++i)
            if (triangles[t][i] >= points.size())
                return Problem{ProblemCode::index_out_of_range,
                               "triangle " + std::to_string(t) + " names a point that doesn't exist", t};
    return problem_with<3>(points);
}

}  // namespace

Result<std::vector<Polyhedron>> decompose(const PointSpan<3>& given, std::span<const glm::uvec3> triangles,
                                          const DecomposeOptions& options) {
    const PackedPoints<3> packed(given);
    const std::span<const Vec3> points = packed.points();
    if (std::optional<Problem> problem = problem_of(points, triangles, options)) return *std::move(problem);
    const Welded mesh = weld(points, triangles);
    if (mesh.triangles.empty())
        return Problem{ProblemCode::empty_input, "every triangle has two corners in the same place", 0};
    return Decomposer(mesh, options).run();
}

Result<std::vector<Polyhedron>> decompose(const Mesh& mesh, const DecomposeOptions& options) {
    return decompose(mesh.points(), mesh.triangles(), options);
}

}  // namespace abut
