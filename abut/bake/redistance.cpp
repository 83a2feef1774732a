#include <abut/bake/combine_fields.hpp>
#include <abut/bake/field_fill.hpp>
#include <abut/bake/field_grid.hpp>
#include <abut/bake/field_nearest.hpp>
#include <abut/bake/field_pieces.hpp>
#include <abut/bake/samples_like.hpp>
#include <abut/bake/zero_set.hpp>
#include <abut/convex/features.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
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

/// Without a length or an area.
template <int D>
bool is_flat(const Piece<D>& piece) {
    if constexpr (D == 2) {
        return piece[0] == piece[1];
    } else {
        const DVec<3> from(piece[0]);
        return length_squared(cross(DVec<3>(piece[1]) - from, DVec<3>(piece[2]) - from)) == 0;
    }
}

/// The distances from pieces of a surface, with the signs of a field.
template <int D>
class PieceSource final : public SampleSource<D> {
public:
    PieceSource(const std::vector<Piece<D>>& pieces, const Field<D>& signs, const SampleLattice<D>& lattice)
        : pieces_(pieces), signs_(signs), lattice_(lattice), tree_(build_piece_tree<D>(pieces)) {}

    void tell(const SampleBlock<D>& block, const SampleValues<D>& values) const override {
        const std::uint32_t count = block.samples();
        std::array<NearestPiece, most_block_samples<D>> nearest;
        std::array<Vec<D>, most_block_samples<D>> places;
        std::array<FieldSample<D>, most_block_samples<D>> signs;
        nearest_pieces(tree_, lattice_, block, nearest.data());
        for (std::uint32_t i = 0; i < count; ++i) places[i] = to_float(lattice_.at(block.sample(i)));
        signs_.sample(std::span<const Vec<D>>(places).first(count), std::span(signs).first(count));
        for (std::uint32_t i = 0; i < count; ++i) {
            const double sign = signs[i].distance <= 0 ? -1 : 1;
            values.distance[i] = static_cast<float>(sign * std::sqrt(nearest[i].squared));
            if (values.gradient != nullptr || values.closest != nullptr) {
                const DVec<D> point = lattice_.at(block.sample(i));
                const DVec<D> on = closest_on(pieces_[nearest[i].piece], point).point;
                if (values.gradient != nullptr)
                    values.gradient[i] = to_float(normalized(sign * (point - on), DVec<D>(signs[i].normal)));
                if (values.closest != nullptr) values.closest[i] = to_float(on);
            }
            if (values.doubtful != nullptr) values.doubtful[i] = 0;
        }
    }
    double distance(const DVec<D>& point) const override { return std::sqrt(nearest_piece(tree_, point).squared); }

private:
    const std::vector<Piece<D>>& pieces_;
    const Field<D>& signs_;
    SampleLattice<D> lattice_;
    PieceTree<D> tree_;
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
    std::vector<Piece<D>> pieces = zero_set(old);
    // Where samples are exactly 0 there are pieces without extent; their neighbours cover them.
    std::erase_if(pieces, is_flat<D>);
    if (pieces.empty()) return Problem{ProblemCode::empty_input, "the field has no surface in its volume"};
    const PieceSource<D> source(pieces, field, lattice_of(*grid));
    FieldReport report;
    report.closed = true;
    Result<Field<D>> result = fill_field(*std::move(grid), source, options, work, report);
    if (result && options.report != nullptr) *options.report = report;
    return result;
}

template Result<Field<2>> field_redistance(const Field<2>&, const FieldOptions<2>&);
template Result<Field<3>> field_redistance(const Field<3>&, const FieldOptions<3>&);

}  // namespace abut
