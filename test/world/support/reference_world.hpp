#pragma once

// The reference implementation of World: it tests every item against every other, and stores nothing from update to
// update except the touching pairs.

#include <abut/query/contains.hpp>
#include <abut/query/detail/surface/surface_contacts.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/sweep.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <tuple>
#include <typeinfo>

namespace abut::test {

template <int D>
class ReferenceWorld {
public:
    struct Item {
        std::function<View<D>(const Pose<D>&)> placed;
        AnyShape<D> any_shape;
        std::shared_ptr<const void> shape;  ///< of this type, which users of the library may do without
        const std::type_info* type = nullptr;
        ItemOptions<D> options;
        bool changed = true;
        bool edited = false;                 ///< changed as well, but pairs may be far from where
        bool settled = false;                ///< present at the last update with this shape
        std::optional<Pose<D>> before = {};  ///< the pose at the last update, if the item has moved since

        View<D> view() const { return placed(options.pose); }
        /// The box of the world's broad phases, by which items are near.
        Aabb<D> box() const { return any_shape.bounds_for_queries(options.pose); }
    };

    template <class S>
    void add(Id id, const S& shape, const ItemOptions<D>& options) {
        const auto stored = std::make_shared<const decltype(owned(shape))>(owned(shape));
        const auto placed = [stored](const Pose<D>& pose) -> View<D> { return abut::view(at(*stored, pose)); };
        items_.insert_or_assign(id, Item{.placed = placed,
                                         .any_shape = shape,
                                         .shape = stored,
                                         .type = &typeid(decltype(owned(shape))),
                                         .options = options});
    }
    template <class S>
    void set_shape(Id id, const S& shape) {
        add(id, shape, ItemOptions<D>(items_.at(id).options));
    }
    template <class S, class F>
    bool edit_shape(Id id, F&& edit) {
        if (*items_.at(id).type != typeid(S)) return false;
        S edited = *static_cast<const S*>(items_.at(id).shape.get());
        edit(edited);
        const bool was_changed = items_.at(id).changed;
        set_shape(id, edited);
        items_.at(id).changed = was_changed;
        items_.at(id).edited = true;
        return true;
    }
    void move(Id id, const Pose<D>& pose) {
        Item& item = items_.at(id);
        if (item.options.pose == pose) return;
        item.changed = true;
        if (item.settled && !item.before) item.before = item.options.pose;
        item.options.pose = pose;
    }
    void set_filter(Id id, std::uint64_t layers, std::uint64_t mask) {
        Item& item = items_.at(id);
        item.options.layers = layers;
        item.options.mask = mask;
        item.changed = true;
    }
    void set_user(Id id, std::uint64_t user) { items_.at(id).options.user = user; }
    void set_fixed(Id id, bool fixed) { set(id, items_.at(id).options.fixed, fixed); }
    void set_sensor(Id id, bool sensor) { set(id, items_.at(id).options.sensor, sensor); }
    void set_continuous(Id id, bool continuous) { items_.at(id).options.continuous = continuous; }
    void set_group(Id id, std::int32_t group) { set(id, items_.at(id).options.group, group); }
    void set_enabled(Id id, bool enabled) {
        Item& item = items_.at(id);
        if (item.options.enabled == enabled) return;
        item.options.enabled = enabled;
        item.changed = true;
        item.settled = false;
        item.before.reset();
    }
    void remove(Id id) { items_.erase(id); }

    /// Returns to another state, as World::restore does: without the lists of the last update, and the next one tests
    /// all pairs. The pair filter is not part of it.
    void restore(const ReferenceWorld& saved) {
        items_ = saved.items_;
        touching_ = saved.touching_;
        passed_ = saved.passed_;
        for (auto& [id, item] : items_) item.changed = true;
        contacts.clear();
        impacts.clear();
    }
    /// The items on their way to where they are in another state.
    void move_towards(const ReferenceWorld& next, float fraction) {
        for (auto& [id, item] : items_) {
            const auto there = next.items_.find(id);
            if (fraction == 0 || there == next.items_.end()) continue;
            const Pose<D>&to = there->second.options.pose, from = item.options.pose;
            if (from != to) item.options.pose = fraction == 1 ? to : pose_at(Motion<D>::between(from, to), fraction);
        }
    }

    const std::map<Id, Item>& items() const { return items_; }

    void update() {
        const std::vector<IdPair> before = std::move(touching_), passed_before = std::move(passed_);
        last_touching_ = before;
        touching_.clear();
        passed_.clear();
        impacts_.clear();
        contacts.clear();
        found_.clear();
        min_counts = max_counts = {};
        for (auto a = items_.begin(); a != items_.end(); ++a)
            for (auto b = std::next(a); b != items_.end(); ++b) test_pair(*a, *b);
        report_contacts();
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
        for (const IdPair& pair : began) fractions.push_back(impacts_.contains(pair) ? impacts_[pair].fraction : 1);
        impacts.clear();
        for (const auto& [pair, hit] : impacts_) impacts.push_back({pair.a, pair.b, hit});
        passed = passed_.size();
        pair_filter_changed = false;
        for (auto& [id, item] : items_) {
            item.changed = item.edited = false;
            item.settled = true;
            item.before.reset();
        }
    }

    std::vector<WorldHit<D>> raycast_all(const Ray<D>& ray, const Filter& filter) const {
        std::vector<WorldHit<D>> all;
        for (const auto& [id, item] : items_)
            if (passes(id, item, filter))
                if (const auto hit = abut::raycast(ray, item.view())) all.push_back({id, *hit});
        std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
            return std::tie(a.hit.distance, a.id) < std::tie(b.hit.distance, b.id);
        });
        return all;
    }

    std::optional<WorldClosest<D>> closest(const View<D>& shape, const Filter& filter) const {
        std::optional<WorldClosest<D>> nearest;
        for (const auto& [id, item] : items_) {
            if (!passes(id, item, filter) || both_half_spaces(shape, item.view())) continue;
            const Closest<D> found = abut::closest(shape, item.view());
            if (!nearest || found.distance < nearest->closest.distance) nearest = {id, found};
        }
        return nearest;
    }

    std::vector<WorldClosest<D>> k_nearest(const View<D>& shape, std::size_t k, const Filter& filter) const {
        std::vector<WorldClosest<D>> all;
        for (const auto& [id, item] : items_)
            if (passes(id, item, filter) && !both_half_spaces(shape, item.view()))
                all.push_back({id, abut::closest(shape, item.view())});
        std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
            return std::tie(a.closest.distance, a.id) < std::tie(b.closest.distance, b.id);
        });
        all.resize(std::min(k, all.size()));
        return all;
    }

    /// The pairs of the last update, without items that have been removed since.
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
            if (passes(id, item, filter) && !both_half_spaces(shape, item.view()) && overlaps(shape, item.view()))
                result.push_back(id);
        return result;
    }

    std::vector<Id> containing(const Vec<D>& point, const Filter& filter) const {
        std::vector<Id> result;
        for (const auto& [id, item] : items_)
            if (passes(id, item, filter) && abut::contains(item.view(), point)) result.push_back(id);
        return result;
    }

    /// The first hit of a sweep of every single item by `sweep_at(item)`, without the neighbours of the item.
    template <class SweepAt>
    std::optional<WorldHit<D>> first_hit(const View<D>& shape, const Filter& filter, SweepAt&& sweep_at) const {
        std::optional<WorldHit<D>> first;
        for (const auto& [id, item] : items_) {
            if (!passes(id, item, filter) || both_half_spaces(shape, item.view())) continue;
            const std::optional<Hit<D>> hit = sweep_at(item);
            if (hit && (!first || hit->fraction < first->hit.fraction)) first = WorldHit<D>{id, *hit};
        }
        return first;
    }

    /// The contacts of a query shape, sorted: those with surface normals, and the ghosts that none of another item
    /// covers.
    std::vector<WorldContact<D>> contacts_of(const View<D>& shape, const Filter& filter, float margin) const {
        std::vector<std::pair<Id, std::vector<detail::SurfaceContact<D>>>> found;
        for (const auto& [id, item] : items_) {
            if (!passes(id, item, filter) || both_half_spaces(shape, item.view())) continue;
            const auto beside = [&, own = id](const detail::DVec<D>& point, double within,
                                              detail::ClosestPointVisitor<D> visit) {
                for (const auto& [other, neighbour] : items_)
                    if (other != own && passes(other, neighbour, filter))
                        each_closest_point_on(neighbour.view(), point, within, visit);
            };
            const detail::EachClosestPoint<D> neighbours(beside);
            auto& of_item = found.emplace_back(id, std::vector<detail::SurfaceContact<D>>()).second;
            each_surface_contact<D>(shape, item.view(), {.margin = margin}, {.of_a = &neighbours},
                                    [&](const detail::SurfaceContact<D>& each) {
                                        of_item.push_back(each);
                                        return true;
                                    });
        }
        std::vector<WorldContact<D>> result;
        for (const auto& [id, of_item] : found)
            for (const detail::SurfaceContact<D>& each : of_item) {
                if (each.surface_normals || !is_covered(id, each, found))
                    result.push_back({{}, id, each.contact});
                else if (each.own_area)
                    result.push_back({{}, id, each.own_area});
            }
        return result;
    }

    static bool passes(Id id, const Item& item, const Filter& filter) {
        return (filter.layers & item.options.mask) != 0 && (item.options.layers & filter.mask) != 0 &&
               (filter.sensors || !item.options.sensor) && id != filter.ignore && item.options.enabled &&
               std::count(filter.ignore_ids.begin(), filter.ignore_ids.end(), id) == 0 &&
               (!filter.accepts || (*filter.accepts)(id));
    }

    std::function<bool(Id, Id)> pair_filter;
    bool pair_filter_changed = false;

    std::vector<IdPair> began, stayed, ended;
    std::vector<float> fractions;
    std::size_t passed = 0;  ///< pairs that began and don't touch now
    std::vector<WorldContact<D>> contacts;
    std::vector<WorldImpact<D>> impacts;
    std::size_t ghosts = 0, covered = 0;  ///< so far: normals of internal edges, and those of them without a contact
    UpdateCounts min_counts, max_counts;  ///< bounds of the world's counts, whose boxes have margins

private:
    template <class T>
    void set(Id id, T& option, T value) {
        items_.at(id).changed = items_.at(id).changed || option != value;
        option = value;
    }

    using Entry = std::pair<const Id, Item>;

    bool may_pair(const Entry& a, const Entry& b) const {
        const ItemOptions<D>&p = a.second.options, &q = b.second.options;
        if (!p.enabled || !q.enabled || both_half_spaces(a.second.view(), b.second.view())) return false;
        if (pair_filter && !pair_filter(std::min(a.first, b.first), std::max(a.first, b.first))) return false;
        if (p.group != 0 && p.group == q.group) return p.group > 0;
        return (p.layers & q.mask) != 0 && (q.layers & p.mask) != 0;
    }
    static bool both_half_spaces(const View<D>& a, const View<D>& b) {
        return std::holds_alternative<detail::HalfSpaceView<D>>(a) &&
               std::holds_alternative<detail::HalfSpaceView<D>>(b);
    }

    static bool is_covered(Id id, const detail::SurfaceContact<D>& ghost,
                           const std::vector<std::pair<Id, std::vector<detail::SurfaceContact<D>>>>& found) {
        for (const auto& [other, of_item] : found)
            for (const detail::SurfaceContact<D>& each : of_item)
                if (other != id && (each.surface_normals || other < id) &&
                    detail::covers_contact<D>(
                        detail::DVec<D>(each.contact.normal), static_cast<double>(each.contact.depth),
                        detail::DVec<D>(ghost.contact.normal), static_cast<double>(ghost.contact.depth), ghost.size))
                    return true;
        return false;
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

    void test_pair(const std::pair<const Id, Item>& a, const std::pair<const Id, Item>& b) {
        const ItemOptions<D>&p = a.second.options, &q = b.second.options;
        const View<D> view_a = a.second.view(), view_b = b.second.view();
        if ((p.fixed && q.fixed) || !may_pair(a, b)) return;
        const bool changed = a.second.changed || b.second.changed,
                   may_change = changed || a.second.edited || b.second.edited || pair_filter_changed;
        count(overlaps(detail::bounds(view_a), detail::bounds(view_b)), changed, min_counts);
        count(overlaps(widened(detail::bounds(view_a)), widened(detail::bounds(view_b))), may_change, max_counts);
        const IdPair pair{a.first, b.first};
        bool touch = false;
        if (p.sensor || q.sensor) {
            touch = overlaps(view_a, view_b);
        } else {
            touch = find_contact(a, b, view_a, view_b);
        }
        if (touch) touching_.push_back(pair);
        if ((!p.continuous && !q.continuous) || (!a.second.before && !b.second.before)) return;
        if (may_change && !touch) ++max_counts.near, ++max_counts.tested;
        if (std::binary_search(last_touching_.begin(), last_touching_.end(), pair)) return;
        const std::optional<Hit<D>> hit = sweep_between(a.second, b.second);
        if (hit) impacts_[pair] = *hit;
        if (hit && !touch) passed_.push_back(pair);
    }

    /// Adds the contact with the surfaces of the neighbours to found_. Two balls have no edges. An item whose centre a
    /// neighbour contains has no surface, nor does one with a single neighbour: its contact is reported in any case.
    /// Returns false if the items don't touch.
    bool find_contact(const Entry& a, const Entry& b, const View<D>& view_a, const View<D>& view_b) {
        const auto others_of_a = others(a, b), others_of_b = others(b, a);
        const detail::EachClosestPoint<D> of_a(others_of_a), of_b(others_of_b);
        const bool are_balls = is_ball(view_a) && is_ball(view_b);
        const detail::EachClosestPoint<D>* const beside_b = are_balls || !is_filtered(a) ? nullptr : &of_a;
        const detail::EachClosestPoint<D>* const beside_a = are_balls || !is_filtered(b) ? nullptr : &of_b;
        return each_surface_contact<
            D>(view_a, view_b, {}, {beside_b, beside_a}, [&](const detail::SurfaceContact<D>& found) {
            const bool is_on_ridge = !found.surface_normals && !std::isfinite(found.size);
            found_.push_back({{a.first, b.first, found.contact}, found.own_area, found.surface_normals, is_on_ridge});
            return true;
        });
    }
    static bool is_ball(const View<D>& view) {
        const auto* convex = std::get_if<detail::Convex<D>>(&view);
        return convex != nullptr && convex->core == detail::Core::points && convex->count == 1;
    }
    bool is_filtered(const Entry& item) const {
        if (item.second.options.fixed || neighbour_count(item) < 2) return false;
        const auto ball = detail::SmallBall<D>::around(detail::bounding_ball(item.second.placed({})));
        if (!std::isfinite(ball.radius)) return true;
        const detail::DVec<D> middle = detail::affine(item.second.options.pose).point(detail::DVec<D>(ball.center));
        bool is_inside = false;
        others(item, item)(middle, 0, [&](const detail::ClosestPoint<D>& closest) {
            is_inside = is_inside || closest.distance < 0;
            return 0.0;
        });
        return !is_inside;
    }

    /// Whether two items continue each other's surface: they pair, are no sensors, and have boxes that overlap.
    bool are_neighbours(const Entry& item, const Entry& other) const {
        return other.first != item.first && !other.second.options.sensor && may_pair(item, other) &&
               overlaps(item.second.box(), other.second.box());
    }
    std::ptrdiff_t neighbour_count(const Entry& item) const {
        return std::count_if(items_.begin(), items_.end(),
                             [&](const Entry& other) { return are_neighbours(item, other); });
    }
    /// Visits the closest points on the neighbours of an item, except on `but`.
    auto others(const Entry& item, const Entry& but) const {
        return [this, &item, &but](const detail::DVec<D>& point, double within, detail::ClosestPointVisitor<D> visit) {
            for (const Entry& other : items_)
                if (other.first != but.first && are_neighbours(item, other))
                    each_closest_point_on(other.second.view(), point, within, visit);
        };
    }

    /// Reports the contacts with surface normals. A ghost is reported if no other contact of the item covers it: none
    /// with a surface normal, and no reported ghost before it. Otherwise its own area is. Any contact covers one on a
    /// ridge.
    void report_contacts() {
        std::vector<bool> reported;
        for (const FoundContact& found : found_) reported.push_back(static_cast<bool>(found.surface_normal));
        for (std::size_t i = 0; i < found_.size(); ++i) {
            const FoundContact& ghost = found_[i];
            if (ghost.surface_normal) continue;
            reported[i] = true;
            const double size = std::min(abut::detail::size(items_.at(ghost.result.a).view()),
                                         abut::detail::size(items_.at(ghost.result.b).view()));
            for (const auto& [item, is_surface_normal] : {std::pair(ghost.result.a, ghost.surface_normal.a),
                                                          std::pair(ghost.result.b, ghost.surface_normal.b)}) {
                if (is_surface_normal || items_.at(item).options.fixed) continue;
                const auto normal = [id = item](const WorldContact<D>& c) {
                    return detail::DVec<D>(c.contact.normal) * (c.a == id ? 1.0 : -1.0);
                };
                for (std::size_t k = 0; k < found_.size(); ++k) {
                    const WorldContact<D>& other = found_[k].result;
                    const bool shares = k != i && (other.a == item || other.b == item);
                    if (shares && reported[k] &&
                        (ghost.is_on_ridge ||
                         detail::covers_contact<D>(normal(other), static_cast<double>(other.contact.depth),
                                                   normal(ghost.result),
                                                   static_cast<double>(ghost.result.contact.depth), size)))
                        reported[i] = false;
                }
            }
            covered += reported[i] ? 0 : 1;
        }
        for (std::size_t i = 0; i < found_.size(); ++i) {
            const WorldContact<D>& result = found_[i].result;
            if (reported[i])
                contacts.push_back(result);
            else if (found_[i].own_area)
                contacts.push_back({result.a, result.b, found_[i].own_area});
            ghosts += found_[i].surface_normal ? 0 : 1;
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
    std::vector<IdPair> touching_, last_touching_, passed_;
    std::map<IdPair, Hit<D>> impacts_;
    struct FoundContact {
        WorldContact<D> result;
        Contact<D> own_area;
        detail::SurfaceNormalFlags surface_normal;
        bool is_on_ridge;  ///< of the surface
    };
    std::vector<FoundContact> found_;
};

}  // namespace abut::test
