#include <abut/convex/pairs/box3.hpp>
#include <abut/convex/pairs/box_axes.hpp>
#include <abut/math/simd/rotation-inl.h>
#include <abut/query/detail/closed_form/box_features.hpp>
#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/detail/write_answer.hpp>

namespace abut::detail {
namespace {

using lanes::Double2;
using lanes::Double3;

/// Two placed boxes, and B in the frame of A.
struct Boxes {
    lanes::Turned turn_a, turn_b;
    Double3 half_a, half_b, between;  ///< `between` is in the world
    Double3 axis_b[3], middle;        ///< in the frame of A

    Boxes(const Box3& a, const Box3& b)
        : turn_a(lanes::turned(a.rotation)),
          turn_b(lanes::turned(b.rotation)),
          half_a(lanes::loaded(a.half)),
          half_b(lanes::loaded(b.half)),
          between(lanes::loaded(b.center) - lanes::loaded(a.center)),
          axis_b{turn_a.transposed(turn_b.first_column()), turn_a.transposed(turn_b.second_column()),
                 turn_a.transposed(turn_b.last_column())},
          middle(turn_a.transposed(between)) {}

    /// Whether both boxes have volume, like `has_volume`.
    bool have_volume() const {
        const Double2 x = lanes::lower(half_a.xy, half_b.xy), y = lanes::upper(half_a.xy, half_b.xy);
        const Double2 z = lanes::lower(half_a.z, half_b.z);
        const Double2 largest = lanes::greater(lanes::greater(x, y), z),
                      smallest = lanes::lesser(lanes::lesser(x, y), z);
        return lanes::bits(smallest > largest * lanes::double2(static_cast<double>(1e-4f))) == 3;
    }

    /// Whether the cached separating axis still separates the boxes by more than `reach`, as for their views.
    bool separated_along(const std::array<float, 3>& axis_of_cache, double reach) const {
        const Double3 axis{lanes::loaded(axis_of_cache.data()), lanes::loaded_twice(axis_of_cache[2])};
        const double apart = dot(axis, between)[0];
        const double covered =
            (dot(magnitude(turn_a.transposed(axis)), half_a) + dot(magnitude(turn_b.transposed(axis)), half_b))[0];
        const double tolerance = 1e-14 * (std::abs(apart) + covered) + 1e-6 * reach;
        return apart - covered > reach + tolerance && apart <= std::numeric_limits<double>::max() &&
               dot(axis, axis)[0] < 1 + 1e-6;
    }
};

/// The gaps along the face normals, like `widest_face_gap`.
struct FaceGaps {
    Double2 a_xy, a_z, b_xy, b_z;
    Double3 sizes[3];

    explicit FaceGaps(const Boxes& boxes)
        : sizes{magnitude(boxes.axis_b[0]), magnitude(boxes.axis_b[1]), magnitude(boxes.axis_b[2])} {
        const Double3 &half_a = boxes.half_a, &half_b = boxes.half_b;
        const Double3 reach_a =
            half_a + sizes[0] * lanes::first(half_b.xy) + sizes[1] * lanes::second(half_b.xy) + sizes[2] * half_b.z;
        const Double3 gap_a = magnitude(boxes.middle) - reach_a;
        a_xy = gap_a.xy;
        a_z = gap_a.z;
    }
    void add_those_of_b(const Boxes& boxes) {
        const Double3& half_b = boxes.half_b;
        Double2 apart[3], reach_b[3];
        for (std::size_t i = 0; i < 3; ++i) {
            apart[i] = lanes::magnitude(dot(boxes.axis_b[i], boxes.middle));
            reach_b[i] = dot(sizes[i], boxes.half_a);
        }
        b_xy = lanes::lower(apart[0], apart[1]) - (half_b.xy + lanes::lower(reach_b[0], reach_b[1]));
        b_z = apart[2] - (half_b.z + reach_b[2]);
    }

    /// The gaps of A depend on all numbers of both boxes.
    bool finite() const { return lanes::finite(a_xy + a_z); }
    bool a_wider_than(double reach) const {
        return lanes::bits(lanes::greater(a_xy, a_z) > lanes::double2(reach)) != 0;
    }
    bool wider_than(double reach) const {
        const Double2 largest = lanes::greater(lanes::greater(a_xy, b_xy), lanes::greater(a_z, b_z));
        return lanes::bits(largest > lanes::double2(reach)) != 0;
    }
    BoxFaceGap widest() const {
        std::array<double, 6> gaps;
        lanes::put(a_xy, &gaps[0]);
        gaps[2] = a_z[0];
        lanes::put(b_xy, &gaps[3]);
        gaps[5] = b_z[0];
        return widest_of(gaps);
    }
};

void put(const Double3& v, double* numbers) {
    lanes::put(v.xy, numbers);
    numbers[2] = v.z[0];
}

void set_frame(const Boxes& boxes, BoxFrame& frame) {
    put(boxes.half_a, frame.half_a.data());
    put(boxes.half_b, frame.half_b.data());
    for (std::size_t i = 0; i < 3; ++i) put(boxes.axis_b[i], frame.axis_b[i].data());
    put(boxes.middle, frame.middle.data());
}

void set_place(const Box3& box, const lanes::Turned& turn, Affine<3>& place) {
    put(turn.first_column(), &place.column[0].x);
    put(turn.second_column(), &place.column[1].x);
    put(turn.last_column(), &place.column[2].x);
    put(lanes::loaded(box.center), &place.offset.x);
}

const Feature& feature_of(const BoxFeature& part) {
    return box_features[(part.free ^ 7u) + 8 * part.low];
}

}  // namespace

ClosedFormAnswer closed_form_overlap(const Box3& a, const Box3& b) {
    const Boxes boxes(a, b);
    FaceGaps gaps(boxes);
    if (!boxes.have_volume() || !gaps.finite()) return ClosedFormAnswer::unknown;
    if (gaps.a_wider_than(0)) return ClosedFormAnswer::no;
    gaps.add_those_of_b(boxes);
    if (gaps.wider_than(0)) return ClosedFormAnswer::no;
    BoxFrame frame;
    set_frame(boxes, frame);
    return BoxEdgeGaps(frame, 0).apart ? ClosedFormAnswer::no : ClosedFormAnswer::yes;
}

bool closed_form_contact(const Box3& a, const Box3& b, double margin, Cache* cache, Contact<3>& result) {
    const Boxes boxes(a, b);
    if (!boxes.have_volume()) return false;
    if (cache != nullptr && margin >= 0 && boxes.separated_along(cache->axis, margin)) return true;
    FaceGaps gaps(boxes);
    if (!gaps.finite()) return false;
    gaps.add_those_of_b(boxes);
    BoxFrame frame;
    set_frame(boxes, frame);
    Affine<3> place_a, place_b;
    set_place(a, boxes.turn_a, place_a);
    set_place(b, boxes.turn_b, place_b);
    BoxClosest closest;
    SignedDistance<3> distance;
    Manifold<3> points;
    const BoxContact contact = contact_in_frame(frame, gaps.widest(), BoxPlacement(place_a), BoxPlacement(place_b),
                                                margin, margin, cache, closest, distance, points);
    if (contact == BoxContact::unknown) return false;
    if (contact == BoxContact::none) return true;
    write(distance, points, result);
    result.feature_a = feature_of(closest.part_a);
    result.feature_b = feature_of(closest.part_b);
    return true;
}

}  // namespace abut::detail
