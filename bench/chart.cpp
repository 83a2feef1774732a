#include "chart.hpp"

#include <abut/draw/svg.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace abut::bench {

namespace {

// In pixels. The legend is right of the plot area.
constexpr float width = 920, height = 560;
constexpr float left = 70, right = 700, bottom = 60, top = 500;
constexpr float legend_line = 715, legend_text = 835, legend_step = 24;
constexpr float text_height = 14;

constexpr Color white{255, 255, 255}, ink{30, 41, 59}, grid{203, 213, 225}, faint_grid{236, 240, 245};
constexpr std::array<Color, 14> palette{{{0, 0, 0},
                                         {220, 38, 38},
                                         {37, 99, 235},
                                         {22, 163, 74},
                                         {217, 119, 6},
                                         {147, 51, 234},
                                         {8, 145, 178},
                                         {219, 39, 119},
                                         {101, 163, 13},
                                         {120, 53, 15},
                                         {71, 85, 105},
                                         {79, 70, 229},
                                         {13, 148, 136},
                                         {161, 98, 7}}};

/// Converts values to pixels.
struct Axis {
    Axis(double min, double max, float from, float to)
        : low(std::log10(min)), high(std::log10(max)), begin(from), end(to) {}

    float operator()(double value) const {
        return begin + (end - begin) * static_cast<float>((std::log10(value) - low) / (high - low));
    }
    bool holds(double value) const {
        const double exponent = std::log10(value);
        return exponent > low - 1e-9 && exponent < high + 1e-9;
    }

    double low, high;
    float begin, end;
};

std::string label(double value) {
    std::ostringstream out;
    if (value >= 1e6)
        out << value / 1e6 << " M";
    else if (value >= 1e4)
        out << value / 1e3 << " k";
    else
        out << value;
    return out.str();
}

/// Calls visit(value, digit) for 1, 2, ... 9, 10, 20, ... on the axis.
template <class Visit>
void each_tick(const Axis& axis, Visit visit) {
    for (double decade = std::pow(10, std::floor(axis.low)); std::log10(decade) <= axis.high; decade *= 10)
        for (int digit = 1; digit < 10; ++digit)
            if (axis.holds(digit * decade)) visit(digit * decade, digit);
}

void draw_grid(SvgCanvas& canvas, const Chart& chart, const Axis& x, const Axis& y) {
    const Style text{.stroke = ink};
    const auto style = [](int digit) { return Style{.stroke = digit == 1 ? grid : faint_grid}; };
    // An axis of little more than a decade has labels within the decade too.
    const auto named = [](const Axis& axis, int digit) {
        return digit == 1 || (axis.high - axis.low < 3 && (digit == 2 || digit == 5));
    };
    each_tick(x, [&](double value, int digit) {
        canvas.line({x(value), bottom}, {x(value), top}, style(digit));
        if (named(x, digit)) canvas.text({x(value), bottom - 16}, label(value), text);
    });
    each_tick(y, [&](double value, int digit) {
        canvas.line({left, y(value)}, {right, y(value)}, style(digit));
        if (named(y, digit)) canvas.text({left - 28, y(value)}, label(value), text);
    });
    const Style border{.stroke = ink};
    canvas.line({left, bottom}, {right, bottom}, border);
    canvas.line({left, bottom}, {left, top}, border);
    canvas.text({0.5f * (left + right), bottom - 40}, chart.x_name, text);
    canvas.text({0.5f * (left + right), height - 20}, chart.title, text);
    canvas.text({left + 30, top + 16}, chart.y_name, text);
}

}  // namespace

std::string svg(const Chart& chart) {
    double x_min = std::numeric_limits<double>::infinity(), x_max = 0, y_min = x_min, y_max = 0;
    for (const ChartLine& line : chart.lines)
        for (const auto& [x, y] : line.points) {
            x_min = std::min(x_min, x);
            x_max = std::max(x_max, x);
            y_min = std::min(y_min, y);
            y_max = std::max(y_max, y);
        }
    const Axis x(x_min, x_max, left, right), y(0.8 * y_min, 1.25 * y_max, bottom, top);

    SvgCanvas canvas({{0, 0}, {width, height}}, 1, white);
    canvas.set_text_height(text_height);
    draw_grid(canvas, chart, x, y);

    std::vector<std::size_t> order(chart.lines.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return chart.lines[i].points.back().second; });
    float legend = top - 10;
    for (const std::size_t i : order) {
        const ChartLine& line = chart.lines[i];
        const Style style{
            .stroke = palette[line.color % palette.size()], .width = line.ours ? 2.5f : 1.5f, .dashed = !line.ours};
        Vec2 last;
        for (std::size_t k = 0; k < line.points.size(); ++k) {
            const Vec2 point{x(line.points[k].first), y(line.points[k].second)};
            if (k > 0) canvas.line(last, point, style);
            canvas.point(point, style);
            last = point;
        }
        canvas.line({legend_line, legend}, {legend_line + 30, legend}, style);
        canvas.point({legend_line + 15, legend}, style);
        canvas.text({legend_text, legend}, line.name, {.stroke = style.stroke});
        legend -= legend_step;
    }
    return canvas.document();
}

}  // namespace abut::bench
