#include <abut/math/dvec.hpp>
#include <abut/recast/recast_polygons.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include <recastnavigation/Recast.h>

namespace abut::detail {
namespace {

constexpr int max_spans = (1 << 24) - 1;          // Recast's span numbers have 24 bits
constexpr std::size_t max_spans_in_column = 250;  // Recast's limit of spans in a column

/// Detail points every 4 cells, if the height error exceeds one cell height.
constexpr float detail_distance = 4, detail_error = 1;
/// Maximum error of a region's contour, and maximum length of its segments, in cells.
constexpr float contour_error = 1;
constexpr int contour_length = 40;
/// The floor is cut into squares of this many cells: a polygon has at most 127 detail points.
constexpr int square_cells = 40;
/// Regions of fewer cells are merged with their neighbours if possible.
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

Problem nothing(const char* why) {
    return {ProblemCode::empty_input, std::string("no part of the level is walkable: ") + why, 0};
}

/// Recast's stages, in order.
class Pipeline {
public:
    Pipeline(const RecastPlan& plan, FunctionRef<bool(double)> report) : plan_(plan), report_(report) {}

    std::optional<Problem> measure(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                   std::span<const std::uint8_t> floor) {
        heights_.reset(rcAllocHeightfield());
        const float min[3] = {0, 0, 0};
        const float max[3] = {plan_.cell * static_cast<float>(plan_.columns), plan_.top,
                              plan_.cell * static_cast<float>(plan_.rows)};
        if (!heights_ || !rcCreateHeightfield(&context_, *heights_, plan_.columns, plan_.rows, min, max, plan_.cell,
                                              plan_.cell_height))
            return context_.problem("the grid");
        std::vector<float> numbers;
        numbers.reserve(3 * points.size());
        for (const Vec3& p : points) numbers.insert(numbers.end(), {p.x, p.y, p.z});
        constexpr std::size_t batch = 8192;
        std::vector<int> corners;
        std::vector<unsigned char> areas;
        for (std::size_t begin = 0; begin < triangles.size(); begin += batch) {
            if (!report_(0.3 * static_cast<double>(begin) / static_cast<double>(triangles.size()))) return cancelled();
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
        if (!report_(0.3)) return cancelled();
        rcFilterLowHangingWalkableObstacles(&context_, plan_.climb, *heights_);
        rcFilterLedgeSpans(&context_, plan_.height, plan_.ledge, *heights_);
        rcFilterWalkableLowHeightSpans(&context_, plan_.height, *heights_);
        if (std::optional<Problem> problem = problem_of_spans()) return problem;

        if (!report_(0.4)) return cancelled();
        floor_.reset(rcAllocCompactHeightfield());
        if (!floor_ || !rcBuildCompactHeightfield(&context_, plan_.height, plan_.climb, *heights_, *floor_))
            return context_.problem("the floor");
        heights_.reset();
        if (plan_.radius > 0 && !rcErodeWalkableArea(&context_, plan_.radius, *floor_))
            return context_.problem("the walker's radius");
        const auto is_left = [](unsigned char area) { return area != RC_NULL_AREA; };
        if (std::none_of(floor_->areas, floor_->areas + floor_->spanCount, is_left))
            return nothing("no floor is wide enough for the walker's radius");
        cut_into_squares();
        return std::nullopt;
    }

    std::optional<Problem> find_regions() {
        if (!report_(0.45)) return cancelled();
        if (!rcBuildDistanceField(&context_, *floor_)) return context_.problem("the distances");
        if (!report_(0.5)) return cancelled();
        if (!rcBuildRegions(&context_, *floor_, 0, plan_.min_region, small_region))
            return context_.problem("the regions");
        if (!report_(0.75)) return cancelled();
        contours_.reset(rcAllocContourSet());
        if (!contours_ || !rcBuildContours(&context_, *floor_, contour_error, contour_length, *contours_))
            return context_.problem("the contours");
        if (contours_->nconts == 0) return nothing("no part of the floor is as large as the minimum area");
        return std::nullopt;
    }

    std::optional<Problem> cut() {
        if (!report_(0.8)) return cancelled();
        polygons_.reset(rcAllocPolyMesh());
        constexpr int corners_each = 6;
        if (!polygons_ || !rcBuildPolyMesh(&context_, *contours_, corners_each, *polygons_))
            return context_.problem("the polygons");
        contours_.reset();
        if (!report_(0.85)) return cancelled();
        details_.reset(rcAllocPolyMeshDetail());
        if (!details_ || !rcBuildPolyMeshDetail(&context_, *polygons_, *floor_, detail_distance * plan_.cell,
                                                detail_error * plan_.cell_height, *details_))
            return context_.problem("the heights of the polygons");
        floor_.reset();
        if (polygons_->npolys == 0) return nothing("no polygon is left");
        return std::nullopt;
    }

    /// Recast's heights are those of the tops of cells, and detail heights are one cell higher; the floor is half a
    /// cell lower.
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
    /// Adjacent squares get different areas, so that no region extends beyond its square.
    void cut_into_squares() {
        for (int row = 0; row < plan_.rows; ++row)
            for (int column = 0; column < plan_.columns; ++column) {
                const rcCompactCell& cell = floor_->cells[row * plan_.columns + column];
                const int area = 1 + column / square_cells % 2 + 2 * (row / square_cells % 2);
                for (unsigned int i = cell.index, end = i + cell.count; i < end; ++i)
                    if (floor_->areas[i] != RC_NULL_AREA) floor_->areas[i] = static_cast<unsigned char>(area);
            }
    }

    /// Recast overflows beyond these limits without an error.
    std::optional<Problem> problem_of_spans() const {
        std::size_t count = 0;
        for (int i = 0; i < plan_.columns * plan_.rows; ++i) {
            std::size_t above = 0;
            for (const rcSpan* span = heights_->spans[i]; span != nullptr; span = span->next)
                above += span->area != RC_NULL_AREA;
            if (above > max_spans_in_column)
                return Problem{ProblemCode::too_large, "more than 250 floors lie above one another", 0};
            count += above;
        }
        if (count > static_cast<std::size_t>(max_spans))
            return Problem{ProblemCode::too_large, "the floor has 2^24 cells or more: use larger ones", 0};
        if (count == 0) return nothing("no floor has enough clearance for the walker's height");
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
    FunctionRef<bool(double)> report_;
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
                                       FunctionRef<bool(double done)> report) {
    Pipeline pipeline(plan, report);
    if (std::optional<Problem> problem = pipeline.measure(points, triangles, floor)) return *std::move(problem);
    if (std::optional<Problem> problem = pipeline.find_floor()) return *std::move(problem);
    if (std::optional<Problem> problem = pipeline.find_regions()) return *std::move(problem);
    if (std::optional<Problem> problem = pipeline.cut()) return *std::move(problem);
    return pipeline.result();
}

}  // namespace abut::detail
