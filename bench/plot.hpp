#pragma once

// What a picture of the bench is made of: a job for each place on its x axis.

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

/// Adds what was measured at one place on the x axis to the lines, one a side. `sides`: all so far, by which a side has
/// the same color in all charts.
void add_rows(Chart& chart, double x, std::span<const Row> rows, std::vector<std::string>& sides);

}  // namespace abut::bench
