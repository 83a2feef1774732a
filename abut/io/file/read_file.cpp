#include <abut/io/file/read_file.hpp>
#include <abut/io/file/size_limit.hpp>

#include <fstream>
#include <optional>
#include <system_error>
#include <utility>

namespace abut::detail {

Result<std::vector<std::byte>> read_file(const std::filesystem::path& file, std::uintmax_t max_bytes) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (status.type() == std::filesystem::file_type::not_found) return Problem{ProblemCode::not_found, "no such file"};
    if (error) return Problem{ProblemCode::unreadable, "can't be read: " + error.message()};
    if (std::filesystem::is_directory(status)) return Problem{ProblemCode::unreadable, "is a directory"};
    if (!std::filesystem::is_regular_file(status)) return Problem{ProblemCode::unreadable, "is not a regular file"};

    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (!error)
        if (std::optional<Problem> problem = check_size(size, max_bytes)) return *std::move(problem);
    std::ifstream stream(file, std::ios::binary);
    if (error || !stream) return Problem{ProblemCode::unreadable, "can't be opened for reading"};
    std::vector<std::byte> bytes(size);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (stream.gcount() != static_cast<std::streamsize>(size))
        return Problem{ProblemCode::unreadable, "ends early while being read"};
    return bytes;
}

}  // namespace abut::detail
