// Clips the four edges of B's face, and tests the four corners of A's, in SIMD. Highway compiles this file once for
// each target; lanes are independent, and rounding is the same on all targets.

#include <abut/convex/manifold/box_face_clip.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/convex/manifold/box_face_clip.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef ABUT_CONVEX_BOX_PATCH_LANES
#define ABUT_CONVEX_BOX_PATCH_LANES
namespace abut::detail {

/// A point in front of a face, by its coordinates along the face and along the normal.
struct FacePoint {
    double x, y, gap;
};

/// The middle of B's face and its half edges, relative to A's face.
struct FacePair {
    FacePoint middle, edge, other;
    double half_x, half_y;  ///< of A's face
    double tolerance;       ///< points no farther beyond the border are included
};

/// In groups of four: where the edges of B enter A's face, where they leave it, and the corners of A.
struct ClipPoints {
    std::array<double, 12> x, y, gap;
    std::uint32_t counts;                          ///< bits of the valid points
    std::uint32_t starts, by_x, falls_x, falls_y;  ///< bits of the edges, the upper four for leaving
};

}  // namespace abut::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void clip_faces(const FacePair& face, ClipPoints& points) {
    const hn::CappedTag<double, 4> d;
    using Vector = hn::Vec<decltype(d)>;
    const auto all = [&](double value) { return hn::Set(d, value); };
    const auto bits = [&](auto mask, std::size_t from) {
        std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(d, mask, bytes);
        return static_cast<std::uint32_t>(bytes[0]) << from;
    };
    // Corner i of B's face with the edge from it; corner i of A's.
    HWY_ALIGN static constexpr double along_edge[4] = {1, -1, -1, 1}, along_other[4] = {1, 1, -1, -1};
    HWY_ALIGN static constexpr double step_edge[4] = {-2, 0, 2, 0}, step_other[4] = {0, -2, 0, 2};
    HWY_ALIGN static constexpr double side_x[4] = {1, -1, 1, -1}, side_y[4] = {1, 1, -1, -1};

    const auto& [middle, edge, other, half_x, half_y, tolerance] = face;
    const double area = edge.x * other.y - edge.y * other.x, per_area = area == 0 ? 0 : 1 / area;
    // A point on the border counts as inside, with a wider tolerance than a corner of A inside of B's face.
    const double within = area == 0 ? -1 : 1 - 1e-13;
    const Vector zero = hn::Zero(d), one = all(1), tiny = all(1e-300);
    points.counts = points.starts = points.by_x = points.falls_x = points.falls_y = 0;
    for (std::size_t i = 0; i < 4; i += hn::Lanes(d)) {
        const Vector to_edge = hn::Load(d, along_edge + i), to_other = hn::Load(d, along_other + i);
        const Vector step_to_edge = hn::Load(d, step_edge + i), step_to_other = hn::Load(d, step_other + i);
        const auto from = [&](double m, double w, double o) {
            return hn::Add(hn::Add(all(m), hn::Mul(all(w), to_edge)), hn::Mul(all(o), to_other));
        };
        const auto step = [&](double w, double o) {
            return hn::Add(hn::Mul(all(w), step_to_edge), hn::Mul(all(o), step_to_other));
        };
        const Vector from_x = from(middle.x, edge.x, other.x), from_y = from(middle.y, edge.y, other.y),
                     from_gap = from(middle.gap, edge.gap, other.gap);
        const Vector step_x = step(edge.x, other.x), step_y = step(edge.y, other.y),
                     step_gap = step(edge.gap, other.gap);

        // An edge along the border is inside over all its length, or nowhere.
        const auto inverse = [&](Vector v) { return hn::Div(one, hn::IfThenElse(hn::Eq(v, zero), tiny, v)); };
        const Vector one_x = inverse(step_x), one_y = inverse(step_y);
        const Vector low_x = hn::Mul(hn::Sub(all(-half_x - tolerance), from_x), one_x),
                     high_x = hn::Mul(hn::Sub(all(half_x + tolerance), from_x), one_x),
                     low_y = hn::Mul(hn::Sub(all(-half_y - tolerance), from_y), one_y),
                     high_y = hn::Mul(hn::Sub(all(half_y + tolerance), from_y), one_y);
        const auto falls_x = hn::Lt(one_x, zero), falls_y = hn::Lt(one_y, zero);
        const Vector enter_x = hn::IfThenElse(falls_x, high_x, low_x), leave_x = hn::IfThenElse(falls_x, low_x, high_x);
        const Vector enter_y = hn::IfThenElse(falls_y, high_y, low_y), leave_y = hn::IfThenElse(falls_y, low_y, high_y);
        const auto enters_x = hn::Gt(enter_x, enter_y), leaves_x = hn::Lt(leave_x, leave_y);
        const Vector enter = hn::IfThenElse(enters_x, enter_x, enter_y),
                     leave = hn::IfThenElse(leaves_x, leave_x, leave_y);
        const auto starts = hn::Le(enter, zero);
        const Vector start = hn::IfThenElse(starts, zero, enter);
        const auto visible = hn::And(hn::And(hn::Le(enter, leave), hn::Le(enter, one)), hn::Ge(leave, zero));
        const auto leaves = hn::And(visible, hn::And(hn::Lt(leave, one), hn::Gt(leave, start)));

        const auto put = [&](std::size_t at, Vector x, Vector y, Vector gap) {
            hn::StoreU(x, d, &points.x[at]);
            hn::StoreU(y, d, &points.y[at]);
            hn::StoreU(gap, d, &points.gap[at]);
        };
        const auto along = [&](std::size_t at, Vector t) {
            put(at, hn::Add(from_x, hn::Mul(step_x, t)), hn::Add(from_y, hn::Mul(step_y, t)),
                hn::Add(from_gap, hn::Mul(step_gap, t)));
        };
        along(i, start);
        along(4 + i, leave);

        // The corners of A's face in the coordinates of B's edges.
        const Vector px = hn::Mul(all(half_x), hn::Load(d, side_x + i)),
                     py = hn::Mul(all(half_y), hn::Load(d, side_y + i));
        const Vector dx = hn::Sub(px, all(middle.x)), dy = hn::Sub(py, all(middle.y));
        const Vector s = hn::Mul(hn::Sub(hn::Mul(dx, all(other.y)), hn::Mul(dy, all(other.x))), all(per_area));
        const Vector t = hn::Mul(hn::Sub(hn::Mul(all(edge.x), dy), hn::Mul(all(edge.y), dx)), all(per_area));
        put(8 + i, px, py, hn::Add(all(middle.gap), hn::Add(hn::Mul(all(edge.gap), s), hn::Mul(all(other.gap), t))));
        const auto inside = hn::And(hn::Lt(hn::Abs(s), all(within)), hn::Lt(hn::Abs(t), all(within)));

        points.counts |= bits(visible, i) | bits(leaves, 4 + i) | bits(inside, 8 + i);
        points.starts |= bits(starts, i);
        points.by_x |= bits(enters_x, i) | bits(leaves_x, 4 + i);
        points.falls_x |= bits(falls_x, i);
        points.falls_y |= bits(falls_y, i);
    }
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

HWY_EXPORT(clip_faces);

BoxFaceClip::BoxFaceClip(const BoxFrame& frame, const Triple& out) : axis(steepest(out)) {
    const std::size_t u = next_axis(axis), v = last_axis(axis);
    const double sign = out[axis] < 0 ? -1 : 1, per_height = 1 / out[axis];
    side = frame.half_a[axis] * sign;
    const auto project = [&](const Triple& p, double times, FacePoint& place) {
        const double height = p[axis] * per_height;
        place.x = (p[u] - out[u] * height) * times;
        place.y = (p[v] - out[v] * height) * times;
        place.gap = height * times;
    };

    const Triple rotated = frame.along_b(out);
    const std::size_t across = steepest(rotated), first = next_axis(across), second = last_axis(across);
    const double face_half = rotated[across] > 0 ? -frame.half_b[across] : frame.half_b[across];
    Triple middle;
    for (std::size_t i = 0; i < 3; ++i) middle[i] = frame.middle[i] + frame.axis_b[across][i] * face_half;
    middle[axis] -= side;
    FacePair face;
    project(middle, 1, face.middle);
    project(frame.axis_b[first], frame.half_b[first], face.edge);
    project(frame.axis_b[second], frame.half_b[second], face.other);
    face.half_x = frame.half_a[u];
    face.half_y = frame.half_a[v];
    face.tolerance = 1e-12 * (face.half_x + face.half_y + frame.half_b[first] + frame.half_b[second]);
    ClipPoints points;
    HWY_DYNAMIC_DISPATCH(clip_faces)(face, points);

    const std::uint32_t low = face_half < 0 ? 1u << across : 0u, first_bit = 1u << first, second_bit = 1u << second;
    corners_ = {low, low | first_bit, low | first_bit | second_bit, low | second_bit};
    starts_ = points.starts;
    by_x_ = points.by_x;
    falls_x_ = points.falls_x;
    falls_y_ = points.falls_y;
    // All are written, and invalid ones are overwritten: a branch can't be predicted.
    for (std::uint32_t i = 0; i < 12; ++i) {
        x[count] = points.x[i];
        y[count] = points.y[i];
        gap[count] = points.gap[i];
        made_by_[count] = i;
        count += points.counts >> i & 1u;
    }
}

// The name of a corner of B's face is its number; of a corner of A's face, 1 << 16 and its number; of a crossing, 2 +
// the side of A's face << 16 and the two corners of B's edge.
std::uint32_t BoxFaceClip::name(std::size_t i) const {
    const std::uint32_t maker = made_by_[i];
    if (maker >= 8) return 1u << 16 | (maker - 8);
    const std::uint32_t from = maker & 3u, leaves = maker >> 2;
    if (leaves == 0 && (starts_ >> from & 1u) != 0) return corners_[from];
    const bool by_x = (by_x_ >> maker & 1u) != 0;
    const std::uint32_t falls = (by_x ? falls_x_ : falls_y_) >> from & 1u;
    const std::uint32_t crossed = (by_x ? 0u : 2u) | (falls ^ leaves);
    const std::uint32_t to = corners_[(from + 1) % 4];
    return (2 + crossed) << 16 | (corners_[from] | to) << 4 | (corners_[from] & to);
}

}  // namespace abut::detail
#endif
