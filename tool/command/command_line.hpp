#pragma once

// The command line: verbs, help, suggestions for misspelt words, and errors of usage.

#include "tool/help/command_help.hpp"
#include "tool/verbs.hpp"
#include <abut/math/result.hpp>

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace abut::tool {

/// What main.cpp says of a verb.
struct VerbActions {
    std::function<Result<ExitCode>()> run;  ///< after its options are parsed
    std::function<std::string()> input;     ///< the file that messages name
    const char* less_memory = "";           ///< advice for too large inputs, such as ": a larger --cell needs less"
};

class CommandLine {
public:
    CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    /// The options are to be added to the result.
    CLI::App& add_verb(const char* name, const char* summary, VerbActions actions);

    /// Parses the words after the program's name and runs the verb. Returns the exit code; a line on stderr says what
    /// is wrong.
    int run(std::vector<std::string> words);

    /// Parses the options of a verb as they may follow a file, and returns them in the verb's own order, one word
    /// each: "--parts=16", "--rooms". The message of a Problem says what is wrong.
    Result<std::vector<std::string>> canonical_options(const std::string& verb, const std::vector<std::string>& words);

private:
    struct Verb {
        CLI::App* app = nullptr;
        VerbActions actions;
    };

    CommandHelp help() const;
    int print_version() const;
    Result<ExitCode> run_help() const;
    std::string usage_error(const CLI::ParseError& error, const std::vector<std::string>& words) const;
    int run_verb(const Verb& verb);

    CLI::App app_;
    std::deque<Verb> verbs_;
    bool wants_version_ = false, wants_json_ = false, is_quiet_ = false, wants_man_page_ = false;
    std::string help_verb_, shell_;
};

}  // namespace abut::tool
