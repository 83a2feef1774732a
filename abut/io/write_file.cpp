#include <abut/io/write_file.hpp>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

namespace abut {
namespace {

namespace fs = std::filesystem;

Problem cannot(const std::string& why) {
    return {ProblemCode::unreadable, "can't be written: " + why};
}
Problem cannot(int error) {
    return cannot(std::generic_category().message(error));
}

std::optional<Problem> write_all(std::FILE* file, std::span<const std::byte> bytes) {
    errno = 0;
    const bool is_written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    const int error = errno;
    errno = 0;
    if (std::fclose(file) != 0) return cannot(errno);
    if (!is_written) return cannot(error);
    return std::nullopt;
}

/// A new file beside the one that is meant.
struct Opened {
    std::FILE* file = nullptr;
    fs::path path;
};

Opened open_beside(const fs::path& file) {
    constexpr int most_tries = 100;
    for (int i = 0; i < most_tries; ++i) {
        Opened result{nullptr, file};
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
    if (fs::is_directory(status)) return cannot("it is a directory");
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        std::FILE* opened = std::fopen(file.c_str(), "wb");
        return opened != nullptr ? write_all(opened, bytes) : cannot(errno);
    }
    // A link keeps pointing to what it does.
    const fs::path target = fs::exists(status) ? fs::canonical(file, error) : file;
    const Opened beside = open_beside(target);
    if (beside.file == nullptr) return cannot(errno);
    std::optional<Problem> problem = write_all(beside.file, bytes);
    if (!problem) {
        fs::rename(beside.path, target, error);
        if (error) problem = cannot(error.message());
    }
    if (problem) fs::remove(beside.path, error);
    return problem;
}

std::optional<Problem> write_file(const fs::path& file, std::string_view text) {
    return write_file(file, std::as_bytes(std::span(text)));
}

}  // namespace abut
