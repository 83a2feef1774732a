// Boxes that move, and the broad phases over them, for the page.

#include "broad_phase.h"

#include "broad_phase_insides.hpp"
#include "json.hpp"

#include <variant>

#include <scenes/moving_boxes.hpp>
#include <scenes/skewed_boxes.hpp>

using namespace abut::detail;
using namespace abut::play;
using abut::Aabb2;

namespace {

using Scene = std::variant<abut::scenes::MovingBoxes<2>, abut::scenes::SkewedBoxes<2>>;
/// In the order of BroadPhaseKind, and then a Temporal.
using Structure = std::variant<abut::BruteForce<2>, abut::Grid<2>, abut::LayeredGrid<2>, abut::SweepAndPrune<2>,
                               abut::Bvh<2>, abut::Bsp<2>, TemporalGrid>;

constexpr std::uint32_t max_boxes = 100000;
constexpr std::uint64_t seed = 7;

template <std::size_t... I>
Structure structure_of(std::size_t index, std::index_sequence<I...>) {
    Structure result;
    static_cast<void>(((index == I && (result.emplace<I>(), true)) || ...));
    return result;
}

template <class T>
void write(const std::vector<T>& elements, abut_buffer& out) {
    const auto bytes = std::as_bytes(std::span(elements));
    out.bytes.assign(bytes.begin(), bytes.end());
}

template <class Phase>
constexpr bool is_temporal = std::is_same_v<Phase, TemporalGrid>;
template <class Phase>
constexpr bool is_brute_force = std::is_same_v<Phase, abut::BruteForce<2>>;

}  // namespace

struct abut_play_broad_phase {
    Structure structure;
    Scene scene{std::in_place_index<0>, 0, seed};
    float top_speed = 0;  ///< no box of the scene is faster
    std::vector<ItemPair> pairs{};

    std::span<const Aabb2> boxes() const {
        return std::visit([](const auto& one) { return one.boxes(); }, scene);
    }
    /// The top speed of each box along an axis.
    std::vector<float> top_speeds() const {
        std::vector<float> result(boxes().size(), top_speed);
        if (const auto* moving = std::get_if<0>(&scene))
            for (std::size_t i = 0; i < result.size(); ++i) {
                const abut::Vec2 step = moving->last_steps()[i];
                result[i] = std::max(std::abs(step.x), std::abs(step.y));
            }
        return result;
    }
    void build() {
        std::visit(
            [&]<class Phase>(Phase& phase) {
                if constexpr (is_temporal<Phase>)
                    phase.build(boxes(), top_speeds());
                else
                    phase.build(boxes());
            },
            structure);
    }
    void replace(Scene boxes_of_scene) {
        scene = std::move(boxes_of_scene);
        pairs.clear();
        build();
    }
};

namespace {

/// Calls body(structure) for a structure that is not a Temporal; that one has no queries.
template <class Body>
abut_code with_queries(const abut_play_broad_phase* phase, std::initializer_list<Fault> faults, const Body& body) {
    if (const Fault fault = present(phase, "phase"); fault.code != ABUT_OK) return report(fault);
    return entry(faults, [&] {
        std::visit(
            [&]<class Phase>(const Phase& one) {
                if constexpr (!is_temporal<Phase>) body(one);
            },
            phase->structure);
    });
}

/// Calls body(structure) for a Temporal.
template <class Body>
abut_code with_temporal(const abut_play_broad_phase* phase, abut_buffer* out, const Body& body) {
    if (const Fault fault = present(phase, "phase"); fault.code != ABUT_OK) return report(fault);
    const auto* temporal = std::get_if<TemporalGrid>(&phase->structure);
    const Fault fault = temporal != nullptr ? Fault() : Fault{ABUT_BAD_ARGUMENT, "phase", "is not a Temporal"};
    return entry({present(out, "out"), fault}, [&] { body(*temporal); });
}

Fault count_within(std::uint32_t count) {
    return count <= max_boxes ? Fault() : Fault{ABUT_BAD_ARGUMENT, "count", "is above 100000"};
}

}  // namespace

abut_code abut_play_broad_phase_create(uint32_t structure, abut_play_broad_phase** out) {
    constexpr std::size_t count = std::variant_size_v<Structure>;
    const Fault fault = structure < count ? Fault() : Fault{ABUT_BAD_ARGUMENT, "structure", "is above 6"};
    return entry({present(out, "out"), fault}, [&] {
        *out = new abut_play_broad_phase{structure_of(structure, std::make_index_sequence<count>())};
        (*out)->build();
    });
}
void abut_play_broad_phase_release(abut_play_broad_phase* phase) {
    delete phase;
}

abut_code abut_play_broad_phase_scatter(abut_play_broad_phase* phase, uint32_t count, float overlaps,
                                        uint32_t one_in_moves, float speed) {
    const bool is_usable = overlaps >= 0.01f && one_in_moves > 0 && speed >= 0 && speed <= 1;
    const Fault fault = is_usable ? Fault() : Fault{ABUT_BAD_ARGUMENT, "overlaps", "or another number is out of range"};
    return entry({present(phase, "phase"), count_within(count), fault}, [&] {
        // Slow boxes need finer steps; coordinates below 1024 are multiples of them without rounding.
        phase->top_speed = speed;
        phase->replace(Scene(std::in_place_index<0>, count, seed,
                             abut::scenes::MovingBoxesOptions{.overlaps = static_cast<double>(overlaps),
                                                              .one_in_moves = one_in_moves,
                                                              .speed = static_cast<double>(speed),
                                                              .fineness = 16384}));
    });
}
abut_code abut_play_broad_phase_scatter_skewed(abut_play_broad_phase* phase, uint32_t count) {
    return entry({present(phase, "phase"), count_within(count)}, [&] {
        phase->top_speed = 0.101f;  // steps of up to 0.1 are rounded down to multiples of 1/1024
        phase->replace(Scene(std::in_place_index<1>, count, seed));
    });
}

abut_code abut_play_broad_phase_step(abut_play_broad_phase* phase) {
    return entry({present(phase, "phase")}, [&] { std::visit([](auto& scene) { scene.step(); }, phase->scene); });
}
abut_code abut_play_broad_phase_build(abut_play_broad_phase* phase) {
    return entry({present(phase, "phase")}, [&] { phase->build(); });
}
abut_code abut_play_broad_phase_update(abut_play_broad_phase* phase) {
    return entry({present(phase, "phase")}, [&] {
        std::visit(
            [&]<class Phase>(Phase& one) {
                if constexpr (is_temporal<Phase>)
                    one.update(phase->boxes(), 1);
                else
                    one.update(phase->boxes());
            },
            phase->structure);
    });
}
abut_code abut_play_broad_phase_find_pairs(abut_play_broad_phase* phase, uint32_t* out) {
    return entry({present(phase, "phase"), present(out, "out")}, [&] {
        phase->pairs.clear();
        const auto append = [&](std::uint32_t i, std::uint32_t j) { phase->pairs.emplace_back(i, j); };
        std::visit([&](const auto& one) { one.each_pair(append); }, phase->structure);
        *out = static_cast<std::uint32_t>(phase->pairs.size());
    });
}

abut_code abut_play_broad_phase_boxes(const abut_play_broad_phase* phase, abut_buffer* out) {
    return entry({present(phase, "phase"), present(out, "out")}, [&] {
        const auto bytes = std::as_bytes(phase->boxes());
        out->bytes.assign(bytes.begin(), bytes.end());
    });
}
abut_code abut_play_broad_phase_pairs(const abut_play_broad_phase* phase, abut_buffer* out) {
    return entry({present(phase, "phase"), present(out, "out")}, [&] { write(phase->pairs, *out); });
}
abut_code abut_play_broad_phase_bounds(const abut_play_broad_phase* phase, abut_aabb2* out) {
    return entry({present(phase, "phase"), present(out, "out")}, [&] {
        Aabb2 result = phase->boxes().empty() ? Aabb2{} : phase->boxes().front();
        for (const Aabb2& box : phase->boxes()) result = merged(result, box);
        *out = same_bytes<abut_aabb2>(result);
    });
}

abut_code abut_play_broad_phase_lines(const abut_play_broad_phase* phase, abut_buffer* out) {
    return with_queries(phase, {present(out, "out")}, [&]<class Phase>(const Phase& one) {
        if constexpr (!is_brute_force<Phase>) write(lines_of(one), *out);
    });
}
abut_code abut_play_broad_phase_overlapping(const abut_play_broad_phase* phase, abut_aabb2 box, abut_buffer* out) {
    return with_queries(phase, {finite(box, "box"), present(out, "out")}, [&](const auto& one) {
        Items items;
        one.each_overlapping(same_bytes<Aabb2>(box), [&](std::uint32_t item) { items.push_back(item); });
        write(items, *out);
    });
}
abut_code abut_play_broad_phase_candidates(const abut_play_broad_phase* phase, abut_aabb2 box, abut_buffer* out) {
    return with_queries(phase, {finite(box, "box"), present(out, "out")}, [&]<class Phase>(const Phase& one) {
        Items items;
        if constexpr (is_brute_force<Phase>)
            for (std::uint32_t i = 0; i < one.size(); ++i) items.push_back(i);
        else
            Candidates<Phase>(one).of(same_bytes<Aabb2>(box), items);
        write(items, *out);
    });
}
abut_code abut_play_broad_phase_candidate_pairs(const abut_play_broad_phase* phase, double* out) {
    return with_queries(phase, {present(out, "out")}, [&]<class Phase>(const Phase& one) {
        const auto count = static_cast<double>(one.size());
        if constexpr (is_brute_force<Phase>) {
            *out = 0.5 * count * (count - 1);
        } else {
            Candidates<Phase> candidates(one);
            Items items;
            double reached = 0;
            for (const Aabb2& box : phase->boxes()) {
                candidates.of(box, items);
                reached += static_cast<double>(items.size());
            }
            *out = 0.5 * (reached - count);  // each box reaches itself
        }
    });
}

abut_code abut_play_broad_phase_not_before(const abut_play_broad_phase* phase, abut_buffer* out) {
    return with_temporal(phase, out, [&](const TemporalGrid& temporal) { write(not_before(temporal), *out); });
}
abut_code abut_play_broad_phase_top_speeds(const abut_play_broad_phase* phase, abut_buffer* out) {
    return with_temporal(phase, out, [&](const TemporalGrid&) { write(phase->top_speeds(), *out); });
}
abut_code abut_play_broad_phase_counts(const abut_play_broad_phase* phase, abut_buffer* out) {
    return with_temporal(phase, out, [&](const TemporalGrid& temporal) {
        const abut::TemporalCounts& counts = temporal.counts();
        Json json;
        json.begin('{');
        const auto add = [&](const char* name, std::uint64_t count) {
            json.key(name).count(static_cast<std::size_t>(count));
        };
        add("updates", counts.updates);
        add("searches", counts.searches);
        add("looks", counts.looks);
        add("plain_searches", counts.plain_searches);
        add("plain_looks", counts.plain_looks);
        add("too_fast", counts.too_fast);
        json.end('}').write(*out);
    });
}
