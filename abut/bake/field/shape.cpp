#include <abut/bake/field.hpp>
#include <abut/bake/field/fill.hpp>
#include <abut/bake/field/grid.hpp>
#include <abut/math/dvec.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/contains.hpp>

#include <cmath>

namespace abut {

using namespace detail;

namespace {

template <int D>
class ShapeSource final : public SampleSource<D> {
public:
    ShapeSource(const AnyShape<D>& shape, const SampleLattice<D>& lattice) : shape_(shape), lattice_(lattice) {}

    void evaluate(const SampleBlock<D>& block, const SampleValues<D>& values) const override {
        for (std::uint32_t i = 0; i < block.samples(); ++i) {
            const Vec<D> point = to_float(lattice_.at(block.sample(i)));
            const Closest<D> found = closest(shape_, point);
            // A composite of parts without thickness reports positive distances inside; `contains` decides the sign.
            const bool turns = found.distance > 0 && contains(shape_, point);
            values.distance[i] = turns ? -found.distance : found.distance;
            if (values.gradient != nullptr) values.gradient[i] = turns ? -found.normal : found.normal;
            if (values.closest != nullptr) values.closest[i] = found.on_a;
        }
    }
    double distance(const DVec<D>& point) const override {
        return std::abs(static_cast<double>(closest(shape_, to_float(point)).distance));
    }

private:
    const AnyShape<D>& shape_;
    SampleLattice<D> lattice_;
};

}  // namespace

template <int D>
Result<Field<D>> bake_field(const AnyShape<D>& shape, const FieldOptions<D>& options) {
    BakeJob work(options);
    if (!work.begin(0)) return BakeJob::cancelled();
    const Aabb<D> box = bounds(shape);
    for (int i = 0; i < D; ++i) {
        if (box.min[i] > box.max[i]) return Problem{ProblemCode::empty_input, "the shape is empty", 0};
        if (!std::isfinite(box.min[i]) || !std::isfinite(box.max[i]))
            return Problem{ProblemCode::bad_argument, "the shape's box is not finite", 0};
    }
    Result<FieldData<D>> grid = field_grid(box, options);
    if (!grid) return grid.problem();
    FieldReport report;
    report.closed = true;
    const ShapeSource<D> source(shape, lattice_of(*grid));
    Result<Field<D>> field = fill_field(*std::move(grid), source, options, work, report);
    if (field && options.report != nullptr) *options.report = report;
    return field;
}

template Result<Field<2>> bake_field(const AnyShape<2>&, const FieldOptions<2>&);
template Result<Field<3>> bake_field(const AnyShape<3>&, const FieldOptions<3>&);

}  // namespace abut
