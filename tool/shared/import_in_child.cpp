#include "tool/shared/import_in_child.hpp"

#include "tool/shared/confine.hpp"
#include "tool/shared/out_of_memory.hpp"
#include <abut/io/mesh/scene_bytes.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace abut::tool {
namespace {

using Clock = std::chrono::steady_clock;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#elif defined(__has_feature)
constexpr bool sanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool sanitized = false;
#endif

Problem too_slow(const ImportLimits& limits) {
    return {ProblemCode::too_large, "the importer took longer than " + std::to_string(limits.seconds) + " s"};
}

Problem too_big(const ImportLimits& limits) {
    return {ProblemCode::too_large,
            "the importer needs more than " + std::to_string(limits.bytes >> 20) + " MB of memory"};
}

// Functions of the child process.

// The soft limit of CPU time raises SIGXCPU, which identifies the cause; the hard limit only raises SIGKILL.
void limit(__rlimit_resource resource, std::uint64_t amount) {
    const rlimit soft_and_hard{amount, amount + 1};
    setrlimit(resource, &soft_and_hard);
}

void redirect_streams_and_limit(const ImportLimits& limits) {
    const int null_device = open("/dev/null", O_RDWR);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(null_device, stream);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, limits.seconds);
    if (limits_memory()) limit(RLIMIT_AS, limits.bytes);
}

void send(int pipe, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = write(pipe, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return;
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

[[noreturn]] void import(int pipe, const std::filesystem::path& file, const ReadOptions& options,
                         const ImportLimits& limits) {
    redirect_streams_and_limit(limits);
    confine(pipe);
    throw_when_out_of_memory();
    try {
        send(pipe, detail::to_bytes(read_scene(file, options)));
    } catch (const std::bad_alloc&) {
        send(pipe, detail::to_bytes(too_big(limits)));
    } catch (const std::exception& exception) {
        send(pipe, detail::to_bytes(
                       Problem{ProblemCode::bad_format, std::string("the importer failed: ") + exception.what()}));
    }
    _exit(0);
}

// Functions of the parent process.

// All bytes until the child closes the pipe, or nothing if the deadline passes first.
std::optional<std::vector<std::byte>> receive(int pipe, const ImportLimits& limits) {
    const Clock::time_point deadline = Clock::now() + std::chrono::seconds(limits.seconds);
    std::vector<std::byte> bytes;
    std::array<std::byte, 1 << 16> part;
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
        pollfd readable{pipe, POLLIN, 0};
        const int ready = left <= 0 ? 0 : poll(&readable, 1, static_cast<int>(left));
        if (ready < 0 && errno == EINTR) continue;
        if (ready <= 0) return std::nullopt;
        const ssize_t received = read(pipe, part.data(), part.size());
        if (received < 0 && errno == EINTR) continue;
        if (received <= 0) return bytes;
        bytes.insert(bytes.end(), part.begin(), part.begin() + received);
    }
}

int wait_for(pid_t child) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

Problem crashed(int signal, const ImportLimits& limits) {
    if (signal == SIGXCPU) return too_slow(limits);
    if (signal == SIGKILL) return {ProblemCode::too_large, "the importer was killed, probably for want of memory"};
    std::string name = strsignal(signal);
    if (!name.empty() && name[0] >= 'A' && name[0] <= 'Z') name[0] = static_cast<char>(name[0] - 'A' + 'a');
    return {ProblemCode::bad_format, "the importer crashed (" + name + ")"};
}

}  // namespace

bool limits_memory() {
    return !sanitized;
}

ImportLimits limits_for(const std::filesystem::path& file) {
    // The bulk of glTF data lies in other files, and this library reads it itself.
    const std::string extension = file.extension().string();
    const bool is_gltf = extension == ".gltf" || extension == ".glb";
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    const std::uintmax_t megabytes = error ? 0 : std::min<std::uintmax_t>(size >> 20, 10'000);
    ImportLimits limits;
    limits.seconds = (is_gltf ? 60 : 10) + 2 * static_cast<std::uint32_t>(megabytes);
    return limits;
}

Result<Scene> import_in_child(const std::filesystem::path& file, const ReadOptions& options,
                              const ImportLimits& limits) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        return Problem{ProblemCode::unreadable, std::string("no pipe for the importer: ") + std::strerror(errno)};
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        import(ends[1], file, options, limits);
    }
    close(ends[1]);
    if (child < 0) {
        close(ends[0]);
        return Problem{ProblemCode::unreadable, std::string("no process for the importer: ") + std::strerror(errno)};
    }
    const std::optional<std::vector<std::byte>> bytes = receive(ends[0], limits);
    close(ends[0]);
    if (!bytes) kill(child, SIGKILL);
    const int status = wait_for(child);
    if (!bytes) return too_slow(limits);
    if (WIFSIGNALED(status)) return crashed(WTERMSIG(status), limits);
    return detail::scene_from_bytes(*bytes);
}

}  // namespace abut::tool
