// Eight boxes at once against what a search reaches: which are perhaps within reach, and from where on. Included once
// for each kind of vector unit: every operation rounds alike on all.

#if defined(ABUT_BVH_REACH) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_BVH_REACH
#undef ABUT_BVH_REACH
#else
#define ABUT_BVH_REACH
#endif

#include <abut/broad_phase/bvh_lanes-inl.h>
#include <abut/broad_phase/reach.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// More than a float loses to a few roundings.
constexpr float float_slack = 1 + 5e-7f;
constexpr float float_least = 1e-37f;

inline float not_less(double number) {
    return static_cast<float>(number) * float_slack + float_least;
}

template <int D>
bool is_usual(const DVec<D>& v) {
    bool result = true;
    for (int i = 0; i < D; ++i) result = result && std::abs(v[i]) < 1e30;
    return result;
}

/// A reach along a ray in floats, with room for what they lose: six tenths of a millionth.
class FloatReach {
public:
    explicit FloatReach(float length) : most_(length * slack) {}

    bool over() const { return most_ < 0; }
    void shrink(float reach) { most_ = reach * slack < most_ ? reach * slack : most_; }
    float most() const { return most_; }

private:
    static constexpr float slack = 1 + 6e-7f;

    float most_;
};

inline float float_most(const FloatReach& reach) {
    return reach.most();
}
template <class Reach>
float float_most(const Reach& reach) {
    return not_less(reach.most());
}

/// Whether floats can hold it and its inverse.
inline bool is_usual_direction(double direction) {
    return (std::abs(direction) > 1e-30) && (std::abs(direction) < 1e30);
}

/// Eight boxes against what goes straight: which are perhaps within reach, and from where on. `some_flat`: where it may
/// go along some of the axes alone, so that others have no part in the distance.
template <int D, bool some_flat>
class RayLanes {
public:
    explicit RayLanes(const RayReach<D>& reach) {
        for (int i = 0; i < D; ++i) {
            const float low = not_above(reach.low()[i]), high = not_below(reach.high()[i]);
            flat_[i] = reach.direction()[i] == 0;
            set(i, low, high, flat_[i] ? 1 : static_cast<float>(reach.inverse()[i]));
        }
    }
    explicit RayLanes(const Ray<D>& ray) {
        for (int i = 0; i < D; ++i) {
            flat_[i] = false;
            set(i, ray.origin[i], ray.origin[i], 1 / ray.direction[i]);
        }
    }

    static bool suits(const RayReach<D>& reach) {
        bool result = is_usual<D>(reach.low()) && is_usual<D>(reach.high());
        for (int i = 0; i < D; ++i)
            result = result && (reach.direction()[i] == 0 || is_usual_direction(reach.direction()[i]));
        return result;
    }
    static bool suits(const Ray<D>& ray) {
        bool result = ray.length >= 0;
        for (int i = 0; i < D; ++i)
            result = result && (std::abs(ray.origin[i]) < 1e30f) && is_usual_direction(ray.direction[i]);
        return result;
    }

    HWY_INLINE std::uint32_t operator()(const BvhRows<D>& rows, float most, float (&measures)[bvh_lanes]) const {
        std::uint32_t result = 0;
        for (std::uint32_t lane = 0; lane < bvh_lanes; lane += bvh_step) {
            BvhVector from = hn::Zero(bvh_tag), to = hn::Set(bvh_tag, most);
            BvhMask mask = hn::Le(hn::Load(bvh_tag, rows.min[0] + lane), hn::Load(bvh_tag, rows.max[0] + lane));
            for (int i = 0; i < D; ++i) {
                const BvhVector first = hn::Load(bvh_tag, (backwards_[i] ? rows.max[i] : rows.min[i]) + lane);
                const BvhVector last = hn::Load(bvh_tag, (backwards_[i] ? rows.min[i] : rows.max[i]) + lane);
                const BvhVector front = hn::Set(bvh_tag, front_[i]), back = hn::Set(bvh_tag, back_[i]);
                if (some_flat && flat_[i]) {
                    mask = hn::And(mask, hn::And(hn::Le(first, front), hn::Le(back, last)));
                    continue;
                }
                const BvhVector inverse = hn::Set(bvh_tag, inverse_[i]);
                from = hn::Max(from, hn::Mul(hn::Sub(first, front), inverse));
                to = hn::Min(to, hn::Mul(hn::Sub(last, back), inverse));
            }
            to = hn::Add(hn::Mul(to, hn::Set(bvh_tag, float_slack)), hn::Set(bvh_tag, float_least));
            result |= bits_of(hn::And(mask, hn::Le(from, to))) << lane;
            hn::StoreU(from, bvh_tag, measures + lane);
        }
        return result;
    }

private:
    static float not_above(double x) {
        const auto near = static_cast<float>(x);
        return static_cast<double>(near) > x ? std::nextafter(near, -std::numeric_limits<float>::infinity()) : near;
    }
    static float not_below(double x) { return -not_above(-x); }

    void set(int i, float low, float high, float inverse) {
        backwards_[i] = inverse < 0;
        front_[i] = backwards_[i] ? low : high;
        back_[i] = backwards_[i] ? high : low;
        inverse_[i] = inverse;
    }

    float front_[D], back_[D];  ///< of what moves, by the way it goes
    float inverse_[D];
    bool flat_[D], backwards_[D];
};

/// Eight boxes against another: which are perhaps within reach, and how far away, squared.
template <int D>
class BoxLanes {
public:
    explicit BoxLanes(const BoxReach<D>& reach) : box_(reach.box()) {}

    static bool suits(const BoxReach<D>& reach) {
        return is_usual<D>(DVec<D>(reach.box().min)) && is_usual<D>(DVec<D>(reach.box().max));
    }

    HWY_INLINE std::uint32_t operator()(const BvhRows<D>& rows, float most, float (&measures)[bvh_lanes]) const {
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
            result |= bits_of(hn::And(mask, hn::Le(sum, hn::Set(bvh_tag, most)))) << lane;
            hn::StoreU(sum, bvh_tag, measures + lane);
        }
        return result;
    }

private:
    Aabb<D> box_;
};

/// Where floats can't hold what is asked: one after the other, in double.
template <int D, class Reach>
class SlowLanes {
public:
    explicit SlowLanes(const Reach& reach) : reach_(reach) {}

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

}  // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
