#include <abut/shape/detail/content_hash.hpp>
#include <abut/world/detail/recording.hpp>
#include <abut/world/file.hpp>
#include <abut/world/replay.hpp>

#include <algorithm>
#include <string>
#include <unordered_map>

namespace abut {

using namespace detail;

namespace {

Problem bad(const std::string& what) {
    return {ProblemCode::bad_format, "the recording " + what};
}

std::string_view name_of(EntryKind kind) {
    constexpr std::string_view names[] = {"shape",        "add",         "set_shape", "move",      "set_option",
                                          "remove",       "save",        "restore",   "update",    "raycast",
                                          "raycast_any",  "raycast_all", "sweep",     "sweep",     "sweep",
                                          "closest",      "closest",     "k_nearest", "k_nearest", "overlapping",
                                          "each_contact", "containing",  "touching",  "contact",   "impact"};
    return names[static_cast<std::size_t>(kind)];
}

/// The parts from a little before the one of this index on, as far as a few lines hold them.
std::string text_of_parts(const std::vector<std::pair<std::string, std::string>>& parts, std::size_t index) {
    constexpr std::size_t max_size = 400, max_before = 8;
    const std::size_t first = index > max_before ? index - 2 : 0;
    std::string text;
    for (std::size_t i = first; i < parts.size(); ++i) {
        if (text.size() > max_size) return text + ", ...";
        text += (i > first ? ", " : i > 0 ? "..., " : "") + parts[i].first + " " + parts[i].second;
    }
    return text;
}

/// Replays the entries of a recording, from the world at its start on.
template <int D>
class Replay {
public:
    Replay(World<D> world, const WorldOptions& world_options, const ReplayOptions& options)
        : world_(std::move(world)), world_options_(world_options), options_(options) {
        report_.dimension = D;
        world_.each_item([&](Id id) { note_shape(world_.any_shape(id)); });
    }

    std::optional<Problem> play(std::span<const std::byte> payload) {
        BlobReader in(payload);
        FieldReader fields{in};
        Entry<D> entry;
        if (!in.number(entry.kind) || entry.kind >= EntryKind::count) return damaged();
        describe(fields, entry);
        if (!fields.is_good) return damaged();
        std::span<const std::byte> answer = payload.last(in.left());
        entry.answer.assign(answer.begin(), answer.end());
        std::optional<Problem> problem = is_question(entry.kind) ? query(entry) : change(entry);
        ++report_.entries;
        return problem;
    }
    ReplayReport report_;

private:
    Problem damaged() const { return bad("is damaged at entry " + std::to_string(report_.entries)); }
    void note_shape(const AnyShape<D>& shape) { shapes_.try_emplace(content_hash(shape.view()), shape); }
    const AnyShape<D>* shape_of(const Entry<D>& entry) const {
        const auto found = shapes_.find(entry.shape);
        return found != shapes_.end() ? &found->second : nullptr;
    }

    std::optional<Problem> change(const Entry<D>& entry) {
        using Kind = EntryKind;
        const AnyShape<D>* const own_shape = shape_of(entry);
        const bool needs_item = entry.kind == Kind::set_shape || entry.kind == Kind::move ||
                                entry.kind == Kind::set_option || entry.kind == Kind::remove;
        const bool needs_shape = entry.kind == Kind::add || entry.kind == Kind::set_shape;
        if ((needs_item && !world_.contains(entry.id)) || (needs_shape && own_shape == nullptr)) return damaged();
        switch (entry.kind) {
            case Kind::shape: {
                const Result<World<D>> alone = load_world<D>(entry.bytes);
                if (!alone || alone->size() != 1) return damaged();
                alone->each_item([&](Id id) { shapes_.try_emplace(entry.shape, alone->any_shape(id)); });
                return std::nullopt;
            }
            case Kind::add:
                compare(entry, encoded(world_.add(*own_shape, entry.options)), encoded(entry.id));
                return std::nullopt;
            case Kind::set_shape:
                world_.set_shape(entry.id, *own_shape);
                return std::nullopt;
            case Kind::move:
                world_.move(entry.id, entry.from);
                return std::nullopt;
            case Kind::set_option:
                return set(entry) ? std::nullopt : std::optional(damaged());
            case Kind::remove:
                world_.remove(entry.id);
                return std::nullopt;
            case Kind::save: {
                const std::vector<std::byte> bytes = world_.save();
                compare(entry, encoded(ListHash{bytes.size(), blob_checksum(bytes)}), entry.answer);
                return std::nullopt;
            }
            case Kind::restore:
                compare(entry, encoded(restore(entry)), entry.answer);
                return std::nullopt;
            default:
                update(entry);
                return std::nullopt;
        }
    }

    bool set(const Entry<D>& entry) {
        const std::uint64_t value = entry.values[0];
        switch (entry.option) {
            case ItemOption::filter:
                return world_.set_filter(entry.id, value, entry.values[1]), true;
            case ItemOption::user:
                return world_.set_user(entry.id, value), true;
            case ItemOption::fixed:
                return world_.set_fixed(entry.id, value != 0), true;
            case ItemOption::sensor:
                return world_.set_sensor(entry.id, value != 0), true;
            case ItemOption::continuous:
                return world_.set_continuous(entry.id, value != 0), true;
            case ItemOption::group:
                return world_.set_group(entry.id, static_cast<std::int32_t>(value)), true;
            case ItemOption::enabled:
                return world_.set_enabled(entry.id, value != 0), true;
            default:
                return false;
        }
    }

    /// A snapshot from before the recording may need shapes that only the recorded world had.
    bool restore(const Entry<D>& entry) {
        const std::optional<Problem> problem = world_.restore(entry.bytes);
        if (!problem) return true;
        if (problem->code != ProblemCode::not_found || entry.answer != encoded(true)) return false;
        World<D> other(world_options_);
        for (const auto& [hash, shape] : shapes_) other.add(shape);
        if (other.restore(entry.bytes)) return false;
        world_ = std::move(other);
        return true;
    }

    void update(const Entry<D>& entry) {
        if (entry.has_pair_filter)
            world_.set_pair_filter([refused = entry.refused](Id a, Id b) {
                return !std::binary_search(refused.begin(), refused.end(), IdPair{a, b});
            });
        else if (had_pair_filter_)
            world_.set_pair_filter(nullptr);
        had_pair_filter_ = entry.has_pair_filter;
        const std::optional<World<D>> before =
            report_.differences.size() < options_.max_differences ? std::optional(world_) : std::nullopt;
        const Events events = world_.update();
        if (!compare(entry, encoded(hashes_of(world_, events)), entry.answer) && before) {
            World<D> then = *before;
            if (const Result<std::vector<std::byte>> file = save_with_shapes(then); file && !entry.has_pair_filter)
                report_.differences.back().code = code_of_update<D>(*file);
        }
        ++report_.frames;
    }

    std::optional<Problem> query(Entry<D>& entry) {
        using Kind = EntryKind;
        const AnyShape<D>* const own_shape = shape_of(entry);
        const bool has_shape = entry.kind == Kind::sweep || entry.kind == Kind::sweep_motion ||
                               entry.kind == Kind::sweep_poses || entry.kind == Kind::closest ||
                               entry.kind == Kind::k_nearest || entry.kind == Kind::overlapping ||
                               entry.kind == Kind::each_contact;
        if ((has_shape && own_shape == nullptr) || (entry.kind == Kind::touching && !world_.contains(entry.id)))
            return damaged();
        entry.values[0] = std::min<std::uint64_t>(entry.values[0], world_.size());
        const std::vector<std::byte> now = answer_of(world_, entry, own_shape);
        ++report_.questions;
        if (!compare(entry, now, entry.answer) && report_.differences.size() == report_.difference_count &&
            !is_about_update(entry.kind))
            report_.differences.back().code = code_of(world_, entry, own_shape, {entry.answer, now});
        return std::nullopt;
    }

    /// Returns whether two answers are the same, and reports them if not.
    bool compare(const Entry<D>& entry, const std::vector<std::byte>& now, const std::vector<std::byte>& recorded) {
        if (now == recorded) return true;
        if (report_.difference_count++ >= options_.max_differences) return false;
        ReplayDifference difference;
        difference.entry = report_.entries;
        difference.frame = report_.frames;
        difference.question = name_of(entry.kind);
        const auto then_parts = text_of<D>(entry.kind, recorded), now_parts = text_of<D>(entry.kind, now);
        const auto first = std::mismatch(then_parts.begin(), then_parts.end(), now_parts.begin(), now_parts.end());
        const auto index = static_cast<std::size_t>(first.first - then_parts.begin());
        if (index < then_parts.size() || index < now_parts.size())
            difference.field = (index < then_parts.size() ? then_parts : now_parts)[index].first;
        difference.recorded = text_of_parts(then_parts, index);
        difference.now = text_of_parts(now_parts, index);
        report_.differences.push_back(std::move(difference));
        return false;
    }

    World<D> world_;
    WorldOptions world_options_;
    ReplayOptions options_;
    std::unordered_map<std::uint64_t, AnyShape<D>> shapes_;
    bool had_pair_filter_ = false;
};

template <int D>
Result<ReplayReport> replay_in(BlobReader reader, std::span<const std::byte> recording, const ReplayOptions& options) {
    WorldOptions world_options;
    std::uint64_t max_released = 0, flags = 0, size = 0, checksum = 0;
    std::span<const std::byte> file;
    if (!reader.number(max_released) || !reader.number(flags) || !reader.number(size) || !reader.bytes(file, size))
        return bad("is truncated before its first entry");
    const std::size_t header = recording.size() - reader.left();
    if (!reader.number(checksum)) return bad("is truncated before its first entry");
    if (checksum != blob_checksum<recording_sums>(recording.first(header)) || flags > 1)
        return bad("is damaged before its first entry");
    world_options.max_released_shapes = static_cast<std::size_t>(max_released);
    world_options.filter_edges = flags == 1;
    Result<World<D>> world = load_world<D>(file, world_options);
    if (!world) return world.problem();
    Replay<D> replay(*std::move(world), world_options, options);
    while (reader.left() > 0) {
        std::uint32_t its_size = 0, complement = 0;
        std::span<const std::byte> payload;
        const bool has_size = reader.number(its_size) && reader.number(complement);
        if (has_size && its_size != ~complement)
            return bad("is damaged at entry " + std::to_string(replay.report_.entries));
        if (!has_size || !reader.bytes(payload, its_size) || !reader.number(checksum)) {
            replay.report_.is_cut = true;
            break;
        }
        if (checksum != blob_checksum<recording_sums>(payload))
            return bad("is damaged at entry " + std::to_string(replay.report_.entries));
        if (std::optional<Problem> problem = replay.play(payload)) return *std::move(problem);
    }
    return std::move(replay.report_);
}

}  // namespace

Result<ReplayReport> replay(std::span<const std::byte> recording, const ReplayOptions& options) {
    BlobReader reader(recording);
    for (const char expected : recording_signature) {
        char c = 0;
        if (!reader.number(c) || c != expected)
            return Problem{ProblemCode::bad_format, "this is not a recording of a world: its signature is wrong"};
    }
    std::uint32_t version = 0, dimension = 0;
    if (!reader.number(version) || !reader.number(dimension)) return bad("is truncated before its first entry");
    if (version != recording_version || (dimension != 2 && dimension != 3))
        return bad("has version " + std::to_string(version) + " and dimension " + std::to_string(dimension) +
                   ", not version " + std::to_string(recording_version) + " and dimension 2 or 3");
    return dimension == 2 ? replay_in<2>(reader, recording, options) : replay_in<3>(reader, recording, options);
}

}  // namespace abut
