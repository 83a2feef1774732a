#include "tool/check/config.hpp"

#include <abut/io/file/glob.hpp>
#include <abut/io/file/read_file.hpp>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <toml++/toml.h>

namespace abut::tool {
namespace {

Problem at_line(const std::filesystem::path& config, const toml::source_region& source, const std::string& message) {
    return {ProblemCode::bad_format, fmt::format("{}:{}: {}", config.string(), source.begin.line, message)};
}

std::string word_of(toml::node_type type) {
    switch (type) {
        case toml::node_type::string:
            return "a string";
        case toml::node_type::integer:
        case toml::node_type::floating_point:
            return "a number";
        case toml::node_type::boolean:
            return "true or false";
        case toml::node_type::array:
            return "a list";
        case toml::node_type::table:
            return "a table";
        default:
            return "a date or a time";
    }
}

// A string or a number as the command line has it.
std::optional<std::string> text_of(const toml::node& node) {
    if (const auto* string = node.as_string()) return string->get();
    if (const auto* whole = node.as_integer()) return std::to_string(whole->get());
    if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
    return std::nullopt;
}

class ConfigReader {
public:
    ConfigReader(const std::filesystem::path& config, const std::string& scene) : config_(config), scene_(scene) {}

    std::optional<Problem> read(const toml::table& table, bool is_top);
    Settings take() { return std::move(settings_); }

private:
    std::optional<Problem> read(const SettingInfo& setting, const toml::node& node);
    std::optional<Problem> read_severities(const toml::node& node);
    std::optional<Problem> read_levels(const toml::node& node);
    Problem wrong_type(const toml::node& node, const std::string& name, const char* wanted) const {
        return at_line(config_, node.source(), fmt::format("{} is {}, not {}", name, word_of(node.type()), wanted));
    }
    void add(const toml::node& node, const std::string& name, const std::string& text) {
        settings_[name].push_back({text, fmt::format("{}:{}: {}", config_.string(), node.source().begin.line, name)});
    }

    const std::filesystem::path& config_;
    const std::string& scene_;
    Settings settings_;
};

// Two numbers are a list here and have a comma between them on the command line.
std::optional<Problem> ConfigReader::read(const SettingInfo& setting, const toml::node& node) {
    const std::string name = setting.name;
    if (setting.form == SettingForm::flag) {
        const auto* flag = node.as_boolean();
        if (flag == nullptr) return wrong_type(node, name, "true or false");
        settings_[name].clear();
        add(node, name, flag->get() ? "true" : "false");
        return std::nullopt;
    }
    const toml::array* list = node.as_array();
    if (setting.form == SettingForm::list) {
        if (list == nullptr) return wrong_type(node, name, "a list of strings");
        if (name != "ignore") settings_[name].clear();
        for (const toml::node& item : *list) {
            const auto* string = item.as_string();
            if (string == nullptr) return wrong_type(item, "an item of " + name, "a string");
            add(item, name, string->get());
        }
        return std::nullopt;
    }
    std::string text;
    const auto append = [&](const toml::node& item) {
        const std::optional<std::string> word = text_of(item);
        if (word) text += (text.empty() ? "" : ",") + *word;
        return word.has_value();
    };
    bool is_value = true;
    if (list == nullptr)
        is_value = append(node);
    else
        for (const toml::node& item : *list) is_value = is_value && append(item);
    if (!is_value) return wrong_type(node, name, "a number, a string or a list of numbers");
    // A file is meant from the folder of abut.toml.
    if (name == "baseline") text = (config_.parent_path() / text).string();
    settings_[name].clear();
    add(node, name, text);
    return std::nullopt;
}

std::optional<Problem> ConfigReader::read_severities(const toml::node& node) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return wrong_type(node, "severity", "a table");
    for (const auto& [key, value] : *table) {
        const auto* word = value.as_string();
        if (word == nullptr) return wrong_type(value, "severity." + std::string(key.str()), "off, warning or error");
        add(value, "severity", std::string(key.str()) + "=" + word->get());
    }
    return std::nullopt;
}

std::optional<Problem> ConfigReader::read_levels(const toml::node& node) {
    const toml::table* levels = node.as_table();
    if (levels == nullptr) return wrong_type(node, "level", "a table");
    for (const auto& [pattern, section] : *levels) {
        const toml::table* table = section.as_table();
        if (table == nullptr) return wrong_type(section, "level." + std::string(pattern.str()), "a table");
        // Sections of other levels are read too, so that an error in one is never hidden.
        Settings before = settings_;
        if (std::optional<Problem> problem = read(*table, false)) return problem;
        if (!detail::glob_matches(pattern.str(), scene_)) settings_ = std::move(before);
    }
    return std::nullopt;
}

std::optional<Problem> ConfigReader::read(const toml::table& table, bool is_top) {
    const toml::node* levels = nullptr;
    for (const auto& [key, node] : table) {
        const std::string_view name = key.str();
        if (is_top && name == "level") {
            levels = &node;
            continue;
        }
        std::optional<Problem> problem;
        const auto& all = all_settings();
        const auto setting =
            std::find_if(all.begin(), all.end(), [&](const SettingInfo& one) { return name == one.name; });
        if (setting == all.end())
            problem = at_line(config_, key.source(), fmt::format("'{}' is no option of abut check", name));
        else if (name == "severity")
            problem = read_severities(node);
        else
            problem = read(*setting, node);
        if (problem) return problem;
    }
    return levels == nullptr ? std::nullopt : read_levels(*levels);
}

}  // namespace

std::optional<std::filesystem::path> find_config(const std::filesystem::path& scene) {
    std::error_code error;
    std::filesystem::path folder = std::filesystem::absolute(scene, error).lexically_normal().parent_path();
    for (;;) {
        const std::filesystem::path config = folder / config_name;
        if (std::filesystem::is_regular_file(config, error)) {
            // Messages name it as the user named the scene.
            return folder == std::filesystem::absolute(scene, error).lexically_normal().parent_path()
                       ? scene.parent_path() / config_name
                       : config;
        }
        if (folder == folder.parent_path()) return std::nullopt;
        folder = folder.parent_path();
    }
}

Result<Settings> settings_of_config(const std::string& text, const std::filesystem::path& config,
                                    const std::string& scene_name) {
    try {
        const toml::table table = toml::parse(text, config.string());
        ConfigReader reader(config, scene_name);
        if (std::optional<Problem> problem = reader.read(table, true)) return *std::move(problem);
        return reader.take();
    } catch (const toml::parse_error& error) {
        return at_line(config, error.source(), std::string(error.description()));
    }
}

Result<Settings> read_config(const std::filesystem::path& config, const std::filesystem::path& scene) {
    const Result<std::vector<std::byte>> bytes = detail::read_file(config);
    if (!bytes) return Problem{bytes.problem().code, config.string() + ": " + bytes.problem().message};
    const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    return settings_of_config(text, config, scene.filename().string());
}

std::string config_section(const std::string& scene_name, const Settings& settings) {
    toml::table section;
    for (const SettingInfo& setting : all_settings()) {
        const auto found = settings.find(setting.name);
        if (found == settings.end() || found->second.empty()) continue;
        const std::string& text = found->second.back().text;
        if (setting.form == SettingForm::flag) {
            section.insert(setting.name, text == "true");
        } else if (setting.form == SettingForm::value) {
            section.insert(setting.name, text);
        } else if (std::string_view(setting.name) == "severity") {
            toml::table severities;
            for (const SettingText& one : found->second) {
                const std::size_t equals = one.text.find('=');
                severities.insert_or_assign(one.text.substr(0, equals), one.text.substr(equals + 1));
            }
            section.insert(setting.name, std::move(severities));
        } else {
            toml::array list;
            for (const SettingText& one : found->second) list.push_back(one.text);
            section.insert(setting.name, std::move(list));
        }
    }
    const toml::table whole{{"level", toml::table{{scene_name, std::move(section)}}}};
    std::ostringstream text;
    text << whole;
    return text.str() + "\n";
}

}  // namespace abut::tool
