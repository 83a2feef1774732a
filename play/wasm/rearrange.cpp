// Disassembly orders and rearrangements.

#include "rearrange.h"

#include "json.hpp"
#include <abut/motion/order/projection.hpp>

#include <algorithm>

using namespace abut::detail;
using abut::play::Json;

namespace {

template <int D>
using Handles = const typename CTypes<D>::Shape* const*;

/// The views of convex shapes; else the fault.
template <int D>
Fault read(Handles<D> shapes, std::uint32_t count, std::vector<Convex<D>>& out) {
    for (std::uint32_t i = 0; i < count; ++i) {
        Fault fault = present(shapes[i], "shapes");
        if (fault.code == ABUT_OK) {
            const abut::View<D> view = shapes[i]->shape.view();
            if (const auto* convex = std::get_if<Convex<D>>(&view))
                out.push_back(*convex);
            else
                fault = {ABUT_WRONG_SHAPE, "shapes", "is not convex"};
        }
        fault.index = i;
        if (fault.code != ABUT_OK) return fault;
    }
    return {};
}

template <int D>
bool is_zero(const typename CTypes<D>::Vec& direction) {
    return same_bytes<abut::Vec<D>>(direction) == abut::Vec<D>(0.0f);
}
template <int D>
Fault valid(const typename CTypes<D>::Vec& direction, const char* name) {
    return is_zero<D>(direction) ? Fault{ABUT_BAD_ARGUMENT, name, "is zero"} : finite(direction, name);
}

void write(Json& json, const char* key, std::span<const std::uint32_t> numbers) {
    json.key(key).begin('[');
    for (const std::uint32_t each : numbers) json.count(each);
    json.end(']');
}
template <int D>
void write(Json& json, const char* key, const abut::Pose<D>& pose) {
    const auto numbers = std::bit_cast<std::array<float, sizeof(abut::Pose<D>) / sizeof(float)>>(pose);
    json.key(key).begin('{').key("position").template vec<D>(pose.position).key("rotation").begin('[');
    for (std::size_t i = D; i < numbers.size(); ++i) json.number(numbers[i]);
    json.end(']').end('}');
}

template <int D>
abut_code removal_order(Handles<D> shapes, std::uint32_t count, const typename CTypes<D>::Vec& direction,
                        abut_buffer* out) {
    return entry({array(shapes, count, "shapes"), valid<D>(direction, "direction"), present(out, "out")}, [&] {
        std::vector<Convex<D>> views;
        if (const Fault fault = read<D>(shapes, count, views); fault.code != ABUT_OK) return report(fault);
        const abut::RemovalOrder order =
            abut::removal_order(std::span<const Convex<D>>(views), same_bytes<abut::Vec<D>>(direction));
        Json json;
        json.begin('{');
        write(json, "order", order.order);
        write(json, "cycle", order.cycle);
        json.end('}').write(*out);
        return ABUT_OK;
    });
}

/// The numbers of the shapes that overlap another one by more than the tolerance.
template <int D>
std::vector<std::uint32_t> overlapping(const std::vector<Convex<D>>& views, const std::vector<abut::Pose<D>>& poses) {
    std::vector<Convex<D>> placed;
    for (std::size_t i = 0; i < views.size(); ++i) placed.push_back(moved(views[i], affine(poses[i])));
    std::vector<bool> overlaps(views.size(), false);
    for (std::size_t i = 0; i < placed.size(); ++i)
        for (std::size_t j = i + 1; j < placed.size(); ++j) {
            if (!abut::overlaps(bounds(placed[i]), bounds(placed[j]))) continue;
            const auto distance = static_cast<double>(abut::closest(placed[i], placed[j]).distance);
            if (distance < -tolerance_for(placed[i], placed[j])) overlaps[i] = overlaps[j] = true;
        }
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < overlaps.size(); ++i)
        if (overlaps[i]) result.push_back(i);
    return result;
}

template <int D>
abut_code rearranged(Handles<D> shapes, std::uint32_t count, const typename CTypes<D>::Pose* from,
                     const typename CTypes<D>::Pose* to, const typename CTypes<D>::Vec& away, abut_buffer* out) {
    const Strided from_of(from, 0, count, "from"), to_of(to, 0, count, "to");
    return entry({array(shapes, count, "shapes"), from_of.fault_of_elements(), to_of.fault_of_elements(),
                  valid<D>(away, "away"), present(out, "out")},
                 [&] {
                     std::vector<Convex<D>> views;
                     if (const Fault fault = read<D>(shapes, count, views); fault.code != ABUT_OK) return report(fault);
                     const auto begin = from_of.template copied<abut::Pose<D>>();
                     const auto goal = to_of.template copied<abut::Pose<D>>();
                     std::vector<std::uint32_t> faults = overlapping(views, begin);
                     if (faults.empty()) faults = overlapping(views, goal);
                     abut::Rearrangement<D> plan;
                     if (faults.empty())
                         plan = abut::rearrange(std::span<const Convex<D>>(views), std::span(begin), std::span(goal),
                                                abut::RearrangeOptions<D>{.away = same_bytes<abut::Vec<D>>(away)});
                     Json json;
                     json.begin('{').key("moves").begin('[');
                     for (const abut::Move<D>& move : plan.moves) {
                         json.begin('{').key("shape").count(move.shape);
                         write<D>(json, "from", move.from);
                         write<D>(json, "to", move.to);
                         json.end('}');
                     }
                     json.end(']');
                     write(json, "stuck", plan.stuck);
                     write(json, "overlapping", faults);
                     json.end('}').write(*out);
                     return ABUT_OK;
                 });
}

}  // namespace

abut_code abut_play_removal_order2(const abut_shape2* const* shapes, uint32_t count, abut_vec2 direction,
                                   abut_buffer* out) {
    return removal_order<2>(shapes, count, direction, out);
}
abut_code abut_play_removal_order3(const abut_shape3* const* shapes, uint32_t count, abut_vec3 direction,
                                   abut_buffer* out) {
    return removal_order<3>(shapes, count, direction, out);
}
abut_code abut_play_rearrange2(const abut_shape2* const* shapes, uint32_t count, const abut_pose2* from,
                               const abut_pose2* to, abut_vec2 away, abut_buffer* out) {
    return rearranged<2>(shapes, count, from, to, away, out);
}
abut_code abut_play_rearrange3(const abut_shape3* const* shapes, uint32_t count, const abut_pose3* from,
                               const abut_pose3* to, abut_vec3 away, abut_buffer* out) {
    return rearranged<3>(shapes, count, from, to, away, out);
}
