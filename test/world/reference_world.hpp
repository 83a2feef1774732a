#pragma once

// What a World must answer, in the plainest way: every item against every other, nothing kept from frame to frame but
// who touched.

#include <abut/query/contains.hpp>
#include <abut/query/detail/surface/contact_with_neighbours.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/sweep.hpp>
#include <abut/query/sweep_turning.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <functional>
#include <map>
#include <tuple>

namespace abut::test {

template <int D>
class ReferenceWorld {
public:
    struct Item {
        std::function<View<D>(const Pose<D>&)> placed;
        ItemOptions<D> options;
        bool changed = true;
        bool settled = false;           ///< was there at the last update, as it is
        std::optional<Pose<D>> before;  ///< at the last update, if it has moved since

        View<D> view() const { return placed(options.pose); }
    };

    template <class S>
    void add(Id id, const S& shape, const ItemOptions<D>& options) {
        items_[id] = {placer(shape), options, true, false, std::nullopt};
    }
    template <class S>
    void set_shape(Id id, const S& shape) {
        items_[id] = {placer(shape), items_.at(id).options, true, false, std::nullopt};
    }
    void move(Id id, const Pose<D>& pose) {
        Item& item = items_.at(id);
        if (item.options.pose == pose) return;
        item.changed = true;
        if (item.settled && !item.before) item.before = item.options.pose;
        item.options.pose = pose;
    }
    void set_filter(Id id, std::uint32_t layers, std::uint32_t mask) {
        Item& item = items_.at(id);
        item.options.layers = layers;
        item.options.mask = mask;
        item.changed = true;
    }
    void set_user(Id id, std::uint64_t user) { items_.at(id).options.user = user; }
    void set_fixed(Id id, bool fixed) { set(id, items_.at(id).options.fixed, fixed); }
    void set_sensor(Id id, bool sensor) { set(id, items_.at(id).options.sensor, sensor); }
    void set_continuous(Id id, bool continuous) { items_.at(id).options.continuous = continuous; }
    void remove(Id id) { items_.erase(id); }

    const std::map<Id, Item>& items() const { return items_; }

    void update() {
        const std::vector<IdPair> before = std::move(touching_), passed_before = std::move(passed_);
        touched_ = before;
        touching_.clear();
        passed_.clear();
        met_.clear();
        contacts.clear();
        found_.clear();
        least = most = {};
        for (auto a = items_.begin(); a != items_.end(); ++a)
            for (auto b = std::next(a); b != items_.end(); ++b) look_at(*a, *b);
        tell_contacts();
        began = difference(touching_, before);
        ended = difference(before, touching_);
        stayed.clear();
        std::set_intersection(touching_.begin(), touching_.end(), before.begin(), before.end(),
                              std::back_inserter(stayed));
        began.insert(began.end(), passed_.begin(), passed_.end());
        ended.insert(ended.end(), passed_before.begin(), passed_before.end());
        std::sort(began.begin(), began.end());
        std::sort(ended.begin(), ended.end());
        fractions.clear();
        for (const IdPair& pair : began) fractions.push_back(met_.contains(pair) ? met_[pair].fraction : 1);
        impacts.clear();
        for (const auto& [pair, hit] : met_) impacts.push_back({pair.a, pair.b, hit});
        passed = passed_.size();
        for (auto& [id, item] : items_) {
            item.changed = false;
            item.settled = true;
            item.before.reset();
        }
    }

    std::vector<WorldHit<D>> raycast_all(const Ray<D>& ray, const Filter& filter) const {
        std::vector<WorldHit<D>> all;
        for (const auto& [id, item] : items_)
            if (asked(id, item, filter))
                if (const auto hit = abut::raycast(ray, item.view())) all.push_back({id, *hit});
        std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
            return std::tie(a.hit.distance, a.id) < std::tie(b.hit.distance, b.id);
        });
        return all;
    }

    std::optional<WorldClosest<D>> closest(const View<D>& shape, const Filter& filter) const {
        std::optional<WorldClosest<D>> nearest;
        for (const auto& [id, item] : items_) {
            if (!asked(id, item, filter) || both_half_spaces(shape, item.view())) continue;
            const Closest<D> found = abut::closest(shape, item.view());
            if (!nearest || found.distance < nearest->closest.distance) nearest = {id, found};
        }
        return nearest;
    }

    std::vector<WorldClosest<D>> k_nearest(const View<D>& shape, std::size_t k, const Filter& filter) const {
        std::vector<WorldClosest<D>> all;
        for (const auto& [id, item] : items_)
            if (asked(id, item, filter) && !both_half_spaces(shape, item.view()))
                all.push_back({id, abut::closest(shape, item.view())});
        std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
            return std::tie(a.closest.distance, a.id) < std::tie(b.closest.distance, b.id);
        });
        all.resize(std::min(k, all.size()));
        return all;
    }

    /// Of the items that are there now, as of the last update.
    std::vector<Id> touching(Id id) const {
        std::vector<Id> result;
        for (const IdPair& pair : touching_)
            if (pair.a == id || pair.b == id) result.push_back(pair.a == id ? pair.b : pair.a);
        std::erase_if(result, [&](Id other) { return !items_.contains(other); });
        std::sort(result.begin(), result.end());
        return result;
    }

    std::vector<Id> overlapping(const View<D>& shape, const Filter& filter) const {
        std::vector<Id> result;
        for (const auto& [id, item] : items_)
            if (asked(id, item, filter) && !both_half_spaces(shape, item.view()) && overlaps(shape, item.view()))
                result.push_back(id);
        return result;
    }

    std::vector<Id> containing(const Vec<D>& point, const Filter& filter) const {
        std::vector<Id> result;
        for (const auto& [id, item] : items_)
            if (asked(id, item, filter) && abut::contains(item.view(), point)) result.push_back(id);
        return result;
    }

    static bool asked(Id id, const Item& item, const Filter& filter) {
        return (filter.layers & item.options.mask) != 0 && (item.options.layers & filter.mask) != 0 &&
               (filter.sensors || !item.options.sensor) && id != filter.ignore &&
               std::count(filter.ignore_ids.begin(), filter.ignore_ids.end(), id) == 0;
    }

    std::vector<IdPair> began, stayed, ended;
    std::vector<float> fractions;
    std::size_t passed = 0;  ///< of those that began, what doesn't touch
    std::vector<WorldContact<D>> contacts;
    std::vector<WorldImpact<D>> impacts;
    std::size_t ghosts = 0, left_out = 0;  ///< so far: normals that aren't felt, and those of them without a contact
    UpdateCounts least, most;              ///< of what the world may count, whose boxes are a little wider than need be

private:
    void set(Id id, bool& option, bool value) {
        items_.at(id).changed = items_.at(id).changed || option != value;
        option = value;
    }

    template <class S>
    static std::function<View<D>(const Pose<D>&)> placer(const S& shape) {
        const auto kept = std::make_shared<const decltype(owned(shape))>(owned(shape));
        return [kept](const Pose<D>& pose) -> View<D> { return abut::view(at(*kept, pose)); };
    }

    static bool both_half_spaces(const View<D>& a, const View<D>& b) {
        return std::holds_alternative<HalfSpaceView<D>>(a) && std::holds_alternative<HalfSpaceView<D>>(b);
    }

    static std::vector<IdPair> difference(const std::vector<IdPair>& a, const std::vector<IdPair>& b) {
        std::vector<IdPair> result;
        std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
        return result;
    }

    static Aabb<D> widened(const Aabb<D>& box) { return grown(box, 1e-5f); }
    static void count(bool near, bool changed, UpdateCounts& counts) {
        counts.near += near ? 1 : 0;
        counts.tested += near && changed ? 1 : 0;
    }

    void look_at(const std::pair<const Id, Item>& a, const std::pair<const Id, Item>& b) {
        const ItemOptions<D>&p = a.second.options, &q = b.second.options;
        const View<D> view_a = a.second.view(), view_b = b.second.view();
        if ((p.fixed && q.fixed) || (p.layers & q.mask) == 0 || (q.layers & p.mask) == 0) return;
        if (both_half_spaces(view_a, view_b)) return;
        const bool changed = a.second.changed || b.second.changed;
        count(overlaps(abut::bounds(view_a), abut::bounds(view_b)), changed, least);
        count(overlaps(widened(abut::bounds(view_a)), widened(abut::bounds(view_b))), changed, most);
        const IdPair pair{a.first, b.first};
        bool touch = false;
        if (p.sensor || q.sensor) {
            touch = overlaps(view_a, view_b);
        } else {
            const auto others_of_a = others(a, b), others_of_b = others(b, a);
            const EachClosestPoint<D> of_a(others_of_a), of_b(others_of_b);
            const ContactWithNeighbours<D> among =
                contact_with_neighbours<D>(view_a, view_b, {p.fixed ? nullptr : &of_a, q.fixed ? nullptr : &of_b});
            touch = among.touch;
            if (among.contact) found_.push_back({{a.first, b.first, among.contact}, among.surface_normals});
        }
        if (touch) touching_.push_back(pair);
        if ((!p.continuous && !q.continuous) || (!a.second.before && !b.second.before)) return;
        if (changed && !touch) ++most.near, ++most.tested;
        if (std::binary_search(touched_.begin(), touched_.end(), pair)) return;
        const std::optional<Hit<D>> hit = sweep_between(a.second, b.second);
        if (hit) met_[pair] = *hit;
        if (hit && !touch) passed_.push_back(pair);
    }

    using Entry = std::pair<const Id, Item>;

    /// All that an item feels beside another one: what pairs with it, is no sensor, and has a box that overlaps its
    /// own.
    auto others(const Entry& feeler, const Entry& but) const {
        return [this, &feeler, &but](const DVec<D>& point, double within, ClosestPointVisitor<D> visit) {
            const ItemOptions<D>& p = feeler.second.options;
            const View<D> own = feeler.second.view();
            for (const Entry& other : items_) {
                const ItemOptions<D>& q = other.second.options;
                const View<D> view = other.second.view();
                if (other.first == feeler.first || other.first == but.first || q.sensor) continue;
                if ((p.layers & q.mask) == 0 || (q.layers & p.mask) == 0 || both_half_spaces(own, view)) continue;
                if (overlaps(abut::bounds(own), abut::bounds(view))) each_closest_point_on(view, point, within, visit);
            }
        };
    }

    /// What isn't felt is told where no other contact of who doesn't feel it tells of it: no felt one, and none that is
    /// told in the place of another and comes before.
    void tell_contacts() {
        std::vector<bool> told;
        for (const Found& found : found_) told.push_back(static_cast<bool>(found.felt));
        for (std::size_t i = 0; i < found_.size(); ++i) {
            const Found& ghost = found_[i];
            if (ghost.felt) continue;
            told[i] = true;
            const double size =
                std::min(abut::size(items_.at(ghost.told.a).view()), abut::size(items_.at(ghost.told.b).view()));
            for (const auto& [feeler, feels] :
                 {std::pair(ghost.told.a, ghost.felt.a), std::pair(ghost.told.b, ghost.felt.b)}) {
                if (feels || items_.at(feeler).options.fixed) continue;
                const auto normal = [id = feeler](const WorldContact<D>& c) {
                    return DVec<D>(c.contact.normal) * (c.a == id ? 1.0 : -1.0);
                };
                for (std::size_t k = 0; k < found_.size(); ++k) {
                    const WorldContact<D>& other = found_[k].told;
                    const bool shares = k != i && (other.a == feeler || other.b == feeler);
                    if (shares && told[k] &&
                        covers_contact<D>(normal(other), static_cast<double>(other.contact.depth), normal(ghost.told),
                                          static_cast<double>(ghost.told.contact.depth), size))
                        told[i] = false;
                }
            }
        }
        for (std::size_t i = 0; i < found_.size(); ++i) {
            if (told[i]) contacts.push_back(found_[i].told);
            ghosts += found_[i].felt ? 0 : 1;
            left_out += told[i] ? 0 : 1;
        }
    }

    static std::optional<Hit<D>> sweep_between(const Item& a, const Item& b) {
        const Pose<D>&to_a = a.options.pose, &to_b = b.options.pose;
        const Pose<D> from_a = a.before.value_or(to_a), from_b = b.before.value_or(to_b);
        if (from_a.rotation == to_a.rotation && from_b.rotation == to_b.rotation)
            return sweep(a.placed(from_a), to_a.position - from_a.position, b.placed(from_b),
                         to_b.position - from_b.position);
        return sweep(a.placed({}), from_a, to_a, b.placed({}), from_b, to_b);
    }

    std::map<Id, Item> items_;
    std::vector<IdPair> touching_, touched_, passed_;
    std::map<IdPair, Hit<D>> met_;
    struct Found {
        WorldContact<D> told;
        SurfaceNormalFlags felt;
    };
    std::vector<Found> found_;
};

}  // namespace abut::test
