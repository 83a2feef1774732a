#include "tool/shared/picture.hpp"
#include "tool/walk/walk_report.hpp"
#include <abut/draw/draw.hpp>
#include <abut/draw/walk_mesh.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace abut::tool {

using namespace detail;

namespace {

constexpr Style fault_style{{220, 38, 38}, 3}, orientation_style{{147, 51, 234}, 3}, path_line{{15, 23, 42}, 3},
    distance_line{{15, 23, 42, 150}, 1.2f, transparent, true}, label{{15, 23, 42}, 1};
// Larger meshes are drawn as boundaries only, to bound the file's size.
constexpr float point_size = 8, vertex_size = 4;
constexpr std::size_t max_triangles = 20'000, max_labels = 50;

/// A view direction and the up direction of the picture.
struct Viewpoint {
    Vec3 towards{}, up{};
    std::string name;
};

Vec3 unit(int axis, float sign) {
    Vec3 result(0);
    result[axis] = sign;
    return result;
}

std::string named(int axis, float sign) {
    return std::string("seen from ") + (sign < 0 ? "-" : "+") + "xyz"[axis];
}

/// The signed axis that most of the surface faces; +y if no direction predominates.
void find_above(const WalkMesh& mesh, int& axis, float& sign) {
    DVec<3> sum(0.0);
    double area = 0;
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i) {
        if (!mesh.is_walkable(i)) continue;
        const glm::uvec3& t = mesh.triangles()[i];
        const DVec<3> a(mesh.points()[t.x]);
        const DVec<3> twice = cross(DVec<3>(mesh.points()[t.y]) - a, DVec<3>(mesh.points()[t.z]) - a);
        sum += twice;
        area += length(twice);
    }
    axis = 1;
    sign = 1;
    for (const int other : {1, 2, 0})
        if (std::abs(sum[other]) > std::max(std::abs(sum[axis]), 0.1 * area)) axis = other;
    if (std::abs(sum[axis]) > 0.1 * area) sign = sum[axis] < 0 ? -1.0f : 1.0f;
}

/// A view from above, and one from the longer side unless the mesh is flat.
std::vector<Viewpoint> viewpoints_for(const WalkMesh& mesh) {
    int above = 1;
    float sign = 1;
    find_above(mesh, above, sign);
    const Vec3 size = bounds(mesh).max - bounds(mesh).min;
    const Vec3 up_above = above == 1 ? unit(2, -sign) : unit(1, 1);
    std::vector<Viewpoint> viewpoints{{unit(above, sign), up_above, named(above, sign)}};
    const int first = (above + 1) % 3, second = (above + 2) % 3;
    const int side = size[first] <= size[second] ? first : second;
    if (size[above] > 0.01f * std::max(size[first], size[second]))
        viewpoints.push_back({unit(side, 1), unit(above, sign), named(side, 1)});
    return viewpoints;
}

/// A rectangular part of a larger canvas.
class Panel final : public Canvas<2> {
public:
    Panel(Canvas<2>& canvas, const Aabb2& shown, const Vec2& shift) : paper_(canvas), shown_(shown), shift_(shift) {}

    Aabb2 shown() const override { return shown_; }
    void line(const Vec2& a, const Vec2& b, const Style& style) override { paper_.line(a + shift_, b + shift_, style); }
    void point(const Vec2& position, const Style& style) override { paper_.point(position + shift_, style); }
    void polygon(std::span<const Vec2> points, const Style& style) override {
        std::vector<Vec2> translated;
        for (const Vec2& point : points) translated.push_back(point + shift_);
        paper_.polygon(translated, style);
    }
    void ball(const Vec2& center, float radius, const Style& style) override {
        paper_.ball(center + shift_, radius, style);
    }
    void text(const Vec2& position, std::string_view text, const Style& style) override {
        paper_.text(position + shift_, text, style);
    }

private:
    Canvas<2>& paper_;
    Aabb2 shown_;
    Vec2 shift_;
};

Style style_of(std::size_t component) {
    Color fill = color_of_part(component), stroke = fill;
    fill.alpha = 110;
    const auto darker = [](std::uint8_t channel) { return static_cast<std::uint8_t>(channel / 2); };
    stroke = {darker(stroke.red), darker(stroke.green), darker(stroke.blue)};
    return {stroke, 1.6f, fill};
}

/// Draws the boundaries of connected components, and the boxes of closed ones.
void draw_outlines(Canvas<3>& view, const WalkSurvey& survey) {
    std::vector<bool> has_boundary(survey.components.size(), false);
    for (const WalkBorder& border : survey.borders) {
        has_boundary[border.component] = true;
        const Style style = style_of(border.component);
        for (std::size_t i = 0; i < border.points.size(); ++i)
            view.line(border.points[i], border.points[(i + 1) % border.points.size()], style);
    }
    for (std::size_t i = 0; i < survey.components.size(); ++i) {
        Style style = style_of(i);
        style.fill = transparent;
        if (!has_boundary[i]) draw(view, survey.components[i].box, style);
    }
}

void draw_surface(Canvas<3>& view, const WalkOutcome& outcome) {
    const WalkMesh& mesh = outcome.mesh;
    if (mesh.triangles().size() <= max_triangles)
        draw(view, mesh, [&](std::uint32_t triangle) { return style_of(mesh.component(triangle)); });
    else
        draw_outlines(view, outcome.survey);
    const std::vector<WalkComponent>& islands = outcome.survey.components;
    if (islands.size() < 2 || islands.size() > max_labels) return;
    for (std::size_t i = 0; i < islands.size(); ++i)
        view.text(mesh.to_world(islands[i].place), std::to_string(i), label);
}

void draw_mesh(Canvas<3>& view, const WalkOutcome& outcome) {
    draw_surface(view, outcome);
    for (const WalkEdge& edge : outcome.survey.mirrored) view.line(edge.from, edge.to, orientation_style);
    for (const WalkEdge& edge : outcome.survey.non_manifold_edges) view.line(edge.from, edge.to, fault_style);
    for (const Vec3& point : outcome.survey.non_manifold_vertices) view.point(point, fault_style);
    for (const std::optional<WalkEnd>& end : {outcome.from, outcome.to}) {
        if (!end) continue;
        view.line(end->requested, end->point, distance_line);
        view.point(end->requested, distance_line);
        view.point(end->point, path_line);
    }
}

}  // namespace

std::string picture(const WalkOutcome& outcome) {
    Aabb3 box = bounds(outcome.mesh);
    for (const std::optional<WalkEnd>& end : {outcome.from, outcome.to})
        if (end) box = merged(box, Aabb3{end->requested, end->requested});
    const std::vector<Viewpoint> viewpoints = viewpoints_for(outcome.mesh);
    std::vector<Aabb2> planes;
    Vec2 size(0);
    for (const Viewpoint& viewpoint : viewpoints) {
        planes.push_back(projected_bounds(box, viewpoint.towards, viewpoint.up));
        size.x = std::max(size.x, planes.back().max.x - planes.back().min.x);
        size.y += planes.back().max.y - planes.back().min.y;
    }
    const float margin = 0.04f * std::max(size.x, size.y), line = 2 * margin;
    const float height = size.y + line * static_cast<float>(viewpoints.size());
    SvgCanvas canvas = make_canvas(Aabb2{{-margin, -margin}, {size.x + margin, height}});
    canvas.set_point_size(point_size);
    float top = height - line;
    for (std::size_t i = 0; i < viewpoints.size(); ++i) {
        const Aabb2& plane = planes[i];
        const Vec2 side = plane.max - plane.min;
        Panel panel(canvas, plane, Vec2(0.5f * (size.x - side.x), top - side.y) - plane.min);
        Projected view(panel, box, viewpoints[i].towards, viewpoints[i].up);
        draw_mesh(view, outcome);
        canvas.set_point_size(vertex_size);
        if (outcome.path) draw(view, *outcome.path, path_line);
        canvas.set_point_size(point_size);
        canvas.text({0.5f * size.x, top + 0.5f * line}, viewpoints[i].name, label);
        top -= side.y + line;
    }
    return canvas.document();
}

}  // namespace abut::tool
