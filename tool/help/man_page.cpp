#include "tool/help/command_help.hpp"

namespace abut::tool {
namespace {

// Text for roff: hyphens are minus signs, and a line that begins with a dot or a quote is no request.
std::string roff(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '\\') {
            result += "\\e";
        } else if (c == '-') {
            result += "\\-";
        } else if ((c == '.' || c == '\'') && (result.empty() || result.back() == '\n')) {
            result += std::string("\\&") + c;
        } else {
            result += c;
        }
    }
    return result;
}

std::string section(const std::string& name) {
    return ".SH \"" + name + "\"\n";
}

std::string options_of(const std::vector<OptionHelp>& options) {
    std::string text;
    for (const OptionHelp& option : options) {
        text += ".TP\n";
        if (!option.short_name.empty()) text += "\\fB" + roff(option.short_name) + "\\fR, ";
        text += (option.is_positional ? "\\fI" : "\\fB") + roff(option.name) + "\\fR";
        if (!option.value.empty() && !option.is_positional) text += " \\fI" + roff(option.value) + "\\fR";
        text += "\n" + roff(option.text) + "\n";
    }
    return text;
}

std::string examples(std::string_view verb) {
    std::string text;
    for (const Example& example : examples_of(verb))
        text += ".TP\n.B " + roff(example.command) + "\n" + roff(example.text) + "\n";
    return text;
}

std::string exit_codes(std::string_view verb) {
    std::string text;
    for (const ExitCodeHelp& code : exit_codes_of(verb))
        text += std::string(".TP\n.B ") + code.code + "\n" + roff(code.text) + "\n";
    return text;
}

}  // namespace

std::string man_page(const CommandHelp& command) {
    std::string text = ".TH ABUT 1 \"\" \"abut " + roff(command.version) + "\"\n";
    text += section("NAME") + "abut \\- collision detection for games: checks levels, bakes shapes\n";
    text += section("SYNOPSIS") + ".B abut\n.I VERB\n\\&... [\\fIOPTION\\fR]...\n";
    text += section("DESCRIPTION") + roff(command.summary) + "\n";
    for (const VerbHelp& verb : command.verbs) text += ".TP\n.B " + roff(verb.name) + "\n" + roff(verb.summary) + "\n";
    text += section("OPTIONS") + options_of(command.options);
    for (const VerbHelp& verb : command.verbs) {
        text += section("abut " + verb.name) + roff(verb.summary) + "\n" + options_of(verb.options);
        if (!verb.details.empty()) text += ".PP\n" + roff(verb.details) + "\n";
        text += ".SS Examples\n" + examples(verb.name) + ".SS \"Exit status\"\n" + exit_codes(verb.name);
    }
    text += section("EXIT STATUS") + exit_codes("");
    text += section("ENVIRONMENT") + ".TP\n.B NO_COLOR\nIf set and not empty, text on terminals has no colours.\n";
    text +=
        ".TP\n.B COLUMNS\nThe width of help texts.\n.TP\n.B TMPDIR\nThe folder for temporary files of \\fBabut "
        "bake\\fR.\n";
    return text;
}

}  // namespace abut::tool
