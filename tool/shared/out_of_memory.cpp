#include "tool/shared/out_of_memory.hpp"

#include "tool/verbs.hpp"

#include <cstddef>
#include <new>

#include <unistd.h>

namespace abut::tool {
namespace {

// Formatted in advance: no memory is left when it is printed.
std::string& last_line() {
    static std::string line;
    return line;
}

void write_and_exit() {
    const std::string& line = last_line();
    for (std::size_t at = 0; at < line.size();) {
        const ssize_t written = write(STDERR_FILENO, line.data() + at, line.size() - at);
        if (written <= 0) break;
        at += static_cast<std::size_t>(written);
    }
    _exit(unusable);
}

}  // namespace

void exit_when_out_of_memory(const std::string& line) {
    last_line() = one_line(line);
    std::set_new_handler(write_and_exit);
}

void throw_when_out_of_memory() {
    std::set_new_handler(nullptr);
}

}  // namespace abut::tool
