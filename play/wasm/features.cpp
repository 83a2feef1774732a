// Features of a shape, and their Voronoi regions in 3D.

#include "features.h"

#include "command_canvas.hpp"
#include <abut/convex/support.hpp>
#include <abut/draw/placed_faces.hpp>

using namespace abut::detail;
using abut::FeatureKind;
using abut::play::CommandCanvas;

namespace {

/// The two point numbers of an edge's index.
std::array<std::uint32_t, 2> ends_of(std::uint32_t index) {
    return {index & 0xffffu, index >> 16};
}

/// Draws the feature, if the shape has it, on its surface.
template <int D>
class FeatureDrawing {
public:
    FeatureDrawing(const Convex<D>& core, CommandCanvas<D>& canvas) : core_(core), canvas_(canvas) {}

    void draw(FeatureKind kind, std::uint32_t index) {
        const std::array<std::uint32_t, 2> ends = kind == FeatureKind::edge ? ends_of(index) : std::array{index, index};
        if (kind == FeatureKind::face) {
            draw_face(index);
        } else if (kind != FeatureKind::none && has_corner(core_, ends[0]) && has_corner(core_, ends[1])) {
            if (kind == FeatureKind::edge) canvas_.line(corner(ends[0]), corner(ends[1]), {});
            canvas_.point(corner(ends[0]), {});
            if (kind == FeatureKind::edge) canvas_.point(corner(ends[1]), {});
        }
    }

private:
    void draw_face(std::uint32_t index) {
        if constexpr (D == 3) {
            const PlacedFaces shape = placed_faces(core_);
            if (index >= shape.faces.size()) return;
            std::vector<abut::Vec3> loop;
            for (const std::uint32_t i : shape.faces[index].corners) loop.push_back(to_float(shape.corners[i]));
            canvas_.polygon(loop, abut::play::style_of(true));
        }
    }
    abut::Vec<D> corner(std::uint32_t index) const { return to_float(core_.place.point(local_corner(core_, index))); }

    const Convex<D>& core_;
    CommandCanvas<D>& canvas_;
};

/// The walls of one region: on the edges of a face; on both sides of an edge, and across its ends; around a vertex.
class RegionDrawing {
public:
    RegionDrawing(const Convex<3>& core, CommandCanvas<3>& canvas)
        : shape_(placed_faces(core)), height_(size(core) / 2), is_box_(core.core == Core::box), canvas_(canvas) {}

    void draw(FeatureKind kind, std::uint32_t index) {
        for (std::uint32_t f = 0; f < shape_.faces.size(); ++f)
            for (std::size_t i = 0; i < shape_.faces[f].corners.size(); ++i) {
                const std::uint32_t a = corner_of(f, i), b = corner_of(f, i + 1);
                const bool is_on_feature = kind == FeatureKind::face ? f == index
                                           : kind == FeatureKind::edge
                                               ? abut::edge_index(named(a), named(b)) == index
                                               : kind == FeatureKind::vertex && named(a) == index;
                if (!is_on_feature) continue;
                if (kind != FeatureKind::vertex) draw_wall(f, a, b);
                if (kind != FeatureKind::face) draw_end(f, a, b);
            }
    }

private:
    std::uint32_t corner_of(std::uint32_t face, std::size_t i) const {
        const std::vector<std::uint32_t>& corners = shape_.faces[face].corners;
        return corners[i % corners.size()];
    }
    /// The number by which answers name a corner: bit i of a box' corner is set at the low end of axis i.
    std::uint32_t named(std::uint32_t corner) const { return is_box_ ? 7 - corner : corner; }

    void draw_wall(std::uint32_t face, std::uint32_t a, std::uint32_t b) {
        const DVec<3> up = shape_.faces[face].normal * height_;
        draw_filled({shape_.corners[a], shape_.corners[b], shape_.corners[b] + up, shape_.corners[a] + up});
    }
    /// Across the end A of an edge, between its two faces.
    void draw_end(std::uint32_t face, std::uint32_t a, std::uint32_t b) {
        for (std::uint32_t f = 0; f < shape_.faces.size(); ++f)
            for (std::size_t i = 0; i < shape_.faces[f].corners.size(); ++i)
                if (corner_of(f, i) == b && corner_of(f, i + 1) == a)
                    draw_filled({shape_.corners[a], shape_.corners[a] + shape_.faces[face].normal * height_,
                                 shape_.corners[a] + shape_.faces[f].normal * height_});
    }
    void draw_filled(std::initializer_list<DVec<3>> corners) {
        std::vector<abut::Vec3> points;
        for (const DVec<3>& corner : corners) points.push_back(to_float(corner));
        canvas_.polygon(points, abut::play::style_of(true));
    }

    PlacedFaces shape_;
    double height_;
    bool is_box_;
    CommandCanvas<3>& canvas_;
};

/// Calls draw(core, canvas) for a convex shape; others have no features.
template <int D, class Draw>
abut_code recorded(const ShapeHandle<D>* shape, abut_buffer* out, Draw&& draw) {
    return entry({present(shape, "shape"), present(out, "out")}, [&] {
        CommandCanvas<D> canvas({});
        const auto view = shape->shape.view();
        if (const auto* convex = std::get_if<Convex<D>>(&view)) draw(*convex, canvas);
        canvas.write(*out);
    });
}

template <int D>
abut_code draw_feature(const ShapeHandle<D>* shape, std::uint32_t kind, std::uint32_t index, abut_buffer* out) {
    return recorded<D>(shape, out, [&](const Convex<D>& convex, CommandCanvas<D>& canvas) {
        FeatureDrawing<D>(convex, canvas).draw(static_cast<FeatureKind>(kind), index);
    });
}

}  // namespace

abut_code abut_play_draw_feature2(const abut_shape2* shape, uint32_t kind, uint32_t index, abut_buffer* out) {
    return draw_feature<2>(shape, kind, index, out);
}
abut_code abut_play_draw_feature3(const abut_shape3* shape, uint32_t kind, uint32_t index, abut_buffer* out) {
    return draw_feature<3>(shape, kind, index, out);
}
abut_code abut_play_draw_region3(const abut_shape3* shape, uint32_t kind, uint32_t index, abut_buffer* out) {
    return recorded<3>(shape, out, [&](const Convex<3>& convex, CommandCanvas<3>& canvas) {
        RegionDrawing(convex, canvas).draw(static_cast<FeatureKind>(kind), index);
    });
}
