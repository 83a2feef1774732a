#include <abut/bake/field.hpp>
#include <abut/bake/field_fill.hpp>
#include <abut/bake/field_grid.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {
namespace {

struct Side {
    DVec<2> from, to;
    std::size_t ring = 0;
};

DVec<2> way_to(const DVec<2>& from, const DVec<2>& to) {
    const DVec<2> along = to - from;
    const double t = std::clamp(-dot(from, along) / dot(along, along), 0.0, 1.0);
    return from + along * t;
}

class OutlineSource final : public SampleSource<2> {
public:
    OutlineSource(std::vector<Side> sides, const SampleLattice<2>& lattice)
        : sides_(std::move(sides)), lattice_(lattice) {}

    void tell(const SampleBlock<2>& block, const SampleValues<2>& values) const override {
        for (std::uint32_t i = 0; i < block.samples(); ++i) {
            const DVec<2> point = lattice_.at(block.sample(i)), way = nearest(point);
            const bool inside = is_inside(point);
            values.distance[i] = static_cast<float>(inside ? -length(way) : length(way));
            if (values.gradient != nullptr) values.gradient[i] = to_float(normalized(inside ? way : -way));
            if (values.closest != nullptr) values.closest[i] = to_float(point + way);
        }
    }
    double distance(const DVec<2>& point) const override { return length(nearest(point)); }

private:
    DVec<2> nearest(const DVec<2>& point) const {
        DVec<2> best(0.0);
        double least = std::numeric_limits<double>::infinity();
        for (const Side& side : sides_) {
            const DVec<2> way = way_to(side.from - point, side.to - point);
            if (dot(way, way) >= least) continue;
            least = dot(way, way);
            best = way;
        }
        return best;
    }
    bool is_inside(const DVec<2>& point) const {
        int winding = 0;
        std::size_t ring = 0;
        bool inside = false;
        const auto finish = [&] {
            if (ring == 0)
                inside = winding != 0;
            else if (winding != 0)
                inside = false;
            winding = 0;
        };
        for (const Side& side : sides_) {
            if (side.ring != ring) {
                finish();
                ring = side.ring;
            }
            const DVec<2> a = side.from - point, b = side.to - point;
            if ((a.y <= 0) == (b.y <= 0)) continue;
            const double turn = cross(a, b);
            if (a.y <= 0 && turn > 0) ++winding;
            if (a.y > 0 && turn < 0) --winding;
        }
        finish();
        return inside;
    }

    std::vector<Side> sides_;
    SampleLattice<2> lattice_;
};

}  // namespace

Result<Field<2>> bake_field(std::span<const Vec2> outline, std::span<const std::vector<Vec2>> holes,
                            const FieldOptions<2>& options) {
    FieldWork work(options);
    if (!work.begin(0.1)) return FieldWork::cancelled();
    std::vector<Side> sides;
    Aabb2 box = Aabb2::empty();
    for (std::size_t ring = 0; ring <= holes.size(); ++ring) {
        const std::span<const Vec2> points = ring == 0 ? outline : std::span<const Vec2>(holes[ring - 1]);
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!is_finite(points[i]))
                return Problem{ProblemCode::not_finite, "a point of the outline is not finite", i};
            const Vec2& next = points[i + 1 < points.size() ? i + 1 : 0];
            if (points[i] == next) continue;
            sides.push_back({DVec<2>(points[i]), DVec<2>(next), ring});
            box = merged(box, Aabb2{points[i], points[i]});
        }
    }
    if (sides.empty()) return Problem{ProblemCode::empty_input, "the outline has no two points", 0};
    Result<FieldData<2>> grid = field_grid(box, options);
    if (!grid) return grid.problem();
    FieldReport report;
    report.closed = true;
    const OutlineSource source(std::move(sides), lattice_of(*grid));
    Result<Field<2>> field = fill_field(*std::move(grid), source, options, work, report);
    if (field && options.report != nullptr) *options.report = report;
    return field;
}

}  // namespace abut
