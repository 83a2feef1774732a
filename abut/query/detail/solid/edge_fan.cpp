#include <abut/math/detail/exact_orientation.hpp>
#include <abut/query/detail/solid/edge_fan.hpp>

#include <utility>

namespace abut::detail {
namespace {

/// Angles around the axis of a fan, counter-clockwise from a half-plane through `start`.
class AnglesFrom {
public:
    AnglesFrom(const EdgeFan& fan, const DVec<3>& start) : from_(fan.from), to_(fan.to), start_(start) {
        for (int i = 0; i < 3; ++i) {
            turn_ = exact_turn(from_, to_, start_, i);
            axis_ = i;
            if (turn_ != 0) break;
        }
    }

    /// 0: the angle is 0, 1: less than half a turn, 2: half a turn, 3: more.
    int class_of(const DVec<3>& point) const {
        const int side = exact_side(from_, to_, start_, point);
        if (side != 0) return side > 0 ? 1 : 3;
        return exact_turn(from_, to_, point, axis_) == turn_ ? 0 : 2;
    }
    /// Whether a comes before b. Neither angle is 0.
    bool before(const DVec<3>& a, const DVec<3>& b) const {
        const int class_a = class_of(a), class_b = class_of(b);
        if (class_a != class_b) return class_a < class_b;
        return class_a != 2 && exact_side(from_, to_, a, b) > 0;
    }

private:
    const DVec<3>&from_, &to_, &start_;
    int turn_ = 0, axis_ = 0;
};

/// Whether a fan has a blade through the point, and is inside on the given side of it.
struct BladeSides {
    bool found = false, inside_before = false, inside_after = false;
};

BladeSides blade_at(const EdgeFan& fan, const DVec<3>& point) {
    const AnglesFrom angles(fan, point);
    BladeSides result;
    for (const FanBlade& blade : fan.all()) {
        if (angles.class_of(blade.point) != 0) continue;
        result.found = true;
        result.inside_before = result.inside_before || blade.inside_before;
        result.inside_after = result.inside_after || blade.inside_after;
    }
    return result;
}

/// Whether the half-plane through a point that no blade goes through is inside.
bool has_inside(const EdgeFan& fan, const DVec<3>& point) {
    if (fan.count < 2) return false;
    const AnglesFrom angles(fan, point);
    const FanBlade* next = nullptr;
    for (const FanBlade& blade : fan.all())
        if (next == nullptr || angles.before(blade.point, next->point)) next = &blade;
    return next->inside_before;
}

bool has_blade_inside(const EdgeFan& a, const EdgeFan& b) {
    for (const FanBlade& blade : a.all()) {
        const BladeSides same = blade_at(b, blade.point);
        if (same.found) {
            if ((same.inside_before && blade.inside_before) || (same.inside_after && blade.inside_after)) return true;
        } else if (has_inside(b, blade.point)) {
            return true;
        }
    }
    return false;
}

}  // namespace

bool fans_overlap(const EdgeFan& a, const EdgeFan& b) {
    return has_blade_inside(a, b) || has_blade_inside(b, a);
}

EdgeFan reversed(const EdgeFan& fan) {
    EdgeFan result = fan;
    std::swap(result.from, result.to);
    for (std::size_t i = 0; i < fan.count; ++i)
        std::swap(result.blades[i].inside_before, result.blades[i].inside_after);
    return result;
}

}  // namespace abut::detail
