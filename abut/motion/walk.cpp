#include <abut/motion/get_out.hpp>
#include <abut/motion/walk.hpp>

#include <array>

namespace abut {
namespace {

/// The bound on turns of one move.
constexpr int most_turns = 8;

/// Ways are swept by a shape grown by this part of the skin; planes are kept to by all of it, so that what slides along
/// a plane doesn't touch it.
constexpr double swept_skin = 0.5;

/// It is pushed out of what is nearer than this part of the skin. Less than what sweeps keep to, so that what has come
/// to rest isn't pushed.
constexpr double pushed_skin = 0.25;

/// Sides of one part whose normals differ by more are touches of their own.
constexpr double same_side = 0.9;

/// What is less than this part of the skin is no way at all.
constexpr double no_way = 1e-5;

}  // namespace

template <int D>
bool Walk<D>::is_ground(const NearContact<D>& contact, double lowest) {
    const double rise = dot(contact.normal, rules_.up);
    if (rise >= rules_.least_rise) return true;
    if (rise < 1e-3) return false;
    // An edge low enough to step on, of something level.
    if (dot(rules_.up, contact.point) - lowest > rules_.step_height) return false;
    const std::optional<DVec<D>> above = near_.normal_above(contact.point, rules_.up);
    return above && dot(*above, rules_.up) >= rules_.least_rise;
}

/// The most level one; of equals, the first.
template <int D>
const NearContact<D>* Walk<D>::ground() {
    const NearContact<D>* result = nullptr;
    double most = 0;
    for (const NearContact<D>& contact : contacts()) {
        const double rise = dot(contact.normal, rules_.up);
        if (rise <= most || !is_ground(contact)) continue;
        result = &contact;
        most = rise;
    }
    return result;
}

template <int D>
const NearContact<D>* Walk<D>::groove() {
    bool wall = false;
    if (rules_.up == DVec<D>(0.0)) return nullptr;
    const DVec<D> down = rules_.up * -rules_.skin;
    if (length(allowed_by_planes(down, wall)) > 1e-3 * rules_.skin) return nullptr;
    const std::span<const NearContact<D>> all = contacts();
    return &*std::max_element(all.begin(), all.end(), [&](const NearContact<D>& a, const NearContact<D>& b) {
        return dot(a.normal, rules_.up) < dot(b.normal, rules_.up);
    });
}

template <int D>
DVec<D> Walk<D>::get_out() {
    const WayOut<D> way = way_out(near_, at_, pushed_skin * rules_.skin, swept_skin * rules_.skin, 2 * rules_.skin);
    depth_ = way.depth;
    at_ += way.push;
    return way.push;
}

template <int D>
void Walk<D>::go_along(const DVec<D>& move) {
    const std::optional<FirstTouch<D>> stop = near_.first_touch(at_, move, pushed_skin * rules_.skin);
    at_ += move * (stop ? stop->fraction : 1.0);
}

/// As fast along the slope as was asked on the level.
template <int D>
DVec<D> Walk<D>::along_ground(const DVec<D>& motion, const NearContact<D>& ground) const {
    const DVec<D> ahead = level(motion);
    const double rise = dot(ground.normal, rules_.up), speed = length(ahead);
    if (rise < rules_.least_rise || !(speed > 0)) return ahead;
    return normalized(ahead - rules_.up * (dot(ahead, ground.normal) / rise)) * speed;
}

template <int D>
DVec<D> Walk<D>::allowed_by_planes(const DVec<D>& wanted, bool& wall) {
    std::array<MovePlane<D>, most_move_planes> planes;
    std::size_t count = 0;
    const auto add = [&](const DVec<D>& normal, double room) {
        if (count < planes.size()) planes[count++] = {normal, room};
    };
    if (extra_) add(extra_->normal, extra_->room);
    for (const NearContact<D>& contact : contacts()) {
        const double room = std::max(contact.gap - rules_.skin, 0.0);
        add(contact.normal, room);
        if (is_ground(contact)) continue;
        // What is too steep is no way up.
        const DVec<D> beside = level(contact.normal);
        const double across = length(beside);
        if (across < 1e-3) continue;
        if (dot(contact.normal, rules_.up) > 1e-3) add(beside / across, room / across);
        if (dot(beside, wanted) < 0) wall = true;
    }
    DVec<D> move(0.0);
    const double tolerance = 1e-9 * rules_.skin;
    if (!nearest_move<D>(std::span<const MovePlane<D>>(planes.data(), count), wanted, tolerance, move))
        return DVec<D>(0.0);
    return move;
}

/// Edges that are low enough to step on are slid over. A slope goes on, but the plane of an edge does so where the edge
/// has ended: no more of it is of use than takes the lowest point up to the highest of them.
template <int D>
double Walk<D>::part_to_edges(const DVec<D>& move, const DVec<D>& asked) {
    const double rises = dot(move - asked, rules_.up);
    if (!(rises > rules_.skin)) return 1;
    const double lowest = lowest_at(at_);
    double highest = -1;
    for (const NearContact<D>& contact : contacts()) {
        const double rise = dot(contact.normal, rules_.up);
        if (rise > 1 - 1e-9 || !(dot(level(contact.normal), move) < 0) || !is_ground(contact, lowest)) continue;
        highest = std::max({highest, dot(rules_.up, contact.point) - lowest, 0.0});
        if (rises <= highest + rules_.skin) return 1;
        const std::optional<DVec<D>> above = near_.normal_above(contact.point, rules_.up);
        if (!above || dot(*above, rules_.up) < rise + 1e-3) return 1;
    }
    return highest < 0 ? 1 : (highest + rules_.skin) / rises;
}

template <int D>
void Walk<D>::slide(const DVec<D>& motion) {
    const double still = no_way * rules_.skin;
    const bool walks = dot(motion, rules_.up) <= 1e-6 * length(motion);
    DVec<D> rest = motion;
    for (int turn = 0; turn < most_turns && length(rest) > still; ++turn) {
        const NearContact<D>* stands_on = walks ? ground() : nullptr;
        const bool on_ground = stands_on != nullptr;
        const DVec<D> wanted = on_ground ? along_ground(rest, *stands_on) : rest;
        bool wall = false;
        DVec<D> move = allowed_by_planes(wanted, wall);
        if (on_ground && wall) {
            const DVec<D> ahead = level(rest);
            const double asked = length(ahead), goes = asked > 0 ? dot(move, ahead) / asked : 0;
            const DVec<D> before = at_;
            if (goes < 0.99 * asked && climb(ahead, std::max(goes, 0.0))) {
                rest = ahead * std::max(0.0, 1 - length(level(at_ - before)) / asked);
                extra_.reset();
                continue;
            }
        }
        const double part = walks ? part_to_edges(move, rest) : 1;
        move *= part;
        const double way = length(move);
        if (way <= still) break;
        const std::optional<FirstTouch<D>> stop = near_.first_touch(at_, move, swept_skin * rules_.skin);
        if (!stop) {
            at_ += move;
            rest *= 1 - part;
            extra_.reset();
            continue;
        }
        tell(stop->contact);
        at_ += move * stop->fraction;
        rest *= 1 - stop->fraction * part;
        extra_.reset();
        if (stop->fraction * way <= still) extra_ = MovePlane<D>{stop->contact.normal, 0.0};
    }
    extra_.reset();
}

/// Up, ahead and down again, if that goes farther than without and ends on ground.
template <int D>
bool Walk<D>::climb(const DVec<D>& ahead, double without) {
    const double grown_by = swept_skin * rules_.skin, asked = length(ahead);
    if (!(rules_.step_height > 0)) return false;
    const DVec<D> before = at_, lift = rules_.up * rules_.step_height;
    const auto fraction = [&](const DVec<D>& from, const DVec<D>& move) {
        const std::optional<FirstTouch<D>> stop = near_.first_touch(from, move, grown_by);
        return stop ? stop->fraction : 1.0;
    };
    const DVec<D> raised = before + lift * fraction(before, lift);
    const double rise = dot(raised - before, rules_.up);
    if (rise < rules_.skin) return false;
    const double goes = fraction(raised, ahead);
    if (goes * asked <= without + 1e-3 * asked) return false;
    const DVec<D> over = raised + ahead * goes;
    const std::optional<FirstTouch<D>> landing = near_.first_touch(over, rules_.up * -rise, grown_by);
    at_ = over - rules_.up * (rise * (landing ? landing->fraction : 1.0));
    if (!landing || is_ground(landing->contact, lowest_at(before))) return true;
    at_ = before;
    return false;
}

template <int D>
void Walk<D>::stick() {
    if (!(rules_.stick > 0)) return;
    const DVec<D> down = rules_.up * -rules_.stick, before = at_;
    const std::optional<FirstTouch<D>> landing = near_.first_touch(at_, down, swept_skin * rules_.skin);
    if (!landing) return;
    // It is as near as planes keep it, or nearer: it stays.
    const double way = landing->fraction * rules_.stick;
    if (way < 0.75 * rules_.skin) return;
    at_ += down * (1 - 0.25 * rules_.skin / way) * landing->fraction;
    if (!is_ground(landing->contact)) at_ = before;
}

template <int D>
DVec<D> Walk<D>::allowed(const DVec<D>& motion) {
    const NearContact<D>* stands_on = dot(motion, rules_.up) <= 0 ? ground() : nullptr;
    bool wall = false;
    return allowed_by_planes(stands_on != nullptr ? level(motion) : motion, wall);
}

template <int D>
void Walk<D>::tell_contacts() {
    for (const NearContact<D>& contact : contacts()) tell(contact);
}

template <int D>
void Walk<D>::tell(const NearContact<D>& contact) {
    const auto name = [](const MoverTouch<D>& touch) { return PartName{touch.id, touch.feature.part}; };
    auto place =
        std::lower_bound(touches_.begin(), touches_.end(), contact.name,
                         [&](const MoverTouch<D>& touch, const PartName& wanted) { return name(touch) < wanted; });
    const auto is_part = [&] { return place != touches_.end() && name(*place) == contact.name; };
    if (contact.has_sides)
        while (is_part() && dot(DVec<D>(place->normal), contact.normal) < same_side) ++place;
    MoverTouch<D> touch;
    touch.id = contact.name.id;
    touch.feature = contact.feature;
    touch.point = to_float(contact.point);
    touch.normal = to_float(contact.normal);
    touch.is_ground = is_ground(contact);
    if (is_part())
        *place = touch;
    else
        touches_.insert(place, touch);
}

template class Walk<2>;
template class Walk<3>;

}  // namespace abut
