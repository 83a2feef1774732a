#include "tool/help/command_help.hpp"

#include <algorithm>

namespace abut::tool {
namespace {

// A text in single quotes of a shell.
std::string in_quotes(std::string_view text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

// The first sentence, or its beginning: descriptions stand on one line.
std::string brief(std::string_view text) {
    std::size_t end = std::min({text.find(". "), text.find("; "), text.find(": "), text.size()});
    constexpr std::size_t max_length = 80;
    if (end > max_length) end = std::min(text.rfind(' ', max_length), max_length);
    return std::string(text.substr(0, end));
}

// For zsh, where brackets and colons end a description.
std::string zsh_text(std::string_view text) {
    std::string result;
    for (const char c : brief(text)) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
        result += c;
    }
    return result;
}

std::string names_of(const std::vector<OptionHelp>& options) {
    std::string names;
    for (const OptionHelp& option : options) {
        if (option.is_positional) continue;
        for (const std::string& name : {option.short_name, option.name})
            if (!name.empty()) names += (names.empty() ? "" : " ") + name;
    }
    return names;
}

std::string verbs_of(const CommandHelp& command) {
    std::string names;
    for (const VerbHelp& verb : command.verbs) names += (names.empty() ? "" : " ") + verb.name;
    return names;
}

std::string bash(const CommandHelp& command) {
    std::string text =
        "# bash completion of abut\n"
        "_abut() {\n"
        "    local word=${COMP_WORDS[COMP_CWORD]} words=\n"
        "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
        "        words=\"" +
        verbs_of(command) + " " + names_of(command.options) +
        "\"\n"
        "    elif [[ $word == -* ]]; then\n"
        "        case ${COMP_WORDS[1]} in\n";
    for (const VerbHelp& verb : command.verbs)
        text += "            " + verb.name + ") words=\"" + names_of(verb.options) + "\" ;;\n";
    text +=
        "        esac\n"
        "    elif [ \"${COMP_WORDS[1]}\" = help ] || [ \"${COMP_WORDS[COMP_CWORD-1]}\" = --verb ]; then\n"
        "        words=\"" +
        verbs_of(command) +
        "\"\n"
        "    fi\n"
        "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
        "}\n"
        "complete -o bashdefault -o default -F _abut abut\n";
    return text;
}

std::string zsh(const CommandHelp& command) {
    std::string text = "#compdef abut\n# zsh completion of abut\n_abut() {\n    local -a verbs\n    verbs=(\n";
    for (const VerbHelp& verb : command.verbs)
        text += "        " + in_quotes(verb.name + ":" + zsh_text(verb.summary)) + "\n";
    text +=
        "    )\n    if (( CURRENT == 2 )); then\n        _describe verb verbs\n        return\n    fi\n"
        "    local verb=$words[2]\n    shift words\n    (( CURRENT-- ))\n    case $verb in\n";
    for (const VerbHelp& verb : command.verbs) {
        text += "        " + verb.name + ")\n            _arguments -S";
        for (const OptionHelp& option : verb.options) {
            if (option.is_positional) continue;
            for (const std::string& name : {option.short_name, option.name}) {
                if (name.empty()) continue;
                std::string entry = "*" + name + "[" + zsh_text(option.text) + "]";
                if (!option.value.empty()) entry += ":" + zsh_text(option.value) + ":_files";
                text += " \\\n                " + in_quotes(entry);
            }
        }
        text += " \\\n                " +
                in_quotes(verb.name == "help" ? "*:verb:(" + verbs_of(command) + ")" : "*:file:_files") +
                "\n            ;;\n";
    }
    return text + "    esac\n}\n_abut \"$@\"\n";
}

std::string fish(const CommandHelp& command) {
    std::string text = "# fish completion of abut\n";
    for (const VerbHelp& verb : command.verbs)
        text += "complete -c abut -n __fish_use_subcommand -f -a " + verb.name + " -d " +
                in_quotes(brief(verb.summary)) + "\n";
    const auto options = [&](const std::string& condition, const std::vector<OptionHelp>& list) {
        for (const OptionHelp& option : list) {
            if (option.is_positional) continue;
            text += "complete -c abut -n " + condition;
            if (!option.short_name.empty()) text += " -s " + option.short_name.substr(1);
            if (option.name.starts_with("--")) text += " -l " + option.name.substr(2);
            if (!option.value.empty()) text += " -r";
            text += " -d " + in_quotes(brief(option.text)) + "\n";
        }
    };
    options("__fish_use_subcommand", command.options);
    for (const VerbHelp& verb : command.verbs)
        options(in_quotes("__fish_seen_subcommand_from " + verb.name), verb.options);
    return text + "complete -c abut -n '__fish_seen_subcommand_from help' -f -a " + in_quotes(verbs_of(command)) + "\n";
}

}  // namespace

std::string completions(const CommandHelp& command, std::string_view shell) {
    if (shell == "bash") return bash(command);
    if (shell == "zsh") return zsh(command);
    if (shell == "fish") return fish(command);
    return {};
}

}  // namespace abut::tool
