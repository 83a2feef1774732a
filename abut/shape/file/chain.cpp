// The data of a chain: flags, the number of its points, the points, and the topology of the tree of its segments.

#include <abut/broad_phase/bvh/topology.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/detail/chain_data.hpp>
#include <abut/shape/file.hpp>
#include <abut/shape/file/blob.hpp>

#include <memory>
#include <optional>
#include <utility>

namespace abut {

using namespace detail;

namespace {

constexpr std::uint32_t closed_chain_flag = 1, one_sided_flag = 2, all_chain_flags = 3;

}  // namespace

std::vector<std::byte> save(const Chain& chain) {
    BlobWriter writer = begin_shape(SavedKind::chain, 64 + chain.points().size() * 18);
    writer.number((chain.closed() ? closed_chain_flag : 0) | (chain.one_sided() ? one_sided_flag : 0));
    writer.number(static_cast<std::uint64_t>(chain.points().size()));
    writer.array(chain.points());
    write(writer, BvhAccess::tree(chain.data_->tree).topology());
    return end_shape(std::move(writer));
}

Result<Chain> load_chain(std::span<const std::byte> bytes) {
    enter_library();
    constexpr SavedKind kind = SavedKind::chain;
    auto data = std::make_shared<Chain::Data>();
    std::uint32_t flags = 0;
    std::uint64_t points = 0;
    BvhTopology topology;
    const auto read_data = [&](BlobReader& reader) {
        return reader.number(flags) && reader.number(points) && reader.array(data->points, points) &&
               read(reader, topology);
    };
    if (std::optional<Problem> wrong = read_shape(bytes, kind, read_data)) return *std::move(wrong);
    if (flags > all_chain_flags) return bad_shape(kind, "is of an unknown kind");
    data->closed = (flags & closed_chain_flag) != 0;
    data->one_sided = (flags & one_sided_flag) != 0;
    if (std::optional<Problem> problem = problem_of_chain(data->points, data->closed)) return *std::move(problem);
    std::vector<Aabb2> boxes;
    boxes.reserve(data->size());
    for (std::uint32_t i = 0; i < data->size(); ++i) boxes.push_back(data->box(i));
    if (!BvhAccess::tree(data->tree).build(boxes, topology))
        return bad_shape(kind, "has a tree that doesn't match its segments");
    return Chain(std::move(data));
}

}  // namespace abut
