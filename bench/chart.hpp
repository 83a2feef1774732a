#pragma once

// A line chart with two logarithmic axes, as SVG.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace abut::bench {

struct ChartLine {
    std::string name;
    std::size_t color = 0;                          ///< index of the color
    std::vector<std::pair<double, double>> points;  ///< x, y above zero; x ascending
    bool ours = false;                              ///< solid line; others are dashed
};

struct Chart {
    std::string title;
    std::string x_name, y_name;
    std::vector<ChartLine> lines;  ///< each with at least one point
};

/// The SVG document. The legend is sorted by the lines' last values, the highest first.
std::string svg(const Chart& chart);

}  // namespace abut::bench
