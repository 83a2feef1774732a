#pragma once

// What the command line offers: one source for --help, the man page and the completions of shells.

#include <string>
#include <string_view>
#include <vector>

namespace abut::tool {

struct OptionHelp {
    std::string short_name;  ///< "-o", or empty
    std::string name;        ///< "--output"; of an argument without a name, such as "SCENE"
    std::string value;       ///< what follows, such as "OUT"; empty for a flag
    std::string text;
    bool is_positional = false;
    bool is_required = false;
};

struct VerbHelp {
    std::string name;
    std::string summary;  ///< one sentence
    std::vector<OptionHelp> options;
    std::string details;  ///< further sentences
};

struct CommandHelp {
    std::string version;
    std::string summary;
    std::vector<VerbHelp> verbs;
    std::vector<OptionHelp> options;  ///< before a verb
};

struct Example {
    const char* command;
    const char* text;
};

struct ExitCodeHelp {
    const char* code;
    const char* text;
};

/// Examples of a verb; of an empty name those of the whole tool.
std::vector<Example> examples_of(std::string_view verb);

/// What the exit codes of a verb mean; of an empty name those of the whole tool.
std::vector<ExitCodeHelp> exit_codes_of(std::string_view verb);

/// Text for a terminal of this width.
std::string help_of(const CommandHelp& command, std::size_t width);
std::string help_of(const VerbHelp& verb, std::size_t width);

/// A man page in the language of man(7).
std::string man_page(const CommandHelp& command);

/// A script that completes verbs, options and files: "bash", "zsh" or "fish". Empty for other shells.
std::string completions(const CommandHelp& command, std::string_view shell);

}  // namespace abut::tool
