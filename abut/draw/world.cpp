#include <abut/draw/world.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace abut {

using namespace detail;

namespace {

template <int D>
bool is_bounded(const Aabb<D>& box) {
    return is_finite(box.min) && is_finite(box.max);
}

template <int D>
const Style& style_of(const World<D>& world, Id id, const WorldDrawOptions& options) {
    if (!world.is_enabled(id)) return options.not_enabled;
    if (world.is_sensor(id)) return options.sensor;
    return world.is_fixed(id) ? options.fixed : options.moving;
}

template <int D>
void draw_item(Canvas<D>& canvas, const World<D>& world, Id id, const WorldDrawOptions& options) {
    const View<D> shape = world.shape(id);
    const Aabb<D> box = bounds(shape);
    if (options.shapes) draw(canvas, shape, style_of(world, id, options));
    if (options.boxes) draw(canvas, box, options.box);
    if (options.ids && is_bounded(box))
        canvas.text(center(box), std::to_string(id.index) + ':' + std::to_string(id.generation), options.id);
}

}  // namespace

template <int D>
void draw(Canvas<D>& canvas, const World<D>& world, const WorldDrawOptions& options) {
    const Aabb<D> shown = canvas.shown();
    std::vector<Id> items = world.overlapping(shown, options.filter);
    if (options.disabled) {
        world.each_item([&](Id id) {
            if (!world.is_enabled(id) && overlaps(bounds(world.shape(id)), shown)) items.push_back(id);
        });
        std::sort(items.begin(), items.end());
    }
    for (const Id id : items) draw_item(canvas, world, id, options);
    if (options.contacts)
        for (const WorldContact<D>& found : world.contacts())
            if (std::any_of(found.contact.points.begin(), found.contact.points.end(),
                            [&](const auto& point) { return contains(shown, point.position); }))
                draw(canvas, found.contact, options.contact);
    if (options.impacts)
        for (const WorldImpact<D>& impact : world.impacts())
            if (contains(shown, impact.hit.point)) draw(canvas, impact.hit, options.impact);
    if (!options.touching) return;
    for (const Id id : items)
        world.each_touching(id, [&](Id other) {
            const Aabb<D> a = bounds(world.shape(id)), b = bounds(world.shape(other));
            if (id < other && is_bounded(a) && is_bounded(b)) canvas.line(center(a), center(b), options.pair);
        });
}

template void draw(Canvas<2>&, const World<2>&, const WorldDrawOptions&);
template void draw(Canvas<3>&, const World<3>&, const WorldDrawOptions&);

}  // namespace abut
