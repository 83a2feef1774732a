// Random games against the reference implementation: the events, contacts and answers of a world are always those of
// testing every pair.

#include "support/simulation.hpp"

#include "../oracle/pair.hpp"
#include "support/bits.hpp"

#include <array>
#include <iostream>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// Counts the positive answers of each query: a test in which all answers are negative proves nothing.
struct Seen {
    int passed = 0, on_the_way = 0, ghosts = 0, covered = 0;
    int touching = 0, several_touching = 0, nearest = 0, all_nearest = 0;
    int began = 0, stayed = 0, ended = 0, contacts = 0, untested = 0;
    int hits = 0, several_hits = 0, misses = 0, gaps = 0, depths = 0, overlapping = 0, containing = 0, stopped = 0;
};

std::ostream& operator<<(std::ostream& out, const Seen& seen) {
    return out << "began " << seen.began << ", stayed " << seen.stayed << ", ended " << seen.ended << ", contacts "
               << seen.contacts << ", untested " << seen.untested << "; hits " << seen.hits << ", several "
               << seen.several_hits << ", misses " << seen.misses << "; gaps " << seen.gaps << ", depths "
               << seen.depths << "; ghosts " << seen.ghosts << ", left out " << seen.covered << "; passed "
               << seen.passed << ", impacts " << seen.on_the_way << "; overlapping " << seen.overlapping
               << ", containing " << seen.containing << ", stopped " << seen.stopped << "; touching " << seen.touching
               << ", several " << seen.several_touching << "; nearest " << seen.nearest << ", all there are "
               << seen.all_nearest;
}

template <int D>
void check_rays(Simulation<D>& game, Seen& seen) {
    oracle::Random& random = game.random();
    const Vec<D> from = game.any_point(), to = game.any_point();
    Ray<D> ray = Ray<D>::between(from, to);
    if (random.chance(0.3)) ray.length = std::numeric_limits<float>::infinity();
    const Filter filter = game.filter();
    const std::vector<WorldHit<D>> expected = game.reference.raycast_all(ray, filter);
    ASSERT_EQ(Bits(game.world.raycast_all(ray, filter)), Bits(expected));
    const auto first = expected.empty() ? std::nullopt : std::optional(expected.front());
    ASSERT_EQ(Bits(game.world.raycast(ray, filter)), Bits(first));
    ASSERT_EQ(game.world.raycast_any(ray, filter), !expected.empty());
    const std::array rays{ray, Ray<D>::between(to, from)};
    std::array<std::optional<WorldHit<D>>, 2> hits;
    game.world.raycast(rays, hits, filter);
    const std::vector<WorldHit<D>> back = game.reference.raycast_all(rays[1], filter);
    ASSERT_EQ(Bits(hits[0]), Bits(first));
    ASSERT_EQ(Bits(hits[1]), Bits(back.empty() ? std::nullopt : std::optional(back.front())));
    seen.misses += expected.empty() ? 1 : 0;
    seen.hits += expected.empty() ? 0 : 1;
    seen.several_hits += expected.size() > 1 ? 1 : 0;
}

/// Checks a visitor that stops after `limit` calls: it gets that many distinct and correct items.
template <int D, class S>
void check_early_stop(const Simulation<D>& game, const S& shape, const Filter& filter, const std::vector<Id>& all,
                      std::size_t limit, Seen& seen) {
    std::vector<Id> visited;
    game.world.each_overlapping(
        shape,
        [&](Id id) {
            visited.push_back(id);
            return visited.size() < limit;
        },
        filter);
    ASSERT_EQ(visited.size(), std::min(limit, all.size()));
    std::sort(visited.begin(), visited.end());
    ASSERT_TRUE(std::includes(all.begin(), all.end(), visited.begin(), visited.end()));
    ASSERT_EQ(std::adjacent_find(visited.begin(), visited.end()), visited.end());
    seen.stopped += visited.size() < all.size() ? 1 : 0;
}

/// Checks the questions about one shape at several poses.
template <int D, class S>
void check_many(const Simulation<D>& game, const S& shape, std::span<const Pose<D>> poses, const Filter& filter) {
    std::vector<std::optional<WorldClosest<D>>> nearest(poses.size());
    IdLists overlapping;
    game.world.closest(shape, poses, nearest, filter);
    game.world.overlapping(shape, poses, overlapping, filter);
    ASSERT_EQ(overlapping.size(), poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const auto placed = at(shape, poses[i]);
        const View<D> query = view(placed);
        ASSERT_EQ(Bits(nearest[i]), Bits(game.reference.closest(query, filter)));
        ASSERT_EQ(Bits(overlapping[i]), Bits(game.reference.overlapping(query, filter)));
    }
}

template <int D>
void check_shapes(Simulation<D>& game, Seen& seen) {
    oracle::Random& random = game.random();
    const Filter filter = game.filter();
    const Pose<D> pose = game.any_pose();
    game.with_any_shape([&](const auto& shape) {
        const auto placed = at(shape, pose);
        const View<D> query = view(placed);
        const auto nearest = game.reference.closest(query, filter);
        ASSERT_EQ(Bits(game.world.closest(placed, filter)), Bits(nearest));
        if (nearest) ++(nearest->closest.distance > 0 ? seen.gaps : seen.depths);

        const std::size_t k = random.below(random.chance(0.7) ? 12 : 200);
        const auto nearest_k = game.reference.k_nearest(query, k, filter);
        ASSERT_EQ(Bits(game.world.k_nearest(placed, k, filter)), Bits(nearest_k));
        ++(nearest_k.size() < k ? seen.all_nearest : seen.nearest);

        const std::vector<Id> all = game.reference.overlapping(query, filter);
        ASSERT_EQ(game.world.overlapping(placed, filter), all);
        seen.overlapping += all.empty() ? 0 : 1;
        check_early_stop(game, placed, filter, all, 1 + random.below(3), seen);

        const std::array poses{pose, Pose<D>{0.5f * pose.position, pose.rotation}};
        check_many<D>(game, shape, poses, filter);
    });
}

template <int D>
void check_points(Simulation<D>& game, Seen& seen) {
    const Filter filter = game.filter();
    const Vec<D> point = game.any_point();
    const std::vector<Id> holders = game.reference.containing(point, filter);
    ASSERT_EQ(game.world.containing(point, filter), holders);
    seen.containing += holders.empty() ? 0 : 1;
    const View<D> as_shape(detail::round_points<D>({point}, 0));
    ASSERT_EQ(Bits(game.world.closest(point, filter)), Bits(game.reference.closest(as_shape, filter)));
    ASSERT_EQ(Bits(game.world.k_nearest(point, 3, filter)), Bits(game.reference.k_nearest(as_shape, 3, filter)));
}

template <int D>
void check_queries(Simulation<D>& game, Seen& seen) {
    for (int i = 0; i < 2; ++i) {
        ASSERT_NO_FATAL_FAILURE(check_rays(game, seen));
        ASSERT_NO_FATAL_FAILURE(check_shapes(game, seen));
        ASSERT_NO_FATAL_FAILURE(check_points(game, seen));
    }
}

template <int D>
void check_items(const Simulation<D>& game) {
    const World<D>& world = game.world;
    ASSERT_EQ(world.size(), game.reference.items().size());
    for (const auto& [id, item] : game.reference.items()) {
        ASSERT_TRUE(world.contains(id));
        ASSERT_EQ(world.user(id), item.options.user);
        ASSERT_EQ(world.pose(id), item.options.pose);
        ASSERT_EQ(world.layers(id), item.options.layers);
        ASSERT_EQ(world.mask(id), item.options.mask);
        ASSERT_EQ(world.is_fixed(id), item.options.fixed);
        ASSERT_EQ(world.is_sensor(id), item.options.sensor);
        ASSERT_EQ(world.is_continuous(id), item.options.continuous);
        ASSERT_EQ(world.group(id), item.options.group);
        ASSERT_EQ(world.is_enabled(id), item.options.enabled);
    }
    std::vector<Id> all;
    world.each_item([&](Id id) { all.push_back(id); });
    ASSERT_EQ(all, game.all_ids());
}

/// Checks the queries, which must not depend on whether anything changed since the last update.
template <int D>
void check_touching(const Simulation<D>& game, Seen& seen) {
    for (const Id id : game.all_ids()) {
        const std::vector<Id> expected = game.reference.touching(id), found = game.world.touching(id);
        ASSERT_EQ(found, expected);
        seen.touching += found.empty() ? 0 : 1;
        seen.several_touching += found.size() > 2 ? 1 : 0;
        std::vector<Id> first;
        game.world.each_touching(id, [&](Id other) {
            first.push_back(other);
            return false;
        });
        ASSERT_EQ(first, std::vector<Id>(found.begin(), found.begin() + (found.empty() ? 0 : 1)));
    }
}

/// Checks that `contact` and `impact` of every touching or begun pair return the entries of the lists.
template <int D>
void check_pairs(const World<D>& world, const Events& events) {
    std::size_t contacts = 0, impacts = 0;
    for (const std::span<const IdPair> pairs : {events.began, events.stayed})
        for (const IdPair& pair : pairs) {
            const Contact<D> contact = world.contact(pair);
            ASSERT_EQ(Bits(world.contact({pair.b, pair.a})), Bits(contact));
            const auto is_of_pair = [&](const auto& entry) { return IdPair{entry.a, entry.b} == pair; };
            const auto listed = std::find_if(world.contacts().begin(), world.contacts().end(), is_of_pair);
            ASSERT_EQ(static_cast<bool>(contact), listed != world.contacts().end());
            if (contact) {
                ASSERT_EQ(Bits(contact), Bits(listed->contact));
            }
            contacts +=
                static_cast<std::size_t>(std::count_if(world.contacts().begin(), world.contacts().end(), is_of_pair));
            const std::optional<Hit<D>> impact = world.impact(pair);
            const auto found = std::find_if(world.impacts().begin(), world.impacts().end(), is_of_pair);
            ASSERT_EQ(impact.has_value(), found != world.impacts().end());
            if (impact) {
                ASSERT_EQ(Bits(*impact), Bits(found->hit));
            }
            impacts += impact ? 1 : 0;
        }
    ASSERT_EQ(contacts, world.contacts().size());
    ASSERT_EQ(impacts, world.impacts().size());
    for (const IdPair& pair : events.ended)
        if (!std::binary_search(events.began.begin(), events.began.end(), pair)) {
            ASSERT_FALSE(world.contact(pair));
            ASSERT_FALSE(world.impact(pair));
        }
}

template <int D>
void check_update(Simulation<D>& game, Seen& seen) {
    const Events events = game.world.update();
    game.reference.update();
    ASSERT_EQ(Bits(events.began), Bits(game.reference.began));
    ASSERT_EQ(Bits(events.stayed), Bits(game.reference.stayed));
    ASSERT_EQ(Bits(events.ended), Bits(game.reference.ended));
    ASSERT_EQ(Bits(events.fractions), Bits(game.reference.fractions));
    ASSERT_EQ(Bits(game.world.contacts()), Bits(game.reference.contacts));
    ASSERT_EQ(Bits(game.world.impacts()), Bits(game.reference.impacts));
    ASSERT_NO_FATAL_FAILURE(check_pairs(game.world, events));
    const UpdateCounts counts = game.world.counts(), min_counts = game.reference.min_counts,
                       max_counts = game.reference.max_counts;
    ASSERT_TRUE(min_counts.near <= counts.near && counts.near <= max_counts.near)
        << min_counts.near << " " << counts.near;
    ASSERT_TRUE(min_counts.tested <= counts.tested && counts.tested <= max_counts.tested)
        << min_counts.tested << " " << counts.tested;
    seen.began += static_cast<int>(events.began.size());
    seen.passed += static_cast<int>(game.reference.passed);
    for (const float fraction : events.fractions) seen.on_the_way += fraction < 1 ? 1 : 0;
    seen.stayed += static_cast<int>(events.stayed.size());
    seen.ended += static_cast<int>(events.ended.size());
    seen.contacts += static_cast<int>(game.world.contacts().size());
    seen.untested += static_cast<int>(game.world.counts().near - game.world.counts().tested);
}

/// Plays one game and adds its counts.
template <int D>
void play(std::uint64_t seed, int items, int frames, bool lattice, Seen& seen, double continuous = 0) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Simulation<D> game(seed, items, lattice, {}, continuous);
    game.with_all = true;
    for (int frame = 0; frame < frames; ++frame) {
        SCOPED_TRACE("frame " + std::to_string(frame));
        ASSERT_NO_FATAL_FAILURE(check_queries(game, seen));
        ASSERT_NO_FATAL_FAILURE(check_update(game, seen));
        ASSERT_NO_FATAL_FAILURE(check_queries(game, seen));
        ASSERT_NO_FATAL_FAILURE(check_items(game));
        ASSERT_NO_FATAL_FAILURE(check_touching(game, seen));
        game.change();
        ASSERT_NO_FATAL_FAILURE(check_touching(game, seen));
    }
    EXPECT_TRUE(game.fresh_ids);
    EXPECT_GT(game.reused, frames / 10);
    seen.ghosts += static_cast<int>(game.reference.ghosts);
    seen.covered += static_cast<int>(game.reference.covered);
    std::cout << "seed " << seed << ", so far: " << seen << "\n";
}

/// Plays a dense game, a sparse one, and a short one that is so dense that some items have more neighbours than are
/// tested one by one.
template <int D>
void play_all(std::uint64_t seed, bool lattice) {
    constexpr int frames = 150;
    Seen seen;
    for (int game = 0; game < oracle::case_count(1); ++game) {
        play<D>(seed++, 40, frames, lattice, seen);
        play<D>(seed++, 12, frames, lattice, seen);
        play<D>(seed++, 100, 12, lattice, seen);
    }
    for (const int count :
         {seen.began, seen.stayed, seen.ended, seen.contacts, seen.untested, seen.hits, seen.several_hits, seen.misses,
          seen.gaps, seen.depths, seen.ghosts, seen.covered, seen.overlapping, seen.containing, seen.stopped,
          seen.touching, seen.several_touching, seen.nearest, 3 * seen.all_nearest})
        EXPECT_GT(count, oracle::case_count(frames / 2));
}

TEST(Simulation, Plane) {
    play_all<2>(11, false);
}
TEST(Simulation, Space) {
    play_all<3>(1001, false);
}
TEST(Simulation, PlaneOnALattice) {
    play_all<2>(2001, true);
}
TEST(Simulation, SpaceOnALattice) {
    play_all<3>(3001, true);
}

template <int D>
void play_continuous(std::uint64_t seed) {
    constexpr int frames = 100;
    for (const bool lattice : {false, true}) {
        Seen seen;
        for (int game = 0; game < oracle::case_count(1); ++game) {
            play<D>(seed++, 30, frames, lattice, seen, 0.3);
            play<D>(seed++, 10, frames, lattice, seen, 1);
        }
        for (const int count : {seen.began, seen.ended, seen.passed, seen.on_the_way - seen.passed})
            EXPECT_GT(count, oracle::case_count(frames / 8));
    }
}

TEST(Simulation, PlaneWithContinuousItems) {
    play_continuous<2>(4001);
}
TEST(Simulation, SpaceWithContinuousItems) {
    play_continuous<3>(5001);
}

}  // namespace
}  // namespace abut::test
