#include <abut/draw/convex.hpp>
#include <abut/draw/draw.hpp>
#include <abut/draw/trace.hpp>

#include <algorithm>
#include <optional>
#include <string>

namespace abut {

using namespace detail;

namespace {

/// The opacity of the first step, relative to that of the last.
constexpr double faintest = 0.25;

Style faded(Style style, double strength) {
    const auto scaled = [&](std::uint8_t alpha) {
        return static_cast<std::uint8_t>(static_cast<double>(alpha) * strength + 0.5);
    };
    style.stroke.alpha = scaled(style.stroke.alpha);
    style.fill.alpha = scaled(style.fill.alpha);
    return style;
}

Style dashed(Style style) {
    style.dashed = true;
    return unfilled(style);
}

template <int D>
bool all_finite(std::span<const Vec<D>> points) {
    return std::all_of(points.begin(), points.end(), [](const Vec<D>& point) { return is_finite(point); });
}

template <int D>
Vec<D> middle_of(std::span<const Vec<D>> points) {
    DVec<D> sum(0.0);
    for (const Vec<D>& point : points) sum += DVec<D>(point);
    return to_float(sum / static_cast<double>(points.size()));
}

/// Draws steps. Each function returns the position of the step's number, or nothing if the step can't be drawn.
template <int D>
class TraceDrawing {
public:
    TraceDrawing(Canvas<D>& canvas, const Style& whole) : canvas_(canvas), whole_(whole) {
        const DVec<D> low(canvas.shown().min), high(canvas.shown().max);
        middle_ = (low + high) * 0.5;
        diagonal_ = length(high - low);
    }

    std::optional<Vec<D>> draw(const GjkStep<D>& step, const Style& style) {
        const std::span<const Vec<D>> points(step.points.data(), step.count);
        if (points.empty() || !all_finite(points) || !is_finite(step.closest)) return {};
        mark_origin();
        if (points.size() == 4)
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t j = 0; j < i; ++j) canvas_.line(points[i], points[j], style);
        else
            draw_points(points, style);
        canvas_.line(Vec<D>(0), step.closest, dashed(style));
        canvas_.point(step.closest, style);
        const DVec<D> middle(middle_of(points));
        return to_float(middle + normalized(middle) * (diagonal_ / 40));
    }

    std::optional<Vec<D>> draw(const PenetrationStep<D>& step, const Style& style) {
        const std::span<const Vec<D>> points(step.points);
        if (!all_finite(points) || !is_finite(step.normal) || !std::isfinite(step.distance)) return {};
        mark_origin();
        draw_points(points, style);
        const Vec<D> middle = middle_of(points);
        canvas_.line(Vec<D>(0), step.normal * step.distance, dashed(style));
        draw_arrow(canvas_, middle, along(middle, step.normal, diagonal_ / 16), style);
        return along(middle, step.normal, diagonal_ / 12);
    }

    std::optional<Vec<D>> draw(const AxisStep<D>& step, const Style& style) {
        if (!is_finite(step.axis) || !std::isfinite(step.min_a + step.max_a + step.min_b + step.max_b)) return {};
        const DVec<D> axis(step.axis), aside = perpendicular(axis);
        const auto place = [&](float along, double off) {
            const DVec<D> projection = middle_ - axis * dot(axis, middle_);
            return to_float(projection + axis * static_cast<double>(along) + aside * (off * diagonal_));
        };
        const double off = 0.2 + 0.03 * static_cast<double>(axes_++ % 6);
        canvas_.line(place(step.min_a, off), place(step.max_a, off), style);
        canvas_.line(place(step.min_b, off + 0.012), place(step.max_b, off + 0.012), dashed(style));
        return along(place(std::max(step.max_a, step.max_b), off), step.axis, diagonal_ / 48);
    }

    std::optional<Vec<D>> draw(const ClipStep<D>& step, const Style& style) {
        const std::span<const Vec<D>> points(step.points);
        if (!all_finite(points) || !is_finite(step.normal) || !std::isfinite(step.offset)) return {};
        abut::draw(canvas_, HalfSpace<D>{step.normal, step.offset}, dashed(style));
        if (points.empty()) return to_float(DVec<D>(step.normal) * static_cast<double>(step.offset));
        draw_points(points, style);
        return middle_of(points);
    }

    std::optional<Vec<D>> draw(const SweepStep<D>& step, const Style& style) {
        if (!is_finite(step.position) || !is_finite(step.normal) || !std::isfinite(step.distance)) return {};
        mark_origin();
        const Vec<D> projection = along(step.position, step.normal, -static_cast<double>(step.distance));
        const double offset = dot(DVec<D>(step.normal), DVec<D>(projection));
        canvas_.line(Vec<D>(0), step.position, style);
        canvas_.point(step.position, style);
        canvas_.line(step.position, projection, dashed(style));
        abut::draw(canvas_, HalfSpace<D>{step.normal, static_cast<float>(offset)}, dashed(style));
        return along(step.position, step.normal, diagonal_ / 40);
    }

private:
    static Vec<D> along(const Vec<D>& from, const Vec<D>& direction, double distance) {
        return to_float(DVec<D>(from) + DVec<D>(direction) * distance);
    }

    void mark_origin() {
        if (origin_marked_) return;
        origin_marked_ = true;
        for (int i = 0; i < D; ++i) {
            const Vec<D> half_axis = to_float(axis<D>(i, diagonal_ / 64));
            canvas_.line(-half_axis, half_axis, whole_);
        }
    }

    void draw_points(std::span<const Vec<D>> points, const Style& style) {
        if (points.size() == 1)
            canvas_.point(points[0], style);
        else if (points.size() == 2)
            canvas_.line(points[0], points[1], style);
        else
            canvas_.polygon(points, style);
    }

    Canvas<D>& canvas_;
    Style whole_;  ///< of the last step
    DVec<D> middle_;
    double diagonal_;
    bool origin_marked_ = false;
    int axes_ = 0;  ///< axes drawn so far; they are placed side by side
};

}  // namespace

template <int D>
void draw(Canvas<D>& canvas, const Trace<D>& trace, const Style& style) {
    TraceDrawing<D> drawing(canvas, style);
    const auto count = static_cast<double>(trace.steps.size());
    for (std::size_t i = 0; i < trace.steps.size(); ++i) {
        const double done = static_cast<double>(i + 1) / count;
        const Style step_style = faded(style, faintest + (1 - faintest) * done);
        const std::optional<Vec<D>> place =
            std::visit([&](const auto& step) { return drawing.draw(step, step_style); }, trace.steps[i]);
        if (place) canvas.text(*place, std::to_string(i + 1), step_style);
    }
}

template void draw(Canvas<2>&, const Trace<2>&, const Style&);
template void draw(Canvas<3>&, const Trace<3>&, const Style&);

}  // namespace abut
