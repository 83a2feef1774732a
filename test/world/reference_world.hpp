#pragma once

// What a World must answer, in the plainest way: every item against every other, nothing kept from frame to frame but
// who touched.

#include <abut/query/contains.hpp>
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
    void remove(Id id) { items_.erase(id); }

    const std::map<Id, Item>& items() const { return items_; }

    void update() {
        const std::vector<IdPair> before = std::move(touching_), passed_before = std::move(passed_);
        touched_ = before;
        touching_.clear();
        passed_.clear();
        met_.clear();
        contacts.clear();
        least = most = {};
        for (auto a = items_.begin(); a != items_.end(); ++a)
            for (auto b = std::next(a); b != items_.end(); ++b) look_at(*a, *b);
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
        for (const IdPair& pair : began) fractions.push_back(met_.contains(pair) ? met_[pair] : 1);
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
               (filter.sensors || !item.options.sensor) && id != filter.ignore;
    }

    std::vector<IdPair> began, stayed, ended;
    std::vector<float> fractions;
    std::size_t passed = 0;  ///< of those that began, what doesn't touch
    std::vector<WorldContact<D>> contacts;
    UpdateCounts least, most;  ///< of what the world may count, whose boxes are a little wider than need be

private:
    template <class S>
    static std::function<View<D>(const Pose<D>&)> placer(const S& shape) {
        const auto kept = std::make_shared<const decltype(owned(shape))>(owned(shape));
        return [kept](const Pose<D>& pose) -> View<D> { return abut::view(at(*kept, pose)); };
    }

    static bool both_half_spaces(const View<D>& a, const View<D>& b) {
        return std::holds_alternative<Solid<D>>(a) && std::holds_alternative<Solid<D>>(b);
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
        } else if (const Contact<D> found = contact(view_a, view_b)) {
            touch = true;
            contacts.push_back({a.first, b.first, found});
        }
        if (touch) touching_.push_back(pair);
        if ((!p.continuous && !q.continuous) || (!a.second.before && !b.second.before)) return;
        if (changed && !touch) ++most.near, ++most.tested;
        if (std::binary_search(touched_.begin(), touched_.end(), pair)) return;
        const std::optional<Hit<D>> hit = sweep_between(a.second, b.second);
        if (hit) met_[pair] = hit->fraction;
        if (hit && !touch) passed_.push_back(pair);
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
    std::map<IdPair, float> met_;
};

}  // namespace abut::test
