// The support point of many points by one SIMD target. Included once for each target, as Highway's own headers.

#include <abut/convex/point_soa.hpp>
#include <abut/math/dvec.hpp>

#include <bit>

#include <hwy/highway.h>

#if defined(ABUT_CONVEX_FARTHEST_LANE) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_CONVEX_FARTHEST_LANE
#undef ABUT_CONVEX_FARTHEST_LANE
#else
#define ABUT_CONVEX_FARTHEST_LANE
#endif

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, PointSoa::max_lanes>;
using FloatVector = hn::Vec<Floats>;

/// One bit per lane.
inline std::uint64_t bits_of(hn::Mask<Floats> mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Floats(), mask, bytes);
    return bytes[0] | static_cast<std::uint64_t>(bytes[1]) << 8;
}

/// The first of the farthest points among those that are equal in float.
class FarthestInDouble {
public:
    FarthestInDouble(const PointSoa& points, const DVec<3>& direction) : points_(points), direction_(direction) {}

    void offer(std::uint32_t i) {
        if (count_ == 0) {
            best_ = i;
        } else {
            if (count_ == 1) max_along_ = along(best_);
            const double here = along(i);
            if (here > max_along_) {
                max_along_ = here;
                best_ = i;
            }
        }
        ++count_;
    }
    std::uint32_t best() const { return best_; }

private:
    double along(std::uint32_t i) const { return dot(DVec<3>(points_.point(i)), direction_); }

    const PointSoa& points_;
    const DVec<3>& direction_;
    std::uint32_t best_ = 0, count_ = 0;
    double max_along_ = 0;
};

inline std::uint32_t farthest_lane(const PointSoa& points, const DVec<3>& direction) {
    const Floats f;
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(f));
    // The direction is scaled so that products stay in the range of floats.
    const double size = largest(direction);
    const Vec3 toward(size > 0x1p-20 && size < 0x1p5 ? direction : direction / size);
    const auto x = hn::Set(f, toward.x), y = hn::Set(f, toward.y), z = hn::Set(f, toward.z);
    // Twice the rounding error of the direction, three products and two sums, and a little more.
    const float rounding_error = 0x1p-20f * (std::abs(toward.x) * points.reach.x + std::abs(toward.y) * points.reach.y +
                                             std::abs(toward.z) * points.reach.z) +
                                 0x1p-140f;
    const auto along = [&](std::uint32_t i) {
        const float* from = points.x + i;
        const auto xy = hn::Add(hn::Mul(hn::LoadU(f, from), x), hn::Mul(hn::LoadU(f, from + points.stride), y));
        return hn::Add(xy, hn::Mul(hn::LoadU(f, from + 2 * points.stride), z));
    };

    // The maximum of each of up to eight blocks of whole words, so that few points are evaluated again in double.
    constexpr std::uint32_t word = 64, blocks = 8;
    const std::uint32_t block = ((points.stride + blocks * word - 1) / (blocks * word)) * word;
    HWY_ALIGN float block_max[blocks * PointSoa::max_lanes];
    FloatVector maximum = along(0);
    float* place = block_max;
    for (std::uint32_t begin = 0; begin < points.stride; begin += block, place += lanes) {
        const std::uint32_t end = std::min(begin + block, points.stride);
        FloatVector here = along(begin);
        for (std::uint32_t i = begin + lanes; i < end; i += lanes) here = hn::Max(here, along(i));
        hn::Store(here, f, place);
        maximum = hn::Max(maximum, here);
    }
    const auto threshold = hn::Sub(hn::MaxOfLanes(f, maximum), hn::Set(f, rounding_error));

    FarthestInDouble farthest(points, direction);
    place = block_max;
    for (std::uint32_t first = 0; first < points.stride; first += block, place += lanes) {
        if (hn::AllFalse(f, hn::Ge(hn::Load(f, place), threshold))) continue;
        const std::uint32_t last = std::min(first + block, points.stride);
        for (std::uint32_t begin = first; begin < last; begin += word) {
            const std::uint32_t end = std::min(begin + word, last);
            std::uint64_t bits = 0;
            for (std::uint32_t i = begin; i < end; i += lanes)
                bits |= bits_of(hn::Ge(along(i), threshold)) << (i - begin);
            for (; bits != 0; bits &= bits - 1)
                farthest.offer(begin + static_cast<std::uint32_t>(std::countr_zero(bits)));
        }
    }
    return farthest.best();
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
