#include <abut/io/write_file.hpp>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#if __has_include(<unistd.h>)
#include <unistd.h>
#endif

namespace abut {
namespace {

namespace fs = std::filesystem;

Problem write_problem(const std::string& why) {
    return {ProblemCode::unreadable, "can't be written: " + why};
}
Problem write_problem(int error) {
    return write_problem(std::generic_category().message(error));
}

/// Brings the file's bytes to its medium. Pipes and the like have none.
bool synchronize(std::FILE* file) {
    if (std::fflush(file) != 0) return false;
#if __has_include(<unistd.h>)
    return fsync(fileno(file)) == 0 || errno == EINVAL || errno == EROFS || errno == ENOTSUP;
#else
    return true;
#endif
}

std::optional<Problem> write_all(std::FILE* file, std::span<const std::byte> bytes) {
    errno = 0;
    const bool is_written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() && synchronize(file);
    const int error = errno;
    errno = 0;
    if (std::fclose(file) != 0) return write_problem(errno);
    if (!is_written) return write_problem(error);
    return std::nullopt;
}

/// A new file in the folder of the target.
struct TemporaryFile {
    std::FILE* file = nullptr;
    fs::path path;
};

TemporaryFile open_temporary(const fs::path& file) {
    constexpr int max_attempts = 100;
    for (int i = 0; i < max_attempts; ++i) {
        TemporaryFile result{nullptr, file};
        result.path += ".part" + std::to_string(i);
        errno = 0;
        result.file = std::fopen(result.path.c_str(), "wbx");
        if (result.file != nullptr || errno != EEXIST) return result;
    }
    return {};
}

}  // namespace

std::optional<Problem> write_file(const fs::path& file, std::span<const std::byte> bytes) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (fs::is_directory(status)) return write_problem("it is a directory");
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        std::FILE* opened = std::fopen(file.c_str(), "wb");
        return opened != nullptr ? write_all(opened, bytes) : write_problem(errno);
    }
    // A symbolic link stays: its target is replaced.
    const fs::path target = fs::exists(status) ? fs::canonical(file, error) : file;
    const TemporaryFile temporary = open_temporary(target);
    if (temporary.file == nullptr) return write_problem(errno);
    std::optional<Problem> problem = write_all(temporary.file, bytes);
    if (!problem && fs::exists(status)) {
        fs::permissions(temporary.path, status.permissions(), error);
        if (error) problem = write_problem(error.message());
    }
    if (!problem) {
        fs::rename(temporary.path, target, error);
        if (error) problem = write_problem(error.message());
    }
    if (problem) fs::remove(temporary.path, error);
    return problem;
}

std::optional<Problem> write_file(const fs::path& file, std::string_view text) {
    return write_file(file, std::as_bytes(std::span(text)));
}

}  // namespace abut
