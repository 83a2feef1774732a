#include <abut/bake/combine_fields.hpp>
#include <abut/bake/field/fill.hpp>
#include <abut/bake/field/grid.hpp>
#include <abut/bake/field/isosurface.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace abut {

using namespace detail;

namespace {

enum class Operation : std::uint8_t { union_of, max_samples, difference, smooth_union, grown };

/// The result of combining two distances, and the weights of their gradients in the gradient of the result.
struct Combined {
    float distance = 0, first = 1, second = 0;
};
Combined combined(Operation operation, float a, float b, float size) {
    switch (operation) {
        case Operation::union_of:
            return a <= b ? Combined{a, 1, 0} : Combined{b, 0, 1};
        case Operation::max_samples:
            return a >= b ? Combined{a, 1, 0} : Combined{b, 0, 1};
        case Operation::difference:
            return a >= -b ? Combined{a, 1, 0} : Combined{-b, 0, -1};
        case Operation::smooth_union: {
            const float apart = std::abs(a - b), union_of = std::min(a, b);
            if (!(apart < size)) return a <= b ? Combined{a, 1, 0} : Combined{b, 0, 1};
            const float weight = (size - apart) / size, other = 0.5f * weight;
            const float distance = union_of - 0.25f * weight * weight * size;
            return a <= b ? Combined{distance, 1 - other, other} : Combined{distance, other, 1 - other};
        }
        case Operation::grown:
            break;
    }
    return {a - size, 1, 0};
}

template <int D>
class CombinedSource final : public SampleSource<D> {
public:
    CombinedSource(const Field<D>& a, const Field<D>* b, Operation operation, float size,
                   const SampleLattice<D>& lattice)
        : a_(a), b_(b), operation_(operation), size_(size), lattice_(lattice) {}

    void evaluate(const SampleBlock<D>& block, const SampleValues<D>& values) const override {
        const std::uint32_t count = block.samples();
        std::array<Vec<D>, max_samples> places;
        for (std::uint32_t i = 0; i < count; ++i) places[i] = to_float(lattice_.at(block.sample(i)));
        const std::span<const Vec<D>> points = std::span(places).first(count);
        if (values.gradient != nullptr) {
            std::array<FieldSample<D>, max_samples> a, b;
            a_.sample(points, std::span(a).first(count));
            if (b_ != nullptr) b_->sample(points, std::span(b).first(count));
            for (std::uint32_t i = 0; i < count; ++i) {
                const Combined here = combined(operation_, a[i].distance, b[i].distance, size_);
                values.distance[i] = here.distance;
                values.gradient[i] = to_float(normalized(DVec<D>(a[i].normal) * static_cast<double>(here.first) +
                                                         DVec<D>(b[i].normal) * static_cast<double>(here.second)));
            }
        } else {
            std::array<float, max_samples> a, b{};
            a_.distance(points, std::span(a).first(count));
            if (b_ != nullptr) b_->distance(points, std::span(b).first(count));
            for (std::uint32_t i = 0; i < count; ++i)
                values.distance[i] = combined(operation_, a[i], b[i], size_).distance;
        }
        if (values.uncertain != nullptr) std::fill_n(values.uncertain, count, std::uint8_t{0});
    }
    double distance(const DVec<D>& point) const override {
        const Vec<D> place = to_float(point);
        const float b = b_ != nullptr ? b_->distance(place) : 0;
        return std::abs(static_cast<double>(combined(operation_, a_.distance(place), b, size_).distance));
    }

private:
    static constexpr std::uint32_t max_samples = max_block_samples<D>;

    const Field<D>& a_;
    const Field<D>* b_;
    Operation operation_;
    float size_;
    SampleLattice<D> lattice_;
};

template <int D>
float extra_band_in_cells(const Field<D>& field, const Field<D>* other, float cell, bool shifts) {
    double result = 1;
    for (const Field<D>* one : {&field, other}) {
        if (one == nullptr) continue;
        const double cells = static_cast<double>(one->cell() / cell);
        const bool far = shifts && one->data().store == FieldStore::sparse;
        result = std::max(result, cells * (far ? square_root(static_cast<double>(D)) * 0.5 * brick_cells<D> : 1.0));
    }
    return static_cast<float>(std::ceil(result));
}

template <int D>
Result<Field<D>> fill(const Field<D>& a, const Field<D>* b, Operation operation, float size,
                      const FieldOptions<D>& requested, const Aabb<D>& surface, const Aabb<D>& volume) {
    if (requested.closest_points)
        return Problem{ProblemCode::bad_argument, "combined fields have no closest points: see field_redistance"};
    if (!std::isfinite(size)) return Problem{ProblemCode::bad_argument, "the length is not finite"};
    FieldOptions<D> options = aligned_options(requested, b != nullptr && b->cell() < a.cell() ? *b : a, volume);
    BakeJob work(options);
    if (!work.begin(0)) return BakeJob::cancelled();
    Result<FieldData<D>> grid = field_grid(surface, options);
    if (!grid) return grid.problem();
    const bool shifts = operation == Operation::smooth_union || operation == Operation::grown;
    options.band = std::max(options.band + extra_band_in_cells(a, b, grid->cell, shifts), 3.0f);
    FieldReport report;
    report.closed = true;
    const CombinedSource<D> source(a, b, operation, size, lattice_of(*grid));
    Result<Field<D>> field = fill_field(*std::move(grid), source, options, work, report);
    if (!field) return field;
    if (options.report != nullptr) *options.report = report;
    // The surface's bounds are known only now. A surface cut by the volume extends beyond it and must not be bounded by
    // its samples.
    if (!contains(field->volume(), surface)) return field;
    FieldData<D> data = field->data();
    data.surface = isosurface_bounds(data);
    return Field<D>(std::move(data));
}

}  // namespace

template <int D>
Result<Field<D>> field_union(const Field<D>& a, const Field<D>& b, const FieldOptions<D>& options) {
    return fill(a, &b, Operation::union_of, 0.0f, options, merged(a.data().surface, b.data().surface),
                merged(a.volume(), b.volume()));
}

template <int D>
Result<Field<D>> field_intersection(const Field<D>& a, const Field<D>& b, const FieldOptions<D>& options) {
    return fill(a, &b, Operation::max_samples, 0.0f, options, merged(a.data().surface, b.data().surface),
                merged(a.volume(), b.volume()));
}

template <int D>
Result<Field<D>> field_difference(const Field<D>& a, const Field<D>& b, const FieldOptions<D>& options) {
    return fill(a, &b, Operation::difference, 0.0f, options, merged(a.data().surface, b.data().surface),
                merged(a.volume(), b.volume()));
}

template <int D>
Result<Field<D>> field_smooth_union(const Field<D>& a, const Field<D>& b, float radius,
                                    const FieldOptions<D>& options) {
    if (!(radius >= 0)) return Problem{ProblemCode::bad_argument, "the radius of a blend is below 0"};
    return fill(a, &b, Operation::smooth_union, radius, options,
                grown(merged(a.data().surface, b.data().surface), 0.25f * radius), merged(a.volume(), b.volume()));
}

template <int D>
Result<Field<D>> field_offset(const Field<D>& field, float distance, const FieldOptions<D>& options) {
    const float more = std::max(distance, 0.0f);
    return fill<D>(field, nullptr, Operation::grown, distance, options, grown(field.data().surface, more),
                   distance > 0 ? grown(field.volume(), distance) : field.volume());
}

template Result<Field<2>> field_union(const Field<2>&, const Field<2>&, const FieldOptions<2>&);
template Result<Field<3>> field_union(const Field<3>&, const Field<3>&, const FieldOptions<3>&);
template Result<Field<2>> field_intersection(const Field<2>&, const Field<2>&, const FieldOptions<2>&);
template Result<Field<3>> field_intersection(const Field<3>&, const Field<3>&, const FieldOptions<3>&);
template Result<Field<2>> field_difference(const Field<2>&, const Field<2>&, const FieldOptions<2>&);
template Result<Field<3>> field_difference(const Field<3>&, const Field<3>&, const FieldOptions<3>&);
template Result<Field<2>> field_smooth_union(const Field<2>&, const Field<2>&, float, const FieldOptions<2>&);
template Result<Field<3>> field_smooth_union(const Field<3>&, const Field<3>&, float, const FieldOptions<3>&);
template Result<Field<2>> field_offset(const Field<2>&, float, const FieldOptions<2>&);
template Result<Field<3>> field_offset(const Field<3>&, float, const FieldOptions<3>&);

}  // namespace abut
