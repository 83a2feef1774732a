#include <abut/bake/field.hpp>
#include <abut/bake/field/fill.hpp>
#include <abut/bake/field/grid.hpp>
#include <abut/bake/field/nearest_primitive.hpp>
#include <abut/bake/field/primitive_bvh.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace abut {

using namespace detail;

namespace {

/// The segments of an outline and its holes.
struct Sides {
    std::vector<PrimitiveCorners<2>> corners;
    std::vector<std::uint32_t> ring;  ///< one per segment: 0 for the outline, else a hole
};

/// The crossings of the lattice's rows with the segments. A row through a corner is treated as if it ran slightly
/// above.
class RowCrossings {
public:
    RowCrossings(const Sides& sides, const SampleLattice<2>& lattice, const glm::uvec2& samples)
        : first_(std::size_t{samples.y} + 1, 0) {
        struct RowCrossing {
            std::uint32_t row;
            Crossing crossing;
        };
        std::vector<RowCrossing> found;
        for (std::size_t i = 0; i < sides.corners.size(); ++i) {
            const DVec<2> a(sides.corners[i][0]), b(sides.corners[i][1]);
            if (a.y == b.y) continue;
            const DVec<2>&low = a.y < b.y ? a : b, &high = a.y < b.y ? b : a;
            const std::uint32_t end = first_at_or_after(lattice, 1, high.y, samples.y);
            for (std::uint32_t row = first_at_or_after(lattice, 1, low.y, samples.y); row < end; ++row) {
                const double fraction = (lattice.along(1, row) - low.y) / (high.y - low.y);
                const double place = low.x + fraction * (high.x - low.x);
                const std::uint32_t sample = first_at_or_after(lattice, 0, place, samples.x);
                if (sample == samples.x) continue;
                found.push_back({row, {sides.ring[i], sample, a.y < b.y ? 1 : -1}});
                ++first_[std::size_t{row} + 1];
            }
        }
        std::sort(found.begin(), found.end(), [](const RowCrossing& a, const RowCrossing& b) {
            return std::tie(a.row, a.crossing.ring, a.crossing.sample, a.crossing.change) <
                   std::tie(b.row, b.crossing.ring, b.crossing.sample, b.crossing.change);
        });
        for (std::size_t row = 1; row < first_.size(); ++row) first_[row] += first_[row - 1];
        crossings_.reserve(found.size());
        for (const RowCrossing& one : found) crossings_.push_back(one.crossing);
    }

    /// Decides for `count` samples, `stride` apart along a row, whether they are in the outline and in no hole.
    void evaluate(const glm::uvec2& first, std::uint32_t count, std::uint32_t stride, bool* inside) const {
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
    /// A crossing of a row: the ring, the first sample at or behind it, and the change of the ring's winding number.
    struct Crossing {
        std::uint32_t ring, sample;
        std::int32_t change;
    };

    std::vector<std::size_t> first_;  // one per row, and the end: its first crossing
    std::vector<Crossing> crossings_;
};

class OutlineSource final : public SampleSource<2> {
public:
    OutlineSource(const Sides& sides, const FieldData<2>& grid)
        : sides_(sides),
          tree_(build_primitive_bvh<2>(sides.corners)),
          crossings_(sides, lattice_of(grid), samples_along(grid)),
          lattice_(lattice_of(grid)) {}

    void evaluate(const SampleBlock<2>& block, const SampleValues<2>& values) const override {
        std::array<NearestPrimitive, max_block_samples<2>> nearest;
        std::array<bool, max_block_samples<2>> inside;
        nearest_primitives(tree_, lattice_, block, nearest.data());
        for (std::uint32_t i = 0; i < block.samples(); i += block.count.x)
            crossings_.evaluate(block.sample(i), block.count.x, block.stride, &inside[i]);
        for (std::uint32_t i = 0; i < block.samples(); ++i) {
            const double distance = square_root(nearest[i].squared);
            values.distance[i] = static_cast<float>(inside[i] ? -distance : distance);
            if (values.gradient == nullptr && values.closest == nullptr) continue;
            const DVec<2> point = lattice_.at(block.sample(i)), offset = closest_offset(point, nearest[i].primitive);
            if (values.closest != nullptr) values.closest[i] = to_float(point + offset);
            if (values.gradient != nullptr)
                values.gradient[i] =
                    to_float(distance > 0x1p-40 * tree_.diameter_bound ? normalized(inside[i] ? offset : -offset)
                                                                       : normal_of(nearest[i].primitive));
        }
    }
    double distance(const DVec<2>& point) const override {
        return square_root(nearest_primitive(tree_, point).squared);
    }

private:
    DVec<2> closest_offset(const DVec<2>& point, std::uint32_t side) const {
        const DVec<2> from = DVec<2>(sides_.corners[side][0]) - point;
        const DVec<2> along = DVec<2>(sides_.corners[side][1]) - point - from;
        return from + along * std::clamp(-dot(from, along) / dot(along, along), 0.0, 1.0);
    }
    /// The normal of a side on which a sample lies. It points to the right: outwards if the outline runs
    /// counter-clockwise.
    DVec<2> normal_of(std::uint32_t side) const {
        return -perpendicular(DVec<2>(sides_.corners[side][1]) - DVec<2>(sides_.corners[side][0]));
    }

    const Sides& sides_;
    PrimitiveBvh<2> tree_;
    RowCrossings crossings_;
    SampleLattice<2> lattice_;
};

}  // namespace

Result<Field<2>> bake_field(const PointSpan<2>& given, std::span<const std::vector<Vec2>> holes,
                            const FieldOptions<2>& options) {
    const PackedPoints<2> packed(given);
    const std::span<const Vec2> outline = packed.points();
    BakeJob work(options);
    if (!work.begin(0.1)) return BakeJob::cancelled();
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
