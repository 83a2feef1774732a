// Saving a world and going back. All is in words of 32 bits, little endian: "abutwld\n", the version, the dimension,
// the numbers of slots, free slots, motions, rare filters, touching pairs, touching pairs with a removed item, and
// passed pairs; these lists in this order, each item in the order of its slot; and a checksum of 64 bits.

#include <abut/math/detail/blob.hpp>
#include <abut/shape/detail/content_hash.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <string>
#include <utility>

namespace abut {

using namespace detail;

namespace {

constexpr std::uint32_t magic[2] = {0x74756261, 0x0a646c77};  // "abutwld\n"
constexpr std::uint32_t version = 2;
constexpr std::size_t checksum_sums = 4;

constexpr std::uint32_t fixed_flag = 1, sensor_flag = 2, continuous_flag = 4, settled_flag = 8, disabled_flag = 16,
                        upper_mask_flag = 32, all_flags = 63;

template <int D>
inline constexpr std::size_t pose_words = D == 2 ? 4 : 7;
template <int D>
inline constexpr std::size_t item_words = pose_words<D> + 8;

/// The numbers of list entries in a snapshot.
struct SnapshotSizes {
    std::uint32_t slots = 0, free = 0, motions = 0, rare_filters = 0, touching = 0, stale = 0, passed = 0;

    template <class Visit>
    void each(Visit visit) {
        for (std::uint32_t* size : {&slots, &free, &motions, &rare_filters, &touching, &stale, &passed}) visit(*size);
    }
    /// Without the checksum.
    template <int D>
    std::uint64_t words() const {
        constexpr std::uint64_t header = 11;
        return header + 2 * std::uint64_t{free} + item_words<D> * (std::uint64_t{slots} - free) +
               (1 + pose_words<D>)*std::uint64_t{motions} + 4 * std::uint64_t{rare_filters} +
               2 * std::uint64_t{touching} + 4 * (std::uint64_t{stale} + passed);
    }
};

/// The upper halves of an item's layers and mask, and its group, where they are not what most items have: no upper
/// layers, all or none of the upper mask, and no group.
struct RareFilter {
    std::uint32_t slot = 0, layers = 0, mask = 0;
    std::int32_t group = 0;
};

constexpr std::uint32_t all_upper = 0xFFFFFFFF;

std::uint32_t upper(std::uint64_t bits) {
    return static_cast<std::uint32_t>(bits >> 32);
}
std::uint32_t lower(std::uint64_t bits) {
    return static_cast<std::uint32_t>(bits);
}
std::uint64_t joined(std::uint32_t lower, std::uint32_t upper) {
    return lower | std::uint64_t{upper} << 32;
}

template <class Item>
bool has_rare_filter(const Item& item) {
    const std::uint32_t mask = upper(item.mask);
    return upper(item.layers) != 0 || (mask != 0 && mask != all_upper) || item.group != 0;
}

/// Writes into a buffer of known size, where BlobWriter would append each word.
class WordWriter {
public:
    explicit WordWriter(std::byte* at) : at_(at) {}

    template <class... T>
    void put(T... words) {
        (put_word(words), ...);
    }
    void put(const Pose<2>& pose) { put(pose.position.x, pose.position.y, pose.rotation.cos, pose.rotation.sin); }
    void put(const Pose<3>& pose) {
        const glm::quat& rotation = pose.rotation;
        put(pose.position.x, pose.position.y, pose.position.z, rotation.x, rotation.y, rotation.z, rotation.w);
    }
    void put(const Id& id) { put(id.index, id.generation); }

private:
    template <class T>
    void put_word(T word) {
        const T ordered = little(word);
        std::memcpy(at_, &ordered, sizeof(T));
        at_ += sizeof(T);
    }

    std::byte* at_;
};

// These read what was written, where the bytes suffice.

template <class... T>
void get(BlobReader& reader, T&... words) {
    (reader.number(words), ...);
}
void get(BlobReader& reader, Pose<2>& pose) {
    get(reader, pose.position.x, pose.position.y, pose.rotation.cos, pose.rotation.sin);
}
void get(BlobReader& reader, Pose<3>& pose) {
    glm::quat& rotation = pose.rotation;
    get(reader, pose.position.x, pose.position.y, pose.position.z, rotation.x, rotation.y, rotation.z, rotation.w);
}
void get(BlobReader& reader, Id& id) {
    get(reader, id.index, id.generation);
}

Problem damaged() {
    return {ProblemCode::bad_format, "a snapshot of a world is damaged or not one"};
}

}  // namespace

/// The numbers of items and of motions in a snapshot, which may be damaged.
template <int D>
std::pair<std::uint32_t, std::uint32_t> World<D>::saved_counts(std::span<const std::byte> bytes) {
    BlobReader reader(bytes);
    std::array<std::uint32_t, 4> start{};
    for (std::uint32_t& word : start) get(reader, word);
    SnapshotSizes sizes;
    sizes.each([&](std::uint32_t& number) { get(reader, number); });
    return {sizes.slots - sizes.free, sizes.motions};
}

/// Copies of one shape are often added one after another.
template <int D>
void World<D>::find_shape_hashes() {
    shape_hashes_.resize(items_.size(), 0);
    std::uint32_t last = none;
    for (std::uint32_t slot = 0; slot < items_.size(); ++slot) {
        if (!items_[slot].in_use || shape_hashes_[slot] != 0) continue;
        const AnyShape<D>& shape = items_[slot].stored;
        shape_hashes_[slot] = last != none && shape.is_shared_with(items_[last].stored)
                                  ? shape_hashes_[last]
                                  : detail::content_hash(shape.view());
        last = slot;
    }
}

/// Holds the shape of a slot, which gets another one or none, if a snapshot may refer to it.
template <int D>
void World<D>::release_shape(std::uint32_t slot) {
    if (slot >= shape_hashes_.size() || shape_hashes_[slot] == 0) return;
    released_shapes_.add(std::exchange(shape_hashes_[slot], 0), items_[slot].stored);
}

template <int D>
std::vector<std::byte> World<D>::save() {
    std::vector<std::byte> bytes;
    save(bytes);
    return bytes;
}

template <int D>
void World<D>::save(std::vector<std::byte>& bytes) {
    find_shape_hashes();
    // A pair is stale if an item of it was removed since the update.
    const bool any_stale = std::any_of(pending_.begin(), pending_.end(), [this](std::uint32_t slot) {
        return !items_[slot].in_use || !items_[slot].settled;
    });
    const auto is_stale = [&](const IdPair& pair) { return any_stale && (!contains(pair.a) || !contains(pair.b)); };
    const auto has_motion = [this](std::uint32_t slot) { return items_[slot].previous != none; };
    SnapshotSizes sizes;
    sizes.slots = static_cast<std::uint32_t>(items_.size());
    sizes.free = static_cast<std::uint32_t>(free_.size());
    sizes.motions = static_cast<std::uint32_t>(std::count_if(pending_.begin(), pending_.end(), has_motion));
    const auto has_rare = [](const Item& item) { return item.in_use && has_rare_filter(item); };
    sizes.rare_filters = static_cast<std::uint32_t>(std::count_if(items_.begin(), items_.end(), has_rare));
    sizes.stale = static_cast<std::uint32_t>(std::count_if(touching_.begin(), touching_.end(), is_stale));
    sizes.touching = static_cast<std::uint32_t>(touching_.size()) - sizes.stale;
    sizes.passed = static_cast<std::uint32_t>(results_.passed.size());

    const std::size_t size = static_cast<std::size_t>(sizes.words<D>()) * sizeof(std::uint32_t);
    bytes.resize(size + sizeof(std::uint64_t));
    WordWriter writer(bytes.data());
    writer.put(magic[0], magic[1], version, std::uint32_t{D});
    sizes.each([&](std::uint32_t number) { writer.put(number); });
    for (const std::uint32_t slot : free_) writer.put(slot, items_[slot].generation);
    for (std::uint32_t slot = 0; slot < items_.size(); ++slot) {
        const Item& item = items_[slot];
        if (!item.in_use) continue;
        writer.put(item.pose);
        writer.put(item.user, shape_hashes_[slot], lower(item.layers), lower(item.mask), item.generation,
                   (item.fixed ? fixed_flag : 0) | (item.sensor ? sensor_flag : 0) |
                       (item.continuous ? continuous_flag : 0) | (item.settled ? settled_flag : 0) |
                       (item.enabled ? 0 : disabled_flag) | (upper(item.mask) != 0 ? upper_mask_flag : 0));
    }
    for (std::uint32_t slot = 0; sizes.motions > 0 && slot < items_.size(); ++slot) {
        if (!has_motion(slot)) continue;
        writer.put(slot);
        writer.put(previous_poses_[items_[slot].previous]);
    }
    for (std::uint32_t slot = 0; sizes.rare_filters > 0 && slot < items_.size(); ++slot) {
        const Item& item = items_[slot];
        if (has_rare(item)) writer.put(slot, upper(item.layers), upper(item.mask), item.group);
    }
    for (const IdPair& pair : touching_)
        if (!is_stale(pair)) writer.put(pair.a.index - 1, pair.b.index - 1);
    const auto put_ids = [&writer](const IdPair& pair) {
        writer.put(pair.a);
        writer.put(pair.b);
    };
    for (const IdPair& pair : touching_)
        if (is_stale(pair)) put_ids(pair);
    for (const IdPair& pair : results_.passed) put_ids(pair);
    writer.put(blob_checksum<checksum_sums>(std::span(bytes).first(size)));
}

/// What a snapshot holds.
template <int D>
struct World<D>::Snapshot {
    struct SavedItem {
        std::uint32_t slot = 0, generation = 0, flags = 0;
        std::uint64_t hash = 0;
        ItemOptions<D> options;

        bool is_settled() const { return (flags & settled_flag) != 0; }
        void set_filter(const RareFilter& rare) {
            options.layers = joined(lower(options.layers), rare.layers);
            options.mask = joined(lower(options.mask), rare.mask);
            options.group = rare.group;
        }
    };
    struct SavedMotion {
        std::uint32_t slot = 0;
        Pose<D> previous{};
    };
    std::uint32_t slots = 0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> free;  // slot and generation
    std::vector<SavedMotion> motions;
    std::vector<IdPair> touching, passed;

    std::optional<Problem> read(std::span<const std::byte> bytes);
    template <class Visit>
    void each_item(const Visit& visit) const {
        auto rare = rare_filters_.begin();
        for (std::uint32_t slot = 0; slot < slots; ++slot) {
            if (place_[slot] == none) continue;
            SavedItem saved = item(slot);
            if (rare != rare_filters_.end() && rare->slot == slot) saved.set_filter(*rare++);
            visit(saved);
        }
    }

private:
    bool read_lists(std::span<const std::byte> lists, const SnapshotSizes& sizes);
    bool has_item(std::uint32_t slot) const { return slot < slots && place_[slot] != none; }
    SavedItem item(std::uint32_t slot) const {
        BlobReader reader(items_.subspan(item_words<D> * sizeof(std::uint32_t) * place_[slot]));
        SavedItem item;
        item.slot = slot;
        get(reader, item.options.pose);
        std::uint32_t layers = 0, mask = 0;
        get(reader, item.options.user, item.hash, layers, mask, item.generation, item.flags);
        item.options.layers = layers;
        item.options.mask = joined(mask, (item.flags & upper_mask_flag) != 0 ? all_upper : 0);
        item.options.enabled = (item.flags & disabled_flag) == 0;
        item.options.fixed = (item.flags & fixed_flag) != 0;
        item.options.sensor = (item.flags & sensor_flag) != 0;
        item.options.continuous = (item.flags & continuous_flag) != 0;
        return item;
    }

    std::span<const std::byte> items_;  // the records
    std::vector<RareFilter> rare_filters_;
    std::vector<std::uint32_t> place_;  // by slot: the index of its record; none if it is free
};

template <int D>
std::optional<Problem> World<D>::Snapshot::read(std::span<const std::byte> bytes) {
    SnapshotSizes sizes;
    const std::uint64_t header = SnapshotSizes{}.words<D>() * sizeof(std::uint32_t);
    if (bytes.size() < header + sizeof(std::uint64_t)) return damaged();
    BlobReader reader(bytes);
    std::uint32_t first = 0, second = 0, its_version = 0, dimension = 0;
    get(reader, first, second, its_version, dimension);
    if (first != magic[0] || second != magic[1]) return damaged();
    if (its_version != version || dimension != D)
        return Problem{ProblemCode::bad_format, "a snapshot of a world has version " + std::to_string(its_version) +
                                                    " and dimension " + std::to_string(dimension) + ", not " +
                                                    std::to_string(version) + " and " + std::to_string(D)};
    sizes.each([&](std::uint32_t& number) { get(reader, number); });
    if (sizes.free > sizes.slots) return damaged();
    const std::uint64_t size = sizes.words<D>() * sizeof(std::uint32_t);
    if (bytes.size() != size + sizeof(std::uint64_t)) return damaged();
    std::uint64_t checksum = 0;
    BlobReader(bytes.subspan(static_cast<std::size_t>(size))).number(checksum);
    if (checksum != blob_checksum<checksum_sums>(bytes.first(static_cast<std::size_t>(size)))) return damaged();
    if (!read_lists(bytes.last(reader.left()), sizes)) return damaged();
    return std::nullopt;
}

template <int D>
bool World<D>::Snapshot::read_lists(std::span<const std::byte> lists, const SnapshotSizes& sizes) {
    slots = sizes.slots;
    place_.assign(slots, 0);
    BlobReader reader(lists);
    for (std::uint32_t i = 0; i < sizes.free; ++i) {
        auto& [slot, generation] = free.emplace_back();
        get(reader, slot, generation);
        if (slot >= slots || std::exchange(place_[slot], none) == none) return false;
    }
    items_ = lists.last(reader.left());
    std::uint32_t items = 0;
    for (std::uint32_t slot = 0; slot < slots; ++slot) {
        if (place_[slot] == none) continue;
        place_[slot] = items++;
        const SavedItem saved = item(slot);
        if (saved.generation == 0 || saved.flags > all_flags) return false;
    }
    reader = BlobReader(items_.subspan(item_words<D> * sizeof(std::uint32_t) * items));
    for (std::uint32_t i = 0; i < sizes.motions; ++i) {
        SavedMotion& motion = motions.emplace_back();
        get(reader, motion.slot);
        get(reader, motion.previous);
        if (!has_item(motion.slot) || !item(motion.slot).is_settled()) return false;
        if (i > 0 && motions[i - 1].slot >= motion.slot) return false;
    }
    for (std::uint32_t i = 0; i < sizes.rare_filters; ++i) {
        RareFilter& rare = rare_filters_.emplace_back();
        get(reader, rare.slot, rare.layers, rare.mask, rare.group);
        if (!has_item(rare.slot) || (i > 0 && rare_filters_[i - 1].slot >= rare.slot)) return false;
    }
    touching.reserve(std::size_t{sizes.touching} + sizes.stale);
    for (std::uint32_t i = 0; i < sizes.touching; ++i) {
        std::uint32_t a = 0, b = 0;
        get(reader, a, b);
        if (!has_item(a) || !has_item(b)) return false;
        touching.push_back({{a + 1, item(a).generation}, {b + 1, item(b).generation}});
    }
    const auto get_ids = [&](std::vector<IdPair>& pairs, std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i) {
            IdPair& pair = pairs.emplace_back();
            get(reader, pair.a);
            get(reader, pair.b);
        }
    };
    get_ids(touching, sizes.stale);
    const auto is_present = [this](const Id& id) {
        return id.index > 0 && has_item(id.index - 1) && item(id.index - 1).generation == id.generation;
    };
    for (std::size_t i = sizes.touching; i < touching.size(); ++i)
        if (is_present(touching[i].a) && is_present(touching[i].b)) return false;
    std::inplace_merge(touching.data(), touching.data() + sizes.touching, touching.data() + touching.size());
    get_ids(passed, sizes.passed);
    const auto are_pairs = [&](const std::vector<IdPair>& pairs) {
        const auto is_pair = [&](const IdPair& pair) {
            return pair.a < pair.b && pair.a.index > 0 && pair.b.index <= slots;
        };
        return std::all_of(pairs.begin(), pairs.end(), is_pair) &&
               std::adjacent_find(pairs.begin(), pairs.end(), std::greater_equal<>()) == pairs.end();
    };
    return are_pairs(touching) && are_pairs(passed);
}

/// Finds the shapes of the saved items that don't have their shape in their slot now, or not in the same broad phase.
template <int D>
std::optional<Problem> World<D>::find_shapes(const Snapshot& snapshot,
                                             std::vector<std::pair<std::uint32_t, AnyShape<D>>>& changed) {
    find_shape_hashes();
    std::unordered_map<std::uint64_t, const AnyShape<D>*> present;
    const auto present_shape = [&](std::uint64_t hash) -> const AnyShape<D>* {
        if (present.empty())
            for (std::uint32_t slot = 0; slot < items_.size(); ++slot)
                if (items_[slot].in_use) present.emplace(shape_hashes_[slot], &items_[slot].stored);
        const auto found = present.find(hash);
        return found != present.end() ? found->second : nullptr;
    };
    std::optional<Problem> problem;
    snapshot.each_item([&](const auto& saved) {
        const Item* const item = saved.slot < items_.size() ? &items_[saved.slot] : nullptr;
        const bool has_shape = item != nullptr && item->in_use && shape_hashes_[saved.slot] == saved.hash;
        if (has_shape && item->fixed == saved.options.fixed) return;
        const AnyShape<D>* shape = has_shape ? &item->stored : released_shapes_.find(saved.hash);
        if (shape == nullptr) shape = present_shape(saved.hash);
        if (shape != nullptr)
            changed.emplace_back(saved.slot, *shape);
        else if (!problem)
            problem = {
                ProblemCode::not_found,
                "a snapshot needs the shape of item " + std::to_string(saved.slot + 1) + ", which this world has not",
                saved.slot + 1};
    });
    return problem;
}

/// The slot has the item's shape, and is not in use if it is new there.
template <int D>
template <class SavedItem>
void World<D>::restore_item(const SavedItem& saved) {
    Item& item = items_[saved.slot];
    const bool is_new = !item.in_use;
    const bool has_box = !is_new && item.pose == saved.options.pose && item.enabled == saved.options.enabled;
    if (!is_new) continuous_ -= item.continuous ? 1 : 0;
    item.set(saved.options);
    item.generation = saved.generation;
    item.settled = saved.is_settled();
    item.previous = none;
    continuous_ += item.continuous ? 1 : 0;
    if (is_new) {
        shape_hashes_[saved.slot] = saved.hash;
        item.in_use = true;
        ++count_;
        set_shape_data(item);
        add_to_boxes(saved.slot);
    }
    if (!has_box) boxes_of(item).set(item.place, item.bounds());
}

template <int D>
std::optional<Problem> World<D>::restore(std::span<const std::byte> bytes) {
    detail::clear_upper_halves();
    Snapshot snapshot;
    if (std::optional<Problem> problem = snapshot.read(bytes)) return problem;
    std::vector<std::pair<std::uint32_t, AnyShape<D>>> changed;
    if (std::optional<Problem> problem = find_shapes(snapshot, changed)) return problem;

    for (std::uint32_t slot = snapshot.slots; slot < items_.size(); ++slot)
        if (items_[slot].in_use) free_slot(slot);
    for (const auto& [slot, generation] : snapshot.free)
        if (slot < items_.size() && items_[slot].in_use) free_slot(slot);
    if (items_.size() > snapshot.slots)
        items_.erase(items_.begin() + static_cast<std::ptrdiff_t>(snapshot.slots), items_.end());
    shape_hashes_.resize(snapshot.slots, 0);
    if (items_.size() < snapshot.slots) items_.resize(snapshot.slots, Item{.stored = AnyShape<D>(Ball<D>{})});
    // All pairs are to be tested: also those that a removed item leaves behind.
    pending_.clear();
    for (std::uint32_t slot = 0; slot < snapshot.slots; ++slot) {
        items_[slot].pending = true;
        items_[slot].pending_in_box = false;
        pending_.push_back(slot);
    }
    previous_poses_.clear();
    positions_.clear_previous();
    changed_boxes_.clear();
    free_.clear();
    for (const auto& [slot, generation] : snapshot.free) {
        items_[slot].generation = generation;
        free_.push_back(slot);
    }
    for (const auto& [slot, shape] : changed) {
        if (items_[slot].in_use) free_slot(slot);
        items_[slot].stored = shape;
    }
    snapshot.each_item([&](const auto& saved) { restore_item(saved); });
    for (const auto& motion : snapshot.motions) {
        items_[motion.slot].previous = static_cast<std::uint32_t>(previous_poses_.size());
        previous_poses_.push_back(motion.previous);
    }
    near_.clear();
    results_.clear();
    contacts_.clear();
    touching_.clear();
    for (const IdPair& pair : snapshot.touching) {
        touching_.push_back(pair);
        results_.touching.push_back({{pair.a.index - 1, pair.b.index - 1}, 0, 0});
    }
    results_.passed.assign(snapshot.passed.begin(), snapshot.passed.end());
    pair_index_.defer(touching_.size());
    return std::nullopt;
}

template class World<2>;
template class World<3>;

}  // namespace abut
