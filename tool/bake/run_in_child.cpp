#include "tool/bake/run_in_child.hpp"

#include <abut/io/file/read_file.hpp>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace abut::tool {
namespace {

namespace fs = std::filesystem;

bool redirect(int stream, const char* file, int flags) {
    const int opened = open(file, flags, 0600);
    return opened >= 0 && dup2(opened, stream) >= 0 && (opened == stream || close(opened) == 0);
}

// Functions of the child process.
[[noreturn]] void run_here(const RunTool& run, const std::vector<std::string>& arguments, const fs::path& folder,
                           const std::string& out, const std::string& err) {
    constexpr int write_flags = O_WRONLY | O_CREAT | O_TRUNC, no_start = 127;
    if (!redirect(STDIN_FILENO, "/dev/null", O_RDONLY) || !redirect(STDOUT_FILENO, out.c_str(), write_flags) ||
        !redirect(STDERR_FILENO, err.c_str(), write_flags) || chdir(folder.empty() ? "." : folder.c_str()) != 0)
        _exit(no_start);
    const int code = run(arguments);
    std::fflush(stdout);
    std::fflush(stderr);
    _exit(code);
}

std::string content(const std::string& file) {
    const Result<std::vector<std::byte>> bytes = detail::read_file(file);
    return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : std::string();
}

}  // namespace

ChildResult run_in_child(const RunTool& run, const std::vector<std::string>& arguments, const fs::path& folder,
                         const fs::path& scratch) {
    const std::string out = fs::absolute(scratch / "stdout").string(), err = fs::absolute(scratch / "stderr").string();
    std::fflush(stdout);
    std::fflush(stderr);
    const pid_t child = fork();
    if (child == 0) run_here(run, arguments, folder, out, err);
    if (child < 0) return {-1, {}, std::string("no process: ") + std::strerror(errno)};
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFSIGNALED(status)) return {-1, {}, std::string("died: ") + strsignal(WTERMSIG(status))};
    return {WEXITSTATUS(status), content(out), content(err)};
}

}  // namespace abut::tool
