#include <abut/math/simd/library_entry.hpp>
#include <abut/motion/depenetrate.hpp>
#include <abut/motion/mover/nearby_parts.hpp>
#include <abut/motion/push/plane_solver.hpp>
#include <abut/query/detail/sweep/linear.hpp>
#include <abut/query/detail/valid_query.hpp>

#include <algorithm>
#include <array>

namespace abut::detail {
namespace {

template <int D>
struct ShortestPush {
    bool found = false;
    DVec<D> push{0.0};
    double depth = 0;  ///< penetration depth of the deepest part at the start
};

/// Maximum number of parts along one line.
constexpr int max_parts_on_line = 256;

/// Maximum number of sphere-tracing steps out of a distance function.
constexpr int max_march_steps = 128;

/// Maximum number of slides from the end of a line; each shortens the push.
constexpr int max_slides = 12;

/// Unit directions: every 22.5 degrees in 2D; axes, edges and diagonals of a cube in 3D.
template <int D>
struct UniformDirections;

template <>
struct UniformDirections<2> {
    static constexpr std::size_t count = 16;
    static DVec<2> direction(std::size_t i) {
        constexpr double cosine = 0.9238795325112867, sine = 0.3826834323650898, half = 0.7071067811865476;
        constexpr std::array<double, 4> x{1, cosine, half, sine}, y{0, sine, half, cosine};
        const DVec<2> in_first{x[i % 4], y[i % 4]};
        switch (i / 4) {
            case 0:
                return in_first;
            case 1:
                return {-in_first.y, in_first.x};
            case 2:
                return -in_first;
            default:
                return {in_first.y, -in_first.x};
        }
    }
};

template <>
struct UniformDirections<3> {
    static constexpr std::size_t count = 26;
    static DVec<3> direction(std::size_t i) {
        const std::size_t k = i < 13 ? i : i + 1;  // skips the zero vector
        const auto part = [](std::size_t digit) { return static_cast<double>(digit % 3) - 1; };
        return normalized(DVec<3>{part(k), part(k / 3), part(k / 9)});
    }
};

template <int D>
struct Touched {
    PartName name;
    DVec<D> normal{0.0};  ///< of length 1, facing the shape
    double gap = 0;
};

/// The deepest contacts, sorted by gap and then by name, so that the order of visits doesn't matter.
template <int D>
class TouchedParts {
public:
    void add(const Touched<D>& touched) {
        const auto before = [](const Touched<D>& a, const Touched<D>& b) {
            return a.gap < b.gap || (a.gap == b.gap && a.name < b.name);
        };
        const auto end = parts_.begin() + static_cast<std::ptrdiff_t>(count_);
        const auto same = [&](const Touched<D>& other) { return other.name == touched.name; };
        const auto place = std::lower_bound(parts_.begin(), end, touched, before);
        // A shape may visit a part twice.
        if (place == parts_.end() || std::find_if(parts_.begin(), end, same) != end) return;
        if (count_ < parts_.size()) ++count_;
        std::move_backward(place, parts_.begin() + static_cast<std::ptrdiff_t>(count_) - 1,
                           parts_.begin() + static_cast<std::ptrdiff_t>(count_));
        *place = touched;
    }
    std::span<const Touched<D>> all() const { return {parts_.data(), count_}; }

private:
    std::array<Touched<D>, max_move_planes> parts_;
    std::size_t count_ = 0;
};

template <int D>
class Search {
public:
    Search(const Convex<D>& shape, const World<D>& world, const Filter& filter, double gap)
        : shape_(shape), grown_(shape), world_(world), filter_(filter), gap_(gap) {
        grown_.radius += gap;
    }

    ShortestPush<D> run() {
        ShortestPush<D> result;
        const TouchedParts<D> start = touched_at(DVec<D>(0.0), 0);
        if (start.all().empty()) {
            result.found = true;
            return result;
        }
        result.depth = -start.all().front().gap;
        double best = std::numeric_limits<double>::infinity();
        const auto try_direction = [&](const DVec<D>& direction) {
            const std::optional<double> free = first_free(direction);
            if (!free) return;
            const DVec<D> push = slide_back(direction * *free);
            // Shorter by more than rounding: the first of equals wins.
            if (length(push) > best - 1e-9 * gap_) return;
            best = length(push);
            result.push = push;
            result.found = true;
        };
        DVec<D> combined(0.0);
        if (nearest_leaving(start, DVec<D>(0.0), combined) && length(combined) > 0) try_direction(normalized(combined));
        for (const Touched<D>& touched : start.all()) try_direction(touched.normal);
        for (std::size_t i = 0; i < UniformDirections<D>::count; ++i) try_direction(UniformDirections<D>::direction(i));
        return result;
    }

private:
    static Convex<D> at(const Convex<D>& shape, const DVec<D>& push) {
        Convex<D> result = shape;
        result.place.offset += push;
        return result;
    }

    /// Calls visit(name, part) for all parts whose boxes overlap `box`.
    template <class Visit>
    void each_part_in(const Aabb<D>& box, Visit&& visit) const {
        world_.each_in_box(
            box,
            [&](Id id, const View<D>& shape) {
                const bool is_composite = std::holds_alternative<Composite<D>>(shape);
                detail::for_each_part(shape, box, [&](const Part<D>& part, std::uint32_t index) {
                    if (!is_composite || overlaps(bounds(part), box)) visit(PartName{id, index}, part);
                    return true;
                });
            },
            filter_);
    }

    /// The parts within `reach` of the shape.
    TouchedParts<D> touched_at(const DVec<D>& push, double reach) const {
        TouchedParts<D> result;
        const Convex<D> there = at(shape_, push);
        each_part_in(grown(bounds(there), static_cast<float>(reach)), [&](const PartName& name, const Part<D>& part) {
            const SignedDistance<D> distance = part_distance<D>(there, part);
            if (distance.distance < reach && touch_at_fronts<D>(there, part, distance.normal))
                result.add({name, -distance.normal, distance.distance});
        });
        return result;
    }

    /// The distance along the line at which the padded shape leaves the part that it overlaps at `along`.
    std::optional<double> exit_distance(const Convex<D>& part, const DVec<D>& direction, double) const {
        // Beyond the part's end the shape is swept back until it touches.
        const double beyond = dot(direction, support(part, direction)) - dot(direction, support(grown_, -direction));
        const double from = beyond + gap_;
        LinearImpact<D> touch;
        if (!time_of_impact(at(grown_, direction * from), Path<D>{-direction, from}, part, 0, SweepOptions<D>{}, touch))
            return std::nullopt;
        return from - touch.along;
    }
    std::optional<double> exit_distance(const DistanceFunction<D>& part, const DVec<D>& direction, double along) const {
        for (int step = 0; step < max_march_steps; ++step) {
            const double distance = part_distance<D>(at(grown_, direction * along), part).distance;
            if (!(distance < -0.1 * gap_)) return along;
            along += std::max(-distance, 0.1 * gap_);
        }
        return std::nullopt;
    }
    std::optional<double> exit_distance(const HalfSpaceView<D>& part, const DVec<D>& direction, double) const {
        const double rise = dot(part.normal, direction);
        if (!(rise > 1e-9)) return std::nullopt;
        return (part.offset - dot(part.normal, support(grown_, -part.normal))) / rise;
    }

    /// The first point along the line that is free of all parts; nothing if there is none.
    std::optional<double> first_free(const DVec<D>& direction) const {
        double along = 0;
        for (int i = 0; i < max_parts_on_line; ++i) {
            const Convex<D> here = at(grown_, direction * along);
            double next = along;
            bool in_something = false, leaves_all = true;
            each_part_in(bounds(here), [&](const PartName&, const Part<D>& part) {
                const SignedDistance<D> distance = part_distance<D>(here, part);
                if (!(distance.distance < -0.3 * gap_) || !touch_at_fronts<D>(here, part, distance.normal)) return;
                in_something = true;
                const std::optional<double> end =
                    part.visit([&](const auto& own) { return exit_distance(own, direction, along); });
                leaves_all = leaves_all && end;
                if (end) next = std::max(next, *end);
            });
            if (!in_something) return along;
            if (!leaves_all) return std::nullopt;
            // A time of impact may be early by the tolerance.
            along = std::max(next, along + 0.1 * gap_);
        }
        return std::nullopt;
    }

    /// The shortest push out of all contacts at once, by their planes.
    bool nearest_leaving(const TouchedParts<D>& touched, const DVec<D>& there, DVec<D>& push) const {
        std::array<MovePlane<D>, max_move_planes> planes;
        std::size_t count = 0;
        for (const Touched<D>& each : touched.all())
            planes[count++] = {each.normal, each.gap - gap_ - dot(each.normal, there)};
        return nearest_move<D>(std::span<const MovePlane<D>>(planes.data(), count), DVec<D>(0.0), 1e-3 * gap_, push);
    }

    /// Slides from a free point towards the start.
    DVec<D> slide_back(DVec<D> push) const {
        for (int i = 0; i < max_slides; ++i) {
            DVec<D> nearer(0.0);
            if (!nearest_leaving(touched_at(push, 1.5 * gap_), push, nearer)) break;
            const DVec<D> move = nearer - push;
            const double distance = length(move);
            if (!(distance > 0.01 * gap_)) break;
            const double goes = first_touch(push, move / distance, distance);
            if (!(goes > 0.01 * gap_)) break;
            push += move * (goes / distance);
        }
        return push;
    }
    /// The distance to the first contact that the padded shape isn't sliding along.
    double first_touch(const DVec<D>& from, const DVec<D>& direction, double max_length) const {
        // Contacts that it slides along overlap the padding by less than half of the gap.
        Convex<D> here = at(shape_, from);
        here.radius += 0.5 * gap_;
        const Aabb<D> first = bounds(here), last = bounds(at(here, direction * max_length));
        double result = max_length;
        each_part_in(merged(first, last), [&](const PartName& name, const Part<D>& part) {
            LinearImpact<D> touch;
            if (!front_time_of_impact<D>(here, {direction, max_length}, part, name.part, {}, touch)) return;
            result = std::min(result, touch.along);
        });
        return result;
    }

    const Convex<D>& shape_;
    Convex<D> grown_;
    const World<D>& world_;
    const Filter& filter_;
    double gap_;
};

/// For each search direction the first free point on the line is found exactly: each overlapped part gives an exit, and
/// parts overlapped at the exit are tested next. From each free point the shape slides back along its contacts towards
/// the start. The shortest push wins. Directions: out of each part, out of all at once, and evenly spread ones. The
/// result is `gap` away from the obstacles.
///
/// Queries the world anew for each step and doesn't allocate. Limits: 32 contacts at a time, 256 parts along a line.
template <int D>
ShortestPush<D> shortest_push(const Convex<D>& shape, const World<D>& world, const Filter& filter, double gap) {
    return Search<D>(shape, world, filter, gap).run();
}

}  // namespace
template <int D>
Depenetration<D> depenetrate_convex(const Convex<D>& shape, const World<D>& world, const Filter& filter) {
    detail::enter_library();
    Depenetration<D> result;
    if (!detail::is_valid_query(shape)) return result;
    const double touching = 1e-5 * detail::size(shape);
    const ShortestPush<D> found = shortest_push(shape, world, filter, 10 * touching);
    result.push = to_float(found.push);
    result.depth = found.found || found.depth <= touching ? 0 : static_cast<float>(found.depth);
    return result;
}

template Depenetration<2> depenetrate_convex(const Convex<2>&, const World<2>&, const Filter&);
template Depenetration<3> depenetrate_convex(const Convex<3>&, const World<3>&, const Filter&);

}  // namespace abut::detail
