// Disassembly order of rotated boxes in the cells of a grid: by sweep line, and for a thousand boxes also by all pairs.
// No peer among the Debian packages has this query.

#include "../../test/oracle/random.hpp"
#include "../bench.hpp"
#include <abut/math/dvec.hpp>
#include <abut/motion/removal_order.hpp>
#include <abut/query/closest.hpp>
#include <abut/shape/box.hpp>

#include <cmath>
#include <memory>
#include <numeric>

namespace abut::bench {

using namespace detail;

namespace {

constexpr Vec2 away(0.3f, 1);

/// The boxes are numbered in random order.
std::vector<Convex<2>> boxes_in_cells(std::size_t count) {
    oracle::Random random(7);
    const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    std::vector<std::size_t> cells(count);
    std::iota(cells.begin(), cells.end(), std::size_t{0});
    for (std::size_t i = count; i > 1; --i) std::swap(cells[i - 1], cells[random.below(static_cast<std::uint32_t>(i))]);
    std::vector<Convex<2>> boxes;
    for (const std::size_t cell : cells) {
        const DVec<2> corner(static_cast<double>(cell % columns), static_cast<double>(cell / columns));
        const Vec2 half(random.uniform_float(0.1, 0.28), random.uniform_float(0.1, 0.28));
        boxes.push_back(convex(Box2{to_float(corner + random.in_cube<2>() * 0.1), half, random.rotation<2>()}));
    }
    return boxes;
}

/// Removes the lowest box that nothing is above, repeatedly; separating planes decide which of two boxes is above the
/// other.
std::vector<std::uint32_t> order_by_pairs(std::span<const Convex<2>> boxes) {
    const DVec<2> up = normalized(DVec<2>(away)), right(up.y, -up.x);
    const auto reach = [](const Convex<2>& box, const DVec<2>& direction) {
        return dot(support(box, direction), direction);
    };
    std::vector<std::vector<std::uint32_t>> lowers(boxes.size());
    std::vector<std::uint32_t> waits(boxes.size(), 0);
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        for (std::uint32_t j = 0; j < boxes.size(); ++j) {
            const bool pass = reach(boxes[i], right) <= -reach(boxes[j], right * -1.0) ||
                              reach(boxes[j], right) <= -reach(boxes[i], right * -1.0);
            if (i == j || pass || !(dot(DVec<2>(closest(boxes[i], boxes[j]).normal), up) > 0)) continue;
            lowers[j].push_back(i);
            ++waits[i];
        }
    std::vector<std::uint32_t> order;
    std::vector<bool> gone(boxes.size(), false);
    while (order.size() < boxes.size()) {
        std::uint32_t next = 0;
        while (next < boxes.size() && (gone[next] || waits[next] > 0)) ++next;
        if (next == boxes.size()) break;
        gone[next] = true;
        order.push_back(next);
        for (const std::uint32_t lower : lowers[next]) --waits[lower];
    }
    return order;
}

template <class Order>
Side side(const char* who, const std::shared_ptr<const std::vector<Convex<2>>>& boxes, Order order) {
    return {who, [boxes, order](std::span<double> values) {
                const std::vector<std::uint32_t> found = order(std::span<const Convex<2>>(*boxes));
                for (std::size_t i = 0; i < values.size(); ++i) values[i] = i < found.size() ? found[i] : -1.0;
            }};
}

Job removal_job(std::size_t count) {
    const auto boxes = std::make_shared<const std::vector<Convex<2>>>(boxes_in_cells(count));
    Job job;
    job.items = job.values = count;
    job.sides.push_back(
        side("abut", boxes, [](std::span<const Convex<2>> all) { return removal_order(all, away).order; }));
    if (count <= 1000) job.sides.push_back(side("all pairs", boxes, order_by_pairs));
    return job;
}

}  // namespace

std::vector<Bench> removal_benches() {
    return {{"motion/removal/2d/1000", [] { return removal_job(1000); }},
            {"motion/removal/2d/10000", [] { return removal_job(10000); }},
            {"motion/removal/2d/100000", [] { return removal_job(100000); }}};
}

}  // namespace abut::bench
