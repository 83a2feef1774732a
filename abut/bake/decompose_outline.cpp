#include <abut/bake/convex_partition.hpp>
#include <abut/bake/decompose_outline.hpp>
#include <abut/bake/outline_sweep.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace abut {
namespace {

using outline::Partition;

/// Of the loop of a piece, as a part of it has it: straight corners left out, from the least.
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
        std::ranges::rotate(corners_, std::ranges::min_element(corners_));
        loop_.clear();
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const Vec2& before = partition.point(corners_[i == 0 ? corners_.size() - 1 : i - 1]);
            const Vec2& corner = partition.point(corners_[i]);
            const Vec2& after = partition.point(corners_[i + 1 == corners_.size() ? 0 : i + 1]);
            if (orientation(before, corner, after) != 0) loop_.push_back(corner);
        }
        report_.area += area_of_loop();
        Polygon part;
        if (!part.set_outline(loop_)) {
            part = *Polygon::build(loop_);
            if (part.rank() < 2) ++report_.thin_pieces;
        }
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
        return Problem{ProblemCode::bad_argument, "concavity is a finite length, not below 0", 0};
    if (options.concavity > 0 && options.conforming)
        return Problem{ProblemCode::bad_argument, "only exact parts are conforming: concavity is not 0", 0};
    return std::nullopt;
}

}  // namespace

Result<std::vector<Polygon>> decompose(std::span<const Vec2> outline, std::span<const std::vector<Vec2>> holes,
                                       const OutlineOptions& options) {
    OutlineReport unread;
    OutlineReport& report = options.report != nullptr ? *options.report : unread;
    report = {};
    if (auto problem = problem_with(outline, options)) return *problem;
    const Result<outline::Triangulation> triangles = outline::triangulate(outline, holes);
    if (!triangles) return triangles.problem();
    if (triangles->origins.empty()) return Problem{ProblemCode::degenerate, "the outline has nothing inside", 0};
    report.repeated_points = triangles->repeated_points;
    report.touching_points = triangles->touching_points;
    report.cancelled_edges = triangles->cancelled_edges;
    report.idle_holes = triangles->idle_holes;

    Partition partition(*triangles, options.conforming);
    partition.merge_all();
    const std::vector<std::uint32_t> faces = partition.faces();
    report.pieces = faces.size();
    std::vector<Polygon> parts;
    parts.reserve(faces.size());
    PartMaker maker(report);
    for (const std::uint32_t face : faces) parts.push_back(maker.make(partition, face));
    return parts;
}

}  // namespace abut
