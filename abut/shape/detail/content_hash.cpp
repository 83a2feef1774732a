#include <abut/math/detail/blob.hpp>
#include <abut/shape/detail/content_hash.hpp>

#include <algorithm>
#include <bit>
#include <variant>

namespace abut::detail {
namespace {

class ContentHash {
public:
    void add(std::uint64_t word) { add_to_checksum(state_, word); }
    void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
    template <int D, class T>
    void add(const glm::vec<D, T>& vector) {
        for (int i = 0; i < D; ++i) add(static_cast<double>(vector[i]));
    }
    template <int D>
    void add(const Aabb<D>& box) {
        add(box.min);
        add(box.max);
    }
    template <int D>
    void add(const Placement<D>& placement) {
        for (const DVec<D>& column : placement.place.column) add(column);
        add(placement.place.offset);
        add(placement.inner_radius);
        add(placement.radius);
    }
    std::uint64_t value() const { return state_; }

private:
    std::uint64_t state_ = 0x6c62272e07bb0142u;
};

/// Visits the points of a grid of `count` points along each axis, with coordinates from 0 to count - 1.
template <int D, class Visit>
void each_grid_point(int count, const Visit& visit) {
    for (int x = 0; x < count; ++x)
        for (int y = 0; y < count; ++y)
            for (int z = 0; z < (D == 3 ? count : 1); ++z) {
                Vec<D> point(0.0f);
                point.x = static_cast<float>(x);
                point.y = static_cast<float>(y);
                if constexpr (D == 3) point.z = static_cast<float>(z);
                visit(point);
            }
}

template <int D>
std::uint64_t hash_of(const Convex<D>& convex) {
    ContentHash hash;
    hash.add(static_cast<const Placement<D>&>(convex));
    hash.add(static_cast<std::uint64_t>(convex.core));
    hash.add(std::uint64_t{convex.one_sided});
    switch (convex.core) {
        case Core::points:
            for (std::uint32_t i = 0; i < convex.count; ++i) hash.add(convex.vertices()[i]);
            break;
        case Core::box:
            hash.add(convex.own[0]);
            break;
        case Core::discs:
            for (std::size_t i = 0; i < 2; ++i) {
                hash.add(convex.own[i]);
                hash.add(static_cast<double>(convex.disc_radius[i]));
            }
            break;
        case Core::function:
            each_grid_point<D>(3, [&](const Vec<D>& point) {
                const Vec<D> direction = point - Vec<D>(1.0f);
                if (direction != Vec<D>(0.0f)) hash.add(convex.function(convex.object, direction));
            });
            break;
    }
    return hash.value();
}

template <int D>
std::uint64_t hash_of(const HalfSpaceView<D>& half_space) {
    ContentHash hash;
    hash.add(half_space.normal);
    hash.add(half_space.offset);
    return hash.value();
}

/// The sum over the parts doesn't depend on their order, which a tree determines. A part that is visited twice has the
/// same hash in every equal shape.
template <int D>
std::uint64_t hash_of(const Composite<D>& composite) {
    std::uint64_t parts = 0;
    composite.each_part(composite.object, composite.bounds, [&](const Convex<D>& part, std::uint32_t index) {
        ContentHash hash;
        hash.add(std::uint64_t{index});
        hash.add(hash_of(part));
        parts += hash.value();
        return true;
    });
    ContentHash hash;
    hash.add(static_cast<const Placement<D>&>(composite));
    hash.add(composite.bounds);
    hash.add(std::uint64_t{composite.solid != nullptr});
    hash.add(std::uint64_t{composite.contains != nullptr});
    hash.add(parts);
    return hash.value();
}

template <int D>
std::uint64_t hash_of(const DistanceFunction<D>& function) {
    constexpr int samples = 5;
    constexpr float far = 1e3f;
    ContentHash hash;
    hash.add(static_cast<const Placement<D>&>(function));
    hash.add(function.bounds);
    const Vec<D> low = glm::clamp(function.bounds.min, -far, far), high = glm::clamp(function.bounds.max, -far, far);
    each_grid_point<D>(samples, [&](const Vec<D>& point) {
        const Vec<D> place = low + (high - low) * (point * (1.0f / (samples - 1)));
        hash.add(static_cast<double>(function.distance(function.object, place)));
    });
    return hash.value();
}

}  // namespace

template <int D>
std::uint64_t content_hash(const View<D>& view) {
    ContentHash hash;
    hash.add(static_cast<std::uint64_t>(view.index()));
    hash.add(std::visit([](const auto& shape) { return hash_of(shape); }, view));
    return std::max(hash.value(), std::uint64_t{1});
}

template std::uint64_t content_hash(const View<2>& view);
template std::uint64_t content_hash(const View<3>& view);

}  // namespace abut::detail
