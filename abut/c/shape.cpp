// Shapes of the C API.

#include <abut/c/detail/answers.hpp>

#include <cmath>
#include <optional>
#include <span>

using namespace abut::detail;

namespace {

using abut::AnyShape;
using abut::PolytopeOf;

template <int D>
using COf = CTypes<D>;

Fault valid_radius(float radius) {
    return not_below_zero(radius, "the radius");
}

template <class B>
Fault valid_size(const B& box) {
    const auto half = std::bit_cast<std::array<float, sizeof(box.half) / sizeof(float)>>(box.half);
    const bool valid = std::all_of(half.begin(), half.end(), [](float h) { return h >= 0; });
    return valid ? Fault() : Fault{ABUT_BAD_ARGUMENT, "box.half", "has a number below 0"};
}

template <int D>
Fault valid_order(const abut::Aabb<D>& box) {
    for (int i = 0; i < D; ++i)
        if (box.max[i] < box.min[i]) return {ABUT_BAD_ARGUMENT, "box.max", "is below box.min"};
    return {};
}

template <int D>
Fault unit(const abut::Vec<D>& normal, const char* name) {
    float square = 0;
    for (int i = 0; i < D; ++i) square += normal[i] * normal[i];
    return std::abs(square - 1) < 1e-3f ? Fault() : Fault{ABUT_BAD_ARGUMENT, name, "is no unit vector"};
}

/// Converts an array of point numbers, N for each element, after a check of the pointer.
template <int N>
std::vector<glm::vec<N, std::uint32_t>> indices(const std::uint32_t* numbers, std::uint32_t count) {
    std::vector<glm::vec<N, std::uint32_t>> result(count);
    for (std::uint32_t i = 0; i < count; ++i)
        for (int k = 0; k < N; ++k) result[i][k] = numbers[N * std::size_t{i} + static_cast<std::size_t>(k)];
    return result;
}

/// A shape of plain values: S is the library's.
template <int D, class S, class C>
abut_code give_value(const C& value, typename COf<D>::Shape** out, Fault fault = {}) {
    return entry({present(out, "out"), finite(value, "the shape"), fault}, [&] {
        const S shape = same_bytes<S>(value);
        if constexpr (std::is_constructible_v<ShapeSource<D>, S>)
            return give_shape<D>(shape, out, shape);
        else
            return give_shape<D>(shape, out);
    });
}

template <int D>
abut_code hull(const typename COf<D>::Vec* points, std::uint32_t stride, std::uint32_t count,
               std::uint32_t max_vertices, typename COf<D>::Shape** out) {
    const Strided array(points, stride, count, "points");
    return entry({present(out, "out"), array.fault()}, [&] {
        const auto copied = array.template copied<abut::Vec<D>>();
        return give_built<D>(PolytopeOf<D>::build(std::span(copied), {.max_vertices = max_vertices}), out);
    });
}

template <int D>
abut_code solid_bsp(const typename COf<D>::Vec* points, std::uint32_t stride, std::uint32_t count,
                    const std::uint32_t* faces, std::uint32_t face_count, typename COf<D>::Shape** out) {
    const Strided points_of(points, stride, count, "points");
    return entry({present(out, "out"), points_of.fault(), array(faces, face_count, "faces")}, [&] {
        return give_built<D>(
            abut::SolidBsp<D>::build(points_of.template copied<abut::Vec<D>>(), indices<D>(faces, face_count)), out);
    });
}

template <int D>
abut_code brushes(const typename COf<D>::HalfSpace* sides, std::uint32_t side_count, const std::uint32_t* ends,
                  std::uint32_t brush_count, typename COf<D>::Shape** out) {
    return entry({present(out, "out"), array(sides, side_count, "sides"), array(ends, brush_count, "ends")}, [&] {
        const auto copied = Strided(sides, 0, side_count, "sides").template copied<abut::HalfSpace<D>>();
        return give_built<D>(abut::SolidBsp<D>::from_brushes(copied, std::span(ends, brush_count)), out);
    });
}

template <int D>
abut_code compound(const typename COf<D>::Shape* const* children, std::uint32_t count, typename COf<D>::Shape** out) {
    return entry({present(out, "out"), array(children, count, "children")}, [&] {
        std::vector<AnyShape<D>> shapes;
        shapes.reserve(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            Fault fault = present(children[i], "children");
            fault.index = i;
            if (fault.code != ABUT_OK) return report(fault);
            shapes.push_back(children[i]->shape);
        }
        return give_built<D>(abut::Compound<D>::build(std::span<const AnyShape<D>>(shapes)), out);
    });
}

/// A view's history of stretching is that of the shape it was made from.
template <int D>
void copy_history(const ShapeHandle<D>& from, ShapeHandle<D>& to) {
    to.was_stretched = from.was_stretched;
    to.was_rounded_after_stretching = from.was_rounded_after_stretching;
}

template <int D>
abut_code placed(const ShapeHandle<D>* shape, typename COf<D>::Pose pose, typename COf<D>::Shape** out) {
    return entry({present(shape, "shape"), finite(pose, "pose"), present(out, "out")}, [&] {
        const auto code = give_shape<D>(PlacedShape<D>{shape->shape, same_bytes<abut::Pose<D>>(pose)}, out);
        if (code == ABUT_OK) copy_history(*shape, **out);
        return code;
    });
}

template <int D>
abut_code round(const ShapeHandle<D>* shape, float radius, typename COf<D>::Shape** out) {
    return entry({present(shape, "shape"), valid_radius(radius), present(out, "out")}, [&] {
        const auto code = give_shape<D>(abut::rounded(AnyShape<D>(shape->shape), radius), out);
        if (code != ABUT_OK) return code;
        copy_history(*shape, **out);
        (*out)->was_rounded_after_stretching = shape->was_stretched;
        return code;
    });
}

template <int D>
abut_code stretch(const ShapeHandle<D>* shape, typename COf<D>::Vec scale, typename COf<D>::Shape** out) {
    return entry({present(shape, "shape"), finite(scale, "scale"), present(out, "out")}, [&] {
        if (shape->was_rounded_after_stretching)
            return report(
                Fault{ABUT_WRONG_SHAPE, "shape", "was stretched and then rounded: stretch first, round last"});
        const auto code =
            give_shape<D>(abut::stretched(AnyShape<D>(shape->shape), same_bytes<abut::Vec<D>>(scale)), out);
        if (code == ABUT_OK) (*out)->was_stretched = true;
        return code;
    });
}

template <int D>
abut_code polytope_of(const ShapeHandle<D>* shape, float tolerance, typename COf<D>::Shape** out) {
    return entry({present(shape, "shape"), present(out, "out")}, [&] {
        if (!(tolerance > 0)) return report(Fault{ABUT_BAD_ARGUMENT, "tolerance", "is not above 0"});
        const abut::View<D> view = shape->shape.view();
        const auto* convex = std::get_if<Convex<D>>(&view);
        if (convex == nullptr) return report(Fault{ABUT_WRONG_SHAPE, "shape", "is not convex"});
        const PolytopeOf<D> polytope = abut::polytope(*convex, tolerance);
        return give_shape<D>(polytope, out, polytope);
    });
}

/// Calls `body` with the views of two polytopes.
template <int D, class Body>
abut_code with_polytopes(const ShapeHandle<D>* a, const ShapeHandle<D>* b, typename COf<D>::Shape** out,
                         const Body& body) {
    return entry({present(a, "a"), present(b, "b"), present(out, "out")}, [&] {
        std::array<PolytopeOf<D>, 2> of_boxes;
        std::array<Convex<D>, 2> views;
        const std::array<const ShapeHandle<D>*, 2> shapes{a, b};
        for (std::size_t i = 0; i < 2; ++i) {
            const abut::View<D> own = shapes[i]->shape.view();
            const auto* convex = std::get_if<Convex<D>>(&own);
            if (convex == nullptr || !has_corners_only(*convex))
                return report(Fault{ABUT_WRONG_SHAPE, i == 0 ? "a" : "b", "is not a polytope"});
            if (const auto* box = std::get_if<abut::Aabb<D>>(&shapes[i]->source)) {
                of_boxes[i] = abut::polytope(*box);
                views[i] = view(of_boxes[i]);
            } else {
                views[i] = *convex;
            }
        }
        return body(views[0], views[1]);
    });
}

template <int D>
abut_code intersect(const ShapeHandle<D>* a, const ShapeHandle<D>* b, typename COf<D>::Shape** out) {
    return with_polytopes<D>(a, b, out, [&](const Convex<D>& x, const Convex<D>& y) {
        PolytopeOf<D> result;
        if (abut::intersection(x, y, result)) return give_shape<D>(result, out, result);
        *out = nullptr;
        return ABUT_OK;
    });
}

template <int D>
abut_code minkowski(const ShapeHandle<D>* a, const ShapeHandle<D>* b, typename COf<D>::Shape** out,
                    bool of_negative_b) {
    return with_polytopes<D>(a, b, out, [&](const Convex<D>& x, const Convex<D>& y) {
        const abut::Aabb<D> of_x = bounds(x), of_y = bounds(y);
        const abut::Aabb<D> added = of_negative_b ? abut::Aabb<D>{-of_y.max, -of_y.min} : of_y;
        if (!is_finite(of_x.min + added.min) || !is_finite(of_x.max + added.max))
            return report(Fault{ABUT_NOT_FINITE, "the sum", "is not finite"});
        const PolytopeOf<D> result = of_negative_b ? abut::minkowski_difference(x, y) : abut::minkowski_sum(x, y);
        return give_shape<D>(result, out, result);
    });
}

template <int D>
abut_code bounds_of(const ShapeHandle<D>* shape, typename COf<D>::Aabb* out) {
    return entry({present(shape, "shape"), present(out, "out")},
                 [&] { *out = same_bytes<typename COf<D>::Aabb>(bounds(shape->shape)); });
}

template <int D>
abut_code points_of(const ShapeHandle<D>* shape, List<typename COf<D>::Vec> list) {
    return entry({present(shape, "shape"), list.fault()}, [&] {
        const auto write = [&](const auto& points) { list.assign(points, [](const auto& p) { return to_c<D>(p); }); };
        using Level = std::variant_alternative_t<4, ShapeSource<D>>;
        if (const auto* polytope = std::get_if<PolytopeOf<D>>(&shape->source))
            write(polytope->points());
        else if (const auto* level = std::get_if<Level>(&shape->source))
            write(level->points());
        else
            return report(Fault{ABUT_WRONG_SHAPE, "shape", "has no list of points"});
        return ABUT_OK;
    });
}

template <int D>
abut_code measure(const ShapeHandle<D>* shape, typename COf<D>::Measures* out) {
    return entry({present(shape, "shape"), present(out, "out")}, [&] {
        const auto* polytope = std::get_if<PolytopeOf<D>>(&shape->source);
        if (polytope == nullptr) return report(Fault{ABUT_WRONG_SHAPE, "shape", "is no polygon or polyhedron"});
        double volume = 0;
        if constexpr (D == 3) volume = polytope->volume();
        *out = {static_cast<std::uint32_t>(polytope->rank()), polytope->area(), volume, to_c<D>(polytope->centroid()),
                to_c<D>(polytope->normal())};
        return ABUT_OK;
    });
}

}  // namespace

// The entries of both dimensions.
#define ABUT_C_ENTRIES(D)                                                                                           \
    abut_code abut_shape##D##_ball(abut_ball##D ball, abut_shape##D** out) {                                        \
        return give_value<D, abut::Ball<D>>(ball, out, valid_radius(ball.radius));                                  \
    }                                                                                                               \
    abut_code abut_shape##D##_capsule(abut_capsule##D capsule, abut_shape##D** out) {                               \
        return give_value<D, abut::Capsule<D>>(capsule, out, valid_radius(capsule.radius));                         \
    }                                                                                                               \
    abut_code abut_shape##D##_box(abut_box##D box, abut_shape##D** out) {                                           \
        return give_value<D, abut::Box<D>>(box, out, valid_size(box));                                              \
    }                                                                                                               \
    abut_code abut_shape##D##_aabb(abut_aabb##D box, abut_shape##D** out) {                                         \
        return give_value<D, abut::Aabb<D>>(box, out, valid_order(same_bytes<abut::Aabb<D>>(box)));                 \
    }                                                                                                               \
    abut_code abut_shape##D##_segment(abut_segment##D segment, abut_shape##D** out) {                               \
        return give_value<D, abut::Segment<D>>(segment, out);                                                       \
    }                                                                                                               \
    abut_code abut_shape##D##_triangle(abut_triangle##D triangle, abut_shape##D** out) {                            \
        return give_value<D, abut::Triangle<D>>(triangle, out);                                                     \
    }                                                                                                               \
    abut_code abut_shape##D##_half_space(abut_half_space##D half_space, abut_shape##D** out) {                      \
        const auto normal = same_bytes<abut::Vec<D>>(half_space.normal);                                            \
        return give_value<D, abut::HalfSpace<D>>(half_space, out, unit(normal, "half_space.normal"));               \
    }                                                                                                               \
    abut_code abut_shape##D##_compound(const abut_shape##D* const* children, uint32_t count, abut_shape##D** out) { \
        return compound<D>(children, count, out);                                                                   \
    }                                                                                                               \
    abut_code abut_shape##D##_solid_bsp(const abut_vec##D* points, uint32_t stride, uint32_t point_count,           \
                                        const uint32_t* faces, uint32_t face_count, abut_shape##D** out) {          \
        return solid_bsp<D>(points, stride, point_count, faces, face_count, out);                                   \
    }                                                                                                               \
    abut_code abut_shape##D##_solid_bsp_from_brushes(const abut_half_space##D* sides, uint32_t side_count,          \
                                                     const uint32_t* ends, uint32_t brush_count,                    \
                                                     abut_shape##D** out) {                                         \
        return brushes<D>(sides, side_count, ends, brush_count, out);                                               \
    }                                                                                                               \
    abut_code abut_shape##D##_at(const abut_shape##D* shape, abut_pose##D pose, abut_shape##D** out) {              \
        return placed<D>(shape, pose, out);                                                                         \
    }                                                                                                               \
    abut_code abut_shape##D##_rounded(const abut_shape##D* shape, float radius, abut_shape##D** out) {              \
        return round<D>(shape, radius, out);                                                                        \
    }                                                                                                               \
    abut_code abut_shape##D##_stretched(const abut_shape##D* shape, abut_vec##D scale, abut_shape##D** out) {       \
        return stretch<D>(shape, scale, out);                                                                       \
    }                                                                                                               \
    abut_code abut_shape##D##_polytope(const abut_shape##D* shape, float tolerance, abut_shape##D** out) {          \
        return polytope_of<D>(shape, tolerance, out);                                                               \
    }                                                                                                               \
    abut_code abut_shape##D##_intersection(const abut_shape##D* a, const abut_shape##D* b, abut_shape##D** out) {   \
        return intersect<D>(a, b, out);                                                                             \
    }                                                                                                               \
    abut_code abut_shape##D##_minkowski_sum(const abut_shape##D* a, const abut_shape##D* b, abut_shape##D** out) {  \
        return minkowski<D>(a, b, out, false);                                                                      \
    }                                                                                                               \
    abut_code abut_shape##D##_minkowski_difference(const abut_shape##D* a, const abut_shape##D* b,                  \
                                                   abut_shape##D** out) {                                           \
        return minkowski<D>(a, b, out, true);                                                                       \
    }                                                                                                               \
    abut_code abut_shape##D##_bounds(const abut_shape##D* shape, abut_aabb##D* out) {                               \
        return bounds_of<D>(shape, out);                                                                            \
    }                                                                                                               \
    abut_code abut_shape##D##_points(const abut_shape##D* shape, abut_vec##D* out, uint32_t capacity,               \
                                     uint32_t* count) {                                                             \
        return points_of<D>(shape, {out, capacity, count});                                                         \
    }                                                                                                               \
    abut_code abut_shape##D##_measures(const abut_shape##D* shape, abut_measures##D* out) {                         \
        return measure<D>(shape, out);                                                                              \
    }                                                                                                               \
    void abut_shape##D##_release(abut_shape##D* shape) {                                                            \
        release(shape);                                                                                             \
    }
ABUT_C_ENTRIES(2)
ABUT_C_ENTRIES(3)
#undef ABUT_C_ENTRIES

abut_code abut_shape2_polygon(const abut_vec2* points, uint32_t stride, uint32_t count, uint32_t max_vertices,
                              abut_shape2** out) {
    return hull<2>(points, stride, count, max_vertices, out);
}

abut_code abut_shape2_chain(const abut_vec2* points, uint32_t stride, uint32_t count, bool closed, bool one_sided,
                            abut_shape2** out) {
    const Strided array(points, stride, count, "points");
    return entry({present(out, "out"), array.fault()}, [&] {
        const auto copied = array.copied<abut::Vec2>();
        return give_built<2>(abut::Chain::build(std::span(copied), closed, {.one_sided = one_sided}), out);
    });
}

abut_code abut_shape2_tile_map(const uint8_t* tiles, uint32_t count, uint32_t columns, abut_vec2 cell,
                               abut_shape2** out) {
    return entry({present(out, "out"), array(tiles, count, "tiles"), finite(cell, "cell")}, [&] {
        static_assert(static_cast<int>(abut::Tile::one_way_high_y) == ABUT_TILE_ONE_WAY_HIGH_Y);
        std::vector<abut::Tile> kinds(count);
        for (uint32_t i = 0; i < count; ++i) kinds[i] = static_cast<abut::Tile>(tiles[i]);
        return give_built<2>(abut::TileMap::build(kinds, columns, same_bytes<abut::Vec2>(cell)), out);
    });
}

abut_code abut_shape3_cylinder(abut_cylinder cylinder, abut_shape3** out) {
    return give_value<3, abut::Cylinder>(cylinder, out, valid_radius(cylinder.radius));
}

abut_code abut_shape3_cone(abut_cone cone, abut_shape3** out) {
    return give_value<3, abut::Cone>(cone, out, valid_radius(cone.radius));
}

abut_code abut_shape3_polyhedron(const abut_vec3* points, uint32_t stride, uint32_t count, uint32_t max_vertices,
                                 abut_shape3** out) {
    return hull<3>(points, stride, count, max_vertices, out);
}

abut_code abut_shape3_voxel_map(const uint8_t* solid, uint32_t nx, uint32_t ny, uint32_t nz, abut_vec3 cell,
                                abut_shape3** out) {
    const double voxels = static_cast<double>(nx) * ny * nz;
    return entry({present(out, "out"), array(solid, voxels > 0 ? 1 : 0, "solid"), finite(cell, "cell")}, [&] {
        if (voxels > 0x1p31) return report(Fault{ABUT_TOO_LARGE, "nx * ny * nz", "is above 2^31"});
        const auto count = static_cast<std::size_t>(voxels);
        std::vector<std::uint64_t> bits((count + 63) / 64);
        for (std::size_t i = 0; i < count; ++i) bits[i / 64] |= std::uint64_t{solid[i] != 0 ? 1u : 0u} << i % 64;
        return give_built<3>(abut::VoxelMap::build(bits, {nx, ny, nz}, same_bytes<abut::Vec3>(cell)), out);
    });
}

abut_code abut_shape3_mesh(const abut_vec3* points, uint32_t stride, uint32_t point_count, const uint32_t* triangles,
                           uint32_t triangle_count, abut_shape3** out) {
    const Strided points_of(points, stride, point_count, "points");
    return entry({present(out, "out"), points_of.fault(), array(triangles, triangle_count, "triangles")}, [&] {
        return give_built<3>(abut::Mesh::build(points_of.copied<abut::Vec3>(), indices<3>(triangles, triangle_count)),
                             out);
    });
}

abut_code abut_shape3_solid(const abut_shape3* mesh, abut_shape3** out) {
    return entry({present(mesh, "mesh"), present(out, "out")}, [&] {
        const auto* surface = std::get_if<abut::Mesh>(&mesh->source);
        if (surface == nullptr) return report(Fault{ABUT_WRONG_SHAPE, "mesh", "is no mesh"});
        return give_shape<3>(abut::solid(abut::Mesh(*surface)), out);
    });
}

abut_code abut_shape3_height_field(const float* heights, uint32_t count, uint32_t columns, abut_vec2 cell,
                                   const uint32_t* holes, uint32_t hole_count, abut_shape3** out) {
    return entry({present(out, "out"), array(heights, count, "heights"), array(holes, hole_count, "holes"),
                  finite(cell, "cell")},
                 [&] {
                     return give_built<3>(
                         abut::HeightField::build(std::span(heights, count), columns, same_bytes<abut::Vec2>(cell),
                                                  {.holes = std::span(holes, hole_count)}),
                         out);
                 });
}

abut_code abut_shape3_triangles(const abut_shape3* shape, uint32_t* out, uint32_t capacity, uint32_t* count) {
    return entry({present(shape, "shape"), present(count, "count"), array(out, capacity, "out")}, [&] {
        uint32_t written = 0;
        const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
            if (written < capacity) {
                uint32_t* triangle = out + 3 * std::size_t{written};
                triangle[0] = a;
                triangle[1] = b;
                triangle[2] = c;
            }
            ++written;
        };
        if (const auto* mesh = std::get_if<abut::Mesh>(&shape->source)) {
            for (const glm::uvec3& triangle : mesh->triangles()) add(triangle.x, triangle.y, triangle.z);
        } else if (const auto* hull = std::get_if<abut::Polyhedron>(&shape->source)) {
            const Facets& facets = hull->facets();
            for (std::size_t face = 0; face < facets.loop_ends.size(); ++face) {
                const auto loop = facets.loop(face);
                for (std::size_t i = 2; i < loop.size(); ++i) add(loop[0], loop[i - 1], loop[i]);
            }
        } else {
            return report(Fault{ABUT_WRONG_SHAPE, "shape", "has no triangles"});
        }
        *count = written;
        return ABUT_OK;
    });
}
