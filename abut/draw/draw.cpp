#include <abut/draw/convex.hpp>
#include <abut/draw/distance_function.hpp>
#include <abut/draw/draw.hpp>
#include <abut/draw/half_space.hpp>
#include <abut/shape/view/part.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace abut {

using namespace detail;

namespace {

/// The diagonal of the visible box.
template <int D>
double diagonal(const Canvas<D>& canvas) {
    const Aabb<D> box = canvas.shown();
    return length(DVec<D>(box.max) - DVec<D>(box.min));
}

/// The length of an arrow that shows a direction, and the maximum length of its head.
template <int D>
double arrow_length(const Canvas<D>& canvas) {
    return diagonal(canvas) / 16;
}
template <int D>
double head_length(const Canvas<D>& canvas) {
    return diagonal(canvas) / 64;
}

/// The directions across an arrow in which its head is drawn: one in 2D, two in 3D.
std::vector<DVec<2>> across(const DVec<2>& along) {
    return {perpendicular(along)};
}
std::vector<DVec<3>> across(const DVec<3>& along) {
    const DVec<3> first = perpendicular(along);
    return {first, cross(along, first)};
}

template <int D>
void draw_normal(Canvas<D>& canvas, const Vec<D>& position, const Vec<D>& normal, const Style& style) {
    draw_arrow(canvas, position, to_float(DVec<D>(position) + DVec<D>(normal) * arrow_length(canvas)), style);
}

/// The parameter at which a line from `origin` leaves the box; negative if it misses.
template <int D>
double leaves_at(const DVec<D>& origin, const DVec<D>& direction, const Aabb<D>& box) {
    double enter = 0, leave = std::numeric_limits<double>::infinity();
    for (int i = 0; i < D; ++i) {
        const double low = static_cast<double>(box.min[i]) - origin[i],
                     high = static_cast<double>(box.max[i]) - origin[i];
        if (direction[i] == 0) {
            if (low > 0 || high < 0) return -1;
            continue;
        }
        const double first = low / direction[i], second = high / direction[i];
        enter = std::max(enter, std::min(first, second));
        leave = std::min(leave, std::max(first, second));
    }
    return enter <= leave ? leave : -1;
}

}  // namespace

template <int D>
void draw(Canvas<D>& canvas, const View<D>& shape, const Style& style) {
    if (!is_finite(shape)) return;
    detail::for_each_part(shape, canvas.shown(), [&](const detail::Part<D>& part, std::uint32_t) {
        if (part.is_convex())
            draw_convex(canvas, part.convex(), style);
        else if (part.is_function())
            draw_function(canvas, part.function(), style);
        else
            draw_half_space(canvas, part.half_space(), style);
        return true;
    });
}

template <int D>
void draw(Canvas<D>& canvas, const Aabb<D>& box, const Style& style) {
    const Aabb<D> shown = canvas.shown();
    Aabb<D> part = box;
    for (int i = 0; i < D; ++i) {
        if (!(box.min[i] <= box.max[i])) return;
        if (std::isinf(part.min[i])) part.min[i] = std::min(shown.min[i], part.max[i]);
        if (std::isinf(part.max[i])) part.max[i] = std::max(shown.max[i], part.min[i]);
    }
    draw(canvas, View<D>(convex(part)), style);
}

template <int D>
void draw(Canvas<D>& canvas, std::span<const Aabb<D>> boxes, const Style& style) {
    for (const Aabb<D>& box : boxes) draw(canvas, box, style);
}

template <int D>
void draw(Canvas<D>& canvas, const Ray<D>& ray, const Style& style) {
    if (!is_finite(ray.origin) || !is_finite(ray.direction) || std::isnan(ray.length)) return;
    const DVec<D> origin(ray.origin), direction(ray.direction);
    const double reach =
        std::isfinite(ray.length) ? static_cast<double>(ray.length) : leaves_at(origin, direction, canvas.shown());
    if (reach >= 0) draw_arrow(canvas, ray.origin, to_float(origin + direction * reach), style);
}

template <int D>
void draw(Canvas<D>& canvas, const Hit<D>& hit, const Style& style) {
    canvas.point(hit.point, style);
    draw_normal(canvas, hit.point, hit.normal, style);
}

template <int D>
void draw(Canvas<D>& canvas, const Closest<D>& closest, const Style& style) {
    if (!std::isfinite(closest.distance)) return;
    canvas.line(closest.on_a, closest.on_b, style);
    canvas.point(closest.on_a, style);
    canvas.point(closest.on_b, style);
    draw_normal(canvas, closest.on_a, closest.normal, style);
}

template <int D>
void draw(Canvas<D>& canvas, const Contact<D>& contact, const Style& style) {
    for (const ContactPoint<D>& point : contact.points) {
        const DVec<D> middle(point.position), half = DVec<D>(contact.normal) * (0.5 * static_cast<double>(point.depth));
        canvas.line(to_float(middle - half), to_float(middle + half), style);
        canvas.point(point.position, style);
        draw_normal(canvas, point.position, contact.normal, style);
    }
}

template <int D>
void draw(Canvas<D>& canvas, const World<D>& world, const Style& style) {
    for (const Id id : world.overlapping(canvas.shown(), Filter{.sensors = true})) draw(canvas, world.shape(id), style);
}

template <int D>
void draw_arrow(Canvas<D>& canvas, const Vec<D>& from, const Vec<D>& to, const Style& style) {
    const DVec<D> start(from), tip(to);
    const double whole = length(tip - start);
    if (!(whole > 0)) return;
    const DVec<D> along = (tip - start) / whole;
    const double head = std::min(head_length(canvas), whole / 3);
    const DVec<D> neck = tip - along * head;
    canvas.line(from, to_float(neck), style);
    Style solid = style;
    solid.fill = style.stroke;
    solid.dashed = false;
    for (const DVec<D>& aside : across(along)) {
        const DVec<D> half = aside * (head * 0.4);
        const std::array<Vec<D>, 3> points{to, to_float(neck + half), to_float(neck - half)};
        canvas.polygon(points, solid);
    }
}

#define ABUT_INSTANTIATE(D)                                                 \
    template void draw(Canvas<D>&, const View<D>&, const Style&);           \
    template void draw(Canvas<D>&, const Aabb<D>&, const Style&);           \
    template void draw(Canvas<D>&, std::span<const Aabb<D>>, const Style&); \
    template void draw(Canvas<D>&, const Ray<D>&, const Style&);            \
    template void draw(Canvas<D>&, const Hit<D>&, const Style&);            \
    template void draw(Canvas<D>&, const Closest<D>&, const Style&);        \
    template void draw(Canvas<D>&, const Contact<D>&, const Style&);        \
    template void draw(Canvas<D>&, const World<D>&, const Style&);          \
    template void draw_arrow(Canvas<D>&, const Vec<D>&, const Vec<D>&, const Style&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
