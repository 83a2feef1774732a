#include <abut/bake/combine_fields.hpp>
#include <abut/bake/field_fill.hpp>
#include <abut/bake/field_grid.hpp>
#include <abut/bake/samples_like.hpp>
#include <abut/bake/zero_set.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/convex/features.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace abut {
namespace {

template <int D>
using Piece = std::array<Vec<D>, D>;

ClosestFeature<2> closest_on(const Piece<2>& piece, const DVec<2>& point) {
    return closest_on_segment<2>(DVec<2>(piece[0]), DVec<2>(piece[1]), point);
}
ClosestFeature<3> closest_on(const Piece<3>& piece, const DVec<3>& point) {
    return closest_on_triangle(DVec<3>(piece[0]), DVec<3>(piece[1]), DVec<3>(piece[2]), point);
}

/// The distances from pieces of a surface, with the signs of a field.
template <int D>
class PieceSource final : public SampleSource<D> {
public:
    PieceSource(const std::vector<Piece<D>>& pieces, const Field<D>& signs, const SampleLattice<D>& lattice,
                Executor* executor)
        : pieces_(pieces), signs_(signs), lattice_(lattice) {
        std::vector<Aabb<D>> boxes;
        boxes.reserve(pieces.size());
        for (const Piece<D>& piece : pieces) {
            Aabb<D> box = Aabb<D>::empty();
            for (const Vec<D>& corner : piece) box = merged(box, {corner, corner});
            boxes.push_back(box);
        }
        tree_.build(boxes, executor);
    }

    void tell(const SampleBlock<D>& block, const SampleValues<D>& values) const override {
        std::uint32_t piece = 0;
        for (std::uint32_t i = 0; i < block.samples(); ++i) {
            const DVec<D> point = lattice_.at(block.sample(i));
            const ClosestFeature<D> found = nearest(point, piece);
            const FieldSample<D> here = signs_.sample(to_float(point));
            const double sign = here.distance <= 0 ? -1 : 1;
            values.distance[i] = static_cast<float>(sign * found.distance);
            if (values.gradient != nullptr) {
                const DVec<D> way = sign * (point - found.point);
                values.gradient[i] = to_float(normalized(way, DVec<D>(here.normal)));
            }
            if (values.closest != nullptr) values.closest[i] = to_float(found.point);
            if (values.doubtful != nullptr) values.doubtful[i] = 0;
        }
    }
    double distance(const DVec<D>& point) const override {
        std::uint32_t piece = 0;
        return nearest(point, piece).distance;
    }

private:
    /// Of those that are equally far the first. `piece` is one that may be near, then the nearest.
    ClosestFeature<D> nearest(const DVec<D>& point, std::uint32_t& piece) const {
        ClosestFeature<D> result = closest_on(pieces_[piece], point);
        const auto visit = [&](std::uint32_t item) {
            const ClosestFeature<D> found = closest_on(pieces_[item], point);
            if (found.distance < result.distance || (found.distance == result.distance && item < piece)) {
                result = found;
                piece = item;
            }
            return widened(result.distance);
        };
        tree_.closest(to_float(point), visit, widened(result.distance));
        return result;
    }
    /// The point and the boxes are rounded to float: a little farther than what is looked for.
    float widened(double reach) const { return static_cast<float>(reach * (1 + 1e-6) + 1e-6 * lattice_.cell + doubt_); }

    const std::vector<Piece<D>>& pieces_;
    const Field<D>& signs_;
    SampleLattice<D> lattice_;
    Bvh<D> tree_;
    double doubt_ = 1e-6 * (largest(lattice_.origin) + 64 * lattice_.cell);
};

}  // namespace

template <int D>
Result<Field<D>> field_redistance(const Field<D>& field, const FieldOptions<D>& user) {
    const FieldData<D>& old = field.data();
    const FieldOptions<D> options = samples_like(user, field, field.volume());
    FieldWork work(options);
    if (!work.begin(0.02)) return FieldWork::cancelled();
    Result<FieldData<D>> grid = field_grid(old.surface, options);
    if (!grid) return grid.problem();
    const std::vector<Piece<D>> pieces = zero_set(old);
    if (pieces.empty()) return Problem{ProblemCode::empty_input, "the field has no surface in its volume"};
    const PieceSource<D> source(pieces, field, lattice_of(*grid), options.executor);
    FieldReport report;
    report.closed = true;
    Result<Field<D>> result = fill_field(*std::move(grid), source, options, work, report);
    if (result && options.report != nullptr) *options.report = report;
    return result;
}

template Result<Field<2>> field_redistance(const Field<2>&, const FieldOptions<2>&);
template Result<Field<3>> field_redistance(const Field<3>&, const FieldOptions<3>&);

}  // namespace abut
