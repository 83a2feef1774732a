// Detour: moveAlongSurface, findNearestPoly, findPath and findStraightPath.

#include "detour_mesh.hpp"
#include <abut/math/dvec.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace abut::bench {

using namespace detail;

namespace {

DVec<3> from_detour(const float* p) {
    return {p[0], p[1], p[2]};
}

class Walkers {
public:
    Walkers(const SharedWalkSteps& steps, bool with_heights)
        : steps_(steps), with_heights_(with_heights), headings_(steps->initial_headings) {
        for (const WalkPoint& start : steps->starts) {
            polygons_.push_back(mesh_->polygon(start.triangle));
            places_.push_back(steps->scene->mesh.to_world(start));
        }
    }

    /// Moves all walkers by one step.
    void advance() {
        std::array<dtPolyRef, 64> visited;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const Vec3 wanted = places_[i] + steps_->headings[headings_[i]];
            Vec3 end;
            int count = 0;
            mesh_->query().moveAlongSurface(polygons_[i], &places_[i].x, &wanted.x, &mesh_->filter(), &end.x,
                                            visited.data(), &count, static_cast<int>(visited.size()));
            if (count > 0) polygons_[i] = visited[static_cast<std::size_t>(count) - 1];
            places_[i] = end;
            if (with_heights_) mesh_->query().getPolyHeight(polygons_[i], &end.x, &places_[i].y);
            const bool is_lost = std::abs(end.x - wanted.x) + std::abs(end.z - wanted.z) > 1e-3f * steps_->length;
            lost_ += is_lost;
            if (is_lost || (frame_ + i) % frames_per_heading == 0) headings_[i] = next_heading(*steps_, headings_[i]);
        }
        ++frame_;
    }

    void write(std::span<double> values) const {
        for (std::size_t i = 0; i < places_.size(); ++i) {
            values[2 * i] = places_[i].x;
            values[2 * i + 1] = places_[i].z;
        }
    }
    double lost_share() const { return static_cast<double>(lost_) / static_cast<double>(frame_ * places_.size()); }

private:
    SharedWalkSteps steps_;
    bool with_heights_;
    std::shared_ptr<const DetourMesh> mesh_ = std::make_shared<const DetourMesh>(*steps_->scene);
    std::vector<dtPolyRef> polygons_;
    std::vector<Vec3> places_;
    std::vector<std::uint32_t> headings_;
    std::size_t frame_ = 0, lost_ = 0;
};

}  // namespace

Side detour_steps(const SharedWalkSteps& steps, bool with_heights) {
    return walking_side(with_heights ? "Detour, heights" : "Detour", "cut short",
                        std::make_shared<Walkers>(steps, with_heights), 2 * steps->starts.size());
}

Side detour_nearest(const SharedWalkPoints& points) {
    const auto mesh = std::make_shared<const DetourMesh>(*points->scene);
    return {"Detour", [points, mesh](std::span<double> values) {
                const Vec3 half(points->reach);
                for (std::size_t i = 0; i < values.size(); ++i) {
                    dtPolyRef polygon = 0;
                    Vec3 nearest;
                    mesh->query().findNearestPoly(&points->points[i].x, &half.x, &mesh->filter(), &polygon, &nearest.x);
                    values[i] = polygon == 0 ? std::numeric_limits<double>::infinity()
                                             : length(DVec<3>(nearest) - DVec<3>(points->points[i]));
                }
            }};
}

Side detour_paths(const SharedWalkPaths& paths) {
    const auto mesh = std::make_shared<const DetourMesh>(*paths->scene);
    return {"Detour", [paths, mesh](std::span<double> values) {
                constexpr int max_polygons = 4096;
                std::vector<dtPolyRef> strip(max_polygons);
                std::vector<float> places(3 * max_polygons);
                for (std::size_t i = 0; i < values.size(); ++i) {
                    const Vec3 from = paths->scene->mesh.to_world(paths->from[i]),
                               to = paths->scene->mesh.to_world(paths->to[i]);
                    int count = 0, place_count = 0;
                    mesh->query().findPath(mesh->polygon(paths->from[i].triangle), mesh->polygon(paths->to[i].triangle),
                                           &from.x, &to.x, &mesh->filter(), strip.data(), &count, max_polygons);
                    mesh->query().findStraightPath(&from.x, &to.x, strip.data(), count, places.data(), nullptr, nullptr,
                                                   &place_count, max_polygons, DT_STRAIGHTPATH_ALL_CROSSINGS);
                    // It has 65,535 search nodes; if these don't suffice, it returns a path to another point.
                    const bool is_there =
                        count > 0 && strip[static_cast<std::size_t>(count - 1)] == mesh->polygon(paths->to[i].triangle);
                    values[i] = is_there ? 0 : std::numeric_limits<double>::infinity();
                    for (int k = 1; k < place_count; ++k)
                        values[i] += length(from_detour(&places[3 * static_cast<std::size_t>(k)]) -
                                            from_detour(&places[3 * static_cast<std::size_t>(k - 1)]));
                }
            }};
}

}  // namespace abut::bench
