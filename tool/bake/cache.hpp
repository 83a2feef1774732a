#pragma once

// Where results are stored: a folder, or an HTTP server.

#include <abut/math/result.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace abut::tool {

using Bytes = std::vector<std::byte>;

/// Stores bytes by name. The messages of all Problems begin with the place.
class Cache {
public:
    Cache() = default;
    virtual ~Cache() = default;
    Cache(const Cache&) = delete;
    Cache& operator=(const Cache&) = delete;

    /// Nothing if there is no such name.
    virtual Result<std::optional<Bytes>> get(const std::string& name) = 0;
    /// Readers see all bytes or none.
    virtual std::optional<Problem> put(const std::string& name, std::span<const std::byte> bytes) = 0;
};

/// A folder, which is made if it isn't there, or a URL that begins with http:// or https://.
Result<std::unique_ptr<Cache>> open_cache(const std::string& place);

/// Takes GET, where 404 and 410 say that there is none, and PUT. Follows redirections. Uses libcurl, which is loaded
/// here.
Result<std::unique_ptr<Cache>> open_http_cache(const std::string& url);

}  // namespace abut::tool
