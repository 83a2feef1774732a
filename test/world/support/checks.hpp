#pragma once

// Compares the answers of a world with those of the reference world, at random, and counts them.

#include "bits.hpp"
#include "simulation.hpp"
#include <abut/math/detail/rigid_path.hpp>
#include <abut/math/thread_pool.hpp>

#include <array>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace abut::test {

/// Counts the answers of each kind: a test in which all answers are negative proves nothing.
struct Seen {
    int passed = 0, on_the_way = 0, ghosts = 0, covered = 0;
    int touching = 0, several_touching = 0, nearest = 0, all_nearest = 0;
    int began = 0, stayed = 0, ended = 0, contacts = 0, untested = 0;
    int hits = 0, several_hits = 0, misses = 0, gaps = 0, depths = 0, overlapping = 0, containing = 0, stopped = 0;
    int reused = 0, edited = 0, restored = 0, past = 0;
    int sweep_hits = 0, sweep_misses = 0, at_once = 0, query_contacts = 0, in_box = 0;
};

inline std::ostream& operator<<(std::ostream& out, const Seen& seen) {
    return out << "began " << seen.began << ", stayed " << seen.stayed << ", ended " << seen.ended << ", contacts "
               << seen.contacts << ", untested " << seen.untested << "; hits " << seen.hits << ", several "
               << seen.several_hits << ", misses " << seen.misses << "; gaps " << seen.gaps << ", depths "
               << seen.depths << "; ghosts " << seen.ghosts << ", left out " << seen.covered << "; passed "
               << seen.passed << ", impacts " << seen.on_the_way << "; overlapping " << seen.overlapping
               << ", containing " << seen.containing << ", in a box " << seen.in_box << ", stopped " << seen.stopped
               << "; touching " << seen.touching << ", several " << seen.several_touching << "; nearest "
               << seen.nearest << ", all there are " << seen.all_nearest << "; sweeps that hit " << seen.sweep_hits
               << ", at once " << seen.at_once << ", miss " << seen.sweep_misses << "; contacts of shapes "
               << seen.query_contacts << "; reused " << seen.reused << ", edited " << seen.edited << ", restored "
               << seen.restored << ", of the past " << seen.past;
}

/// The questions to a world, which may be the past of the game's.
template <int D>
class Checks {
public:
    Checks(Simulation<D>& game, const World<D>& world, const ReferenceWorld<D>& reference, Executor& executor,
           Seen& seen)
        : game_(game), world_(world), reference_(reference), executor_(executor), seen_(seen) {}

    void rays() {
        const Vec<D> from = game_.any_point(), to = game_.any_point();
        Ray<D> ray = Ray<D>::between(from, to);
        if (game_.random().chance(0.3)) ray.length = std::numeric_limits<float>::infinity();
        const Filter filter = game_.filter();
        const std::vector<WorldHit<D>> expected = reference_.raycast_all(ray, filter);
        ASSERT_EQ(Bits(world_.raycast_all(ray, filter)), Bits(expected));
        const auto first = expected.empty() ? std::nullopt : std::optional(expected.front());
        ASSERT_EQ(Bits(world_.raycast(ray, filter)), Bits(first));
        ASSERT_EQ(world_.raycast_any(ray, filter), !expected.empty());
        const std::array rays{ray, Ray<D>::between(to, from)};
        std::array<std::optional<WorldHit<D>>, 2> hits;
        with_or_without_executor([&](auto&... executor) { world_.raycast(rays, hits, executor..., filter); });
        const std::vector<WorldHit<D>> back = reference_.raycast_all(rays[1], filter);
        ASSERT_EQ(Bits(hits[0]), Bits(first));
        ASSERT_EQ(Bits(hits[1]), Bits(back.empty() ? std::nullopt : std::optional(back.front())));
        ++(expected.empty() ? seen_.misses : seen_.hits);
        seen_.several_hits += expected.size() > 1 ? 1 : 0;
    }

    void shapes() {
        oracle::Random& random = game_.random();
        const Filter filter = game_.filter();
        const Pose<D> pose = game_.any_pose();
        game_.with_any_shape([&](const auto& shape) {
            const auto placed = at(shape, pose);
            const View<D> query = view(placed);
            const auto nearest = reference_.closest(query, filter);
            ASSERT_EQ(Bits(world_.closest(placed, filter)), Bits(nearest));
            if (nearest) ++(nearest->closest.distance > 0 ? seen_.gaps : seen_.depths);

            const std::size_t k = random.below(random.chance(0.7) ? 12 : 200);
            const auto nearest_k = reference_.k_nearest(query, k, filter);
            ASSERT_EQ(Bits(world_.k_nearest(placed, k, filter)), Bits(nearest_k));
            ++(nearest_k.size() < k ? seen_.all_nearest : seen_.nearest);

            const std::vector<Id> all = reference_.overlapping(query, filter);
            ASSERT_EQ(world_.overlapping(placed, filter), all);
            seen_.overlapping += all.empty() ? 0 : 1;
            early_stop(placed, filter, all, 1 + random.below(3));

            const std::array poses{pose, Pose<D>{0.5f * pose.position, pose.rotation}};
            many(shape, poses, filter);
        });
    }

    void points() {
        const Filter filter = game_.filter();
        const std::array points{game_.any_point(), game_.any_point()};
        const std::vector<Id> holders = reference_.containing(points[0], filter);
        ASSERT_EQ(world_.containing(points[0], filter), holders);
        seen_.containing += holders.empty() ? 0 : 1;
        std::array<std::optional<WorldClosest<D>>, 2> nearest;
        with_or_without_executor([&](auto&... executor) { world_.closest(points, nearest, executor..., filter); });
        for (std::size_t i = 0; i < points.size(); ++i) {
            const View<D> as_shape(detail::round_points<D>({points[i]}, 0));
            ASSERT_EQ(Bits(world_.closest(points[i], filter)), Bits(reference_.closest(as_shape, filter)));
            ASSERT_EQ(Bits(nearest[i]), Bits(reference_.closest(as_shape, filter)));
            ASSERT_EQ(Bits(world_.k_nearest(points[i], 3, filter)), Bits(reference_.k_nearest(as_shape, 3, filter)));
        }
    }

    void sweeps() {
        oracle::Random& random = game_.random();
        const Filter filter = game_.filter();
        const Pose<D> from = game_.any_pose(), to = game_.any_pose();
        const Vec<D> motion = (to.position - from.position) * (random.chance(0.2) ? 0.1f : 1.0f);
        Motion<D> turning = Motion<D>::between(from, to);
        turning.turn *= random.chance(0.3) ? 7.0f : 1.0f;
        game_.with_any_shape([&](const auto& shape) {
            const auto placed = at(shape, from);
            const View<D> query = view(placed), own = view(shape);
            using Item = typename ReferenceWorld<D>::Item;
            const auto straight = reference_.first_hit(
                query, filter, [&](const Item& item) { return sweep(query, motion, item.view(), Vec<D>(0.0f)); });
            same_but_for_seams(world_.sweep(placed, motion, filter), straight, query,
                               [&](const Hit<D>&) { return detail::DVec<D>(motion); });
            const auto spun = reference_.first_hit(own, filter, [&](const Item& item) {
                return sweep(own, turning, item.placed({}), Motion<D>{.from = item.options.pose});
            });
            const auto along = [](const detail::RigidPath<D>& path) {
                return [path](const Hit<D>& hit) {
                    return path.velocity(static_cast<double>(hit.fraction), detail::DVec<D>(hit.point));
                };
            };
            const auto found = world_.sweep(shape, turning, filter);
            same_but_for_seams(found, spun, own, along(detail::rigid_path(turning)));
            std::array<std::optional<WorldHit<D>>, 2> hits;
            const std::array turnings{turning, turning};
            with_or_without_executor(
                [&](auto&... executor) { world_.sweep(shape, turnings, hits, executor..., filter); });
            for (const auto& hit : hits) ASSERT_EQ(Bits(hit), Bits(found));
            const auto between = reference_.first_hit(own, filter, [&](const Item& item) {
                const Pose<D>& there = item.options.pose;
                return sweep(own, from, to, item.placed({}), there, there);
            });
            same_but_for_seams(world_.sweep(shape, from, to, filter), between, own,
                               along(detail::rigid_path(from, to)));
        });
    }

    void contacts_of_shapes() {
        const Filter filter = game_.filter();
        const float margin = game_.random().chance(0.3) ? 0.1f : 0;
        const Pose<D> pose = game_.any_pose();
        game_.with_any_shape([&](const auto& shape) {
            const auto placed = at(shape, pose);
            std::vector<WorldContact<D>> found;
            const auto note = [&](Id id, const Contact<D>& contact) { found.push_back({{}, id, contact}); };
            world_.each_contact(placed, note, filter, {.margin = margin});
            std::ranges::stable_sort(found, {}, &WorldContact<D>::b);
            ASSERT_EQ(Bits(found), Bits(reference_.contacts_of(view(placed), filter, margin)));
            seen_.query_contacts += found.empty() ? 0 : 1;
        });
    }

    /// An item has a margin, so that it may be found where its own box is not.
    void box() {
        const Filter filter = game_.filter();
        const Aabb<D> box{Vec<D>(-0.5f) + game_.any_point(), Vec<D>(1.0f) + game_.any_point()};
        std::vector<Id> found;
        world_.each_in_box(
            box, [&](Id id, const View<D>&) { found.push_back(id); }, filter);
        std::sort(found.begin(), found.end());
        ASSERT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
        for (const auto& [id, item] : reference_.items()) {
            const bool is_found = std::binary_search(found.begin(), found.end(), id);
            const bool passes = ReferenceWorld<D>::passes(id, item, filter);
            const Aabb<D> own = detail::bounds(item.view());
            if (passes && overlaps(own, box)) {
                ASSERT_TRUE(is_found) << id.index;
            }
            if (!passes || !overlaps(grown(own, 1e-5f * (1 + length(own.max - own.min))), box)) {
                ASSERT_FALSE(is_found) << id.index;
            }
        }
        seen_.in_box += found.empty() ? 0 : 1;
    }

    void items() {
        ASSERT_EQ(world_.size(), reference_.items().size());
        std::vector<Id> expected, all;
        for (const auto& [id, item] : reference_.items()) {
            expected.push_back(id);
            const ItemOptions<D> options = world_.options(id);
            ASSERT_EQ(options.pose, item.options.pose);
            ASSERT_EQ(world_.pose(id), item.options.pose);
            ASSERT_EQ(std::tie(options.user, options.layers, options.mask, options.fixed, options.sensor,
                               options.continuous, options.group, options.enabled),
                      std::tie(item.options.user, item.options.layers, item.options.mask, item.options.fixed,
                               item.options.sensor, item.options.continuous, item.options.group, item.options.enabled));
            ASSERT_EQ(
                std::tuple(world_.user(id), world_.layers(id), world_.mask(id), world_.is_fixed(id),
                           world_.is_sensor(id), world_.is_continuous(id), world_.group(id), world_.is_enabled(id)),
                std::tuple(options.user, options.layers, options.mask, options.fixed, options.sensor,
                           options.continuous, options.group, options.enabled));
        }
        for (const Id id : game_.given) ASSERT_EQ(world_.contains(id), reference_.items().contains(id));
        world_.each_item([&](Id id) { all.push_back(id); });
        ASSERT_EQ(all, expected);
    }

    /// These must not depend on whether anything changed since the last update.
    void touching() {
        for (const auto& [id, item] : reference_.items()) {
            const std::vector<Id> expected = reference_.touching(id), found = world_.touching(id);
            ASSERT_EQ(found, expected);
            seen_.touching += found.empty() ? 0 : 1;
            seen_.several_touching += found.size() > 2 ? 1 : 0;
            std::vector<Id> first;
            world_.each_touching(id, [&](Id other) {
                first.push_back(other);
                return false;
            });
            ASSERT_EQ(first, std::vector<Id>(found.begin(), found.begin() + (found.empty() ? 0 : 1)));
        }
    }

    /// The lists of the last update, and what is asked about each of its pairs.
    void events(const Events& events) {
        ASSERT_EQ(Bits(events.began), Bits(reference_.began));
        ASSERT_EQ(Bits(events.stayed), Bits(reference_.stayed));
        ASSERT_EQ(Bits(events.ended), Bits(reference_.ended));
        ASSERT_EQ(Bits(events.fractions), Bits(reference_.fractions));
        ASSERT_NO_FATAL_FAILURE(contacts());
        ASSERT_EQ(Bits(world_.impacts()), Bits(reference_.impacts));
        ASSERT_NO_FATAL_FAILURE(pairs(events));
        const UpdateCounts counts = world_.counts(), min = reference_.min_counts, max = reference_.max_counts;
        ASSERT_TRUE(min.near <= counts.near && counts.near <= max.near) << min.near << " " << counts.near;
        ASSERT_TRUE(min.tested <= counts.tested && counts.tested <= max.tested) << min.tested << " " << counts.tested;
        seen_.began += static_cast<int>(events.began.size());
        seen_.passed += static_cast<int>(reference_.passed);
        for (const float fraction : events.fractions) seen_.on_the_way += fraction < 1 ? 1 : 0;
        seen_.stayed += static_cast<int>(events.stayed.size());
        seen_.ended += static_cast<int>(events.ended.size());
        seen_.contacts += static_cast<int>(world_.contacts().size());
        seen_.untested += static_cast<int>(counts.near - counts.tested);
    }

private:
    template <class Call>
    void with_or_without_executor(const Call& call) {
        if (game_.random().chance(0.3))
            call(executor_);
        else
            call();
    }

    /// A visitor that stops after `limit` calls gets that many distinct and correct items.
    template <class S>
    void early_stop(const S& shape, const Filter& filter, const std::vector<Id>& all, std::size_t limit) {
        std::vector<Id> visited;
        const auto visit = [&](Id id) {
            visited.push_back(id);
            return visited.size() < limit;
        };
        world_.each_overlapping(shape, visit, filter);
        ASSERT_EQ(visited.size(), std::min(limit, all.size()));
        std::sort(visited.begin(), visited.end());
        ASSERT_TRUE(std::includes(all.begin(), all.end(), visited.begin(), visited.end()));
        ASSERT_EQ(std::adjacent_find(visited.begin(), visited.end()), visited.end());
        seen_.stopped += visited.size() < all.size() ? 1 : 0;
    }

    /// One shape at several poses.
    template <class S>
    void many(const S& shape, const std::array<Pose<D>, 2>& poses, const Filter& filter) {
        std::array<std::optional<WorldClosest<D>>, 2> nearest;
        IdLists overlapping;
        with_or_without_executor([&](auto&... executor) {
            world_.closest(shape, poses, nearest, executor..., filter);
            world_.overlapping(shape, poses, overlapping, executor..., filter);
        });
        ASSERT_EQ(overlapping.size(), poses.size());
        for (std::size_t i = 0; i < poses.size(); ++i) {
            const auto placed = at(shape, poses[i]);
            const View<D> query = view(placed);
            ASSERT_EQ(Bits(nearest[i]), Bits(reference_.closest(query, filter)));
            ASSERT_EQ(Bits(overlapping[i]), Bits(reference_.overlapping(query, filter)));
        }
    }

    static std::string shown(const std::optional<WorldHit<D>>& hit) {
        if (!hit) return "\nno hit";
        std::ostringstream text;
        text << std::setprecision(9) << "\nitem " << hit->id.index << " at fraction " << hit->hit.fraction << ", point";
        for (int i = 0; i < D; ++i) text << " " << hit->hit.point[i];
        text << ", normal";
        for (int i = 0; i < D; ++i) text << " " << hit->hit.normal[i];
        text << ", part " << hit->hit.feature.part << ", feature " << hit->hit.feature.index << " of kind "
             << static_cast<int>(hit->hit.feature.kind);
        return text.str();
    }

    /// Compares two hits. If several items touch at the hit, the normal is that of their union, and only its side is
    /// compared: it faces the mover, which moves along `motion(hit)`.
    template <class MotionAt>
    void same_but_for_seams(const std::optional<WorldHit<D>>& found, std::optional<WorldHit<D>> expected,
                            const View<D>& mover, const MotionAt& motion) {
        using detail::DVec;
        if (found && expected && found->hit.normal != expected->hit.normal) {
            // Others count as near where the filter of the normal looks for them: twice as far as the mover's centre.
            int near = 0;
            for (const auto& [id, item] : reference_.items())
                near += static_cast<double>(closest(item.view(), found->hit.point).distance) < 2.1 * detail::size(mover)
                            ? 1
                            : 0;
            // The normal of a single composite is filtered twice. At an edge, the second result depends on the first.
            const double off = length(DVec<D>(found->hit.normal) - DVec<D>(expected->hit.normal));
            EXPECT_TRUE(near > 1 || off < 1e-3) << off << shown(found) << shown(expected);
            EXPECT_NEAR(length(DVec<D>(found->hit.normal)), 1, 1e-6);
            const DVec<D> velocity = motion(found->hit);
            EXPECT_LE(dot(DVec<D>(found->hit.normal), velocity), 1e-6 * length(velocity))
                << shown(found) << shown(expected);
        }
        if (found && expected) expected->hit.normal = found->hit.normal;  // 0 may be -0
        EXPECT_TRUE(Bits(found) == Bits(expected)) << shown(found) << shown(expected);
        ++(found ? seen_.sweep_hits : seen_.sweep_misses);
        seen_.at_once += found && found->hit.fraction == 0 ? 1 : 0;
    }

    void contacts() {
        const std::span<const WorldContact<D>> found = world_.contacts();
        const auto pair_of = [](const WorldContact<D>& each) {
            return std::to_string(each.a.index) + " and " + std::to_string(each.b.index) + ", depth " +
                   std::to_string(each.contact.depth);
        };
        for (std::size_t i = 0; i < std::min(found.size(), reference_.contacts.size()); ++i)
            ASSERT_EQ(Bits(found[i]), Bits(reference_.contacts[i]))
                << pair_of(found[i]) << "; " << pair_of(reference_.contacts[i]);
        ASSERT_EQ(found.size(), reference_.contacts.size());
    }

    /// `contact` and `impact` of every touching or begun pair return the entries of the lists.
    void pairs(const Events& events) {
        std::size_t contacts = 0, impacts = 0;
        for (const std::span<const IdPair> pairs : {events.began, events.stayed})
            for (const IdPair& pair : pairs) {
                const Contact<D> contact = world_.contact(pair);
                ASSERT_EQ(Bits(world_.contact({pair.b, pair.a})), Bits(contact));
                const auto is_of_pair = [&](const auto& entry) { return IdPair{entry.a, entry.b} == pair; };
                const auto listed = std::find_if(world_.contacts().begin(), world_.contacts().end(), is_of_pair);
                ASSERT_EQ(static_cast<bool>(contact), listed != world_.contacts().end());
                if (contact) {
                    ASSERT_EQ(Bits(contact), Bits(listed->contact));
                }
                contacts += static_cast<std::size_t>(
                    std::count_if(world_.contacts().begin(), world_.contacts().end(), is_of_pair));
                const std::optional<Hit<D>> impact = world_.impact(pair);
                const auto found = std::find_if(world_.impacts().begin(), world_.impacts().end(), is_of_pair);
                ASSERT_EQ(impact.has_value(), found != world_.impacts().end());
                if (impact) {
                    ASSERT_EQ(Bits(*impact), Bits(found->hit));
                }
                impacts += impact ? 1 : 0;
            }
        ASSERT_EQ(contacts, world_.contacts().size());
        ASSERT_EQ(impacts, world_.impacts().size());
        for (const IdPair& pair : events.ended)
            if (!std::binary_search(events.began.begin(), events.began.end(), pair)) {
                ASSERT_FALSE(world_.contact(pair));
                ASSERT_FALSE(world_.impact(pair));
            }
    }

    Simulation<D>& game_;
    const World<D>& world_;
    const ReferenceWorld<D>& reference_;
    Executor& executor_;
    Seen& seen_;
};

}  // namespace abut::test
