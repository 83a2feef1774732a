// Drawing by the library's own canvas.

#include "draw.h"

#include "command_canvas.hpp"
#include <abut/draw/draw.hpp>
#include <abut/draw/voronoi.hpp>

using namespace abut::detail;

namespace {

template <int D>
using Corner = typename CTypes<D>::Vec;

/// Calls draw(canvas, view, style) and writes what it drew.
template <int D, class Draw>
abut_code recorded(const ShapeHandle<D>* shape, Corner<D> min, Corner<D> max, bool filled, abut_buffer* out,
                   Draw&& draw) {
    return entry({present(shape, "shape"), finite(min, "min"), finite(max, "max"), present(out, "out")}, [&] {
        abut::play::CommandCanvas<D> canvas({same_bytes<abut::Vec<D>>(min), same_bytes<abut::Vec<D>>(max)});
        draw(canvas, shape->shape.view(), abut::play::style_of(filled));
        canvas.write(*out);
    });
}

const auto draw_shape = [](auto& canvas, const auto& view, const abut::Style& style) { draw(canvas, view, style); };
const auto draw_voronoi = [](auto& canvas, const auto& view, const abut::Style& style) {
    draw(canvas, voronoi(view), style);
};

}  // namespace

abut_code abut_play_draw2(const abut_shape2* shape, abut_vec2 min, abut_vec2 max, bool filled, abut_buffer* out) {
    return recorded<2>(shape, min, max, filled, out, draw_shape);
}
abut_code abut_play_draw3(const abut_shape3* shape, abut_vec3 min, abut_vec3 max, bool filled, abut_buffer* out) {
    return recorded<3>(shape, min, max, filled, out, draw_shape);
}
abut_code abut_play_draw_voronoi2(const abut_shape2* shape, abut_vec2 min, abut_vec2 max, bool filled,
                                  abut_buffer* out) {
    return recorded<2>(shape, min, max, filled, out, draw_voronoi);
}
abut_code abut_play_draw_voronoi3(const abut_shape3* shape, abut_vec3 min, abut_vec3 max, bool filled,
                                  abut_buffer* out) {
    return recorded<3>(shape, min, max, filled, out, draw_voronoi);
}
