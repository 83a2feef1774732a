// Conservative tests of eight boxes in SIMD: which may be within reach of a ray or a box, with a lower bound of their
// measure. Included once for each Highway target: every operation rounds alike on all targets.

#if defined(ABUT_BVH_REACH_SIMD) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_BVH_REACH_SIMD
#undef ABUT_BVH_REACH_SIMD
#else
#define ABUT_BVH_REACH_SIMD
#endif

#include <abut/broad_phase/bvh/overlap_simd-inl.h>
#include <abut/broad_phase/reach.hpp>
#include <abut/math/detail/round_outwards.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

/// A relative and an absolute tolerance that exceed a few rounding errors of float.
constexpr float float_tolerance = 1 + 5e-7f;
constexpr float float_absolute_tolerance = 1e-37f;

/// A float that is not less than the number.
inline float rounded_up(double number) {
    return static_cast<float>(number) * float_tolerance + float_absolute_tolerance;
}

/// Whether all coordinates are below 1e30 in magnitude, so that sums and differences of floats don't overflow.
template <int D>
bool is_in_float_range(const DVec<D>& v) {
    bool result = true;
    for (int i = 0; i < D; ++i) result = result && std::abs(v[i]) < 1e30;
    return result;
}

/// A reach along a ray in float. Its relative tolerance of 6e-7 covers the rounding errors.
class FloatReach {
public:
    explicit FloatReach(float length) : max_measure_(length * tolerance) {}

    bool is_exhausted() const { return max_measure_ < 0; }
    void shrink(float reach) { max_measure_ = reach * tolerance < max_measure_ ? reach * tolerance : max_measure_; }
    float max_measure() const { return max_measure_; }

private:
    static constexpr float tolerance = 1 + 6e-7f;

    float max_measure_;
};

/// The largest measure within reach, rounded up to float.
inline float float_max_measure(const FloatReach& reach) {
    return reach.max_measure();
}
template <class Reach>
float float_max_measure(const Reach& reach) {
    return rounded_up(reach.max_measure());
}

/// Whether the component of a direction and its inverse fit into a float.
inline bool has_float_inverse(double direction) {
    return (std::abs(direction) > 1e-30) && (std::abs(direction) < 1e30);
}

/// The slab test of a ray or a moving box against eight boxes. With `may_be_parallel`, components of the direction may
/// be 0: those axes don't change the distance.
template <int D, bool may_be_parallel>
class RayLanes {
public:
    explicit RayLanes(const RayReach<D>& reach) {
        for (int i = 0; i < D; ++i) {
            const float low = float_at_most(reach.low()[i]), high = float_at_least(reach.high()[i]);
            is_parallel_[i] = reach.direction()[i] == 0;
            set(i, low, high, is_parallel_[i] ? 1 : static_cast<float>(reach.inverse()[i]));
        }
    }
    explicit RayLanes(const Ray<D>& ray) {
        for (int i = 0; i < D; ++i) {
            is_parallel_[i] = false;
            set(i, ray.origin[i], ray.origin[i], 1 / ray.direction[i]);
        }
    }

    /// Whether float suffices for this ray; else ScalarLanes tests it.
    static bool is_in_range(const RayReach<D>& reach) {
        bool result = is_in_float_range<D>(reach.low()) && is_in_float_range<D>(reach.high());
        for (int i = 0; i < D; ++i)
            result = result && (reach.direction()[i] == 0 || has_float_inverse(reach.direction()[i]));
        return result;
    }
    static bool is_in_range(const Ray<D>& ray) {
        bool result = ray.length >= 0;
        for (int i = 0; i < D; ++i)
            result = result && (std::abs(ray.origin[i]) < 1e30f) && has_float_inverse(ray.direction[i]);
        return result;
    }

    HWY_INLINE std::uint32_t operator()(const BvhRows<D>& rows, float max_measure, float (&measures)[bvh_lanes]) const {
        std::uint32_t result = 0;
        for (std::uint32_t lane = 0; lane < bvh_lanes; lane += bvh_step) {
            BvhVector from = hn::Zero(bvh_tag), to = hn::Set(bvh_tag, max_measure);
            BvhMask mask = hn::Le(hn::Load(bvh_tag, rows.min[0] + lane), hn::Load(bvh_tag, rows.max[0] + lane));
            for (int i = 0; i < D; ++i) {
                const BvhVector first = hn::Load(bvh_tag, (backwards_[i] ? rows.max[i] : rows.min[i]) + lane);
                const BvhVector last = hn::Load(bvh_tag, (backwards_[i] ? rows.min[i] : rows.max[i]) + lane);
                const BvhVector front = hn::Set(bvh_tag, front_[i]), back = hn::Set(bvh_tag, back_[i]);
                if (may_be_parallel && is_parallel_[i]) {
                    mask = hn::And(mask, hn::And(hn::Le(first, front), hn::Le(back, last)));
                    continue;
                }
                const BvhVector inverse = hn::Set(bvh_tag, inverse_[i]);
                from = hn::Max(from, hn::Mul(hn::Sub(first, front), inverse));
                to = hn::Min(to, hn::Mul(hn::Sub(last, back), inverse));
            }
            to = hn::Add(hn::Mul(to, hn::Set(bvh_tag, float_tolerance)), hn::Set(bvh_tag, float_absolute_tolerance));
            result |= bits_of(hn::And(mask, hn::Le(from, to))) << lane;
            hn::StoreU(from, bvh_tag, measures + lane);
        }
        return result;
    }

private:
    void set(int i, float low, float high, float inverse) {
        backwards_[i] = inverse < 0;
        front_[i] = backwards_[i] ? low : high;
        back_[i] = backwards_[i] ? high : low;
        inverse_[i] = inverse;
    }

    float front_[D], back_[D];  ///< the coordinates of the moving box at its front and back
    float inverse_[D];
    bool is_parallel_[D], backwards_[D];
};

/// The squared distances of eight boxes from another box.
template <int D>
class BoxLanes {
public:
    explicit BoxLanes(const BoxReach<D>& reach) : box_(reach.box()) {}

    static bool is_in_range(const BoxReach<D>& reach) {
        return is_in_float_range<D>(DVec<D>(reach.box().min)) && is_in_float_range<D>(DVec<D>(reach.box().max));
    }

    HWY_INLINE std::uint32_t operator()(const BvhRows<D>& rows, float max_measure, float (&measures)[bvh_lanes]) const {
        std::uint32_t result = 0;
        for (std::uint32_t lane = 0; lane < bvh_lanes; lane += bvh_step) {
            BvhVector sum = hn::Zero(bvh_tag);
            const BvhMask mask = hn::Le(hn::Load(bvh_tag, rows.min[0] + lane), hn::Load(bvh_tag, rows.max[0] + lane));
            for (int i = 0; i < D; ++i) {
                const BvhVector ahead = hn::Sub(hn::Load(bvh_tag, rows.min[i] + lane), hn::Set(bvh_tag, box_.max[i]));
                const BvhVector behind = hn::Sub(hn::Set(bvh_tag, box_.min[i]), hn::Load(bvh_tag, rows.max[i] + lane));
                const BvhVector gap = hn::Max(hn::Max(ahead, behind), hn::Zero(bvh_tag));
                sum = hn::Add(sum, hn::Mul(gap, gap));
            }
            result |= bits_of(hn::And(mask, hn::Le(sum, hn::Set(bvh_tag, max_measure)))) << lane;
            hn::StoreU(sum, bvh_tag, measures + lane);
        }
        return result;
    }

private:
    Aabb<D> box_;
};

/// The fallback for queries that don't fit into floats: tests the boxes one by one in double.
template <int D, class Reach>
class ScalarLanes {
public:
    explicit ScalarLanes(const Reach& reach) : reach_(reach) {}

    std::uint32_t operator()(const BvhRows<D>& rows, float, float (&measures)[bvh_lanes]) const {
        std::uint32_t result = 0;
        for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane) {
            double measure = 0;
            const Aabb<D> box = rows.box(lane);
            measures[lane] = 0;
            if (is_empty(box) || !reach_.measure(box, measure)) continue;
            result |= 1u << lane;
            measures[lane] = static_cast<float>(std::min(measure, 3e38));
        }
        return result;
    }

private:
    const Reach& reach_;
};

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
