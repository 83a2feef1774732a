#include <abut/math/dvec.hpp>
#include <abut/recast/recast_polygons.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include <recastnavigation/Recast.h>

namespace abut {
namespace {

constexpr int most_spans = (1 << 24) - 1;    // the bits that Recast has for their numbers
constexpr std::size_t most_in_column = 250;  // and for how many are above one another

/// Detail: points every so many cells, where the height is off by more than so many cells of height.
constexpr float detail_distance = 4, detail_error = 1;
/// How far the border of a region may be from the cells', and how long a piece of it is, in cells.
constexpr float contour_error = 1;
constexpr int contour_length = 40;
/// The floor is cut into squares of so many cells: there are at most 127 points for details of a polygon.
constexpr int square = 40;
/// Regions of fewer cells are joined to their neighbours where that can be.
constexpr int small_region = 400;

class Context : public rcContext {
public:
    Context() : rcContext(true) { enableTimer(false); }

    std::size_t warnings() const { return warnings_; }
    Problem problem(const char* stage) const {
        const std::string message = last_.empty() ? std::string("Recast stopped at ") + stage : "Recast: " + last_;
        return {ProblemCode::too_large, message, 0};
    }

private:
    void doLog(rcLogCategory category, const char* message, int) override {
        if (category == RC_LOG_PROGRESS) return;
        ++warnings_;
        if (category == RC_LOG_ERROR) last_ = message;
    }

    std::size_t warnings_ = 0;
    std::string last_;
};

template <class T, void (*release)(T*)>
struct Release {
    void operator()(T* thing) const { release(thing); }
};
using Heightfield = std::unique_ptr<rcHeightfield, Release<rcHeightfield, rcFreeHeightField>>;
using CompactField = std::unique_ptr<rcCompactHeightfield, Release<rcCompactHeightfield, rcFreeCompactHeightfield>>;
using Contours = std::unique_ptr<rcContourSet, Release<rcContourSet, rcFreeContourSet>>;
using Polygons = std::unique_ptr<rcPolyMesh, Release<rcPolyMesh, rcFreePolyMesh>>;
using Details = std::unique_ptr<rcPolyMeshDetail, Release<rcPolyMeshDetail, rcFreePolyMeshDetail>>;

Problem cancelled() {
    return {ProblemCode::cancelled, "cancelled", 0};
}
Problem nothing(const char* why) {
    return {ProblemCode::empty_input, std::string("nothing of the level can be walked on: ") + why, 0};
}

/// The pipeline, one stage after another.
class Pipeline {
public:
    Pipeline(const RecastPlan& plan, FunctionRef<bool(double)> tell) : plan_(plan), tell_(tell) {}

    std::optional<Problem> measure(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                   std::span<const std::uint8_t> floor) {
        heights_.reset(rcAllocHeightfield());
        const float least[3] = {0, 0, 0};
        const float most[3] = {plan_.cell * static_cast<float>(plan_.columns), plan_.top,
                               plan_.cell * static_cast<float>(plan_.rows)};
        if (!heights_ || !rcCreateHeightfield(&context_, *heights_, plan_.columns, plan_.rows, least, most, plan_.cell,
                                              plan_.cell_height))
            return context_.problem("the grid");
        std::vector<float> numbers;
        numbers.reserve(3 * points.size());
        for (const Vec3& p : points) numbers.insert(numbers.end(), {p.x, p.y, p.z});
        constexpr std::size_t batch = 8192;
        std::vector<int> corners;
        std::vector<unsigned char> areas;
        for (std::size_t begin = 0; begin < triangles.size(); begin += batch) {
            if (!tell_(0.3 * static_cast<double>(begin) / static_cast<double>(triangles.size()))) return cancelled();
            const std::size_t end = std::min(triangles.size(), begin + batch);
            corners.clear();
            areas.clear();
            for (std::size_t i = begin; i < end; ++i) {
                for (int k = 0; k < 3; ++k) corners.push_back(static_cast<int>(triangles[i][k]));
                areas.push_back(floor[i] != 0 ? RC_WALKABLE_AREA : RC_NULL_AREA);
            }
            if (!rcRasterizeTriangles(&context_, numbers.data(), static_cast<int>(points.size()), corners.data(),
                                      areas.data(), static_cast<int>(end - begin), *heights_, plan_.climb))
                return context_.problem("measuring the triangles");
        }
        return std::nullopt;
    }

    std::optional<Problem> find_floor() {
        if (!tell_(0.3)) return cancelled();
        rcFilterLowHangingWalkableObstacles(&context_, plan_.climb, *heights_);
        rcFilterLedgeSpans(&context_, plan_.height, plan_.ledge, *heights_);
        rcFilterWalkableLowHeightSpans(&context_, plan_.height, *heights_);
        if (std::optional<Problem> problem = problem_of_spans()) return problem;

        if (!tell_(0.4)) return cancelled();
        floor_.reset(rcAllocCompactHeightfield());
        if (!floor_ || !rcBuildCompactHeightfield(&context_, plan_.height, plan_.climb, *heights_, *floor_))
            return context_.problem("the floor");
        heights_.reset();
        if (plan_.radius > 0 && !rcErodeWalkableArea(&context_, plan_.radius, *floor_))
            return context_.problem("the walker's radius");
        const auto is_left = [](unsigned char area) { return area != RC_NULL_AREA; };
        if (std::none_of(floor_->areas, floor_->areas + floor_->spanCount, is_left))
            return nothing("no floor is as wide as the walker's radius asks");
        cut_into_squares();
        return std::nullopt;
    }

    std::optional<Problem> find_regions() {
        if (!tell_(0.45)) return cancelled();
        if (!rcBuildDistanceField(&context_, *floor_)) return context_.problem("the distances");
        if (!tell_(0.5)) return cancelled();
        if (!rcBuildRegions(&context_, *floor_, 0, plan_.least_region, small_region))
            return context_.problem("the regions");
        if (!tell_(0.75)) return cancelled();
        contours_.reset(rcAllocContourSet());
        if (!contours_ || !rcBuildContours(&context_, *floor_, contour_error, contour_length, *contours_))
            return context_.problem("the contours");
        if (contours_->nconts == 0) return nothing("no part of the floor is as large as the least area");
        return std::nullopt;
    }

    std::optional<Problem> cut() {
        if (!tell_(0.8)) return cancelled();
        polygons_.reset(rcAllocPolyMesh());
        constexpr int corners_each = 6;
        if (!polygons_ || !rcBuildPolyMesh(&context_, *contours_, corners_each, *polygons_))
            return context_.problem("the polygons");
        contours_.reset();
        if (!tell_(0.85)) return cancelled();
        details_.reset(rcAllocPolyMeshDetail());
        if (!details_ || !rcBuildPolyMeshDetail(&context_, *polygons_, *floor_, detail_distance * plan_.cell,
                                                detail_error * plan_.cell_height, *details_))
            return context_.problem("the heights of the polygons");
        floor_.reset();
        if (polygons_->npolys == 0) return nothing("no polygon is left of it");
        return std::nullopt;
    }

    /// Heights are told of the tops of cells, and those of details a cell above that; the floor is half a cell below.
    RecastPolygons result() const {
        RecastPolygons result;
        result.warnings = context_.warnings();
        for (int i = 0; i < polygons_->nverts; ++i) {
            const unsigned short* at = polygons_->verts + 3 * i;
            result.corners.push_back({at[0] * static_cast<double>(plan_.cell),
                                      (at[1] - 0.5) * static_cast<double>(plan_.cell_height),
                                      at[2] * static_cast<double>(plan_.cell)});
        }
        for (int i = 0; i < polygons_->npolys; ++i) result.polygons.push_back(polygon(i));
        return result;
    }

private:
    /// Squares side by side are areas of their own, over whose borders no region goes.
    void cut_into_squares() {
        for (int row = 0; row < plan_.rows; ++row)
            for (int column = 0; column < plan_.columns; ++column) {
                const rcCompactCell& cell = floor_->cells[row * plan_.columns + column];
                const int area = 1 + column / square % 2 + 2 * (row / square % 2);
                for (unsigned int i = cell.index, end = i + cell.count; i < end; ++i)
                    if (floor_->areas[i] != RC_NULL_AREA) floor_->areas[i] = static_cast<unsigned char>(area);
            }
    }

    /// Beyond what Recast has bits for, it would go on with other numbers.
    std::optional<Problem> problem_of_spans() const {
        std::size_t count = 0;
        for (int i = 0; i < plan_.columns * plan_.rows; ++i) {
            std::size_t above = 0;
            for (const rcSpan* span = heights_->spans[i]; span != nullptr; span = span->next)
                above += span->area != RC_NULL_AREA;
            if (above > most_in_column)
                return Problem{ProblemCode::too_large, "more than 250 floors lie above one another", 0};
            count += above;
        }
        if (count > static_cast<std::size_t>(most_spans))
            return Problem{ProblemCode::too_large, "the floor has 2^24 cells or more: take larger ones", 0};
        if (count == 0) return nothing("above none of it there is room of the walker's height");
        return std::nullopt;
    }

    CutPolygon polygon(int index) const {
        CutPolygon result;
        const unsigned short* corners = polygons_->polys + 2 * polygons_->nvp * index;
        for (int k = 0; k < polygons_->nvp && corners[k] != RC_MESH_NULL_IDX; ++k) result.corners.push_back(corners[k]);
        const unsigned int* detail = details_->meshes + 4 * index;
        for (unsigned int k = 0; k < detail[1]; ++k) {
            const float* at = details_->verts + 3 * (detail[0] + k);
            result.points.push_back({at[0], at[1] - 1.5 * static_cast<double>(plan_.cell_height), at[2]});
        }
        for (unsigned int k = 0; k < detail[3]; ++k) {
            const unsigned char* at = details_->tris + 4 * (detail[2] + k);
            result.triangles.push_back({at[0], at[1], at[2]});
        }
        return result;
    }

    const RecastPlan& plan_;
    FunctionRef<bool(double)> tell_;
    Context context_;
    Heightfield heights_;
    CompactField floor_;
    Contours contours_;
    Polygons polygons_;
    Details details_;
};

}  // namespace

Result<RecastPolygons> recast_polygons(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                       std::span<const std::uint8_t> floor, const RecastPlan& plan,
                                       FunctionRef<bool(double done)> tell) {
    Pipeline pipeline(plan, tell);
    if (std::optional<Problem> problem = pipeline.measure(points, triangles, floor)) return *std::move(problem);
    if (std::optional<Problem> problem = pipeline.find_floor()) return *std::move(problem);
    if (std::optional<Problem> problem = pipeline.find_regions()) return *std::move(problem);
    if (std::optional<Problem> problem = pipeline.cut()) return *std::move(problem);
    return pipeline.result();
}

}  // namespace abut
