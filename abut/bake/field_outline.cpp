#include <abut/bake/field.hpp>
#include <abut/bake/field_fill.hpp>
#include <abut/bake/field_grid.hpp>
#include <abut/bake/field_nearest.hpp>
#include <abut/bake/field_pieces.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace abut {
namespace {

/// The segments of an outline and its holes.
struct Sides {
    std::vector<PieceCorners<2>> corners;
    std::vector<std::uint32_t> ring;  ///< of each: 0, the outline, or a hole
};

/// Where the rows of a lattice go through the sides. A row through a corner is taken as if it ran a little above.
class RowCrossings {
public:
    RowCrossings(const Sides& sides, const SampleLattice<2>& lattice, const glm::uvec2& samples)
        : first_(std::size_t{samples.y} + 1, 0) {
        struct Found {
            std::uint32_t row;
            Crossing crossing;
        };
        std::vector<Found> found;
        for (std::size_t i = 0; i < sides.corners.size(); ++i) {
            const DVec<2> a(sides.corners[i][0]), b(sides.corners[i][1]);
            if (a.y == b.y) continue;
            const DVec<2>&low = a.y < b.y ? a : b, &high = a.y < b.y ? b : a;
            const std::uint32_t end = first_behind(lattice, 1, high.y, samples.y);
            for (std::uint32_t row = first_behind(lattice, 1, low.y, samples.y); row < end; ++row) {
                const double share = (lattice.along(1, row) - low.y) / (high.y - low.y);
                const double place = low.x + share * (high.x - low.x);
                const std::uint32_t sample = first_behind(lattice, 0, place, samples.x);
                if (sample == samples.x) continue;
                found.push_back({row, {sides.ring[i], sample, a.y < b.y ? 1 : -1}});
                ++first_[std::size_t{row} + 1];
            }
        }
        std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
            return std::tie(a.row, a.crossing.ring, a.crossing.sample, a.crossing.change) <
                   std::tie(b.row, b.crossing.ring, b.crossing.sample, b.crossing.change);
        });
        for (std::size_t row = 1; row < first_.size(); ++row) first_[row] += first_[row - 1];
        crossings_.reserve(found.size());
        for (const Found& one : found) crossings_.push_back(one.crossing);
    }

    /// Of `count` samples `stride` apart along a row: whether they are in the outline and in no hole.
    void tell(const glm::uvec2& first, std::uint32_t count, std::uint32_t stride, bool* inside) const {
        std::fill(inside, inside + count, false);
        const std::size_t end = first_[std::size_t{first.y} + 1];
        for (std::size_t next = first_[first.y]; next < end;) {
            const std::uint32_t ring = crossings_[next].ring;
            std::int32_t winding = 0;
            for (std::uint32_t i = 0; i < count; ++i) {
                const std::uint32_t sample = first.x + i * stride;
                for (; next < end && crossings_[next].ring == ring && crossings_[next].sample <= sample; ++next)
                    winding += crossings_[next].change;
                if (winding != 0) inside[i] = ring == 0;
            }
            while (next < end && crossings_[next].ring == ring) ++next;
        }
    }

private:
    /// Of a row: the ring, the first sample that lies behind the crossing or on it, and what the ring's winding number
    /// is more from there on.
    struct Crossing {
        std::uint32_t ring, sample;
        std::int32_t change;
    };

    std::vector<std::size_t> first_;  // of each row among the crossings, and the end
    std::vector<Crossing> crossings_;
};

class OutlineSource final : public SampleSource<2> {
public:
    OutlineSource(const Sides& sides, const FieldData<2>& grid)
        : sides_(sides),
          tree_(build_piece_tree<2>(sides.corners)),
          crossings_(sides, lattice_of(grid), samples_along(grid)),
          lattice_(lattice_of(grid)) {}

    void tell(const SampleBlock<2>& block, const SampleValues<2>& values) const override {
        std::array<NearestPiece, most_block_samples<2>> nearest;
        std::array<bool, most_block_samples<2>> inside;
        nearest_pieces(tree_, lattice_, block, nearest.data());
        for (std::uint32_t i = 0; i < block.samples(); i += block.count.x)
            crossings_.tell(block.sample(i), block.count.x, block.stride, &inside[i]);
        for (std::uint32_t i = 0; i < block.samples(); ++i) {
            const double distance = std::sqrt(nearest[i].squared);
            values.distance[i] = static_cast<float>(inside[i] ? -distance : distance);
            if (values.gradient == nullptr && values.closest == nullptr) continue;
            const DVec<2> point = lattice_.at(block.sample(i)), way = way_to(point, nearest[i].piece);
            if (values.closest != nullptr) values.closest[i] = to_float(point + way);
            if (values.gradient != nullptr)
                values.gradient[i] = to_float(distance > 0x1p-40 * tree_.spread ? normalized(inside[i] ? way : -way)
                                                                                : normal_of(nearest[i].piece));
        }
    }
    double distance(const DVec<2>& point) const override { return std::sqrt(nearest_piece(tree_, point).squared); }

private:
    DVec<2> way_to(const DVec<2>& point, std::uint32_t piece) const {
        const DVec<2> from = DVec<2>(sides_.corners[piece][0]) - point;
        const DVec<2> along = DVec<2>(sides_.corners[piece][1]) - point - from;
        return from + along * std::clamp(-dot(from, along) / dot(along, along), 0.0, 1.0);
    }
    /// Of a side on which a sample lies; to the right, where the outline runs counter-clockwise.
    DVec<2> normal_of(std::uint32_t piece) const {
        return -perpendicular(DVec<2>(sides_.corners[piece][1]) - DVec<2>(sides_.corners[piece][0]));
    }

    const Sides& sides_;
    PieceTree<2> tree_;
    RowCrossings crossings_;
    SampleLattice<2> lattice_;
};

}  // namespace

Result<Field<2>> bake_field(std::span<const Vec2> outline, std::span<const std::vector<Vec2>> holes,
                            const FieldOptions<2>& options) {
    FieldWork work(options);
    if (!work.begin(0.1)) return FieldWork::cancelled();
    Sides sides;
    Aabb2 box = Aabb2::empty();
    for (std::size_t ring = 0; ring <= holes.size(); ++ring) {
        const std::span<const Vec2> points = ring == 0 ? outline : std::span<const Vec2>(holes[ring - 1]);
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!is_finite(points[i]))
                return Problem{ProblemCode::not_finite, "a point of the outline is not finite", i};
            const Vec2& next = points[i + 1 < points.size() ? i + 1 : 0];
            if (points[i] == next) continue;
            sides.corners.push_back({points[i], next});
            sides.ring.push_back(static_cast<std::uint32_t>(ring));
            box = merged(box, Aabb2{points[i], points[i]});
        }
    }
    if (sides.corners.empty()) return Problem{ProblemCode::empty_input, "the outline has no two points", 0};
    Result<FieldData<2>> grid = field_grid(box, options);
    if (!grid) return grid.problem();
    FieldReport report;
    report.closed = true;
    const OutlineSource source(sides, *grid);
    Result<Field<2>> field = fill_field(*std::move(grid), source, options, work, report);
    if (field && options.report != nullptr) *options.report = report;
    return field;
}

}  // namespace abut
