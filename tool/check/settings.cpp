#include "tool/check/settings.hpp"

#include "tool/arguments.hpp"

#include <algorithm>
#include <utility>

namespace abut::tool {
namespace {

// Where its address is taken, a function has its true type in WebAssembly only if the type of its result is complete.
template <class... Values>
constexpr bool are_complete = (... && (sizeof(Result<Values>) > 0));
static_assert(are_complete<float, std::size_t, Character, UpDirection, GapRange, PairPattern, IgnorePattern>);

// Reads the values of options, and keeps the first Problem.
class Reader {
public:
    explicit Reader(const Settings& settings) : settings_(settings) {}

    template <class Value, class To>
    void read(const char* name, Result<Value> (*parse)(const std::string&), To& to) {
        for (const SettingText& given : of(name)) parse_into(given, parse, to);
    }
    template <class Value>
    void read_all(const char* name, Result<Value> (*parse)(const std::string&), std::vector<Value>& to) {
        for (const SettingText& given : of(name)) parse_into(given, parse, to.emplace_back());
    }
    void read(const char* name, std::vector<std::string>& to) const {
        for (const SettingText& given : of(name)) to.push_back(given.text);
    }
    void read(const char* name, bool& to) const {
        for (const SettingText& given : of(name)) to = given.text == "true";
    }
    void read(const char* name, std::optional<std::string>& to) const {
        for (const SettingText& given : of(name)) to = given.text;
    }

    const std::vector<SettingText>& of(const char* name) const {
        static const std::vector<SettingText> none;
        const auto found = settings_.find(name);
        return found == settings_.end() ? none : found->second;
    }
    void fail(const SettingText& given, const std::string& message) {
        if (!problem_) problem_ = Problem{ProblemCode::bad_argument, given.where + ": " + message};
    }
    const std::optional<Problem>& problem() const { return problem_; }

private:
    template <class Value, class To>
    void parse_into(const SettingText& given, Result<Value> (*parse)(const std::string&), To& to) {
        Result<Value> value = parse(given.text);
        if (value)
            to = *std::move(value);
        else
            fail(given, value.problem().message);
    }

    const Settings& settings_;
    std::optional<Problem> problem_;
};

std::string no_rule(const std::string& word) {
    return "'" + word + "' is no kind and no code; the kinds are " + kind_names();
}

// KIND=SEVERITY
bool read_severity(const std::string& text, std::string& word, Severity& severity) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) return false;
    word = text.substr(0, equals);
    for (const Severity one : {Severity::off, Severity::warning, Severity::error})
        if (text.substr(equals + 1) == name_of(one)) {
            severity = one;
            return true;
        }
    return false;
}

void read_severities(Reader& reader, Severities& severities) {
    // Objects that are said to be closed must not leak.
    if (!reader.of("closed").empty()) severities.set(name_of(Kind::leak), Severity::error);
    for (const SettingText& given : reader.of("severity")) {
        std::string word;
        Severity severity = Severity::off;
        if (!read_severity(given.text, word, severity))
            reader.fail(given, "'" + given.text +
                                   "' is no KIND=SEVERITY, such as leak=error; the severities are off, "
                                   "warning and error");
        else if (!names_any_rule(word))
            reader.fail(given, no_rule(word));
        severities.set(word, severity);
    }
    const std::vector<SettingText>& only = reader.of("only");
    for (const char* name : {"only", "no"})
        for (const SettingText& given : reader.of(name))
            if (!names_any_rule(given.text)) reader.fail(given, no_rule(given.text));
    for (const RuleInfo& rule : all_rules()) {
        const auto named = [&](const SettingText& given) { return names_rule(given.text, rule); };
        Severity& severity = severities.of(rule.rule);
        const bool is_selected = std::any_of(only.begin(), only.end(), named);
        if (!only.empty() && !is_selected) severity = Severity::off;
        // Who selects what is off by default wants to see it.
        if (is_selected && severity == Severity::off) severity = Severity::warning;
        if (const auto& no = reader.of("no"); std::any_of(no.begin(), no.end(), named)) severity = Severity::off;
    }
}

}  // namespace

const std::vector<SettingInfo>& all_settings() {
    using enum SettingForm;
    static const std::vector<SettingInfo> all{
        {"allow", value},     {"clearance", value}, {"frames", value},
        {"character", value}, {"up", value},        {"gap", value},
        {"baseline", value},  {"pairs", list},      {"spawn", list},
        {"closed", list},     {"solid", list},      {"body", list},
        {"only", list},       {"no", list},         {"severity", list},
        {"ignore", list},     {"strict", flag},     {"allow-outside", flag},
        {"all-meshes", flag}, {"scale", value},     {"warnings-as-errors", flag},
    };
    return all;
}

Result<CheckPlan> plan_of(const Settings& settings) {
    CheckPlan plan;
    Reader reader(settings);
    reader.read("allow", parse_length, plan.contacts.limits.allow);
    reader.read("clearance", parse_length, plan.contacts.limits.clearance);
    reader.read("frames", parse_frames, plan.frames);
    reader.read("character", parse_character, plan.faults.character);
    reader.read("up", parse_up, plan.faults.up);
    reader.read("gap", parse_gap, plan.faults.gap);
    reader.read_all("pairs", parse_pair, plan.contacts.pairs);
    reader.read("baseline", plan.baseline);
    reader.read("spawn", plan.faults.spawns);
    reader.read("closed", plan.faults.closed);
    reader.read("solid", plan.solid);
    reader.read("body", plan.bodies);
    reader.read_all("ignore", parse_ignore, plan.ignored);
    for (std::size_t i = 0; i < plan.ignored.size(); ++i) plan.ignored[i].where = reader.of("ignore")[i].where;
    reader.read("strict", plan.files.strict);
    reader.read("allow-outside", plan.files.allow_outside);
    reader.read("all-meshes", plan.files.all_meshes);
    reader.read("scale", parse_length, plan.files.scale);
    reader.read("warnings-as-errors", plan.warnings_as_errors);
    read_severities(reader, plan.severities);
    if (reader.problem()) return *reader.problem();
    plan.faults.allow = plan.contacts.limits.allow;
    plan.faults.pairs = plan.contacts.pairs;
    return plan;
}

Settings merged(const Settings& of_file, const Settings& of_command_line) {
    Settings result = of_file;
    for (const auto& [name, values] : of_command_line) {
        std::vector<SettingText>& all = result[name];
        if (name != "ignore") all.clear();
        all.insert(all.end(), values.begin(), values.end());
    }
    return result;
}

}  // namespace abut::tool
