#include <abut/query/closest.hpp>
#include <abut/query/part_pairs.hpp>

namespace abut {
namespace {

/// The gap between two boxes along the axis on which it is widest; not below zero.
template <int D>
float gap(const Aabb<D>& a, const Aabb<D>& b) {
    float widest = 0;
    for (int i = 0; i < D; ++i) widest = std::max({widest, a.min[i] - b.max[i], b.min[i] - a.max[i]});
    return widest;
}

/// How much wider to look at first: an eighth of the smaller shape, and enough to matter beside `start`.
template <int D>
float first_step(const View<D>& a, const View<D>& b, float start) {
    const float eighth = static_cast<float>(0.125 * std::min(size(a), size(b)));
    return std::max(eighth, 2 * (std::nextafter(start, std::numeric_limits<float>::max()) - start));
}

template <int D>
void write(const SignedDistance<D>& distance, Closest<D>& result) {
    result.distance = static_cast<float>(distance.distance);
    result.normal = to_float(distance.normal);
    result.on_a = to_float(distance.on_a);
    result.on_b = to_float(distance.on_b());
}

template <int D>
class Nearest {
public:
    explicit Nearest(const SearchOptions<D>& options) : options_(options) {}

    /// The least distance over all pairs of parts within reach.
    void search(const View<D>& a, const View<D>& b, float reach) {
        each_part_pair(a, b, reach,
                       [&](const auto& part_a, std::uint32_t index_a, const auto& part_b, std::uint32_t index_b) {
                           const SignedDistance<D> distance = part_distance(part_a, part_b, options_);
                           if (!any_ || distance.distance < least_.distance) {
                               any_ = true;
                               least_ = distance;
                               // Now, while the parts are there: a composite shape may make them up as it goes.
                               name_features(part_a, part_b, distance, index_a, index_b, found_);
                           }
                           return true;
                       });
    }

    bool any() const { return any_; }
    double distance() const { return least_.distance; }
    Closest<D> found() const {
        Closest<D> result = found_;
        if (any_) write(least_, result);
        return result;
    }

private:
    SearchOptions<D> options_;
    bool any_ = false;
    SignedDistance<D> least_{};
    Closest<D> found_;  ///< its features
};

}  // namespace

template <int D>
Closest<D> closest(const Convex<D>& a, const Convex<D>& b, const QueryOptions<D>& options) {
    Closest<D> result;
    const bool finite = is_finite(a) && is_finite(b);
    ABUT_ASSERT(finite);
    if (!finite) return result;
    const SignedDistance<D> distance = part_distance(a, b, {options.cache, options.trace});
    write(distance, result);
    name_features(a, b, distance, 0, 0, result);
    return result;
}

template <int D>
Closest<D> closest(const View<D>& a, const View<D>& b, const QueryOptions<D>& options) {
    const bool finite = is_finite(a) && is_finite(b);
    ABUT_ASSERT(finite);
    if (!finite) return {};
    Nearest<D> nearest(search_options(a, b, options));
    if (!std::holds_alternative<Composite<D>>(a) && !std::holds_alternative<Composite<D>>(b)) {
        nearest.search(a, b, 0);
        return nearest.found();
    }
    // Parts are told by their boxes alone. So the search widens until it finds some part, and then looks once more as
    // far as that one is, since a box out there may hold something nearer.
    const Aabb<D> box_a = bounds(a), box_b = bounds(b);
    if (!(box_a.min[0] <= box_a.max[0] && box_b.min[0] <= box_b.max[0])) return {};
    constexpr float most = std::numeric_limits<float>::max();
    const float start = gap(box_a, box_b);
    float reach = start;
    nearest.search(a, b, reach);
    for (float step = first_step(a, b, start); !nearest.any() && reach < most; step *= 2) {
        reach = std::min(start + step, most);
        nearest.search(a, b, reach);
    }
    if (nearest.any() && nearest.distance() > static_cast<double>(reach))
        nearest.search(a, b, std::nextafter(static_cast<float>(nearest.distance()), most));
    return nearest.found();
}

template Closest<2> closest(const View<2>&, const View<2>&, const QueryOptions<2>&);
template Closest<3> closest(const View<3>&, const View<3>&, const QueryOptions<3>&);
template Closest<2> closest(const Convex<2>&, const Convex<2>&, const QueryOptions<2>&);
template Closest<3> closest(const Convex<3>&, const Convex<3>&, const QueryOptions<3>&);

}  // namespace abut
