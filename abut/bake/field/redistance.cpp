#include <abut/bake/combine_fields.hpp>
#include <abut/bake/field/fill.hpp>
#include <abut/bake/field/grid.hpp>
#include <abut/bake/field/isosurface.hpp>
#include <abut/bake/field/nearest_primitive.hpp>
#include <abut/bake/field/primitive_bvh.hpp>
#include <abut/convex/features.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace abut {

using namespace detail;

namespace {

template <int D>
using Primitive = std::array<Vec<D>, D>;

ClosestFeature<2> closest_on(const Primitive<2>& primitive, const DVec<2>& point) {
    return closest_on_segment<2>(DVec<2>(primitive[0]), DVec<2>(primitive[1]), point);
}
ClosestFeature<3> closest_on(const Primitive<3>& primitive, const DVec<3>& point) {
    return closest_on_triangle(DVec<3>(primitive[0]), DVec<3>(primitive[1]), DVec<3>(primitive[2]), point);
}

/// True for a segment without length or a triangle without area.
template <int D>
bool is_flat(const Primitive<D>& primitive) {
    if constexpr (D == 2) {
        return primitive[0] == primitive[1];
    } else {
        const DVec<3> from(primitive[0]);
        return length_squared(cross(DVec<3>(primitive[1]) - from, DVec<3>(primitive[2]) - from)) == 0;
    }
}

/// Distances from the primitives of a surface, with the signs of a field.
template <int D>
class PrimitiveSource final : public SampleSource<D> {
public:
    PrimitiveSource(const std::vector<Primitive<D>>& primitives, const Field<D>& signs, const SampleLattice<D>& lattice)
        : primitives_(primitives), signs_(signs), lattice_(lattice), bvh_(build_primitive_bvh<D>(primitives)) {}

    void evaluate(const SampleBlock<D>& block, const SampleValues<D>& values) const override {
        const std::uint32_t count = block.samples();
        std::array<NearestPrimitive, max_block_samples<D>> nearest;
        std::array<Vec<D>, max_block_samples<D>> places;
        std::array<FieldSample<D>, max_block_samples<D>> signs;
        nearest_primitives(bvh_, lattice_, block, nearest.data());
        for (std::uint32_t i = 0; i < count; ++i) places[i] = to_float(lattice_.at(block.sample(i)));
        signs_.sample(std::span<const Vec<D>>(places).first(count), std::span(signs).first(count));
        for (std::uint32_t i = 0; i < count; ++i) {
            const double sign = signs[i].distance <= 0 ? -1 : 1;
            values.distance[i] = static_cast<float>(sign * square_root(nearest[i].squared));
            if (values.gradient != nullptr || values.closest != nullptr) {
                const DVec<D> point = lattice_.at(block.sample(i));
                const DVec<D> on = closest_on(primitives_[nearest[i].primitive], point).point;
                if (values.gradient != nullptr)
                    values.gradient[i] = to_float(normalized(sign * (point - on), DVec<D>(signs[i].normal)));
                if (values.closest != nullptr) values.closest[i] = to_float(on);
            }
            if (values.uncertain != nullptr) values.uncertain[i] = 0;
        }
    }
    double distance(const DVec<D>& point) const override { return square_root(nearest_primitive(bvh_, point).squared); }

private:
    const std::vector<Primitive<D>>& primitives_;
    const Field<D>& signs_;
    SampleLattice<D> lattice_;
    PrimitiveBvh<D> bvh_;
};

}  // namespace

template <int D>
Result<Field<D>> field_redistance(const Field<D>& field, const FieldOptions<D>& requested) {
    const FieldData<D>& old = field.data();
    const FieldOptions<D> options = aligned_options(requested, field, field.volume());
    BakeJob work(options);
    if (!work.begin(0.02)) return BakeJob::cancelled();
    Result<FieldData<D>> grid = field_grid(old.surface, options);
    if (!grid) return grid.problem();
    std::vector<Primitive<D>> primitives = isosurface(old);
    // Samples of value 0 give degenerate primitives, which their neighbours cover.
    std::erase_if(primitives, is_flat<D>);
    if (primitives.empty()) return Problem{ProblemCode::empty_input, "the field has no surface in its volume"};
    const PrimitiveSource<D> source(primitives, field, lattice_of(*grid));
    FieldReport report;
    report.closed = true;
    Result<Field<D>> result = fill_field(*std::move(grid), source, options, work, report);
    if (result && options.report != nullptr) *options.report = report;
    return result;
}

template Result<Field<2>> field_redistance(const Field<2>&, const FieldOptions<2>&);
template Result<Field<3>> field_redistance(const Field<3>&, const FieldOptions<3>&);

}  // namespace abut
