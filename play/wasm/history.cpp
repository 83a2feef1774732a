// The past of a world for the page.

#include "history.h"

#include <abut/c/detail/handles.hpp>
#include <abut/world/history.hpp>

using namespace abut::detail;

struct abut_play_history2 {
    abut::History2 history;
};

abut_code abut_play_history2_create(const abut_world2* world, uint32_t ticks, uint64_t layers,
                                    abut_play_history2** out) {
    return entry({present(world, "world"), present(out, "out")},
                 [&] { *out = new abut_play_history2{abut::History2(world->world, ticks, {.layers = layers})}; });
}
void abut_play_history2_release(abut_play_history2* history) {
    delete history;
}
abut_code abut_play_history2_record(abut_play_history2* history) {
    return entry({present(history, "history")}, [&] { history->history.record(); });
}
abut_code abut_play_history2_ticks(const abut_play_history2* history, uint32_t* first, uint32_t* last) {
    return entry({present(history, "history"), present(first, "first"), present(last, "last")}, [&] {
        *first = static_cast<std::uint32_t>(history->history.first_tick());
        *last = static_cast<std::uint32_t>(history->history.last_tick());
    });
}
abut_code abut_play_history2_at(abut_play_history2* history, uint32_t tick, float fraction, abut_world2** out) {
    const bool exists = history != nullptr && history->history.contains(tick) && fraction >= 0 && fraction <= 1;
    const Fault fault = exists ? Fault() : Fault{ABUT_INDEX_OUT_OF_RANGE, "tick", "is not held"};
    return entry({present(history, "history"), fault, present(out, "out")},
                 [&] { *out = new abut_world2{{.world = history->history.at(tick, fraction)}}; });
}
