// Many motions and questions in one call.

#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/world/world.hpp>

#include <algorithm>

namespace abut {
namespace {

/// Writes the answer of each question to its place; the threads of an executor share the questions.
template <class Question, class Place, class Answer>
void answer_all(std::span<const Question> questions, std::span<Place> places, Executor* executor,
                const Answer& answer) {
    constexpr std::size_t part_size = 64;
    ABUT_ASSERT(questions.size() == places.size());
    const std::size_t count = std::min(questions.size(), places.size());
    const auto answer_part = [&](std::uint32_t part) {
        const std::size_t begin = part * part_size, end = std::min(count, begin + part_size);
        for (std::size_t i = begin; i < end; ++i) places[i] = answer(questions[i]);
    };
    detail::run_parallel(executor, static_cast<std::uint32_t>((count + part_size - 1) / part_size), answer_part);
}

}  // namespace

template <int D>
void World<D>::move(std::span<const Id> ids, std::span<const Pose<D>> poses) {
    detail::enter_library();
    ABUT_ASSERT(ids.size() == poses.size());
    for (std::size_t i = 0; i < std::min(ids.size(), poses.size()); ++i) move_to(ids[i], poses[i]);
}

template <int D>
void World<D>::raycast(std::span<const Ray<D>> rays, Hits hits, const Filter& filter) const {
    detail::enter_library();
    answer_all(rays, hits, nullptr, [&](const Ray<D>& ray) { return first_hit(ray, filter); });
}
template <int D>
void World<D>::raycast(std::span<const Ray<D>> rays, Hits hits, Executor& executor, const Filter& filter) const {
    detail::enter_library();
    answer_all(rays, hits, &executor, [&](const Ray<D>& ray) { return first_hit(ray, filter); });
}

template <int D>
void World<D>::closest(std::span<const Vec<D>> points, ClosestItems items, const Filter& filter) const {
    detail::enter_library();
    answer_all(points, items, nullptr, [&](const Vec<D>& point) { return closest_to(point_view(point), filter); });
}
template <int D>
void World<D>::closest(std::span<const Vec<D>> points, ClosestItems items, Executor& executor,
                       const Filter& filter) const {
    detail::enter_library();
    answer_all(points, items, &executor, [&](const Vec<D>& point) { return closest_to(point_view(point), filter); });
}

template class World<2>;
template class World<3>;

}  // namespace abut
