// The order of half-planes around an edge.

#include <abut/math/detail/exact_orientation.hpp>
#include <abut/query/detail/solid/placed_solid.hpp>

#include <algorithm>
#include <utility>

namespace abut::detail {

void EdgeFan::each(FunctionRef<void(const FanBlade& blade)> visit) const {
    if (count_ <= stored_.size()) {
        for (std::size_t i = 0; i < count_; ++i) visit(stored_[i]);
        return;
    }
    solid_->each_blade(triangle_, own_side_, [&](std::uint32_t, const FanBlade& blade) {
        visit(is_reversed_ ? FanBlade{blade.point, blade.inside_after, blade.inside_before} : blade);
        return true;
    });
}

EdgeFan EdgeFan::reversed() const {
    EdgeFan result = *this;
    std::swap(result.from, result.to);
    result.is_reversed_ = !is_reversed_;
    for (std::size_t i = 0; i < std::min(count_, stored_.size()); ++i)
        std::swap(result.stored_[i].inside_before, result.stored_[i].inside_after);
    return result;
}

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
    /// -1, 0 or 1 if a comes before b, at the same angle, or after it. Neither angle is 0.
    int order(const DVec<3>& a, const DVec<3>& b) const {
        const int class_a = class_of(a), class_b = class_of(b);
        if (class_a != class_b) return class_a < class_b ? -1 : 1;
        return class_a == 2 ? 0 : -exact_side(from_, to_, a, b);
    }

private:
    DVec<3> from_, to_, start_;
    int turn_ = 0, axis_ = 0;
};

/// Whether a solid is inside on either side of a half-plane.
struct Sides {
    bool before = false, after = false;
};

DVec<3> first_point(const EdgeFan& fan) {
    std::optional<DVec<3>> first;
    fan.each([&](const FanBlade& blade) {
        if (!first) first = blade.point;
    });
    return first.value_or(fan.to);
}

/// Winding numbers of the sectors of a fan, relative to that after its first blade. The lowest sector is outside, and
/// all that wind more are inside.
class FanWinding {
public:
    explicit FanWinding(const EdgeFan& fan) : fan_(fan), angles_(fan, first_point(fan)) {
        fan.each([&](const FanBlade& blade) { lowest_ = std::min(lowest_, around(blade.point).after); });
    }

    Sides sides_at(const DVec<3>& point) const {
        const Winding winding = around(point);
        // The back of a blade is inside, although another one on it may face the other direction.
        Sides result{winding.before > lowest_, winding.after > lowest_};
        const AnglesFrom angles(fan_, point);
        fan_.each([&](const FanBlade& blade) {
            if (angles.class_of(blade.point) != 0) return;
            result.before = result.before || blade.inside_before;
            result.after = result.after || blade.inside_after;
        });
        return result;
    }

private:
    struct Winding {
        int before = 0, after = 0;
    };

    Winding around(const DVec<3>& point) const {
        Winding result;
        const bool is_first = angles_.class_of(point) == 0;
        fan_.each([&](const FanBlade& blade) {
            if (angles_.class_of(blade.point) == 0) return;
            const int change = (blade.inside_after ? 1 : 0) - (blade.inside_before ? 1 : 0);
            const int order = is_first ? -1 : angles_.order(blade.point, point);
            if (order < 0) result.before += change;
            if (order <= 0 && !is_first) result.after += change;
        });
        return result;
    }

    const EdgeFan& fan_;
    AnglesFrom angles_;
    int lowest_ = 0;
};

}  // namespace

bool fans_overlap(const EdgeFan& a, const EdgeFan& b) {
    const FanWinding winding_a(a), winding_b(b);
    bool found = false;
    const auto test = [&](const FanBlade& blade) {
        if (found) return;
        const Sides in_a = winding_a.sides_at(blade.point), in_b = winding_b.sides_at(blade.point);
        found = (in_a.before && in_b.before) || (in_a.after && in_b.after);
    };
    a.each(test);
    b.each(test);
    return found;
}

}  // namespace abut::detail
