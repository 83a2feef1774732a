#pragma once

// A chart of the bench: one job per x value.

#include "bench.hpp"
#include "chart.hpp"
#include "measure.hpp"

#include <span>
#include <string>
#include <vector>

namespace abut::bench {

struct PlotPoint {
    double x;
    Bench bench;
};

struct Plot {
    std::string file;
    Chart chart;  ///< without lines
    std::vector<PlotPoint> points;
};

std::vector<Plot> broad_plots();

/// Adds the rows measured at one x value to the lines, one per side. `sides`: all sides so far, so that a side has the
/// same color in all charts.
void add_rows(Chart& chart, double x, std::span<const Row> rows, std::vector<std::string>& sides);

}  // namespace abut::bench
