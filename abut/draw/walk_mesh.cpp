#include <abut/draw/draw.hpp>
#include <abut/draw/walk_mesh.hpp>
#include <abut/math/dvec.hpp>

#include <array>
#include <vector>

namespace abut {

using namespace detail;

namespace {

constexpr std::size_t walk_segments = 64;

/// The style of less important lines.
Style paler(Style style) {
    style.stroke.alpha = static_cast<std::uint8_t>(style.stroke.alpha / 3);
    style.width *= 0.5f;
    return style;
}

std::array<Vec3, 3> corners(const WalkMesh& mesh, std::uint32_t triangle) {
    const glm::uvec3& t = mesh.triangles()[triangle];
    return {mesh.points()[t.x], mesh.points()[t.y], mesh.points()[t.z]};
}

bool is_shown(const Aabb3& shown, const std::array<Vec3, 3>& corner) {
    Aabb3 box = Aabb3::empty();
    for (const Vec3& point : corner) box = merged(box, Aabb3{point, point});
    return overlaps(box, shown);
}

/// Lines cover areas: fills come first, then inner edges, and borders last.
enum class Layer { areas, edges, borders };

void draw_triangle(Canvas<3>& canvas, const WalkMesh& mesh, std::uint32_t triangle, Layer layer, const Style& style) {
    const std::array<Vec3, 3> corner = corners(mesh, triangle);
    if (layer == Layer::areas) {
        Style area = style;
        area.stroke = transparent;
        if (style.fill.visible()) canvas.polygon(corner, area);
        return;
    }
    if (!style.stroke.visible()) return;
    for (std::uint32_t side = 0; side < 3; ++side) {
        const std::optional<WalkSide> beyond = mesh.beyond({triangle, side});
        const Vec3 &from = corner[side], &to = corner[(side + 1) % 3];
        if (layer == Layer::borders && !beyond) canvas.line(from, to, style);
        if (layer == Layer::edges && beyond && triangle < beyond->triangle) canvas.line(from, to, paler(style));
    }
}

/// The last point far enough from the end for a visible arrow between them; otherwise the last but one.
std::size_t arrow_start(const Aabb3& shown, std::span<const Vec3> points) {
    const DVec<3> end(points.back());
    const double min_length = length(DVec<3>(shown.max) - DVec<3>(shown.min)) / 20;
    for (std::size_t i = points.size() - 1; i-- > 0;)
        if (length(DVec<3>(points[i]) - end) >= min_length) return i;
    return points.size() - 2;
}

/// Draws a point at the start and an arrow head at the end.
void draw_line(Canvas<3>& canvas, std::span<const Vec3> points, const Style& style) {
    if (points.empty()) return;
    canvas.point(points.front(), style);
    if (points.size() < 2) return;
    const std::size_t arrow = arrow_start(canvas.shown(), points), last = points.size() - 2;
    for (std::size_t i = 0; i < last; ++i) canvas.line(points[i], points[i + 1], style);
    if (arrow < last) canvas.line(points[last], points.back(), style);
    draw_arrow(canvas, points[arrow], points.back(), style);
}

}  // namespace

void draw(Canvas<3>& canvas, const WalkMesh& mesh, FunctionRef<Style(std::uint32_t triangle)> style) {
    const Aabb3 shown = canvas.shown();
    std::vector<std::uint32_t> visible;
    for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i)
        if (mesh.is_walkable(i) && is_shown(shown, corners(mesh, i))) visible.push_back(i);
    for (const Layer layer : {Layer::areas, Layer::edges, Layer::borders})
        for (const std::uint32_t i : visible) draw_triangle(canvas, mesh, i, layer, style(i));
}

void draw(Canvas<3>& canvas, const WalkMesh& mesh, const Style& style) {
    draw(canvas, mesh, [&](std::uint32_t) { return style; });
}

void draw(Canvas<3>& canvas, const WalkPath& path, const Style& style) {
    draw_path(canvas, path.points, style);
}

void draw_path(Canvas<3>& canvas, std::span<const Vec3> points, const Style& style) {
    draw_line(canvas, points, style);
    for (std::size_t i = 1; i + 1 < points.size(); ++i) canvas.point(points[i], style);
}

void draw_walk(Canvas<3>& canvas, const WalkMesh& mesh, const WalkPoint& from, const Vec3& step, const Style& style) {
    std::vector<Vec3> points{mesh.to_world(from)};
    WalkPoint place = from;
    Vec3 part = step / static_cast<float>(walk_segments);
    for (std::size_t i = 0; i < walk_segments; ++i) {
        const Walked walked = mesh.walk(place, part);
        place = walked.place;
        part = walked.turn * part;
        const Vec3 point = mesh.to_world(place);
        if (point != points.back()) points.push_back(point);
    }
    draw_line(canvas, points, style);
}

}  // namespace abut
