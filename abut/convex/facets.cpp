#include <abut/convex/bucket_sort.hpp>
#include <abut/convex/facets.hpp>

#include <algorithm>

namespace abut::detail {

std::vector<FacetEdge> facet_edges(std::span<const std::uint32_t> loops, std::span<const std::uint32_t> loop_ends) {
    if (loops.empty()) return {};
    // A bucket per lower end; the key holds the higher end, the direction and the face.
    constexpr std::uint64_t falling = std::uint64_t{1} << 32, high_unit = falling << 1;
    const auto each_side = [&](auto visit) {
        std::size_t begin = 0;
        for (std::uint32_t face = 0; face < loop_ends.size(); ++face) {
            const std::size_t end = loop_ends[face];
            for (std::size_t i = begin; i < end; ++i) {
                const std::uint32_t from = loops[i], to = loops[i + 1 == end ? begin : i + 1];
                visit(std::min(from, to), std::max(from, to) * high_unit + (from < to ? 0 : falling) + face);
            }
            begin = end;
        }
    };
    const Buckets sides = in_buckets(std::size_t{*std::max_element(loops.begin(), loops.end())} + 1, each_side);

    std::vector<FacetEdge> result;
    result.reserve(sides.keys.size() / 2);
    for (std::uint32_t low = 0; low < sides.ends.size(); ++low) {
        const std::span<const std::uint64_t> bucket = sides.bucket(low);
        for (std::size_t i = 0; i + 1 < bucket.size(); i += 2)
            result.push_back({low, static_cast<std::uint32_t>(bucket[i] / high_unit),
                              static_cast<std::uint32_t>(bucket[i]), static_cast<std::uint32_t>(bucket[i + 1])});
    }
    return result;
}

}  // namespace abut::detail
