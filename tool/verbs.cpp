#include "verbs.hpp"

#include <cstdio>

namespace abut::tool {

Result<ExitCode> print(const std::string& text, ExitCode code) {
    const bool done = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (!done) return Problem{ProblemCode::unreadable, "the report can't be written"};
    return code;
}

}  // namespace abut::tool
