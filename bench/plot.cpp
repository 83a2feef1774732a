#include "plot.hpp"

#include <algorithm>

namespace abut::bench {

namespace {

/// The index of a side in the list, which it is added to.
std::size_t number_of(const std::string& who, std::vector<std::string>& sides) {
    const auto found = std::ranges::find(sides, who);
    const auto number = static_cast<std::size_t>(found - sides.begin());
    if (found == sides.end()) sides.push_back(who);
    return number;
}

}  // namespace

void add_rows(Chart& chart, double x, std::span<const Row> rows, std::vector<std::string>& sides) {
    for (const Row& row : rows) {
        auto line = std::ranges::find(chart.lines, row.who, &ChartLine::name);
        if (line == chart.lines.end())
            line = chart.lines.insert(line, {.name = row.who,
                                             .color = number_of(row.who, sides),
                                             .points = {},
                                             .ours = row.who.starts_with("abut")});
        line->points.emplace_back(x, row.ns);
    }
}

}  // namespace abut::bench
