#include "tool/verbs.hpp"

#include <abut/io/write_file.hpp>

#include <algorithm>
#include <cstdio>

namespace abut::tool {

std::string one_line(std::string message) {
    std::replace_if(
        message.begin(), message.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return "abut: " + message + "\n";
}

std::optional<Problem> write_picture(const std::string& file, const std::string& document) {
    std::optional<Problem> problem = write_file(file, document);
    if (problem) problem->message = file + ": " + problem->message;
    return problem;
}

Result<ExitCode> print(const std::string& text, ExitCode code) {
    const bool done = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (!done) return Problem{ProblemCode::unreadable, "the report can't be written"};
    return code;
}

}  // namespace abut::tool
