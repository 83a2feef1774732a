// The two charts of the documentation: time per frame over the number of boxes, and over their density.

#include "../plot.hpp"

#include "../../scenes/moving_boxes.hpp"
#include "broad.hpp"

#include <sstream>

namespace abut::bench {

namespace {

constexpr const char* y_name = "ns a box and frame";

PlotPoint point(const std::string& plot, double x, std::size_t count, const scenes::MovingBoxesOptions& options) {
    const BoxFrames<3> frames{count, scene_of<3, scenes::MovingBoxes>(count, broad_seed, options)};
    std::ostringstream name;
    name << "plot/" << plot << "/3d/" << x;
    return {x, {name.str(), [frames] { return pairs_of_frames(frames); }}};
}

Plot by_size() {
    Plot result{"broad_phase_size.svg",
                {.title = "All pairs of n moving boxes in 3D, each overlaps about 2 others",
                 .x_name = "boxes",
                 .y_name = y_name,
                 .lines = {}},
                {}};
    for (const std::size_t count : {100u, 300u, 1'000u, 3'000u, 10'000u, 30'000u, 100'000u, 300'000u, 1'000'000u})
        result.points.push_back(point("size", static_cast<double>(count), count, {}));
    return result;
}

Plot by_density() {
    Plot result{"broad_phase_density.svg",
                {.title = "All pairs of 10,000 moving boxes in 3D",
                 .x_name = "overlaps per box",
                 .y_name = y_name,
                 .lines = {}},
                {}};
    for (const double overlaps : {0.1, 0.3, 1.0, 3.0, 10.0, 30.0})
        result.points.push_back(point("density", overlaps, 10'000, {.overlaps = overlaps}));
    return result;
}

}  // namespace

std::vector<Plot> broad_plots() {
    return {by_size(), by_density()};
}

}  // namespace abut::bench
