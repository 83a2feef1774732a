#include <abut/bake/decompose_outline.hpp>
#include <abut/bake/outline/partition.hpp>
#include <abut/bake/outline/triangulate.hpp>
#include <abut/convex/hull/hull_input.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace abut {

using namespace detail;

namespace {

using outline::Partition;

/// Up to this number of corners the minimum partition is computed at once.
constexpr std::uint32_t max_exact_corners = 128;
/// Up to this number of corners large patches are improved.
constexpr std::uint32_t max_large_patch_corners = 2000;

/// Makes the polygon of a face: without its straight corners, starting at the smallest.
class PartMaker {
public:
    explicit PartMaker(OutlineReport& report) : report_(report) {}

    Polygon make(const Partition& partition, std::uint32_t face) {
        corners_.clear();
        std::uint32_t edge = face;
        do {
            corners_.push_back(partition.origin(edge));
            edge = partition.next(edge);
        } while (edge != face);
        // Points are numbered in lexicographical order.
        std::rotate(corners_.begin(), std::ranges::min_element(corners_), corners_.end());
        loop_.clear();
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const Vec2& before = partition.point(corners_[i == 0 ? corners_.size() - 1 : i - 1]);
            const Vec2& corner = partition.point(corners_[i]);
            const Vec2& after = partition.point(corners_[i + 1 == corners_.size() ? 0 : i + 1]);
            if (orientation(before, corner, after) != 0) loop_.push_back(corner);
        }
        const double area = area_of_loop();
        Polygon part;
        if (!part.set_outline(loop_)) {
            part = *Polygon::build(loop_);
            if (part.rank() < 2) ++report_.thin_pieces;
        }
        report_.area += area;
        report_.area_added += std::max(0.0, part.area() - area);
        return part;
    }

private:
    double area_of_loop() const {
        double twice = 0;
        const DVec<2> first(loop_[0]);
        for (std::size_t i = 1; i + 1 < loop_.size(); ++i)
            twice += cross(DVec<2>(loop_[i]) - first, DVec<2>(loop_[i + 1]) - first);
        return 0.5 * twice;
    }

    OutlineReport& report_;
    std::vector<std::uint32_t> corners_;
    std::vector<Vec2> loop_;
};

std::optional<Problem> problem_with(std::span<const Vec2> outline, const OutlineOptions& options) {
    if (outline.empty()) return Problem{ProblemCode::empty_input, "the outline has no points", 0};
    if (!std::isfinite(options.concavity) || options.concavity < 0)
        return Problem{ProblemCode::bad_argument, "concavity is not a finite length of at least 0", 0};
    if (options.concavity > 0 && options.conforming)
        return Problem{ProblemCode::bad_argument, "conforming parts must be exact: concavity is not 0", 0};
    return std::nullopt;
}

/// The holes; those to be filled are empty.
std::vector<std::vector<Vec2>> open_holes(double width, std::span<const std::vector<Vec2>> holes,
                                          OutlineReport& report) {
    std::vector<std::vector<Vec2>> result(holes.begin(), holes.end());
    for (std::vector<Vec2>& hole : result) {
        const bool finite = std::ranges::all_of(hole, [](const Vec2& point) { return is_finite(point); });
        if (hole.empty() || !finite || extent<2>(hole) > width) continue;
        hole.clear();
        ++report.filled_holes;
    }
    return result;
}

/// Partitions the region into few convex faces.
void cut(Partition& partition, OutlineReport& report) {
    report.reflex_corners = partition.reflex_corners();
    const std::size_t corners = partition.corners();
    partition.merge_all();
    const auto cuts = static_cast<std::int64_t>((report.reflex_corners + 1) / 2);
    report.min_pieces = static_cast<std::size_t>(std::max<std::int64_t>(1, partition.pieces_less_holes() + cuts));
    const auto is_optimal = [&] { return partition.face_count() == report.min_pieces; };
    if (is_optimal())
        report.optimal = true;
    else if (corners <= max_exact_corners)
        report.optimal = partition.improve(max_exact_corners, 3, false).optimal;
    else if (corners <= max_large_patch_corners)
        partition.improve(32, 3, false);
    else if (partition.improve(8, 1, true).is_worthwhile)
        partition.improve(16, 2, false);
    report.optimal = report.optimal || is_optimal();
}

}  // namespace

Result<std::vector<Polygon>> decompose(const PointSpan<2>& given, std::span<const std::vector<Vec2>> holes,
                                       const OutlineOptions& options) {
    const PackedPoints<2> packed(given);
    const std::span<const Vec2> outline = packed.points();
    OutlineReport unused;
    OutlineReport& report = options.report != nullptr ? *options.report : unused;
    report = {};
    if (auto problem = problem_with(outline, options)) return *problem;
    Result<outline::Triangulation> triangles =
        options.concavity > 0 ? outline::triangulate(outline, open_holes(options.concavity, holes, report))
                              : outline::triangulate(outline, holes);
    if (!triangles) return triangles.problem();
    if (triangles->origins.empty()) return Problem{ProblemCode::degenerate, "the interior of the outline is empty", 0};
    report.repeated_points = triangles->repeated_points;
    report.touching_points = triangles->touching_points;
    report.cancelled_edges = triangles->cancelled_edges;
    report.idle_holes = triangles->idle_holes;

    outline::shorten_edges(*triangles);
    Partition partition(*triangles, options.conforming);
    cut(partition, report);
    if (options.concavity > 0) partition.merge_shallow(options.concavity);
    const std::vector<std::uint32_t> faces = partition.faces();
    report.pieces = faces.size();
    std::vector<Polygon> parts;
    parts.reserve(faces.size());
    PartMaker maker(report);
    for (const std::uint32_t face : faces) parts.push_back(maker.make(partition, face));
    return parts;
}

}  // namespace abut
