#include "tool/cast/cast_report.hpp"
#include "tool/shared/flipped.hpp"
#include "tool/shared/picture.hpp"
#include <abut/draw/draw.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>

namespace abut::tool {

using namespace detail;

namespace {

constexpr Style plain{{148, 163, 184, 120}, 0.7f}, hit_thing{{37, 99, 235, 200}, 1, {37, 99, 235, 26}};
constexpr Style beam{{225, 29, 72}, 2}, unreached{{225, 29, 72, 130}, 1.5f, transparent, true};

// An object with more parts is drawn as its box, to bound the file's size.
constexpr std::size_t most_parts = 5000;

// The vertices of the ray's path; an infinite last segment is shortened.
template <int D>
std::vector<Vec<D>> corners(const CastReport<D>& report) {
    std::vector<Vec<D>> points{report.options.from, report.options.to};
    for (const CastHit<D>& hit : report.result.hits) points.push_back(hit.hit.point);
    return points;
}

// The region shown: the ray with a margin.
template <int D>
Aabb<D> surroundings(const std::vector<Vec<D>>& points) {
    Aabb<D> box = Aabb<D>::empty();
    for (const Vec<D>& point : points) box = merged(box, Aabb<D>{point, point});
    return grown(box, 0.15f * static_cast<float>(length(DVec<D>(box.max) - DVec<D>(box.min))));
}

// The view direction: perpendicular to the ray, so that it isn't foreshortened, and slightly from above.
Vec3 towards_eye(const CastOptions<3>& options) {
    const DVec<3> along = DVec<3>(options.to) - DVec<3>(options.from);
    const DVec<3> level = normalized(DVec<3>(-along.z, 0, along.x), axis<3>(2));
    return to_float(normalized(level + DVec<3>(0, 0.6, 0)));
}

template <int D>
void draw_object(Canvas<D>& canvas, const Object<D>& object, const Style& style) {
    if (!object.present || !overlaps(object.box, canvas.shown())) return;
    if (object.parts > most_parts)
        draw(canvas, object.box, style);
    else
        draw(canvas, object.placed, style);
}

template <int D>
void draw_ray(Canvas<D>& canvas, const CastReport<D>& report) {
    const CastResult<D>& result = report.result;
    for (const CastHit<D>& hit : result.hits) draw(canvas, Ray<D>::between(hit.ray.origin, hit.hit.point), beam);
    if (result.hits.empty() || !result.end) draw(canvas, result.last, beam);
    if (report.options.bounces == 0 && !result.hits.empty())
        canvas.line(result.hits.back().hit.point, report.options.to, unreached);
    canvas.point(report.options.from, beam);
    canvas.point(report.options.to, unreached);
    for (const CastHit<D>& hit : result.hits) draw(canvas, hit.hit, beam);
}

template <int D>
void draw_all(Canvas<D>& canvas, const CastReport<D>& report) {
    std::vector<bool> is_hit(report.objects.size(), false);
    for (const CastHit<D>& hit : report.result.hits) is_hit[hit.object] = true;
    for (const bool hit : {false, true})
        for (std::size_t i = 0; i < report.objects.size(); ++i)
            if (is_hit[i] == hit) draw_object(canvas, report.objects[i], hit ? hit_thing : plain);
    draw_ray(canvas, report);
}

}  // namespace

std::string picture(const CastReport<3>& report) {
    const Aabb3 shown = surroundings(corners(report));
    const Vec3 eye = towards_eye(report.options);
    SvgCanvas canvas = make_canvas(projected_bounds(shown, eye));
    Projected view(canvas, shown, eye, {0, 1, 0});
    draw_all(view, report);
    return canvas.document();
}

std::string picture(const CastReport<2>& report) {
    SvgCanvas canvas = make_canvas(Flipped::flipped(surroundings(corners(report))));
    Flipped view(canvas);
    draw_all(view, report);
    return canvas.document();
}

}  // namespace abut::tool
