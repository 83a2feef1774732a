#include <abut/convex/features.hpp>
#include <abut/draw/convex.hpp>
#include <abut/draw/outline.hpp>
#include <abut/draw/placed_faces.hpp>
#include <abut/draw/voronoi.hpp>

#include <vector>

namespace abut {

using namespace detail;

namespace {

// --- 2D ---

/// A corner of a region, and the border to which the line to the next corner belongs.
struct RegionCorner {
    DVec<2> position;
    std::size_t border;
};
using Region = std::vector<RegionCorner>;

/// Clips a region to dot(normal, p) <= offset; the new side belongs to `border`.
Region cut(const Region& region, const DVec<2>& normal, double offset, std::size_t border) {
    Region result;
    for (std::size_t i = 0; i < region.size(); ++i) {
        const RegionCorner &a = region[i], &b = region[(i + 1) % region.size()];
        const double height_a = dot(normal, a.position) - offset, height_b = dot(normal, b.position) - offset;
        if (height_a <= 0) result.push_back(a);
        if ((height_a <= 0) == (height_b <= 0)) continue;
        const DVec<2> crossing = a.position + (b.position - a.position) * (height_a / (height_a - height_b));
        result.push_back({crossing, height_a <= 0 ? border : a.border});
    }
    return result;
}

void fill(Canvas<2>& canvas, const Region& region, const Style& style) {
    if (region.size() < 3 || !style.fill.visible()) return;
    std::vector<Vec2> points;
    for (const RegionCorner& corner : region) points.push_back(to_float(corner.position));
    canvas.polygon(points, fill_only(style));
}

/// A polygon's outline with its Voronoi regions, outside and inside. A segment counts as two edges.
class Regions {
public:
    Regions(Canvas<2>& canvas, const std::vector<Vec2>& outline) : canvas_(canvas) {
        for (const Vec2& point : outline) corners_.emplace_back(point);
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const DVec<2> along = normalized(corner(i + 1) - corner(i));
            along_.push_back(along);
            normals_.emplace_back(along.y, -along.x);
        }
        const Aabb2 box = canvas.shown();
        for (const Vec2& point : {box.min, Vec2(box.max.x, box.min.y), box.max, Vec2(box.min.x, box.max.y)})
            shown_.push_back({DVec<2>(point), corners_.size()});
    }

    void draw(const Style& style) const {
        Style faint = style;
        faint.fill.alpha = static_cast<std::uint8_t>(style.fill.alpha / 2);
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            fill(canvas_, of_edge(i), style);
            fill(canvas_, of_corner(i), faint);
            fill(canvas_, inside_of_edge(i), style);
        }
        if (!style.stroke.visible()) return;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            draw_ray(corner(i), normals_[i], style);
            draw_ray(corner(i + 1), normals_[i], style);
            const Region inside = inside_of_edge(i);
            for (std::size_t k = 0; k < inside.size(); ++k) {
                const Vec2 from = to_float(inside[k].position), to = to_float(inside[(k + 1) % inside.size()].position);
                const bool first_of_two = inside[k].border > i && inside[k].border < corners_.size();
                if (first_of_two && from != to) canvas_.line(from, to, style);
            }
        }
    }

private:
    const DVec<2>& corner(std::size_t i) const { return corners_[i % corners_.size()]; }
    std::size_t before(std::size_t i) const { return (i == 0 ? corners_.size() : i) - 1; }

    Region of_edge(std::size_t i) const {
        Region result = cut(shown_, -normals_[i], -height(i), i);
        result = cut(result, -along_[i], -dot(along_[i], corner(i)), i);
        return cut(result, along_[i], dot(along_[i], corner(i + 1)), i);
    }
    Region of_corner(std::size_t i) const {
        const DVec<2>&past = along_[before(i)], &ahead = along_[i];
        return cut(cut(shown_, -past, -dot(past, corner(i)), i), ahead, dot(ahead, corner(i)), i);
    }
    /// The part of the interior nearest to edge i.
    Region inside_of_edge(std::size_t i) const {
        if (corners_.size() < 3) return {};
        const std::size_t outline = corners_.size();
        Region result = shown_;
        for (std::size_t k = 0; k < corners_.size(); ++k) result = cut(result, normals_[k], height(k), outline);
        for (std::size_t k = 0; k < corners_.size(); ++k)
            if (k != i) result = cut(result, normals_[k] - normals_[i], height(k) - height(i), k);
        return result;
    }
    /// The offset of edge i along its normal.
    double height(std::size_t i) const { return dot(normals_[i], corner(i)); }

    void draw_ray(const DVec<2>& origin, const DVec<2>& direction, const Style& style) const {
        const Aabb2 box = canvas_.shown();
        double enter = 0, leave = std::numeric_limits<double>::infinity();
        for (int i = 0; i < 2; ++i) {
            const double low = static_cast<double>(box.min[i]) - origin[i],
                         high = static_cast<double>(box.max[i]) - origin[i];
            if (direction[i] == 0) {
                if (low > 0 || high < 0) return;
                continue;
            }
            enter = std::max(enter, std::min(low / direction[i], high / direction[i]));
            leave = std::min(leave, std::max(low / direction[i], high / direction[i]));
        }
        if (enter < leave)
            canvas_.line(to_float(origin + direction * enter), to_float(origin + direction * leave), style);
    }

    Canvas<2>& canvas_;
    std::vector<DVec<2>> corners_, along_, normals_;
    Region shown_;
};

void draw_regions(Canvas<2>& canvas, const Convex<2>& core, const Style& style) {
    const std::vector<Vec2> loop = outline(core);
    if (loop.size() > 1) Regions(canvas, loop).draw(style);
}

// --- 3D ---

void draw_regions(Canvas<3>& canvas, const Convex<3>& core, const Style& style) {
    if (is_ball(core)) return;
    Convex<3> above = core;
    above.radius = size(core) / 2;
    const PlacedFaces shape = placed_faces(core);
    for (const PlacedFaces::FaceLoop& face : shape.faces) {
        const DVec<3> up = face.normal * above.radius;
        for (std::size_t i = 0; i < face.corners.size(); ++i) {
            const DVec<3>&a = shape.corners[face.corners[i]],
                  &b = shape.corners[face.corners[(i + 1) % face.corners.size()]];
            const std::array<Vec3, 4> wall{to_float(a), to_float(b), to_float(b + up), to_float(a + up)};
            if (style.fill.visible()) canvas.polygon(wall, fill_only(style));
            if (style.stroke.visible()) canvas.line(wall[0], wall[3], style);
        }
    }
    draw_convex(canvas, above, unfilled(style));
}

}  // namespace

template <int D>
void draw(Canvas<D>& canvas, const Voronoi<D>& voronoi, const Style& style) {
    const auto* convex = std::get_if<Convex<D>>(&voronoi.shape);
    if (convex == nullptr || !is_finite(*convex) || !has_features(*convex)) return;
    Convex<D> core = *convex;
    core.radius = 0;
    draw_regions(canvas, core, style);
}

template void draw(Canvas<2>&, const Voronoi<2>&, const Style&);
template void draw(Canvas<3>&, const Voronoi<3>&, const Style&);

}  // namespace abut
