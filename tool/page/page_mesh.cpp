#include "tool/page/page_mesh.hpp"

#include <abut/io/file/base64.hpp>
#include <abut/math/aabb.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace abut::tool {
namespace {

constexpr double max_step = 65535;

template <class Number>
void append(std::vector<std::byte>& bytes, Number number) {
    for (std::size_t i = 0; i < sizeof(Number); ++i)
        bytes.push_back(static_cast<std::byte>((number >> (8 * i)) & Number{0xff}));
}

}  // namespace

template <int D>
std::vector<std::uint32_t> nearest_facets(const Facets<D>& shape, const std::vector<Vec<D>>& places,
                                          std::size_t count) {
    std::vector<std::uint32_t> order(shape.facets.size());
    std::iota(order.begin(), order.end(), 0u);
    if (order.size() <= count) return order;
    std::vector<float> distances;
    for (const auto& facet : shape.facets) {
        Aabb<D> box = Aabb<D>::empty();
        for (const std::uint32_t corner : facet) box = merged(box, Aabb<D>{shape.points[corner], shape.points[corner]});
        float nearest = std::numeric_limits<float>::max();
        for (const Vec<D>& place : places) {
            const Vec<D> offset = place - glm::clamp(place, box.min, box.max);
            nearest = std::min(nearest, glm::dot(offset, offset));
        }
        distances.push_back(nearest);
    }
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
        return std::pair(distances[i], i) < std::pair(distances[j], j);
    });
    order.resize(count);
    std::sort(order.begin(), order.end());
    return order;
}

template <int D>
Json mesh_json(const Facets<D>& shape, const std::vector<std::uint32_t>& chosen) {
    constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> new_number(shape.points.size(), unused), used;
    std::vector<std::byte> elements, points;
    Aabb<D> box = Aabb<D>::empty();
    for (const std::uint32_t facet : chosen)
        for (const std::uint32_t corner : shape.facets[facet]) {
            if (new_number[corner] == unused) {
                new_number[corner] = static_cast<std::uint32_t>(used.size());
                used.push_back(corner);
                box = merged(box, Aabb<D>{shape.points[corner], shape.points[corner]});
            }
            append(elements, new_number[corner]);
        }
    for (const std::uint32_t corner : used)
        for (int i = 0; i < D; ++i) {
            const double low = box.min[i], extent = static_cast<double>(box.max[i]) - low;
            const double share = extent > 0 ? (static_cast<double>(shape.points[corner][i]) - low) / extent : 0;
            append(points, static_cast<std::uint16_t>(std::lround(share * max_step)));
        }
    Json result = {{"low", numbers(box.min)},
                   {"high", numbers(box.max)},
                   {"points", detail::encode_base64(points)},
                   {"elements", detail::encode_base64(elements)}};
    if (chosen.size() < shape.facets.size()) result["partial"] = true;
    return result;
}

std::string base64_floats(std::span<const float> numbers) {
    std::vector<std::byte> bytes;
    for (const float number : numbers) append(bytes, std::bit_cast<std::uint32_t>(number));
    return detail::encode_base64(bytes);
}

template std::vector<std::uint32_t> nearest_facets(const Facets<2>&, const std::vector<Vec<2>>&, std::size_t);
template std::vector<std::uint32_t> nearest_facets(const Facets<3>&, const std::vector<Vec<3>>&, std::size_t);
template Json mesh_json(const Facets<2>&, const std::vector<std::uint32_t>&);
template Json mesh_json(const Facets<3>&, const std::vector<std::uint32_t>&);

}  // namespace abut::tool
