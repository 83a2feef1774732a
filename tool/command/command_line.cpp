#include "tool/command/command_line.hpp"

#include "tool/help/suggestion.hpp"
#include "tool/shared/color.hpp"
#include "tool/shared/format.hpp"
#include "tool/shared/out_of_memory.hpp"
#include "tool/shared/version.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace abut::tool {
namespace {

constexpr std::array shells{"bash", "zsh", "fish"};

// Options of verbs that write a file, which each input of `abut bake` would write again.
constexpr std::array writing_options{"--output", "--picture", "--report", "--svg", "--sarif", "--junit"};

int fail(const std::string& message) {
    std::fputs(one_line(message).c_str(), stderr);
    return unusable;
}

OptionHelp help_of(const CLI::Option& option) {
    OptionHelp help;
    help.is_positional = !option.nonpositional();
    help.is_required = option.get_required();
    help.text = option.get_description();
    if (help.is_positional) {
        help.name = option.get_name(true);
        return help;
    }
    if (!option.get_snames().empty()) help.short_name = "-" + option.get_snames().front();
    if (!option.get_lnames().empty()) help.name = "--" + option.get_lnames().front();
    if (option.get_items_expected_max() > 0) help.value = option.get_type_name();
    return help;
}

std::vector<OptionHelp> options_of(const CLI::App& app) {
    std::vector<OptionHelp> options;
    for (const CLI::Option* option : app.get_options())
        if (!option->get_group().empty()) options.push_back(help_of(*option));
    return options;
}

std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const OptionHelp& option : options_of(app))
        if (!option.is_positional) names.push_back(option.name);
    return names;
}

// The option alone, without a value after '='.
std::string option_of(const std::string& word) {
    return word.substr(0, word.find('='));
}

}  // namespace

CommandLine::CommandLine()
    : app_(
          "Checks scenes and levels for collisions: which objects touch, where, how deep and when. Makes convex parts, "
          "signed distance fields and walk meshes from meshes.",
          "abut") {
    app_.require_subcommand(0, 1);  // so that `help check` has one, and a word
    app_.set_help_flag("-h,--help", "Print this text");
    app_.add_flag("--version", wants_version_, "Print the version; with --json as one JSON object");
    app_.add_flag("--json", wants_json_)->group("");
    CLI::App& help = add_verb("help", "Explains a verb, or lists all",
                              {[this] { return run_help(); }, [] { return std::string(); }});
    help.add_option("VERB", help_verb_, "The verb to explain; without it, all are listed");
    help.add_flag("--man", wants_man_page_, "Print the man page");
    help.add_option("--completions", shell_, "Print the completions for bash, zsh or fish")->type_name("SHELL");
}

CLI::App& CommandLine::add_verb(const char* name, const char* summary, VerbActions actions) {
    CLI::App& app = *app_.add_subcommand(name, summary);
    app.set_help_flag("-h,--help", "Print this text");
    app.add_flag("-q,--quiet", is_quiet_, "Print nothing on stdout: the exit status says it all");
    verbs_.push_back({&app, std::move(actions)});
    return app;
}

CommandHelp CommandLine::help() const {
    CommandHelp result{version(), app_.get_description(), {}, options_of(app_)};
    for (const Verb& verb : verbs_)
        result.verbs.push_back(
            {verb.app->get_name(), verb.app->get_description(), options_of(*verb.app), verb.app->get_footer()});
    // `help` itself comes last.
    std::rotate(result.verbs.begin(), result.verbs.begin() + 1, result.verbs.end());
    return result;
}

int CommandLine::print_version() const {
    const Json json = {{"name", "abut"}, {"version", version()}};
    const Result<ExitCode> code = print(wants_json_ ? to_text(json) : std::string("abut ") + version() + "\n", fine);
    return code ? static_cast<int>(*code) : fail(code.problem().message);
}

Result<ExitCode> CommandLine::run_help() const {
    const CommandHelp all = help();
    if (wants_man_page_) return print(man_page(all), fine);
    if (!shell_.empty()) {
        if (std::find(shells.begin(), shells.end(), shell_) != shells.end())
            return print(completions(all, shell_), fine);
        return Problem{ProblemCode::bad_argument, "--completions: '" + shell_ + "' is not one of bash, zsh and fish"};
    }
    if (help_verb_.empty()) return print(help_of(all, terminal_width()), fine);
    std::vector<std::string> names;
    for (const VerbHelp& verb : all.verbs) {
        if (verb.name == help_verb_) return print(help_of(verb, terminal_width()), fine);
        names.push_back(verb.name);
    }
    return Problem{ProblemCode::bad_argument, "'" + help_verb_ + "' is not a verb" + suggestion(help_verb_, names)};
}

// CLI11's own messages stay where nothing better is known.
std::string CommandLine::usage_error(const CLI::ParseError& error, const std::vector<std::string>& words) const {
    std::vector<std::string> names;
    for (const Verb& verb : verbs_) names.push_back(verb.app->get_name());
    if (app_.get_subcommands().empty()) {
        if (words.empty()) return "a verb is needed; `abut help` lists them";
        const std::string& word = words.front();
        if (word.starts_with('-'))
            return "'" + option_of(word) + "' is not an option of abut" +
                   suggestion(option_of(word), option_names(app_));
        const std::string near = suggestion(word, names);
        return "'" + word + "' is not a verb" + (near.empty() ? "; `abut help` lists them" : near);
    }
    const CLI::App& verb = *app_.get_subcommands().front();
    for (const std::string& word : app_.remaining(true)) {
        if (!word.starts_with('-')) continue;
        const std::string near = suggestion(option_of(word), option_names(verb));
        return "'" + option_of(word) + "' is not an option of " + verb.get_name() +
               (near.empty() ? "; `abut help " + verb.get_name() + "` lists them" : near);
    }
    return std::string(error.what()) + "; `abut help " + verb.get_name() + "` explains it";
}

int CommandLine::run(std::vector<std::string> words) {
    const std::vector<std::string> given = words;
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    try {
        app_.parse(std::move(words));
    } catch (const CLI::CallForHelp&) {
        const std::vector<CLI::App*> verbs = app_.get_subcommands();
        help_verb_ = verbs.empty() ? "" : verbs.front()->get_name();
        const Result<ExitCode> code = run_help();
        return code ? static_cast<int>(*code) : fail(code.problem().message);
    } catch (const CLI::ParseError& error) {
        return fail(usage_error(error, given));
    }
    if (wants_version_) return print_version();
    // A child process that `bake` starts has a stdout of its own.
    if (is_quiet_ && std::freopen("/dev/null", "w", stdout) == nullptr) return fail("/dev/null can't be opened");
    for (const Verb& verb : verbs_)
        if (verb.app->parsed()) return run_verb(verb);
    return fail("a verb is needed; `abut help` lists them");
}

int CommandLine::run_verb(const Verb& verb) {
    const std::string too_large = verb.actions.input() + ": needs more memory than there is" + verb.actions.less_memory;
    exit_when_out_of_memory(too_large);
    try {
        const Result<ExitCode> code = verb.actions.run();
        return code ? static_cast<int>(*code) : fail(code.problem().message);
    } catch (const std::length_error&) {
        return fail(too_large);
    }
}

Result<std::vector<std::string>> CommandLine::canonical_options(const std::string& verb,
                                                                const std::vector<std::string>& words) {
    const auto bad = [&](const std::string& what) { return Problem{ProblemCode::bad_argument, verb + ": " + what}; };
    const auto found =
        std::find_if(verbs_.begin(), verbs_.end(), [&](const Verb& other) { return other.app->get_name() == verb; });
    if (found == verbs_.end()) return bad("is not a verb");
    std::vector<std::string> given{verb, "input"};
    // Where the verb must have an output, bake gives it one.
    for (const CLI::Option* option : found->app->get_options())
        if (option->get_required() && option->nonpositional() && option->check_lname("output"))
            given.insert(given.end(), {"--output", "output"});
    const std::size_t own = given.size();
    given.insert(given.end(), words.begin(), words.end());
    try {
        app_.parse(std::vector<std::string>(given.rbegin(), given.rend()));
    } catch (const CLI::CallForHelp&) {
        return bad("--help is no option of a bake");
    } catch (const CLI::ParseError& error) {
        return bad(usage_error(error, given));
    }
    std::vector<std::string> result;
    for (const CLI::Option* option : found->app->get_options()) {
        if (option->count() == 0 || !option->nonpositional()) continue;
        const std::string name = help_of(*option).name;
        const bool writes = std::find(writing_options.begin(), writing_options.end(), name) != writing_options.end();
        if (writes && !(name == "--output" && own > 2 && option->count() == 1))
            return bad(name + " would write one file for all inputs");
        if (writes || name == "--json" || name == "--quiet") continue;
        for (const std::string& value : option->results())
            result.push_back(option->get_items_expected_max() > 0 ? name + "=" + value : name);
    }
    return result;
}

}  // namespace abut::tool
