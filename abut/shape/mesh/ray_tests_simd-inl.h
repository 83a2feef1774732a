// Float tests of a ray against the boxes of a node and the triangles of a leaf, with error bounds. Included once for
// each Highway target.

#if defined(ABUT_MESH_RAY_TESTS) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_MESH_RAY_TESTS
#undef ABUT_MESH_RAY_TESTS
#else
#define ABUT_MESH_RAY_TESTS
#endif

#include <abut/math/simd/lanes-inl.h>
#include <abut/shape/mesh/rays.hpp>
#include <abut/shape/mesh/triangle_simd-inl.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

/// The size in bytes of a row of eight floats. Rows are addressed by their offsets in bytes, so that no index is
/// multiplied.
constexpr std::size_t row_size = sizeof(float) * mesh_lanes;

HWY_INLINE const float* row_at(const void* rows, std::size_t offset) {
    return reinterpret_cast<const float*>(static_cast<const char*>(rows) + offset);
}

/// Times along a LocalRay are up to 5e-6 shorter or longer than lengths. The reach in time exceeds that in length by
/// more, and a proof of a hit within reach takes that back.
constexpr float time_margin = 1 + 1e-5f, time_tolerance = 2.2e-5f;

/// Slab test of a ray against eight boxes. The boxes are padded, and each slab is widened by the error of the ray's
/// origin.
class RayBoxTest {
public:
    /// The fourth lanes of both vectors are unspecified.
    HWY_INLINE RayBoxTest(lanes::Floats4 origin, lanes::Floats4 direction, float origin_error) {
        // A direction component near 0 is replaced: no product overflows, and every finite time is far enough.
        const lanes::Floats4 size = lanes::greater(lanes::magnitude(direction), lanes::Floats4(1e-20f));
        const lanes::Floats4 inverse = 1 / lanes::flipped_by(size, direction);
        const lanes::Floats4 time = origin * inverse;
        // The origin and its products have three roundings, of 2^-24 each.
        const lanes::Floats4 error = (lanes::magnitude(origin) * 0x1p-22f + origin_error) * lanes::magnitude(inverse);
        const lanes::Floats4 near = time + error, far = (time - error) * tolerance, far_inverse = inverse * tolerance;
        const std::size_t signs = lanes::signs(direction);
        for (std::size_t i = 0; i < 3; ++i) {
            near_factor_[i] = hn::Set(bvh_tag, inverse[i]);
            far_factor_[i] = hn::Set(bvh_tag, far_inverse[i]);
            near_[i] = hn::Set(bvh_tag, near[i]);
            far_[i] = hn::Set(bvh_tag, far[i]);
            const std::size_t is_backwards = signs >> i & 1;
            near_row_[i] = row_size * (i + 3 * is_backwards);
            far_row_[i] = row_size * (2 * i + 3) - near_row_[i];
        }
    }

    /// The boxes that the ray may hit, one bit each, and the times of entry, which may be -0.
    HWY_INLINE std::uint32_t operator()(const MeshNode& node, float max_time, float (&times)[mesh_lanes]) const {
        std::uint32_t result = 0;
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const auto time_at = [&](std::size_t row, V factor, V of_origin) {
                return hn::Sub(hn::Mul(hn::Load(bvh_tag, row_at(&node, row) + lane), factor), of_origin);
            };
            const auto enters = [&](int i) { return time_at(near_row_[i], near_factor_[i], near_[i]); };
            const auto leaves = [&](int i) { return time_at(far_row_[i], far_factor_[i], far_[i]); };
            const V from = hn::Max(hn::Max(enters(0), hn::Zero(bvh_tag)), hn::Max(enters(1), enters(2)));
            const V to = hn::Min(hn::Min(leaves(0), hn::Set(bvh_tag, max_time)), hn::Min(leaves(1), leaves(2)));
            result |= bits_of(hn::Le(from, to)) << lane;
            hn::StoreU(from, bvh_tag, times + lane);
        }
        return result;
    }

private:
    /// More than twice five float roundings.
    static constexpr float tolerance = 1 + 1e-6f;

    V near_factor_[3], far_factor_[3];  ///< the inverse of the direction; the far one is longer by the tolerance
    V near_[3], far_[3];                ///< a plane's coordinate times the factor, minus this, is the time
    std::size_t near_row_[3], far_row_[3];
};

/// The triangles of a leaf that a ray may hit, one bit each.
struct LeafHits {
    std::uint32_t possible = 0;
    std::uint32_t proven = 0;  ///< those of them that the exact test surely accepts
};

/// Test of a ray against the triangles of a leaf: projected along the ray, a triangle is hit if it contains the origin.
/// Woop, Benthin, Wald, "Watertight ray/triangle intersection" (2013), here with error bounds.
class RayTriangleTest {
public:
    /// The fourth lanes of both vectors are unspecified.
    HWY_INLINE RayTriangleTest(lanes::Floats4 origin, lanes::Floats4 direction, const LocalRay& ray)
        : origin_error_(2 * static_cast<float>(ray.origin_error)) {
        HWY_ALIGN float from[4], along[4];
        std::memcpy(from, &origin, sizeof(from));
        std::memcpy(along, &direction, sizeof(along));
        // The dominant axis of the direction, by arithmetic since a branch is unpredictable, and the other two.
        static constexpr std::uint8_t others[3][2] = {{1, 2}, {2, 0}, {0, 1}};
        const lanes::Floats4 size = lanes::magnitude(direction);
        const float x = size[0], y = size[1], z = size[2];
        const auto is_y = static_cast<std::size_t>(y > x), is_z = static_cast<std::size_t>(z > std::max(x, y));
        const std::size_t dominant = is_y + (2 - is_y) * is_z;
        const std::size_t axes[3] = {others[dominant][0], others[dominant][1], dominant};
        inverse_ = 1 / along[dominant];
        from_ = from[dominant];
        for (int i = 0; i < 3; ++i) {
            origin_[i] = hn::Set(bvh_tag, from[axes[i]]);
            row_[i] = row_size * axes[i];
        }
        for (int i = 0; i < 2; ++i) slope_[i] = hn::Set(bvh_tag, along[axes[i]] * inverse_);
        constexpr float never = std::numeric_limits<float>::infinity();
        proof_factor_ = ray.similar ? 1.25f : never;
        facing_ = ray.facing_sign == 0 ? 0.0f : never;
    }

    /// The triangles of a leaf that the line may pass through.
    HWY_INLINE std::uint32_t possible(const MeshLeaf& leaf) const { return test<false>(leaf, 0).possible; }

    /// Also the triangles that decide_triangle surely accepts, for a ray whose reach is `max_time` without time_margin:
    /// by more than all errors, the line passes through the triangle, doesn't graze it, and hits it away from both
    /// ends.
    HWY_INLINE LeafHits proven(const MeshLeaf& leaf, float max_time) const { return test<true>(leaf, max_time); }

private:
    /// With u = 2^-24, the projection of a corner is off by at most 7 u times its distance along the axis, and 2 u
    /// times the extent of the leaf. The line passes the leaf's box, so projected corners are no farther from it than
    /// the box is wide; the product of two such coordinates is off by less than six times the product of extent and
    /// error.
    template <bool proves>
    HWY_INLINE LeafHits test(const MeshLeaf& leaf, float max_time) const {
        const float distance = std::abs(*row_at(&leaf, row_[2]) - from_);
        const float corner_error = 0x1p-21f * distance + 0x1p-20f * leaf.extent + origin_error_;
        const float area_error = 6 * corner_error * (leaf.extent + corner_error);
        const V upper = hn::Set(bvh_tag, area_error), lower = hn::Neg(upper);
        LeafHits result;
        LeafRows<3> places;
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const V along = from_origin(leaf, 2, lane);
            for (int i = 0; i < 2; ++i)
                places.set(i, lane, hn::Sub(from_origin(leaf, i, lane), hn::Mul(along, slope_[i])));
            if constexpr (proves) places.set(2, lane, along);
        }
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const LeafNumbers numbers(leaf, lane);
            const V2 a = numbers.pick<0>(places), b = numbers.pick<1>(places), c = numbers.pick<2>(places);
            const Areas areas{signed_area(a, b), signed_area(b, c), signed_area(c, a)};
            // Written so that a NaN excludes no triangle.
            const auto outside = hn::And(hn::Lt(areas.least(), lower), hn::Gt(areas.greatest(), upper));
            const std::uint32_t possible = leaf.used & ~(bits_of(outside) << lane) & lanes_from(lane);
            result.possible |= possible;
            if constexpr (proves)
                if (possible != 0) {
                    const V depth = hn::Add(hn::Add(hn::Mul(areas.bc, numbers.pick_row<0>(places, 2)),
                                                    hn::Mul(areas.ca, numbers.pick_row<1>(places, 2))),
                                            hn::Mul(areas.ab, numbers.pick_row<2>(places, 2)));
                    const float depth_error = 8 * leaf.extent * area_error;
                    const auto surely =
                        surely_hit(leaf, areas, depth, {corner_error, area_error, depth_error}, max_time);
                    result.proven |= bits_of(surely) << lane & possible;
                }
        }
        return result;
    }

    /// Twice the signed areas between the origin and the edges of projected triangles.
    struct Areas {
        V ab, bc, ca;

        HWY_INLINE V least() const { return hn::Min(hn::Min(ab, bc), ca); }
        HWY_INLINE V greatest() const { return hn::Max(hn::Max(ab, bc), ca); }
    };
    struct Errors {
        float corner, area;
        float depth;  ///< of the mean depth, times the whole area
    };

    /// With w the sum of the areas, the mean of the corners' depths, weighted by the areas, is off by at most twice the
    /// error of a corner, and 5 area_error / (w - 3 area_error) times the extent. Where w exceeds 0.004 times twice the
    /// area of the triangle, the slope of the ray is at least 0.0019. From this, and a distance of 0.01 times the
    /// extent, follow the conditions of decide_triangle. A comparison with NaN is false and proves nothing.
    HWY_INLINE BvhMask surely_hit(const MeshLeaf& leaf, const Areas& areas, V depth, const Errors& errors,
                                  float max_time) const {
        const V inside = hn::Set(bvh_tag, proof_factor_ * errors.area);
        const V whole = hn::Add(hn::Add(areas.ab, areas.bc), areas.ca);
        const V factor = hn::Div(hn::Set(bvh_tag, inverse_), whole), time = hn::Mul(depth, factor);
        const V error =
            hn::Add(hn::Set(bvh_tag, 4 * errors.corner), hn::Mul(hn::Set(bvh_tag, errors.depth), hn::Abs(factor)));
        const V earliest = hn::Sub(hn::Mul(time, hn::Set(bvh_tag, 1 - time_tolerance)), error);
        const V latest = hn::Add(hn::Mul(time, hn::Set(bvh_tag, 1 + time_tolerance)), error);
        const V min_whole = hn::Set(bvh_tag, std::max(16 * errors.area, leaf.min_area));
        const auto passes = hn::Or(hn::Gt(areas.least(), inside), hn::Lt(areas.greatest(), hn::Neg(inside)));
        const auto clearly = hn::And(passes, hn::Gt(hn::Abs(whole), min_whole));
        const auto faces = hn::Lt(hn::Mul(factor, hn::Set(bvh_tag, facing_)), hn::Set(bvh_tag, 1.0f));
        const auto within = hn::And(hn::Gt(earliest, hn::Set(bvh_tag, 0.01f * leaf.extent)),
                                    hn::Lt(latest, hn::Set(bvh_tag, max_time)));
        return hn::And(hn::And(clearly, faces), within);
    }

    /// The bits of a vector of lanes.
    static constexpr std::uint32_t lanes_from(std::uint32_t lane) { return ((1u << bvh_step) - 1) << lane; }
    HWY_INLINE V from_origin(const MeshLeaf& leaf, int i, std::uint32_t lane) const {
        return hn::Sub(hn::Load(bvh_tag, row_at(&leaf, row_[i]) + lane), origin_[i]);
    }
    static HWY_INLINE V signed_area(const V2& a, const V2& b) { return hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x)); }

    std::size_t row_[3];  ///< rows of the corners: the two axes across and the one along
    V origin_[3], slope_[2];
    float from_, inverse_;  ///< of the origin and the direction along the dominant axis
    float origin_error_;
    float proof_factor_;  ///< how far inside a proven hit is, in errors
    float facing_;        ///< times a number that is negative in front of a triangle, it is less than 1
};

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
