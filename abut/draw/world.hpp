#pragma once

// A World as a debug view: items by what they are, their boxes and ids, and the contacts and impacts of the last
// update.

#include <abut/draw/draw.hpp>

namespace abut {

/// What is drawn of a World, and in which style.
struct WorldDrawOptions {
    bool shapes = true;
    bool boxes = false;     ///< AABBs
    bool contacts = true;   ///< of the last update
    bool impacts = true;    ///< of the last update
    bool touching = false;  ///< a line between the centres of the AABBs of each touching pair
    bool ids = false;       ///< "index:generation" at the centre of each AABB
    bool disabled = true;   ///< items that are not enabled; no filter applies to them

    Style moving{{37, 99, 235}};
    Style fixed{{51, 65, 85}};
    Style sensor{{22, 163, 74}, 1, transparent, true};
    Style not_enabled{{148, 163, 184, 128}, 1, transparent, true};
    Style box{{148, 163, 184}};
    Style contact{{225, 29, 72}};
    Style impact{{234, 88, 12}};
    Style pair{{147, 51, 234}};
    Style id{{51, 65, 85}};

    Filter filter{.sensors = true};  ///< the items of which shapes, boxes and ids are drawn
};

/// All that reaches into the visible box, as the options say. Items are drawn in the order of their ids, and then
/// contacts, impacts and pairs.
template <int D>
void draw(Canvas<D>& canvas, const World<D>& world, const WorldDrawOptions& options);

}  // namespace abut
