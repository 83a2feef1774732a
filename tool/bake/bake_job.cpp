#include "tool/bake/bake_job.hpp"

#include "tool/bake/inputs.hpp"
#include "tool/bake/sha256.hpp"
#include "tool/verbs.hpp"
#include <abut/io/file/read_file.hpp>

#include <array>
#include <system_error>
#include <utility>

namespace abut::tool {
namespace {

namespace fs = std::filesystem;

// Members of reports that differ from run to run, or from folder to folder.
constexpr std::array unsteady{"seconds", "output", "file", "path"};

constexpr const char* entry_ending = ".json";

// The nearest abut.toml in the folder of a file or above, which `check` reads.
std::optional<fs::path> config_of(const fs::path& file) {
    std::error_code error;
    for (fs::path folder = fs::absolute(file, error).lexically_normal().parent_path();; folder = folder.parent_path()) {
        if (fs::is_regular_file(folder / "abut.toml", error)) return folder / "abut.toml";
        if (folder == folder.parent_path()) return std::nullopt;
    }
}

// The value of an option that names a file, such as --baseline=old.json.
std::optional<fs::path> file_of(const std::string& option) {
    const std::size_t equals = option.find('=');
    std::error_code error;
    if (equals == std::string::npos || !fs::is_regular_file(option.substr(equals + 1), error)) return std::nullopt;
    return option.substr(equals + 1);
}

// A line with its length before it, so that no two lists of lines give the same bytes.
void add_line(Sha256& hash, const std::string& line) {
    hash.add(std::to_string(line.size()) + ":" + line + "\n");
}

Result<std::string> hash_of(const fs::path& file) {
    const Result<Bytes> bytes = detail::read_file(file);
    if (!bytes) return bytes.problem();
    return sha256(*bytes);
}

// What went wrong, without "abut: " and the name of the input.
std::string reason_of(const ChildResult& ran, const std::string& name) {
    std::string line = ran.err.substr(0, ran.err.find('\n'));
    for (const std::string& start : {std::string("abut: "), name + ": "})
        if (line.starts_with(start)) line.erase(0, start.size());
    return line.empty() ? "ended with " + std::to_string(ran.code) : line;
}

}  // namespace

std::optional<std::string> output_ending(const std::string& verb) {
    if (verb == "check") return "";
    if (verb == "hull" || verb == "decompose") return ".glb";
    if (verb == "field") return std::string(field_ending);
    if (verb == "walk") return std::string(walk_ending);
    return std::nullopt;
}

Result<std::string> key_of(const BakeTask& task, const fs::path& file) {
    const Result<std::vector<InputFile>> inputs = input_files(file);
    if (!inputs) return inputs.problem();
    Sha256 hash;
    for (const std::string& line : {std::string("abut bake"), task.version, task.verb}) add_line(hash, line);
    for (const std::string& option : task.options) {
        const std::optional<fs::path> named = file_of(option);
        add_line(hash, named ? option.substr(0, option.find('=')) : option);
        if (!named) continue;
        const Result<std::string> digest = hash_of(*named);
        if (!digest) return Problem{digest.problem().code, named->string() + ": " + digest.problem().message};
        add_line(hash, *digest);
    }
    if (task.verb == "check")
        if (const std::optional<fs::path> config = config_of(file)) {
            const Result<std::string> digest = hash_of(*config);
            if (!digest) return Problem{digest.problem().code, config->string() + ": " + digest.problem().message};
            add_line(hash, "abut.toml " + *digest);
        }
    for (const InputFile& input : *inputs) add_line(hash, input.name + " " + input.sha256);
    const std::string digest = hash.digest();
    return digest.substr(0, 2) + "/" + digest.substr(2);
}

Result<Baked> bake(const BakeTask& task, const fs::path& file, const fs::path& scratch) {
    const std::string name = file.filename().string(), ending = output_ending(task.verb).value_or("");
    const fs::path output = fs::absolute(scratch / ("output" + ending));
    // A name that begins with '-' is no option.
    std::vector<std::string> arguments{task.verb, name.starts_with('-') ? "./" + name : name, "--json"};
    if (!ending.empty()) arguments.insert(arguments.end(), {"-o", output.string()});
    for (const std::string& option : task.options) {
        const std::optional<fs::path> named = file_of(option);
        arguments.push_back(named ? option.substr(0, option.find('=') + 1) + fs::absolute(*named).string() : option);
    }
    std::error_code error;
    fs::remove(output, error);
    const ChildResult ran = run_in_child(task.run, arguments, file.parent_path(), scratch);
    if (ran.code != fine && ran.code != found) return Problem{ProblemCode::bad_format, reason_of(ran, name)};

    Baked baked;
    Json report = Json::parse(ran.out, nullptr, false);
    if (!report.is_object()) return Problem{ProblemCode::bad_format, "the verb's report is no JSON object"};
    for (const char* member : unsteady) report.erase(member);
    baked.entry = {{"abut", task.version}, {"verb", task.verb},  {"options", task.options},
                   {"file", name},         {"status", ran.code}, {"report", report}};
    if (!ending.empty()) {
        Result<Bytes> bytes = detail::read_file(output);
        if (!bytes) return Problem{bytes.problem().code, "the output " + bytes.problem().message};
        baked.entry["output"] = {{"bytes", bytes->size()}, {"sha256", sha256(*bytes)}};
        baked.output = *std::move(bytes);
    }
    return baked;
}

Result<std::optional<Baked>> load(const BakeTask& task, const std::string& key, Cache& cache) {
    const Result<std::optional<Bytes>> text = cache.get(key + entry_ending);
    if (!text) return text.problem();
    if (!*text) return std::optional<Baked>();
    const auto* first = reinterpret_cast<const char*>((*text)->data());
    Baked baked{std::nullopt, Json::parse(first, first + (*text)->size(), nullptr, false)};
    if (!baked.entry.is_object() || !baked.entry.contains("status")) return std::optional<Baked>();
    const std::string ending = output_ending(task.verb).value_or("");
    if (ending.empty()) return std::optional(std::move(baked));
    Result<std::optional<Bytes>> output = cache.get(key + ending);
    if (!output) return output.problem();
    const Json stored = baked.entry.value("output", Json::object());
    if (!*output || stored.value("sha256", "") != sha256(**output)) return std::optional<Baked>();
    baked.output = *std::move(output);
    return std::optional(std::move(baked));
}

std::optional<Problem> save(const BakeTask& task, const std::string& key, const Baked& baked, Cache& cache) {
    if (baked.output)
        if (std::optional<Problem> problem = cache.put(key + output_ending(task.verb).value_or(""), *baked.output))
            return problem;
    const std::string text = baked.text();
    return cache.put(key + entry_ending, std::as_bytes(std::span(text)));
}

}  // namespace abut::tool
