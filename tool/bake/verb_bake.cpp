#include "tool/bake/verb_bake.hpp"

#include "tool/shared/format.hpp"
#include "tool/shared/progress.hpp"
#include <abut/io/file/read_file.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <random>
#include <sstream>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace abut::tool {
namespace {

namespace fs = std::filesystem;

// A folder for the files of running jobs, removed at the end.
class Scratch {
public:
    Scratch() {
        std::error_code error;
        std::string name = (fs::temp_directory_path(error) / "abut-bake-XXXXXX").string();
        if (mkdtemp(name.data()) != nullptr) folder_ = name;
    }
    ~Scratch() {
        std::error_code error;
        if (!folder_.empty()) fs::remove_all(folder_, error);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    const fs::path& folder() const { return folder_; }

private:
    fs::path folder_;
};

// One line of the list.
struct Item {
    std::string file;
    std::string outcome;  ///< "made", "there", "missing", "rejected", "equal", "different"
    std::string reason;   ///< why it was rejected
    std::string key;
    Json entry;
    int code = fine;
};

Result<std::vector<std::string>> lines_of(const std::string& list) {
    std::string text;
    if (list == "-") {
        text.assign(std::istreambuf_iterator<char>(std::cin), {});
    } else {
        const Result<Bytes> bytes = detail::read_file(list);
        if (!bytes) return Problem{bytes.problem().code, list + ": " + bytes.problem().message};
        text.assign(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    }
    std::vector<std::string> result;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.ends_with('\r')) line.pop_back();
        if (!line.empty()) result.push_back(line);
    }
    if (result.empty()) return Problem{ProblemCode::bad_argument, list + ": the list names no file"};
    return result;
}

class Baker {
public:
    Baker(const BakeRequest& request, Cache& cache, const fs::path& scratch)
        : request_(request), cache_(cache), scratch_(scratch), random_(std::random_device()()) {}

    /// Does what the request says with one file. Returns a Problem if the cache fails.
    Result<Item> process(const std::string& file);

private:
    Result<Item> audit(Item item, const Baked& stored);
    bool is_audited() { return std::uniform_real_distribution<double>(0, 100)(random_) < *request_.audit; }

    const BakeRequest& request_;
    Cache& cache_;
    const fs::path& scratch_;
    std::mt19937_64 random_;
};

Item rejected(Item item, const std::string& reason) {
    item.outcome = "rejected";
    item.reason = reason;
    item.code = unusable;
    return item;
}

Result<Item> Baker::process(const std::string& file) {
    Item item{file, {}, {}, {}, {}, fine};
    const Result<std::string> key = key_of(request_.task, file);
    if (!key) return rejected(std::move(item), key.problem().message);
    item.key = *key;
    const Result<std::optional<Baked>> stored = load(request_.task, *key, cache_);
    if (!stored) return stored.problem();
    if (*stored) {
        item.outcome = "there";
        item.code = (*stored)->status();
        item.entry = (*stored)->entry;
        return request_.audit && is_audited() ? audit(std::move(item), **stored) : Result<Item>(std::move(item));
    }
    if (request_.report || request_.audit) {
        item.outcome = "missing";
        item.code = unusable;
        return item;
    }
    const Result<Baked> baked = bake(request_.task, file, scratch_);
    if (!baked) return rejected(std::move(item), baked.problem().message);
    if (const std::optional<Problem> problem = save(request_.task, *key, *baked, cache_)) return *problem;
    item.outcome = "made";
    item.code = baked->status();
    item.entry = baked->entry;
    return item;
}

Result<Item> Baker::audit(Item item, const Baked& stored) {
    const Result<Baked> again = bake(request_.task, item.file, scratch_);
    if (!again) return rejected(std::move(item), again.problem().message);
    const bool is_equal = again->text() == stored.text() && again->output == stored.output;
    item.outcome = is_equal ? "equal" : "different";
    item.code = is_equal ? fine : found;
    return item;
}

std::size_t count(const std::vector<Item>& items, std::string_view outcome) {
    return static_cast<std::size_t>(
        std::count_if(items.begin(), items.end(), [&](const Item& item) { return item.outcome == outcome; }));
}

std::string text_report(const BakeRequest& request, const std::vector<Item>& items, std::size_t listed) {
    std::string text;
    for (const Item& item : items) {
        if (item.outcome == "rejected") text += fmt::format("{}: rejected: {}\n", item.file, item.reason);
        if (item.outcome == "missing") text += fmt::format("{}: no result\n", item.file);
        if (item.outcome == "different")
            text += fmt::format("{}: not the bytes in the cache, {}\n", item.file, item.key);
        if (request.report && item.code == found) text += fmt::format("{}: something was found\n", item.file);
    }
    text += fmt::format("{} {}", request.task.verb, counted(items.size(), "file", "files"));
    if (items.size() != listed)
        text += fmt::format(" of {} (shard {} of {})", listed, request.shard.index, request.shard.count);
    std::string separator = ": ";
    for (const auto& [outcome, name] : {std::pair("made", "made"),
                                        {"there", "in the cache"},
                                        {"equal", "made again, with equal bytes"},
                                        {"different", "made again, with different bytes"},
                                        {"missing", "without a result"},
                                        {"rejected", "rejected"}})
        if (const std::size_t number = count(items, outcome); number > 0) {
            text += fmt::format("{}{} {}", separator, number, name);
            separator = ", ";
        }
    return text + "\n";
}

std::string json_report(const BakeRequest& request, const std::vector<Item>& items, std::size_t listed) {
    Json list = Json::array();
    for (const Item& item : items) {
        Json& entry = list.emplace_back(Json{{"file", item.file}, {"outcome", item.outcome}, {"status", item.code}});
        if (!item.key.empty()) entry["key"] = item.key;
        if (!item.reason.empty()) entry["reason"] = item.reason;
        if (request.report && item.entry.is_object()) {
            entry["report"] = item.entry["report"];
            if (item.entry.contains("output")) entry["output"] = item.entry["output"];
        }
    }
    return to_text({{"version", request.task.version},
                    {"verb", request.task.verb},
                    {"options", request.task.options},
                    {"listed", listed},
                    {"shard", {request.shard.index, request.shard.count}},
                    {"items", std::move(list)}});
}

}  // namespace

Result<ExitCode> run_bake(const BakeRequest& request) {
    const Result<std::vector<std::string>> files = lines_of(request.list);
    if (!files) return files.problem();
    Result<std::unique_ptr<Cache>> cache = open_cache(request.cache);
    if (!cache) return cache.problem();
    const Scratch scratch;
    if (scratch.folder().empty())
        return Problem{ProblemCode::unreadable, "no folder for temporary files: TMPDIR names one"};

    Baker baker(request, **cache, scratch.folder());
    Progress progress("baking");
    std::vector<Item> items;
    int worst = fine;
    for (std::size_t i = 0; i < files->size(); ++i) {
        progress(i, files->size());
        if (!request.report && i % request.shard.count != request.shard.index - 1) continue;
        Result<Item> item = baker.process((*files)[i]);
        if (!item) return item.problem();
        worst = std::max(worst, item->code);
        items.push_back(*std::move(item));
    }
    return print(request.json ? json_report(request, items, files->size()) : text_report(request, items, files->size()),
                 static_cast<ExitCode>(worst));
}

Result<Shard> parse_shard(const std::string& text) {
    constexpr std::size_t max_shards = 1'000'000;
    Shard shard;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, shard.index);
    if (first.ec == std::errc() && first.ptr != end && *first.ptr == '/') {
        const auto second = std::from_chars(first.ptr + 1, end, shard.count);
        if (second.ec == std::errc() && second.ptr == end && shard.index >= 1 && shard.index <= shard.count &&
            shard.count <= max_shards)
            return shard;
    }
    return Problem{ProblemCode::bad_argument, "'" + text + "' is not I/N with 1 <= I <= N, such as 2/8"};
}

Result<double> parse_percent(const std::string& text) {
    double percent = 0;
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, percent);
    if (error == std::errc() && stopped == end && percent > 0 && percent <= 100) return percent;
    return Problem{ProblemCode::bad_argument, "'" + text + "' is not a number above 0 and at most 100"};
}

}  // namespace abut::tool
