#include "tool/verbs.hpp"

#include "tool/shared/printable.hpp"
#include <abut/io/write_file.hpp>

#include <cstdio>

namespace abut::tool {

std::string one_line(const std::string& message) {
    return "abut: " + printable(message) + "\n";
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
