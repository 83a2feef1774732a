#include <abut/bake/combine_fields.hpp>
#include <abut/bake/field_fill.hpp>
#include <abut/bake/field_grid.hpp>
#include <abut/bake/samples_like.hpp>
#include <abut/bake/zero_set.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace abut {
namespace {

enum class Operation : std::uint8_t { least, most, without, blended, grown };

/// What becomes of two distances, and which share the second one's gradient has in that of the result: the sign of the
/// share is the gradient's.
struct Combined {
    float distance = 0, first = 1, second = 0;
};
Combined combined(Operation operation, float a, float b, float size) {
    switch (operation) {
        case Operation::least:
            return a <= b ? Combined{a, 1, 0} : Combined{b, 0, 1};
        case Operation::most:
            return a >= b ? Combined{a, 1, 0} : Combined{b, 0, 1};
        case Operation::without:
            return a >= -b ? Combined{a, 1, 0} : Combined{-b, 0, -1};
        case Operation::blended: {
            const float apart = std::abs(a - b), least = std::min(a, b);
            if (!(apart < size)) return a <= b ? Combined{a, 1, 0} : Combined{b, 0, 1};
            const float share = (size - apart) / size, other = 0.5f * share;
            const float distance = least - 0.25f * share * share * size;
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

    void tell(const SampleBlock<D>& block, const SampleValues<D>& values) const override {
        const std::uint32_t count = block.samples();
        std::array<Vec<D>, most> places;
        for (std::uint32_t i = 0; i < count; ++i) places[i] = to_float(lattice_.at(block.sample(i)));
        const std::span<const Vec<D>> points = std::span(places).first(count);
        if (values.gradient != nullptr) {
            std::array<FieldSample<D>, most> a, b;
            a_.sample(points, std::span(a).first(count));
            if (b_ != nullptr) b_->sample(points, std::span(b).first(count));
            for (std::uint32_t i = 0; i < count; ++i) {
                const Combined here = combined(operation_, a[i].distance, b[i].distance, size_);
                values.distance[i] = here.distance;
                values.gradient[i] = to_float(normalized(DVec<D>(a[i].normal) * static_cast<double>(here.first) +
                                                         DVec<D>(b[i].normal) * static_cast<double>(here.second)));
            }
        } else {
            std::array<float, most> a, b{};
            a_.distance(points, std::span(a).first(count));
            if (b_ != nullptr) b_->distance(points, std::span(b).first(count));
            for (std::uint32_t i = 0; i < count; ++i)
                values.distance[i] = combined(operation_, a[i], b[i], size_).distance;
        }
        if (values.doubtful != nullptr) std::fill_n(values.doubtful, count, std::uint8_t{0});
    }
    double distance(const DVec<D>& point) const override {
        const Vec<D> place = to_float(point);
        const float b = b_ != nullptr ? b_->distance(place) : 0;
        return std::abs(static_cast<double>(combined(operation_, a_.distance(place), b, size_).distance));
    }

private:
    static constexpr std::uint32_t most = most_block_samples<D>;

    const Field<D>& a_;
    const Field<D>* b_;
    Operation operation_;
    float size_;
    SampleLattice<D> lattice_;
};

template <int D>
float doubt_in_cells(const Field<D>& field, const Field<D>* other, float cell, bool shifts) {
    double result = 1;
    for (const Field<D>* one : {&field, other}) {
        if (one == nullptr) continue;
        const double cells = static_cast<double>(one->cell() / cell);
        const bool far = shifts && one->data().store == FieldStore::sparse;
        result = std::max(result, cells * (far ? std::sqrt(static_cast<double>(D)) * 0.5 * brick_cells<D> : 1.0));
    }
    return static_cast<float>(std::ceil(result));
}

template <int D>
Result<Field<D>> fill(const Field<D>& a, const Field<D>* b, Operation operation, float size,
                      const FieldOptions<D>& user, const Aabb<D>& surface, const Aabb<D>& volume) {
    if (user.closest_points)
        return Problem{ProblemCode::bad_argument,
                       "closest points of what fields are combined to: see field_redistance"};
    if (!std::isfinite(size)) return Problem{ProblemCode::bad_argument, "a length that is not finite"};
    FieldOptions<D> options = samples_like(user, b != nullptr && b->cell() < a.cell() ? *b : a, volume);
    FieldWork work(options);
    if (!work.begin(0)) return FieldWork::cancelled();
    Result<FieldData<D>> grid = field_grid(surface, options);
    if (!grid) return grid.problem();
    const bool shifts = operation == Operation::blended || operation == Operation::grown;
    options.band = std::max(options.band + doubt_in_cells(a, b, grid->cell, shifts), 3.0f);
    FieldReport report;
    report.closed = true;
    const CombinedSource<D> source(a, b, operation, size, lattice_of(*grid));
    Result<Field<D>> field = fill_field(*std::move(grid), source, options, work, report);
    if (!field) return field;
    if (options.report != nullptr) *options.report = report;
    // Where the surface is can only be said now. What the volume cuts reaches out of it, and must be seen to.
    if (!contains(field->volume(), surface)) return field;
    FieldData<D> data = field->data();
    data.surface = zero_box(data);
    return Field<D>(std::move(data));
}

}  // namespace

template <int D>
Result<Field<D>> field_union(const Field<D>& a, const Field<D>& b, const FieldOptions<D>& options) {
    return fill(a, &b, Operation::least, 0.0f, options, merged(a.data().surface, b.data().surface),
                merged(a.volume(), b.volume()));
}

template <int D>
Result<Field<D>> field_intersection(const Field<D>& a, const Field<D>& b, const FieldOptions<D>& options) {
    return fill(a, &b, Operation::most, 0.0f, options, merged(a.data().surface, b.data().surface),
                merged(a.volume(), b.volume()));
}

template <int D>
Result<Field<D>> field_difference(const Field<D>& a, const Field<D>& b, const FieldOptions<D>& options) {
    return fill(a, &b, Operation::without, 0.0f, options, merged(a.data().surface, b.data().surface),
                merged(a.volume(), b.volume()));
}

template <int D>
Result<Field<D>> field_smooth_union(const Field<D>& a, const Field<D>& b, float radius,
                                    const FieldOptions<D>& options) {
    if (!(radius >= 0)) return Problem{ProblemCode::bad_argument, "the radius of a blend is below 0"};
    return fill(a, &b, Operation::blended, radius, options,
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
