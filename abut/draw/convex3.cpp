// Polytopes are drawn by their faces and edges; rounded ones have an arc between adjacent faces at each corner. Other
// shapes are drawn by outlines along their axes, and filled by their support points in all directions.

#include <abut/draw/convex.hpp>
#include <abut/draw/outline.hpp>
#include <abut/draw/placed_faces.hpp>

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace abut::detail {
namespace {

// --- lines of polytopes ---

using FaceLoop = PlacedFaces::FaceLoop;

std::vector<Vec3> offset_face(const PlacedFaces& polytope, const FaceLoop& face, double radius) {
    std::vector<Vec3> result;
    for (const std::uint32_t i : face.corners) result.push_back(to_float(polytope.corners[i] + face.normal * radius));
    return result;
}

/// Draws the arc about `center` from one direction to another through `middle`.
void draw_arc(Canvas<3>& canvas, const DVec<3>& center, double radius, const DVec<3>& from, const DVec<3>& middle,
              const DVec<3>& to, int halvings, const Style& style) {
    if (halvings == 0) {
        canvas.line(to_float(center + from * radius), to_float(center + to * radius), style);
        return;
    }
    draw_arc(canvas, center, radius, from, normalized(from + middle, middle), middle, halvings - 1, style);
    draw_arc(canvas, center, radius, middle, normalized(middle + to, middle), to, halvings - 1, style);
}

/// Calls visit(i, j, face, other) once for each edge. It runs from i to j on the loop of `face`, and back on that of
/// `other`.
template <class Visit>
void each_edge(const PlacedFaces& polytope, Visit&& visit) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, const FaceLoop*> sides;
    for (const FaceLoop& face : polytope.faces)
        for (std::size_t k = 0; k < face.corners.size(); ++k)
            sides[{face.corners[k], face.corners[(k + 1) % face.corners.size()]}] = &face;
    for (const auto& [edge, face] : sides) {
        const auto back = sides.find({edge.second, edge.first});
        if (back != sides.end() && edge.first < edge.second) visit(edge.first, edge.second, *face, *back->second);
    }
}

void draw_edges(Canvas<3>& canvas, const PlacedFaces& polytope, double radius, const Style& style) {
    if (radius > 0)
        for (const FaceLoop& face : polytope.faces)
            canvas.polygon(offset_face(polytope, face, radius), unfilled(style));
    each_edge(polytope, [&](std::uint32_t i, std::uint32_t j, const FaceLoop& face, const FaceLoop& other) {
        const DVec<3>&a = polytope.corners[i], &b = polytope.corners[j];
        if (radius > 0) {
            const DVec<3> aside = normalized(cross(b - a, face.normal));
            const DVec<3> middle = normalized(face.normal + other.normal, aside);
            for (const DVec<3>& corner : {a, b})
                draw_arc(canvas, corner, radius, face.normal, middle, other.normal, 3, style);
        } else {
            canvas.line(to_float(a), to_float(b), style);
        }
    });
}

// --- lines and fill of round shapes ---

/// The shape's own axes as normals in the world, right-handed. z is the axis of symmetry, if there is one.
struct Frame {
    DVec<3> x, y, z;
};

bool is_segment_with_ball(const Convex<3>& convex) {
    return convex.core == Core::points && convex.count == 2;
}
bool has_two_ends(const Convex<3>& convex) {
    return convex.core == Core::discs || is_segment_with_ball(convex);
}

Frame frame_of(const Convex<3>& convex) {
    const Affine<3>& place = convex.place;
    const bool flattened = dot(place.column[0], cross(place.column[1], place.column[2])) == 0;
    if (flattened) return {axis<3>(0), axis<3>(1), axis<3>(2)};
    DVec<3> z = axis<3>(2);
    if (has_two_ends(convex)) z = normalized(DVec<3>(convex.vertices()[1]) - DVec<3>(convex.vertices()[0]), z);
    const DVec<3> x = perpendicular(z), y = cross(z, x);
    const DVec<3> u = normalized(mapped_normal(place, x)), v = normalized(mapped_normal(place, y)),
                  w = normalized(mapped_normal(place, z));
    return dot(cross(u, v), w) < 0 ? Frame{v, u, w} : Frame{u, v, w};
}

void draw_outline(Canvas<3>& canvas, const Convex<3>& convex, const DVec<3>& u, const DVec<3>& v, const DVec<3>& tilt,
                  const Style& style) {
    const DVec<3> beside = normalized(v - u * dot(u, v), perpendicular(u));
    const std::vector<Vec3> points = outline(convex, OutlinePlane<3>{u, beside, tilt});
    if (points.size() > 2)
        canvas.polygon(points, unfilled(style));
    else if (points.size() == 2)
        canvas.line(points[0], points[1], style);
}

void draw_outlines(Canvas<3>& canvas, const Convex<3>& convex, const Style& style) {
    const Frame frame = frame_of(convex);
    draw_outline(canvas, convex, frame.x, frame.z, DVec<3>(0.0), style);
    draw_outline(canvas, convex, frame.y, frame.z, DVec<3>(0.0), style);
    if (!has_two_ends(convex)) return draw_outline(canvas, convex, frame.x, frame.y, DVec<3>(0.0), style);
    constexpr double slightly = 1e-3;
    draw_outline(canvas, convex, frame.x, frame.y, frame.z * -slightly, style);
    const bool pointed = convex.core == Core::discs && convex.disc_radius[1] == 0;
    if (!pointed) draw_outline(canvas, convex, frame.x, frame.y, frame.z * slightly, style);
}

/// Fills the surface between three directions, a triangle on the unit ball, counter-clockwise seen from outside.
void fill_between(Canvas<3>& canvas, const Convex<3>& convex, const DVec<3>& a, const DVec<3>& b, const DVec<3>& c,
                  int halvings, const Style& style) {
    if (halvings == 0) {
        const std::array<Vec3, 3> points{to_float(support(convex, a)), to_float(support(convex, b)),
                                         to_float(support(convex, c))};
        if (points[0] != points[1] && points[1] != points[2] && points[2] != points[0]) canvas.polygon(points, style);
        return;
    }
    const DVec<3> ab = normalized(a + b), bc = normalized(b + c), ca = normalized(c + a);
    fill_between(canvas, convex, a, ab, ca, halvings - 1, style);
    fill_between(canvas, convex, ab, b, bc, halvings - 1, style);
    fill_between(canvas, convex, ca, bc, c, halvings - 1, style);
    fill_between(canvas, convex, ab, bc, ca, halvings - 1, style);
}

/// The directions of an octahedron with each face divided into 64.
void fill_all_around(Canvas<3>& canvas, const Convex<3>& convex, const Style& style) {
    const Frame frame = frame_of(convex);
    const std::array<DVec<3>, 4> equator{frame.x, frame.y, -frame.x, -frame.y};
    // The directions are slightly off the axis: along it all points of a flat end are equally far, and rounding would
    // choose the support point.
    const DVec<3> top = frame.z + frame.x * 1e-7, bottom = frame.x * 1e-7 - frame.z;
    for (std::size_t i = 0; i < 4; ++i) {
        const DVec<3>&from = equator[i], &to = equator[(i + 1) % 4];
        fill_between(canvas, convex, from, to, top, 3, fill_only(style));
        fill_between(canvas, convex, to, from, bottom, 3, fill_only(style));
    }
}

}  // namespace

void draw_convex(Canvas<3>& canvas, const Convex<3>& convex, const Style& style) {
    if (is_ball(convex)) return draw_ball(canvas, convex, style);
    if (is_segment_with_ball(convex) && convex.inner_radius == 0 && convex.radius == 0) {
        const auto end = [&](int i) { return to_float(convex.place.point(DVec<3>(convex.vertices()[i]))); };
        return canvas.line(end(0), end(1), style);
    }
    const PlacedFaces shape = placed_faces(convex);
    const bool flat_faces = !shape.faces.empty();
    if (style.fill.visible() && flat_faces && convex.radius == 0)
        for (const FaceLoop& face : shape.faces) canvas.polygon(offset_face(shape, face, 0), fill_only(style));
    else if (style.fill.visible())
        fill_all_around(canvas, convex, style);
    if (!style.stroke.visible()) return;
    if (flat_faces)
        draw_edges(canvas, shape, convex.radius, style);
    else
        draw_outlines(canvas, convex, style);
}

}  // namespace abut::detail
