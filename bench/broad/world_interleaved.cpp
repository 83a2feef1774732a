// Changes of a World with a query after each, compared with the same changes and the same queries of an updated world.

#include "../../scenes/moving_boxes.hpp"
#include "broad.hpp"
#include <abut/shape/ball.hpp>
#include <abut/world/world.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace abut::bench {
namespace {

constexpr std::size_t items = 5000;

enum class Change { add, remove, set_shape, jump };
enum class Query { ray, overlap, closest };

struct Interleaved {
    Change change = Change::add;
    Query query = Query::ray;
    std::optional<BroadPhaseKind> kind{};  ///< by default the world chooses
};

/// A world of balls that don't pair, so that an update is brief.
template <int D>
class Balls {
public:
    explicit Balls(const Interleaved& job) : job_(job), now_(items, broad_seed), later_(items, broad_seed + 1) {
        oracle::Random random(broad_seed);
        for (std::size_t i = 0; i < items; ++i)
            rays_.push_back({at(later_, i), detail::to_float<D>(random.direction<D>()), 25});
    }

    void clear() {
        world_ = std::make_unique<World<D>>(WorldOptions{.broad_phase = job_.kind});
        ids_.clear();
    }
    /// A world of all balls that has queries in each update.
    void fill() {
        clear();
        for (std::size_t i = 0; i < items; ++i) add(i);
        for (int update = 0; update < 3; ++update) {
            world_->update();
            for (std::size_t i = 0; i < items; ++i) query(i);
        }
        world_->update();
    }
    void prepare() { job_.change == Change::add ? clear() : fill(); }

    void change(std::size_t i) {
        switch (job_.change) {
            case Change::add:
                return add(i);
            case Change::remove:
                return world_->remove(ids_[i]);
            case Change::set_shape:
                return world_->set_shape(ids_[i], ball(items - 1 - i));
            case Change::jump:
                return world_->move(ids_[i], {at(later_, i)});
        }
    }
    void query(std::size_t i) const {
        switch (job_.query) {
            case Query::ray:
                world_->raycast(rays_[i]);
                return;
            case Query::overlap:
                world_->each_overlapping(Ball<D>{rays_[i].origin, 1.5f}, [](Id) {});
                return;
            case Query::closest:
                world_->closest(rays_[i].origin);
        }
    }
    double size() const { return static_cast<double>(world_->size()); }

private:
    static Vec<D> at(const scenes::MovingBoxes<D>& boxes, std::size_t i) { return center(boxes.boxes()[i]); }
    Ball<D> ball(std::size_t i) const {
        const Aabb<D>& box = now_.boxes()[i];
        return {Vec<D>(0.0f), 0.5f * (box.max.x - box.min.x)};
    }
    void add(std::size_t i) {
        constexpr std::uint32_t layer = 2;
        ids_.push_back(world_->add(ball(i), {.pose = {at(now_, i)}, .layers = layer, .mask = ~layer}));
    }

    Interleaved job_;
    scenes::MovingBoxes<D> now_, later_;
    std::vector<Ray<D>> rays_;
    std::unique_ptr<World<D>> world_;
    std::vector<Id> ids_;
};

template <int D>
Job interleaved(const Interleaved& job) {
    const auto changing = std::make_shared<Balls<D>>(job), settled = std::make_shared<Balls<D>>(job);
    const auto mixed = [=](std::span<double> values) {
        for (std::size_t i = 0; i < items; ++i) {
            changing->change(i);
            changing->query(i);
        }
        values[0] = changing->size();
    };
    const auto apart = [=](std::span<double> values) {
        for (std::size_t i = 0; i < items; ++i) changing->change(i);
        for (std::size_t i = 0; i < items; ++i) settled->query(i);
        values[0] = changing->size();
    };
    settled->fill();
    const auto prepare = [=] { changing->prepare(); };
    return {.items = items,
            .values = 1,
            .rounds = 1,
            .frames = 10,
            .tolerance = 0,
            .sides = {{"abut", mixed, prepare}, {"abut, queries of an updated world", apart, prepare}}};
}

void add_rows(std::vector<Bench>& rows, const std::string& name, const Interleaved& job) {
    const std::string size = "/" + std::to_string(items);
    rows.push_back({name + "/2d" + size, [job] { return interleaved<2>(job); }});
    rows.push_back({name + "/3d" + size, [job] { return interleaved<3>(job); }});
}

}  // namespace

std::vector<Bench> world_interleaved_benches() {
    std::vector<Bench> result;
    const std::string start = "broad/world/";
    for (const auto& [query, query_name] :
         {std::pair(Query::ray, "ray"), {Query::overlap, "overlap"}, {Query::closest, "closest"}}) {
        const std::string end = std::string("/") + query_name;
        add_rows(result, start + "added" + end, {.query = query});
        add_rows(result, start + "added/bvh" + end, {.query = query, .kind = BroadPhaseKind::bvh});
        add_rows(result, start + "added/grid" + end, {.query = query, .kind = BroadPhaseKind::grid});
        add_rows(result, start + "removed" + end, {.change = Change::remove, .query = query});
        add_rows(result, start + "set_shape" + end, {.change = Change::set_shape, .query = query});
        add_rows(result, start + "jumped" + end, {.change = Change::jump, .query = query});
    }
    return result;
}

}  // namespace abut::bench
