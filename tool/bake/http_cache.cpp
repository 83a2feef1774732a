#include "tool/bake/cache.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include <curl/curl.h>
#include <dlfcn.h>

// The macros that check types need the functions by their names.
#undef curl_easy_setopt
#undef curl_easy_getinfo

namespace abut::tool {
namespace {

#ifdef __APPLE__
constexpr const char* library_file = "libcurl.4.dylib";
#else
constexpr const char* library_file = "libcurl.so.4";
#endif

constexpr long connect_seconds = 30, stall_seconds = 60;

// The functions of libcurl. To link it would make each start of the tool 20 ms longer.
struct Curl {
    decltype(&::curl_easy_init) init = nullptr;
    decltype(&::curl_easy_setopt) set = nullptr;
    decltype(&::curl_easy_perform) perform = nullptr;
    decltype(&::curl_easy_getinfo) get_info = nullptr;
    decltype(&::curl_easy_reset) reset = nullptr;
    decltype(&::curl_easy_cleanup) cleanup = nullptr;
    decltype(&::curl_easy_strerror) error = nullptr;
};

std::optional<Curl> load_curl() {
    void* library = dlopen(library_file, RTLD_NOW);
    if (library == nullptr) return std::nullopt;
    Curl curl;
    bool is_complete = true;
    const auto load = [&](auto& function, const char* name) {
        void* symbol = dlsym(library, name);
        is_complete = is_complete && symbol != nullptr;
        std::memcpy(&function, &symbol, sizeof symbol);
    };
    load(curl.init, "curl_easy_init");
    load(curl.set, "curl_easy_setopt");
    load(curl.perform, "curl_easy_perform");
    load(curl.get_info, "curl_easy_getinfo");
    load(curl.reset, "curl_easy_reset");
    load(curl.cleanup, "curl_easy_cleanup");
    load(curl.error, "curl_easy_strerror");
    return is_complete ? std::optional(curl) : std::nullopt;
}

std::size_t receive(const char* data, std::size_t size, std::size_t count, void* to) {
    const auto* bytes = reinterpret_cast<const std::byte*>(data);
    static_cast<Bytes*>(to)->insert(static_cast<Bytes*>(to)->end(), bytes, bytes + size * count);
    return size * count;
}

std::size_t send(char* data, std::size_t size, std::size_t count, void* from) {
    auto& left = *static_cast<std::span<const std::byte>*>(from);
    const std::size_t sent = std::min(size * count, left.size());
    if (sent > 0) std::memcpy(data, left.data(), sent);
    left = left.subspan(sent);
    return sent;
}

class HttpCache final : public Cache {
public:
    HttpCache(const Curl& curl, std::string url) : curl_(curl), handle_(curl.init()), url_(std::move(url)) {
        while (url_.ends_with('/')) url_.pop_back();
    }
    ~HttpCache() override { curl_.cleanup(handle_); }

    Result<std::optional<Bytes>> get(const std::string& name) override {
        Bytes bytes;
        begin(name);
        curl_.set(handle_, CURLOPT_WRITEFUNCTION, receive);
        curl_.set(handle_, CURLOPT_WRITEDATA, &bytes);
        const Result<long> status = perform(name);
        if (!status) return status.problem();
        if (*status == 404 || *status == 410) return std::optional<Bytes>();
        if (*status != 200) return refused(name, *status);
        return std::optional(std::move(bytes));
    }

    std::optional<Problem> put(const std::string& name, std::span<const std::byte> bytes) override {
        Bytes answer;
        const auto size = static_cast<curl_off_t>(bytes.size());
        begin(name);
        curl_.set(handle_, CURLOPT_UPLOAD, 1L);
        curl_.set(handle_, CURLOPT_INFILESIZE_LARGE, size);
        curl_.set(handle_, CURLOPT_READFUNCTION, send);
        curl_.set(handle_, CURLOPT_READDATA, &bytes);
        curl_.set(handle_, CURLOPT_WRITEFUNCTION, receive);
        curl_.set(handle_, CURLOPT_WRITEDATA, &answer);
        const Result<long> status = perform(name);
        if (!status) return status.problem();
        if (*status < 200 || *status >= 300) return refused(name, *status);
        return std::nullopt;
    }

private:
    void begin(const std::string& name) {
        curl_.reset(handle_);
        curl_.set(handle_, CURLOPT_URL, (url_ + "/" + name).c_str());
        curl_.set(handle_, CURLOPT_NOSIGNAL, 1L);
        curl_.set(handle_, CURLOPT_FOLLOWLOCATION, 1L);
        curl_.set(handle_, CURLOPT_CONNECTTIMEOUT, connect_seconds);
        curl_.set(handle_, CURLOPT_LOW_SPEED_LIMIT, 1L);
        curl_.set(handle_, CURLOPT_LOW_SPEED_TIME, stall_seconds);
    }

    // The status of the answer.
    Result<long> perform(const std::string& name) {
        const CURLcode code = curl_.perform(handle_);
        if (code != CURLE_OK) return Problem{ProblemCode::unreadable, place(name) + ": " + curl_.error(code)};
        long status = 0;
        curl_.get_info(handle_, CURLINFO_RESPONSE_CODE, &status);
        return status;
    }

    std::string place(const std::string& name) const { return url_ + "/" + name; }
    Problem refused(const std::string& name, long status) const {
        return {ProblemCode::unreadable, place(name) + ": the server answers " + std::to_string(status)};
    }

    Curl curl_;
    CURL* handle_;
    std::string url_;
};

}  // namespace

Result<std::unique_ptr<Cache>> open_http_cache(const std::string& url) {
    const std::optional<Curl> curl = load_curl();
    if (!curl)
        return Problem{ProblemCode::unreadable,
                       url + ": a cache behind a URL needs " + library_file + ", which isn't here"};
    return std::unique_ptr<Cache>(std::make_unique<HttpCache>(*curl, url));
}

}  // namespace abut::tool
