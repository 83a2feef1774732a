#include "tool/page/scene_picture.hpp"

#include "tool/shared/flipped.hpp"
#include "tool/shared/picture.hpp"
#include <abut/draw/draw.hpp>

#include <algorithm>
#include <set>
#include <string_view>

#include <glm/geometric.hpp>

namespace abut::tool {
namespace {

constexpr Style plain{{148, 163, 184, 120}, 0.7f}, involved{{37, 99, 235, 220}, 1.2f, {37, 99, 235, 30}};
constexpr Style error_mark{{225, 29, 72}, 2}, warning_mark{{217, 119, 6}, 2};

// An object with more facets is drawn as its box, to bound the file's size. Of many findings the first have their
// codes written beside them.
constexpr std::size_t max_facets = 5000, max_codes = 40;

// True if a path, or one above it, is in the set.
bool is_below_any(const std::string& path, const std::set<std::string, std::less<>>& paths) {
    for (std::size_t end = path.size(); end != std::string::npos && end > 0; end = path.rfind('/', end - 1))
        if (paths.contains(std::string_view(path).substr(0, end))) return true;
    return false;
}

template <int D>
Aabb<D> bounds_of(const FileReport& report, const LevelView<D>& level) {
    Aabb<D> box = Aabb<D>::empty();
    for (const ViewedObject<D>& object : level.objects) box = merged(box, object.box);
    for (const Finding& finding : report.findings) {
        Vec<D> place{};
        for (int i = 0; i < D; ++i) place[i] = static_cast<float>(finding.position[static_cast<std::size_t>(i)]);
        box = merged(box, Aabb<D>{place, place});
    }
    const float extent = glm::distance(box.min, box.max);
    return grown(box, std::max(0.03f * extent, 1e-6f));
}

template <int D>
void draw_all(Canvas<D>& canvas, const FileReport& report, const LevelView<D>& level) {
    std::set<std::string, std::less<>> paths;
    for (const Finding& finding : report.findings)
        for (const ObjectName& object : finding.objects) paths.insert(object.path);
    for (const bool colored : {false, true})
        for (const ViewedObject<D>& object : level.objects) {
            if (is_below_any(object.path, paths) != colored) continue;
            const Style& style = colored ? involved : plain;
            if (object.surface.facets.size() > max_facets)
                draw(canvas, object.box, style);
            else
                draw(canvas, object.shape, style);
        }
    for (std::size_t i = 0; i < report.findings.size(); ++i) {
        const Finding& finding = report.findings[i];
        const Style& style = finding.severity == Severity::error ? error_mark : warning_mark;
        Vec<D> place{};
        for (int axis = 0; axis < D; ++axis)
            place[axis] = static_cast<float>(finding.position[static_cast<std::size_t>(axis)]);
        canvas.point(place, style);
        if (i < max_codes) canvas.text(place, info(finding.rule).code, style);
    }
}

}  // namespace

std::string scene_picture(const FileReport& report, const LevelView<3>& level, const Vec3& up) {
    const Aabb3 shown = bounds_of(report, level);
    const Vec3 front = std::abs(up.z) > 0.5f ? Vec3(0, -1, 0) : Vec3(0, 0, 1);
    const Vec3 eye = front + 0.7f * up + 0.45f * glm::cross(up, front);
    SvgCanvas canvas = make_canvas(projected_bounds(shown, eye, up));
    Projected view(canvas, shown, eye, up);
    draw_all(view, report, level);
    return canvas.document();
}

std::string scene_picture(const FileReport& report, const LevelView<2>& level) {
    SvgCanvas canvas = make_canvas(Flipped::flipped(bounds_of(report, level)));
    Flipped view(canvas);
    draw_all(view, report, level);
    return canvas.document();
}

}  // namespace abut::tool
