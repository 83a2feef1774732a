#include <abut/bake/bodies.hpp>
#include <abut/bake/cut_search.hpp>
#include <abut/bake/decompose.hpp>
#include <abut/bake/gaps.hpp>
#include <abut/bake/merge_parts.hpp>
#include <abut/convex/hull.hpp>
#include <abut/convex/hull_input.hpp>
#include <abut/math/dvec.hpp>
#include <abut/shape/weld.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace abut {
namespace {

/// Cut into more pieces than there may be parts: which cuts were needless shows when they are joined.
constexpr double pieces_a_part = 1.75;

/// Of half the longest side of the mesh's box.
constexpr double shell_thickness = 0.01;

/// How exactly gaps are measured: 0.003 of half the longest side, or a tenth of what they may be.
double gap_precision(double half, double concavity) {
    return std::max(0.003 * half, 0.1 * concavity);
}

struct Candidate {
    Piece piece;
    bool whole = false;
    bool done = false;
};

class Decomposer {
public:
    Decomposer(const Welded& mesh, const DecomposeOptions& options) : options_(options) {
        half_ = extent<3>(mesh.points) / 2;
        concavity_ = options.concavity * half_;
        for (Piece& body : bodies_of(mesh.points, mesh.triangles, shell_thickness * half_)) {
            const bool whole = is_convex(body);
            closed_ = closed_ && body.closed;
            if (body.closed) mesh_volume_ += body.volume;
            add(std::move(body), whole);
        }
    }

    Result<std::vector<Polyhedron>> run() {
        const std::size_t bodies = candidates_.size();
        const auto most = bodies + static_cast<std::size_t>(pieces_a_part * options_.max_parts);
        for (std::size_t cuts = 0; candidates_.size() < most && cuts < 2 * most; ++cuts) {
            constexpr double share_of_cutting = 0.9;
            const double done = static_cast<double>(candidates_.size() - bodies) / static_cast<double>(most - bodies);
            if (is_cancelled(done * share_of_cutting)) return cancelled();
            const std::size_t worst = worst_candidate();
            if (worst == candidates_.size()) break;
            cut_up(worst);
        }
        if (is_cancelled(0.9)) return cancelled();
        std::vector<Lump> lumps;
        for (Candidate& candidate : candidates_) {
            Piece& piece = candidate.piece;
            const double gap = candidate.whole ? 0 : gap_of(piece);
            lumps.push_back(
                {std::move(piece.points), piece.volume, piece.hull_volume, piece.thickness, gap, candidate.whole});
        }
        merge_parts(lumps, options_.max_parts, {concavity_, gap_precision(half_, concavity_)}, hull_);
        if (is_cancelled(1)) return cancelled();
        return parts_of(lumps);
    }

private:
    bool is_cancelled(double done) const { return options_.progress && !(*options_.progress)(done); }

    static Problem cancelled() { return {ProblemCode::cancelled, "the decomposition was cancelled", 0}; }

    void add(Piece piece, bool whole) {
        Candidate& candidate = candidates_.emplace_back();
        candidate.piece = std::move(piece);
        measure_hull(candidate.piece, hull_);
        candidate.whole = candidate.done = whole;
        if (whole) return;
        candidate.done =
            volume_as_length(candidate.piece.extra()) <= concavity_ && gap_of(candidate.piece) <= concavity_;
    }

    /// How far its hull is from it.
    double gap_of(const Piece& piece) {
        return farthest_from(piece, coarse_sides(piece.points, hull_), {concavity_, gap_precision(half_, concavity_)});
    }

    /// The one whose hull adds most; past the last where all are near enough.
    std::size_t worst_candidate() const {
        std::size_t worst = candidates_.size();
        for (std::size_t i = 0; i < candidates_.size(); ++i)
            if (!candidates_[i].done &&
                (worst == candidates_.size() || candidates_[i].piece.extra() > candidates_[worst].piece.extra()))
                worst = i;
        return worst;
    }

    std::vector<Piece> cut_by(const Piece& piece, const CutPlane& plane) {
        std::vector<Piece> parts = cut(piece, plane, cut_margin(piece));
        for (Piece& part : parts) measure_hull(part, hull_);
        return parts;
    }

    /// What the hulls will have beyond the piece when each part is cut once more.
    double extra_after_cuts(const std::vector<Piece>& parts) {
        constexpr int offsets = 5;
        double result = 0;
        for (const Piece& part : parts) {
            const std::vector<RatedCut> next = rated_cuts(part, hull_, 1, offsets);
            result += next.empty() ? part.extra() : std::min(part.extra(), next.front().extra);
        }
        return result;
    }

    void cut_up(std::size_t number) {
        constexpr int offsets = 11;
        constexpr std::size_t large = 1500, small = 500;
        Candidate& candidate = candidates_[number];
        const std::size_t points = candidate.piece.points.size();
        constexpr std::size_t most_looks = 4;
        constexpr double clear_gain = 0.3;
        constexpr double still_whole = 0.999;  // else what was cut off was empty
        std::vector<RatedCut> cuts = rated_cuts(candidate.piece, hull_, most_looks, offsets);
        std::size_t looks = points > large ? 1 : points > small ? 2 : most_looks;
        if (!cuts.empty() && cuts.front().extra > (1 - clear_gain) * candidate.piece.extra()) looks = most_looks;
        if (cuts.size() > looks) cuts.resize(looks);
        std::vector<Piece> best;
        double least = 0;
        for (const RatedCut& rated : cuts) {
            std::vector<Piece> parts = cut_by(candidate.piece, rated.plane);
            if (parts.empty() ||
                (parts.size() == 1 && parts[0].hull_volume > still_whole * candidate.piece.hull_volume))
                continue;
            // Of cuts that lead equally far the one that leads there at once.
            constexpr double now = 0.02, clearly = 1e-3;
            const double left = looks == 1 ? 0 : extra_after_cuts(parts) + now * rated.extra + rated.no_face;
            if (!best.empty() && left >= least - clearly * candidate.piece.extra()) continue;
            least = left;
            best = std::move(parts);
        }
        if (best.empty()) {
            candidate.done = true;
            return;
        }
        candidates_.erase(candidates_.begin() + static_cast<std::ptrdiff_t>(number));
        for (Piece& part : best) add(std::move(part), false);
    }

    Result<std::vector<Polyhedron>> parts_of(const std::vector<Lump>& lumps) const {
        DecomposeReport report;
        report.closed = closed_;
        report.mesh_volume = mesh_volume_;
        std::vector<Polyhedron> parts;
        for (const Lump& lump : lumps) {
            std::vector<Vec3> points;
            points.reserve(lump.points.size());
            double moved = 0;
            for (const DVec<3>& p : lump.points) {
                points.push_back(to_float(p));
                moved = std::max(moved, length(p - DVec<3>(points.back())));
            }
            Result<Polyhedron> built = Polyhedron::build(points, {.max_vertices = options_.max_vertices});
            if (!built) return built.problem();
            const Polyhedron& part = parts.emplace_back(*std::move(built));
            report.parts_volume += part.volume();
            report.vertices += part.points().size();
            report.farthest = std::max(report.farthest, moved + hull_tolerance * extent<3>(points));
            report.concavity.push_back(std::max(lump.gap, volume_as_length(lump.hull_volume - lump.volume)) / half_);
        }
        if (options_.report != nullptr) *options_.report = std::move(report);
        return parts;
    }

    const DecomposeOptions& options_;
    RoughHull hull_;
    std::vector<Candidate> candidates_;
    double half_ = 0;       ///< the longest side of the mesh's box, halved
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
        return Problem{ProblemCode::bad_argument, "concavity is no number from 0 on", 0};
    if (triangles.empty()) return Problem{ProblemCode::empty_input, "there are no triangles", 0};
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (int i = 0; i < 3; ++i)
            if (triangles[t][i] >= points.size())
                return Problem{ProblemCode::index_out_of_range,
                               "triangle " + std::to_string(t) + " names a point that isn't there", t};
    return problem_with<3>(points);
}

}  // namespace

Result<std::vector<Polyhedron>> decompose(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                          const DecomposeOptions& options) {
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
