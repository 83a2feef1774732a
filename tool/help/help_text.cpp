#include "tool/help/command_help.hpp"
#include "tool/help/wrap.hpp"
#include "tool/shared/color.hpp"

#include <utility>

namespace abut::tool {
namespace {

constexpr std::size_t margin = 2, max_left = 26;

// Two columns; a left side that is too long has a line of its own.
std::string row(const std::string& left, std::string_view text, std::size_t width, std::size_t left_width) {
    const std::size_t indent = margin + left_width + 2;
    std::string line = std::string(margin, ' ') + left;
    if (left.size() > left_width)
        line += "\n" + std::string(indent, ' ');
    else
        line += std::string(indent - line.size(), ' ');
    return line + wrapped(text, width, indent, indent);
}

std::string table(const std::vector<std::pair<std::string, std::string>>& rows, std::size_t width) {
    std::size_t left_width = 0;
    for (const auto& [left, text] : rows)
        if (left.size() <= max_left) left_width = std::max(left_width, left.size());
    std::string result;
    for (const auto& [left, text] : rows) result += row(left, text, width, left_width);
    return result;
}

std::string heading(const char* text) {
    return "\n" + colored(Tone::heading, text) + "\n";
}

std::string left_of(const OptionHelp& option) {
    std::string left = option.short_name.empty() ? "" : option.short_name + ", ";
    left += option.name;
    return option.value.empty() || option.is_positional ? left : left + " " + option.value;
}

std::string options_table(const std::vector<OptionHelp>& options, bool positional, std::size_t width) {
    std::vector<std::pair<std::string, std::string>> rows;
    for (const OptionHelp& option : options)
        if (option.is_positional == positional)
            rows.emplace_back(left_of(option), option.text + (option.is_required && !positional ? " (required)" : ""));
    return table(rows, width);
}

// Examples stay whole, so that they can be copied.
std::string examples_and_codes(std::string_view verb, std::size_t width) {
    std::string text;
    const std::vector<Example> examples = examples_of(verb);
    if (!examples.empty()) text += heading("Examples");
    for (const Example& example : examples)
        text += std::string(margin, ' ') + example.command + "\n" + std::string(margin + 4, ' ') +
                wrapped(example.text, width, margin + 4, margin + 4);
    text += heading("Exit status");
    std::vector<std::pair<std::string, std::string>> codes;
    for (const ExitCodeHelp& code : exit_codes_of(verb)) codes.emplace_back(code.code, code.text);
    return text + table(codes, width);
}

}  // namespace

std::string help_of(const CommandHelp& command, std::size_t width) {
    std::string text = wrapped(command.summary, width, 0, 0);
    text += heading("Usage") + "  abut VERB ... [OPTION]...\n" + heading("Verbs");
    std::vector<std::pair<std::string, std::string>> verbs;
    for (const VerbHelp& verb : command.verbs) verbs.emplace_back(verb.name, verb.summary);
    text += table(verbs, width) + heading("Options") + options_table(command.options, false, width);
    return text + examples_and_codes("", width) + "\n" +
           wrapped("`abut help VERB` prints all options of a verb.", width, 0, 0);
}

std::string help_of(const VerbHelp& verb, std::size_t width) {
    std::string text = wrapped(verb.summary, width, 0, 0), usage = "abut " + verb.name;
    bool has_arguments = false;
    for (const OptionHelp& option : verb.options) {
        if (option.is_positional) usage += option.is_required ? " " + option.name : " [" + option.name + "]";
        if (!option.is_positional && option.is_required)
            usage += " " + (option.short_name.empty() ? option.name : option.short_name) + " " + option.value;
        has_arguments = has_arguments || option.is_positional;
    }
    text += heading("Usage") + "  " + wrapped(usage + " [OPTION]...", width, 6, 2);
    if (has_arguments) text += heading("Arguments") + options_table(verb.options, true, width);
    text += heading("Options") + options_table(verb.options, false, width);
    if (!verb.details.empty()) text += "\n" + wrapped(verb.details, width, 0, 0);
    return text + examples_and_codes(verb.name, width);
}

}  // namespace abut::tool
