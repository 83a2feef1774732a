#pragma once

// A chart of lines over two logarithmic axes, as SVG.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace abut::bench {

struct ChartLine {
    std::string name;
    std::size_t color = 0;                          ///< a number, of which each has another color
    std::vector<std::pair<double, double>> points;  ///< x, y above zero; x ascending
    bool ours = false;                              ///< drawn whole, the others dashed
};

struct Chart {
    std::string title;
    std::string x_name, y_name;
    std::vector<ChartLine> lines;  ///< each with a point at least
};

/// The document. In the legend the lines stand in the order of their last points, the highest first.
std::string svg(const Chart& chart);

}  // namespace abut::bench
