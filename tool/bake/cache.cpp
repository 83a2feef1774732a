#include "tool/bake/cache.hpp"

#include <abut/io/file/read_file.hpp>
#include <abut/io/write_file.hpp>

#include <filesystem>
#include <system_error>
#include <utility>

namespace abut::tool {
namespace {

namespace fs = std::filesystem;

class FolderCache final : public Cache {
public:
    explicit FolderCache(fs::path folder) : folder_(std::move(folder)) {}

    Result<std::optional<Bytes>> get(const std::string& name) override {
        Result<Bytes> bytes = detail::read_file(folder_ / name);
        if (bytes) return std::optional(*std::move(bytes));
        if (bytes.problem().code == ProblemCode::not_found) return std::optional<Bytes>();
        return with_place(name, bytes.problem());
    }

    std::optional<Problem> put(const std::string& name, std::span<const std::byte> bytes) override {
        const fs::path file = folder_ / name;
        std::error_code error;
        fs::create_directories(file.parent_path(), error);
        if (error) return with_place(name, {ProblemCode::unreadable, "can't be made: " + error.message()});
        if (const std::optional<Problem> problem = write_file(file, bytes)) return with_place(name, *problem);
        return std::nullopt;
    }

private:
    Problem with_place(const std::string& name, const Problem& problem) const {
        return {problem.code, (folder_ / name).string() + ": " + problem.message};
    }

    fs::path folder_;
};

}  // namespace

Result<std::unique_ptr<Cache>> open_cache(const std::string& place) {
    if (place.starts_with("http://") || place.starts_with("https://")) return open_http_cache(place);
    std::error_code error;
    fs::create_directories(place, error);
    if (error) return Problem{ProblemCode::unreadable, place + ": can't be made: " + error.message()};
    return std::unique_ptr<Cache>(std::make_unique<FolderCache>(place));
}

}  // namespace abut::tool
