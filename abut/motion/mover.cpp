// The kinematic character controller: it moves a shape through a world by move and slide, without forces.

#include <abut/math/simd/library_entry.hpp>
#include <abut/motion/mover.hpp>
#include <abut/motion/mover/nearby_surface.hpp>
#include <abut/motion/push/plane_solver.hpp>
#include <abut/query/detail/valid_query.hpp>

#include <array>

namespace abut::detail {
namespace {

/// The mover's options in double.
template <int D>
struct MoveSettings {
    DVec<D> up;  ///< unit vector, or 0: then nothing is ground and no slope too steep
    double step_height = 0, min_rise = 0, snap_distance = 0,
           skin = 0;  ///< min_rise: minimum component of a ground normal along `up`
};

template <int D>
struct PushOut {
    DVec<D> push{0.0};
    double depth = 0;  ///< remaining penetration depth
};

/// Maximum number of pushes; each one uses the contacts after the last one.
constexpr int max_pushes = 12;

template <int D>
double min_gap(std::span<const NearContact<D>> contacts) {
    double result = std::numeric_limits<double>::infinity();
    for (const NearContact<D>& contact : contacts) result = std::min(result, contact.gap);
    return result;
}

/// The minimal move after which all gaps are at least `target` or unchanged.
template <int D>
bool push_to(std::span<const NearContact<D>> contacts, double target, double tolerance, DVec<D>& push) {
    std::array<MovePlane<D>, max_move_planes> planes;
    const std::size_t count = std::min(contacts.size(), max_move_planes);
    for (std::size_t i = 0; i < count; ++i) planes[i] = {contacts[i].normal, contacts[i].gap - target};
    return nearest_move<D>(std::span<const MovePlane<D>>(planes.data(), count), DVec<D>(0.0), tolerance, push);
}

/// Pushes a shape out of its contacts by minimal translations against contact planes; each push is swept and stopped by
/// obstacles. Nothing happens if all gaps are at least `trigger`. Otherwise gaps become `target`, which is larger, or 0
/// if there is no space. `reach` is the range of contacts, at least `target`.
template <int D>
PushOut<D> push_out(NearbySurface<D>& near, const DVec<D>& at, double trigger, double target, double reach) {
    const double tolerance = 1e-6 * near.size();
    PushOut<D> result;
    for (int i = 0; i < max_pushes; ++i) {
        const std::span<const NearContact<D>> contacts = near.contacts(at + result.push, reach);
        if (!(min_gap(contacts) < trigger)) break;
        DVec<D> push(0.0);
        // If the planes leave no solution, the deepest contact alone is resolved.
        if (!push_to(contacts, target, tolerance, push) && !push_to(contacts, 2 * tolerance, tolerance, push)) {
            const auto deepest =
                std::min_element(contacts.begin(), contacts.end(),
                                 [](const NearContact<D>& a, const NearContact<D>& b) { return a.gap < b.gap; });
            if (deepest->gap >= -tolerance) break;
            push = deepest->normal * -deepest->gap;
        }
        const std::optional<FirstTouch<D>> stop = near.first_touch(at + result.push, push, 0);
        if (stop) push *= stop->fraction;
        if (length(push) < tolerance) break;
        result.push += push;
    }
    result.depth = std::max(0.0, -min_gap(near.contacts(at + result.push, reach)));
    return result;
}

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

template <int D>
class MoveAndSlide {
public:
    MoveAndSlide(NearbySurface<D>& near, const MoveSettings<D>& settings, const DVec<D>& at,
                 std::vector<MoverTouch<D>>& touches)
        : near_(near), settings_(settings), at_(at), touches_(touches) {}

    const DVec<D>& at() const { return at_; }
    double depth() const { return depth_; }

    /// Pushes the mover out of overlaps; returns the push.
    DVec<D> separate() {
        const PushOut<D> out =
            push_out(near_, at_, pushed_skin * settings_.skin, swept_skin * settings_.skin, 2 * settings_.skin);
        depth_ = out.depth;
        at_ += out.push;
        return out.push;
    }

    /// Follows the motion of the ground until blocked.
    void carry(const DVec<D>& move) {
        const std::optional<FirstTouch<D>> stop = near_.first_touch(at_, move, pushed_skin * settings_.skin);
        at_ += move * (stop ? stop->fraction : 1.0);
    }

    /// Moves and slides by the requested motion.
    void slide(const DVec<D>& motion) {
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

    /// Snaps down to sinking ground.
    void snap_to_ground() {
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

    /// The ground contact, or null. Valid until the next step.
    /// The most level ground contact, the first of equals.
    const NearContact<D>* ground() {
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

    /// A contact that supports the mover without ground, such as both sides of a groove. Null if it would slide down.
    const NearContact<D>* supporting_groove() {
        bool wall = false;
        if (settings_.up == DVec<D>(0.0)) return nullptr;
        const DVec<D> down = settings_.up * -settings_.skin;
        if (length(allowed_by_planes(down, wall)) > 1e-3 * settings_.skin) return nullptr;
        const std::span<const NearContact<D>> all = contacts();
        return &*std::max_element(all.begin(), all.end(), [&](const NearContact<D>& a, const NearContact<D>& b) {
            return dot(a.normal, settings_.up) < dot(b.normal, settings_.up);
        });
    }

    /// The part of a motion that all contacts allow.
    DVec<D> allowed(const DVec<D>& motion) {
        const NearContact<D>* stands_on = dot(motion, settings_.up) <= 0 ? ground() : nullptr;
        bool wall = false;
        return allowed_by_planes(stands_on != nullptr ? level(motion) : motion, wall);
    }

    /// Adds all contacts to the list.
    void report_contacts() {
        for (const NearContact<D>& contact : contacts()) report(contact);
    }

private:
    std::span<const NearContact<D>> contacts() { return near_.contacts(at_, 2 * settings_.skin); }
    DVec<D> level(const DVec<D>& v) const { return v - settings_.up * dot(v, settings_.up); }
    /// True if the contact is ground for a mover whose lowest point is at `lowest` along up.
    bool is_ground(const NearContact<D>& contact, double lowest) {
        const double rise = dot(contact.normal, settings_.up);
        if (rise >= settings_.min_rise) return true;
        if (rise < 1e-3) return false;
        // An edge low enough to step on, of a level surface.
        if (dot(settings_.up, contact.point) - lowest > settings_.step_height) return false;
        const std::optional<DVec<D>> above = near_.normal_above(contact.point, settings_.up);
        return above && dot(*above, settings_.up) >= settings_.min_rise;
    }

    bool is_ground(const NearContact<D>& contact) { return is_ground(contact, lowest_at(at_)); }
    double lowest_at(const DVec<D>& at) const { return dot(settings_.up, support(near_.shape_at(at), -settings_.up)); }
    /// The motion along the slope at the requested speed.
    DVec<D> along_ground(const DVec<D>& motion, const NearContact<D>& ground) const {
        const DVec<D> ahead = level(motion);
        const double rise = dot(ground.normal, settings_.up), speed = length(ahead);
        if (rise < settings_.min_rise || !(speed > 0)) return ahead;
        return normalized(ahead - settings_.up * (dot(ahead, ground.normal) / rise)) * speed;
    }

    /// The nearest move that the planes allow; `wall` is set if a wall blocks `requested`.
    DVec<D> allowed_by_planes(const DVec<D>& requested, bool& wall) {
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

    /// The fraction of an allowed move to make at once.
    /// Slides over edges that are low enough to step on. The plane of an edge extends beyond the edge, so the move is
    /// limited to the height of the highest edge.
    double fraction_to_edges(const DVec<D>& move, const DVec<D>& requested) {
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

    /// Climbs a step: up, ahead and down, if that goes farther than `without` and ends on ground.
    bool climb_step(const DVec<D>& ahead, double without) {
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

    void report(const NearContact<D>& contact) {
        const auto name = [](const MoverTouch<D>& touch) { return PartName{touch.id, touch.feature.part}; };
        auto place =
            std::lower_bound(touches_.begin(), touches_.end(), contact.name,
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

    NearbySurface<D>& near_;
    const MoveSettings<D>& settings_;
    DVec<D> at_;
    std::vector<MoverTouch<D>>& touches_;
    std::optional<MovePlane<D>> extra_;  // plane of an obstacle that stopped it and isn't among the contacts
    double depth_ = 0;
};

}  // namespace
}  // namespace abut::detail

namespace abut {

using namespace detail;

namespace {

template <int D>
MoverTouch<D> touch_of(const NearContact<D>& contact) {
    MoverTouch<D> result;
    result.id = contact.name.id;
    result.feature = contact.feature;
    result.point = to_float(contact.point);
    result.normal = to_float(contact.normal);
    result.overlapped = contact.overlapped;
    return result;
}

/// The cosine of the slope angle; the same bits on every machine.
double min_rise_for(float steepest) {
    return static_cast<double>(Turn::by(std::clamp(steepest, 0.0f, 1.55f)).cos);
}

}  // namespace

template <int D>
struct Mover<D>::Memory {
    NearbySurface<D> near;
    std::vector<MoverTouch<D>> touches;
    // The ground at the end of the last move, with its pose then, and the mover's position.
    Id ground;
    Pose<D> ground_pose;
    Vec<D> position{};

    /// The translation of the ground since then, at the mover's position.
    Vec<D> carried_by_ground(const World<D>& world, const Vec<D>& from) const {
        if (!ground || from != position || !world.contains(ground)) return Vec<D>(0.0f);
        const Pose<D> now = world.pose(ground);
        if (now == ground_pose) return Vec<D>(0.0f);
        const Affine<D> then = affine(ground_pose);
        const DVec<D> own = then.transposed(DVec<D>(from) - then.offset);
        return to_float(affine(now).point(own) - DVec<D>(from));
    }
};

template <int D>
Mover<D>::Mover(const MoverOptions<D>& options) : memory_(std::make_unique<Memory>()) {
    set_options(options);
}
template <int D>
Mover<D>::~Mover() = default;
template <int D>
Mover<D>::Mover(Mover&&) noexcept = default;
template <int D>
Mover<D>& Mover<D>::operator=(Mover&&) noexcept = default;

template <int D>
void Mover<D>::set_options(const MoverOptions<D>& options) {
    detail::enter_library();
    options_ = options;
    if (!detail::is_valid_query(options.up)) options_.up = MoverOptions<D>{}.up;
}

template <int D>
Moved<D> Mover<D>::move_convex(const World<D>& world, const Convex<D>& shape, const Vec<D>& position,
                               const Vec<D>& motion, const MoverPasses<D>* passes) {
    detail::enter_library();
    Moved<D> result;
    result.position = position;
    if (!detail::is_valid_query(shape, position, motion)) return result;

    Memory& memory = *memory_;
    memory.touches.clear();
    const auto goes_through = [&](const NearContact<D>& contact) { return (*passes)(touch_of(contact)); };
    const Passes<D> filter(goes_through);
    NearbySurface<D>& near = memory.near;
    near.begin(world, options_.filter, shape, DVec<D>(position), passes != nullptr ? &filter : nullptr);

    MoveSettings<D> settings;
    settings.up = normalized(DVec<D>(options_.up), DVec<D>(0.0));
    settings.step_height = static_cast<double>(options_.step_height);
    settings.snap_distance = static_cast<double>(options_.stick);
    settings.min_rise = min_rise_for(options_.steepest);
    settings.skin = options_.skin > 0 ? static_cast<double>(options_.skin) : 0.01 * near.size();

    // The region that the move will probably need.
    const DVec<D> requested(motion);
    const DVec<D> carried(memory.carried_by_ground(world, position));
    near.prefetch(carried + requested, settings.up * settings.skin, settings.up * -settings.snap_distance,
                  4 * settings.skin);

    MoveAndSlide<D> solver(near, settings, DVec<D>(position), memory.touches);
    if (carried != DVec<D>(0.0)) solver.carry(carried);
    result.carried = to_float(solver.at() - DVec<D>(position));
    result.pushed = to_float(solver.separate());

    const bool may_stand = dot(requested, settings.up) <= 1e-6 * length(requested);
    const bool stood_before = may_stand && solver.ground() != nullptr;
    solver.slide(requested);
    if (stood_before) solver.snap_to_ground();

    solver.report_contacts();
    result.position = to_float(solver.at());
    result.motion = to_float(solver.allowed(requested));
    result.crushed = solver.depth() > 0.1 * settings.skin;
    memory.ground = {};
    const NearContact<D>* ground = may_stand ? solver.ground() : nullptr;
    if (ground == nullptr && may_stand) ground = solver.supporting_groove();
    if (ground != nullptr) {
        result.grounded = true;
        result.ground = touch_of(*ground);
        result.ground.is_ground = true;
        memory.ground = ground->name.id;
        memory.ground_pose = world.pose(memory.ground);
    }
    memory.position = result.position;
    result.touches = memory.touches;
    return result;
}

template class Mover<2>;
template class Mover<3>;

}  // namespace abut
