#include "tool/field/contours.hpp"
#include "tool/field/field_report.hpp"
#include "tool/shared/format.hpp"
#include "tool/shared/picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace abut::tool {

using namespace detail;

namespace {

constexpr float samples_along = 256;  // samples along the longest side of a picture
constexpr double target_bands = 9;    // contour bands on the side of the surface that extends farther

constexpr Color sand_near{255, 247, 230}, sand_far{217, 160, 102}, blue_near{219, 234, 254}, blue_far{29, 78, 216};
constexpr Style band_border{{71, 85, 105, 110}, 0.6f}, zero_border{{15, 23, 42}, 1.4f},
    surface_style{{220, 38, 38}, 0.7f}, label{{15, 23, 42}, 1};

// A planar slice of the volume: a 2D box, and the map from its points to the volume.
template <int D>
struct Sheet {
    Aabb2 box;
    std::function<Vec<D>(const Vec2&)> place;
};

// The smallest 1, 2 or 5 times a power of ten that is at least the number.
double rounded_up(double number) {
    double power = 1;
    while (power > number) power /= 10;
    while (power * 10 <= number) power *= 10;
    for (const double step : {1.0, 2.0, 5.0})
        if (step * power >= number) return step * power;
    return 10 * power;
}

Color between(const Color& a, const Color& b, double share) {
    const auto mixed = [&](std::uint8_t from, std::uint8_t to) {
        return static_cast<std::uint8_t>(std::lround(from + (to - from) * share));
    };
    return {mixed(a.red, b.red), mixed(a.green, b.green), mixed(a.blue, b.blue)};
}

// Sampled distances of a slice, and its contour levels: multiples of one step.
struct Heights {
    HeightGrid grid;
    Vec2 origin{};
    Vec2 spacing{1};  // of samples
    float min = 0, max = 0;

    Vec2 position(const Vec2& corner) const { return origin + spacing * corner; }
};

template <int D>
Heights heights_of(const Field<D>& field, const Sheet<D>& sheet, float spacing) {
    Heights result;
    const Vec2 side = sheet.box.max - sheet.box.min;
    const auto squares = [&](float length) { return std::max(1.0f, std::ceil(length / spacing)); };
    const Vec2 counts(squares(side.x), squares(side.y));
    result.grid.columns = static_cast<std::uint32_t>(counts.x) + 1;
    result.grid.rows = static_cast<std::uint32_t>(counts.y) + 1;
    result.origin = sheet.box.min;
    result.spacing = side / counts;
    for (std::uint32_t row = 0; row < result.grid.rows; ++row)
        for (std::uint32_t column = 0; column < result.grid.columns; ++column) {
            // Clamps the last samples to the volume, against rounding.
            const Vec2 corner = glm::min(result.position(Vec2(column, row)), sheet.box.max);
            result.grid.heights.push_back(field.distance(sheet.place(corner)));
        }
    const auto [min, max] = std::minmax_element(result.grid.heights.begin(), result.grid.heights.end());
    result.min = *min;
    result.max = *max;
    return result;
}

// The colour of the contour band from `band` to `band` + 1 steps.
Color color_of(int band, double step, double farthest) {
    const double bands = std::max(1.0, farthest / step);
    if (band >= 0) return between(sand_near, sand_far, std::min(1.0, band / bands));
    return between(blue_near, blue_far, std::min(1.0, (-band - 1) / bands));
}

void draw_bands(SvgCanvas& canvas, const Heights& heights, const Vec2& shift, double step, double farthest) {
    const int first = static_cast<int>(std::floor(static_cast<double>(heights.min) / step)) + 1,
              last = static_cast<int>(std::ceil(static_cast<double>(heights.max) / step)) - 1;
    std::vector<float> levels;
    for (int level = first; level <= last; ++level) levels.push_back(static_cast<float>(level * step));
    const Vec2 size(static_cast<float>(heights.grid.columns - 1), static_cast<float>(heights.grid.rows - 1));
    const std::vector<Vec2> whole{shift + heights.position({0, 0}), shift + heights.position({size.x, 0}),
                                  shift + heights.position(size), shift + heights.position({0, size.y})};
    canvas.polygon(whole, Style{band_border.stroke, band_border.width, color_of(last, step, farthest)});
    // A twentieth of the sample spacing is less than a tenth of a pixel.
    for (const Contour& contour : contours(heights.grid, levels, 0.05)) {
        const int level = first + static_cast<int>(contour.level);
        Style style = level == 0 ? zero_border : band_border;
        style.fill = color_of(contour.area > 0 ? level - 1 : level, step, farthest);
        std::vector<Vec2> vertices;
        for (const Vec2& corner : contour.vertices) vertices.push_back(shift + heights.position(corner));
        canvas.polygon(vertices, style);
    }
}

// The intersection of an edge of a triangle with a slice.
void draw_cut(SvgCanvas& canvas, std::span<const std::array<Vec3, 3>> triangles, const FieldSlice& slice, int across,
              int up, const Aabb2& box, const Vec2& shift) {
    for (const std::array<Vec3, 3>& triangle : triangles) {
        std::vector<Vec2> ends;
        for (std::size_t i = 0; i < 3; ++i) {
            const DVec<3> a(triangle[i]), b(triangle[(i + 1) % 3]);
            const double above = a[slice.axis] - static_cast<double>(slice.at),
                         then = b[slice.axis] - static_cast<double>(slice.at);
            if ((above < 0) == (then < 0)) continue;
            const DVec<3> there = a + (b - a) * (above / (above - then));
            ends.emplace_back(static_cast<float>(there[across]), static_cast<float>(there[up]));
        }
        if (ends.size() != 2) continue;
        if (contains(box, ends[0]) && contains(box, ends[1]))
            canvas.line(ends[0] + shift, ends[1] + shift, surface_style);
    }
}

double step_for(double farthest) {
    return rounded_up(std::max(farthest / target_bands, 1e-30));
}

double farthest_of(const Heights& heights) {
    return static_cast<double>(std::max(std::abs(heights.min), std::abs(heights.max)));
}

}  // namespace

std::string picture(const Field3& field, std::span<const std::array<Vec3, 3>> triangles,
                    std::span<const FieldSlice> slices) {
    const Aabb3 volume = field.volume();
    std::vector<FieldSlice> wanted(slices.begin(), slices.end());
    for (int axis = 0; axis < 3 && slices.empty(); ++axis)
        wanted.push_back({axis, 0.5f * (volume.min[axis] + volume.max[axis])});

    const Vec3 side = volume.max - volume.min;
    const float longest = std::max({side.x, side.y, side.z}), gap = 0.05f * longest, line = 0.06f * longest;
    // The y axis is vertical if it lies in the slice: across x lie z and y, across y lie x and z, across z lie x and y.
    constexpr std::array<std::array<int, 2>, 3> axes{{{2, 1}, {0, 2}, {0, 1}}};
    float width = 0, height = 0;
    for (const FieldSlice& slice : wanted) {
        const auto [across, up] = axes[static_cast<std::size_t>(slice.axis)];
        width += side[across] + (width > 0 ? gap : 0);
        height = std::max(height, side[up]);
    }
    SvgCanvas canvas = make_canvas(Aabb2{{-gap, -line - gap}, {width + gap, height + gap}});

    std::vector<Heights> all;
    double farthest = 0;
    for (const FieldSlice& slice : wanted) {
        const auto [across, up] = axes[static_cast<std::size_t>(slice.axis)];
        const Sheet<3> sheet{{{volume.min[across], volume.min[up]}, {volume.max[across], volume.max[up]}},
                             [&, across = across, up = up](const Vec2& p) {
                                 Vec3 place{};
                                 place[slice.axis] = slice.at;
                                 place[across] = p.x;
                                 place[up] = p.y;
                                 return place;
                             }};
        all.push_back(heights_of<3>(field, sheet, longest / samples_along));
        farthest = std::max(farthest, farthest_of(all.back()));
    }
    const double step = step_for(farthest);
    float left = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const auto [across, up] = axes[static_cast<std::size_t>(wanted[i].axis)];
        const Aabb2 box{{volume.min[across], volume.min[up]}, {volume.max[across], volume.max[up]}};
        const Vec2 shift = Vec2(left, 0) - box.min;
        draw_bands(canvas, all[i], shift, step, farthest);
        draw_cut(canvas, triangles, wanted[i], across, up, box, shift);
        canvas.text({left + 0.5f * side[across], -0.5f * line},
                    std::string(1, "xyz"[wanted[i].axis]) + " = " + number(static_cast<double>(wanted[i].at)) +
                        (i == 0 ? ", lines every " + number(step) : ""),
                    label);
        left += side[across] + gap;
    }
    return canvas.document();
}

std::string picture(const Field2& field) {
    const Aabb2 volume = field.volume();
    const Vec2 side = volume.max - volume.min;
    const float longest = std::max(side.x, side.y), line = 0.04f * longest;
    const Aabb2 seen{{volume.min.x, -volume.max.y}, {volume.max.x, -volume.min.y}};
    SvgCanvas canvas = make_canvas(Aabb2{seen.min - Vec2(line, 2 * line), seen.max + Vec2(line)});
    const Heights heights =
        heights_of<2>(field, {seen, [](const Vec2& p) { return Vec2(p.x, -p.y); }}, longest / (2 * samples_along));
    const double farthest = farthest_of(heights), step = step_for(farthest);
    draw_bands(canvas, heights, Vec2(0), step, farthest);
    canvas.text({0.5f * (seen.min.x + seen.max.x), seen.min.y - line}, "lines every " + number(step), label);
    return canvas.document();
}

}  // namespace abut::tool
