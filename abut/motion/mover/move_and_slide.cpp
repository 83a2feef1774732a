#include <abut/motion/mover/move_and_slide.hpp>
#include <abut/motion/push/push_out.hpp>

#include <array>

namespace abut::detail {
namespace {

/// Maximum number of slides in one move.
constexpr int max_iterations = 8;

/// Sweeps use the shape grown by this part of the skin. Planes use the full skin, so a shape that slides along a plane
/// doesn't touch it.
constexpr double swept_skin = 0.5;

/// Contacts nearer than this part of the skin push the mover out. It is less than the sweep's skin, so a resting mover
/// isn't pushed.
constexpr double pushed_skin = 0.25;

/// Planes of one part whose normals differ by more are separate contacts.
constexpr double same_side = 0.9;

/// A move shorter than this part of the skin is ignored.
constexpr double min_move = 1e-5;

}  // namespace

template <int D>
bool MoveAndSlide<D>::is_ground(const NearContact<D>& contact, double lowest) {
    const double rise = dot(contact.normal, settings_.up);
    if (rise >= settings_.min_rise) return true;
    if (rise < 1e-3) return false;
    // An edge low enough to step on, of a level surface.
    if (dot(settings_.up, contact.point) - lowest > settings_.step_height) return false;
    const std::optional<DVec<D>> above = near_.normal_above(contact.point, settings_.up);
    return above && dot(*above, settings_.up) >= settings_.min_rise;
}

/// The most level ground contact, the first of equals.
template <int D>
const NearContact<D>* MoveAndSlide<D>::ground() {
    const NearContact<D>* result = nullptr;
    double highest_rise = 0;
    for (const NearContact<D>& contact : contacts()) {
        const double rise = dot(contact.normal, settings_.up);
        if (rise <= highest_rise || !is_ground(contact)) continue;
        result = &contact;
        highest_rise = rise;
    }
    return result;
}

template <int D>
const NearContact<D>* MoveAndSlide<D>::supporting_groove() {
    bool wall = false;
    if (settings_.up == DVec<D>(0.0)) return nullptr;
    const DVec<D> down = settings_.up * -settings_.skin;
    if (length(allowed_by_planes(down, wall)) > 1e-3 * settings_.skin) return nullptr;
    const std::span<const NearContact<D>> all = contacts();
    return &*std::max_element(all.begin(), all.end(), [&](const NearContact<D>& a, const NearContact<D>& b) {
        return dot(a.normal, settings_.up) < dot(b.normal, settings_.up);
    });
}

template <int D>
DVec<D> MoveAndSlide<D>::separate() {
    const PushOut<D> out =
        push_out(near_, at_, pushed_skin * settings_.skin, swept_skin * settings_.skin, 2 * settings_.skin);
    depth_ = out.depth;
    at_ += out.push;
    return out.push;
}

template <int D>
void MoveAndSlide<D>::carry(const DVec<D>& move) {
    const std::optional<FirstTouch<D>> stop = near_.first_touch(at_, move, pushed_skin * settings_.skin);
    at_ += move * (stop ? stop->fraction : 1.0);
}

/// The motion along the slope at the requested speed.
template <int D>
DVec<D> MoveAndSlide<D>::along_ground(const DVec<D>& motion, const NearContact<D>& ground) const {
    const DVec<D> ahead = level(motion);
    const double rise = dot(ground.normal, settings_.up), speed = length(ahead);
    if (rise < settings_.min_rise || !(speed > 0)) return ahead;
    return normalized(ahead - settings_.up * (dot(ahead, ground.normal) / rise)) * speed;
}

template <int D>
DVec<D> MoveAndSlide<D>::allowed_by_planes(const DVec<D>& requested, bool& wall) {
    std::array<MovePlane<D>, max_move_planes> planes;
    std::size_t count = 0;
    const auto add = [&](const DVec<D>& normal, double clearance) {
        if (count < planes.size()) planes[count++] = {normal, clearance};
    };
    if (extra_) add(extra_->normal, extra_->clearance);
    for (const NearContact<D>& contact : contacts()) {
        const double clearance = std::max(contact.gap - settings_.skin, 0.0);
        add(contact.normal, clearance);
        if (is_ground(contact)) continue;
        // A steep slope also blocks as a vertical wall.
        const DVec<D> beside = level(contact.normal);
        const double across = length(beside);
        if (across < 1e-3) continue;
        if (dot(contact.normal, settings_.up) > 1e-3) add(beside / across, clearance / across);
        if (dot(beside, requested) < 0) wall = true;
    }
    DVec<D> move(0.0);
    const double tolerance = 1e-9 * settings_.skin;
    if (!nearest_move<D>(std::span<const MovePlane<D>>(planes.data(), count), requested, tolerance, move))
        return DVec<D>(0.0);
    return move;
}

/// Slides over edges that are low enough to step on. The plane of an edge extends beyond the edge, so the move is
/// limited to the height of the highest edge.
template <int D>
double MoveAndSlide<D>::fraction_to_edges(const DVec<D>& move, const DVec<D>& requested) {
    const double rises = dot(move - requested, settings_.up);
    if (!(rises > settings_.skin)) return 1;
    const double lowest = lowest_at(at_);
    double highest = -1;
    for (const NearContact<D>& contact : contacts()) {
        const double rise = dot(contact.normal, settings_.up);
        if (rise > 1 - 1e-9 || !(dot(level(contact.normal), move) < 0) || !is_ground(contact, lowest)) continue;
        highest = std::max({highest, dot(settings_.up, contact.point) - lowest, 0.0});
        if (rises <= highest + settings_.skin) return 1;
        const std::optional<DVec<D>> above = near_.normal_above(contact.point, settings_.up);
        if (!above || dot(*above, settings_.up) < rise + 1e-3) return 1;
    }
    return highest < 0 ? 1 : (highest + settings_.skin) / rises;
}

template <int D>
void MoveAndSlide<D>::slide(const DVec<D>& motion) {
    const double still = min_move * settings_.skin;
    const bool walks = dot(motion, settings_.up) <= 1e-6 * length(motion);
    DVec<D> rest = motion;
    for (int i = 0; i < max_iterations && length(rest) > still; ++i) {
        const NearContact<D>* stands_on = walks ? ground() : nullptr;
        const bool on_ground = stands_on != nullptr;
        const DVec<D> target = on_ground ? along_ground(rest, *stands_on) : rest;
        bool wall = false;
        DVec<D> move = allowed_by_planes(target, wall);
        if (on_ground && wall) {
            const DVec<D> ahead = level(rest);
            const double requested_length = length(ahead),
                         goes = requested_length > 0 ? dot(move, ahead) / requested_length : 0;
            const DVec<D> before = at_;
            if (goes < 0.99 * requested_length && climb_step(ahead, std::max(goes, 0.0))) {
                rest = ahead * std::max(0.0, 1 - length(level(at_ - before)) / requested_length);
                extra_.reset();
                continue;
            }
        }
        const double fraction = walks ? fraction_to_edges(move, rest) : 1;
        move *= fraction;
        const double distance = length(move);
        if (distance <= still) break;
        const std::optional<FirstTouch<D>> stop = near_.first_touch(at_, move, swept_skin * settings_.skin);
        if (!stop) {
            at_ += move;
            rest *= 1 - fraction;
            extra_.reset();
            continue;
        }
        report(stop->contact);
        at_ += move * stop->fraction;
        rest *= 1 - stop->fraction * fraction;
        extra_.reset();
        if (stop->fraction * distance <= still) extra_ = MovePlane<D>{stop->contact.normal, 0.0};
    }
    extra_.reset();
}

/// Climbs a step: up, ahead and down, if that goes farther than `without` and ends on ground.
template <int D>
bool MoveAndSlide<D>::climb_step(const DVec<D>& ahead, double without) {
    const double grown_by = swept_skin * settings_.skin, requested_length = length(ahead);
    if (!(settings_.step_height > 0)) return false;
    const DVec<D> before = at_, lift = settings_.up * settings_.step_height;
    const auto fraction = [&](const DVec<D>& from, const DVec<D>& move) {
        const std::optional<FirstTouch<D>> stop = near_.first_touch(from, move, grown_by);
        return stop ? stop->fraction : 1.0;
    };
    const DVec<D> raised = before + lift * fraction(before, lift);
    const double rise = dot(raised - before, settings_.up);
    if (rise < settings_.skin) return false;
    const double goes = fraction(raised, ahead);
    if (goes * requested_length <= without + 1e-3 * requested_length) return false;
    const DVec<D> over = raised + ahead * goes;
    const std::optional<FirstTouch<D>> landing = near_.first_touch(over, settings_.up * -rise, grown_by);
    at_ = over - settings_.up * (rise * (landing ? landing->fraction : 1.0));
    if (!landing || is_ground(landing->contact, lowest_at(before))) return true;
    at_ = before;
    return false;
}

template <int D>
void MoveAndSlide<D>::snap_to_ground() {
    if (!(settings_.snap_distance > 0)) return;
    const DVec<D> down = settings_.up * -settings_.snap_distance, before = at_;
    const std::optional<FirstTouch<D>> landing = near_.first_touch(at_, down, swept_skin * settings_.skin);
    if (!landing) return;
    // It is already as near as the planes allow.
    const double distance = landing->fraction * settings_.snap_distance;
    if (distance < 0.75 * settings_.skin) return;
    at_ += down * (1 - 0.25 * settings_.skin / distance) * landing->fraction;
    if (!is_ground(landing->contact)) at_ = before;
}

template <int D>
DVec<D> MoveAndSlide<D>::allowed(const DVec<D>& motion) {
    const NearContact<D>* stands_on = dot(motion, settings_.up) <= 0 ? ground() : nullptr;
    bool wall = false;
    return allowed_by_planes(stands_on != nullptr ? level(motion) : motion, wall);
}

template <int D>
void MoveAndSlide<D>::report_contacts() {
    for (const NearContact<D>& contact : contacts()) report(contact);
}

template <int D>
void MoveAndSlide<D>::report(const NearContact<D>& contact) {
    const auto name = [](const MoverTouch<D>& touch) { return PartName{touch.id, touch.feature.part}; };
    auto place = std::lower_bound(touches_.begin(), touches_.end(), contact.name,
                                  [&](const MoverTouch<D>& touch, const PartName& part) { return name(touch) < part; });
    const auto is_part = [&] { return place != touches_.end() && name(*place) == contact.name; };
    if (contact.is_sdf)
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

template class MoveAndSlide<2>;
template class MoveAndSlide<3>;

}  // namespace abut::detail
