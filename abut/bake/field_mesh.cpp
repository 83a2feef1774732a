#include <abut/bake/field.hpp>
#include <abut/bake/field_fill.hpp>
#include <abut/bake/field_grid.hpp>
#include <abut/bake/field_kept.hpp>
#include <abut/bake/field_mesh_source.hpp>

#include <utility>

namespace abut {
namespace {

FieldReport report_of(const FieldSurface& surface) {
    FieldReport result;
    result.closed = surface.gaps == 0;
    result.gaps = surface.gaps;
    result.rewound = surface.rewound;
    return result;
}

Result<Field<3>> filled(FieldData<3> grid, const SampleSource<3>& source, const FieldOptions<3>& options,
                        FieldWork& work, FieldReport report) {
    Result<Field<3>> field = fill_field(std::move(grid), source, options, work, report);
    if (field && options.report != nullptr) *options.report = report;
    return field;
}

}  // namespace

Result<Field<3>> bake_field(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                            const FieldOptions<3>& options) {
    FieldWork work(options);
    if (!work.begin(0.1)) return FieldWork::cancelled();
    const Result<FieldSurface> surface = field_surface(points, triangles);
    if (!surface) return surface.problem();
    Result<FieldData<3>> grid = field_grid(surface->box, options);
    if (!grid) return grid.problem();
    const auto source = mesh_source(*surface, *grid);
    return filled(*std::move(grid), *source, options, work, report_of(*surface));
}

Result<Field<3>> bake_field(const Mesh& mesh, const FieldOptions<3>& options) {
    return bake_field(mesh.points(), mesh.triangles(), options);
}

Result<Field<3>> rebake_field(const Field<3>& field, const Aabb3& changed, std::span<const Vec3> points,
                              std::span<const glm::uvec3> triangles, const FieldOptions<3>& options) {
    const FieldData<3>& before = field.data();
    if (options.store != before.store || options.lookup != before.lookup ||
        options.closest_points == before.closest.empty() || options.quantised == before.steps.empty() ||
        (options.cell != 0 && options.cell != before.cell) || !(options.band >= 1))
        return Problem{ProblemCode::bad_argument, "the field wasn't baked with these options", 0};
    FieldWork work(options);
    if (!work.begin(0.1)) return FieldWork::cancelled();
    const Result<FieldSurface> surface = field_surface(points, triangles);
    if (!surface) return surface.problem();
    FieldData<3> grid;
    grid.origin = before.origin;
    grid.cell = before.cell;
    grid.cells = before.cells;
    grid.store = before.store;
    grid.lookup = before.lookup;
    grid.surface = surface->box;
    const auto source = mesh_source(*surface, grid);
    // What isn't closed is felt everywhere, and what was rounded isn't as it was told.
    if (surface->gaps > 0 || !before.steps.empty())
        return filled(std::move(grid), *source, options, work, report_of(*surface));
    const KeptSource<3> kept(*source, before, changed);
    return filled(std::move(grid), kept, options, work, report_of(*surface));
}

Result<Field<3>> rebake_field(const Field<3>& field, const Aabb3& changed, const Mesh& mesh,
                              const FieldOptions<3>& options) {
    return rebake_field(field, changed, mesh.points(), mesh.triangles(), options);
}

}  // namespace abut
