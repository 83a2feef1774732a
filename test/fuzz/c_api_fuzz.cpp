// Programs of calls of the C API, all functions of it, with any numbers, with handles that were released and of no
// object: a call works, or it is an error with a message.

#include "bytes.hpp"
#include <abut/c/abut.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <tuple>
#include <type_traits>
#include <vector>

namespace {

using namespace abut;

constexpr std::size_t max_handles = 8, max_calls = 100;

struct Caller;
void release_all(Caller& caller);

/// Makes the arguments of calls from bytes, and owns the handles.
struct Caller {
    explicit Caller(fuzz::Bytes& all) : bytes(all) {}
    ~Caller() { release_all(*this); }
    Caller(const Caller&) = delete;
    Caller& operator=(const Caller&) = delete;

    /// Most are halves from -2 to 10, so that shapes touch exactly.
    float number() {
        using Limits = std::numeric_limits<float>;
        constexpr std::array special{-0.0f,
                                     1e-30f,
                                     1e15f,
                                     1e30f,
                                     -1e30f,
                                     Limits::max(),
                                     Limits::infinity(),
                                     -Limits::infinity(),
                                     Limits::quiet_NaN()};
        const std::uint8_t byte = bytes.byte();
        return byte < 240 ? static_cast<float>(byte % 25) * 0.5f - 2 : special[byte % special.size()];
    }
    /// Most are small.
    std::uint32_t integer() {
        const std::uint8_t byte = bytes.byte();
        return byte < 250 ? byte % 16u : 0xffffffffu - byte % 2u;
    }
    std::uint32_t count() { return bytes.byte() % 9u; }

    template <class T>
    std::vector<T*>& pool() {
        return std::get<std::vector<T*>>(pools);
    }
    template <class T>
    void keep(T* handle) {
        if (handle == nullptr) return;
        if (pool<T>().size() == max_handles) {
            release(*this, pool<T>().front());
            pool<T>().erase(pool<T>().begin());
        }
        pool<T>().push_back(handle);
    }
    /// The last ones often, null at times.
    template <class T>
    T* any() {
        const std::uint8_t byte = bytes.byte();
        const std::vector<T*>& all = pool<T>();
        return all.empty() || byte >= 250 ? nullptr : all[all.size() - 1 - byte % all.size()];
    }
    template <class T>
    T* taken() {
        T* result = any<T>();
        std::erase(pool<T>(), result);
        return result;
    }
    template <class T>
    std::unique_ptr<const T* []> handles(std::size_t size) {
        auto result = std::make_unique<const T*[]>(size);
        for (std::size_t i = 0; i < size; ++i) result[i] = any<T>();
        return result;
    }

    /// Null for no elements.
    template <class T>
    std::unique_ptr<T[]> empty(std::size_t size) {
        return size == 0 ? nullptr : std::make_unique<T[]>(size);
    }
    template <class T>
    std::unique_ptr<T[]> filled(std::size_t size) {
        auto result = empty<T>(size);
        for (std::size_t i = 0; i < size; ++i) fill(*this, result[i]);
        return result;
    }
    /// A saved file, whole, cut short or with one byte changed, or any bytes.
    std::vector<std::uint8_t> file() {
        std::vector<std::uint8_t> result;
        if (const abut_buffer* saved = any<abut_buffer>())
            result.assign(abut_buffer_data(saved), abut_buffer_data(saved) + abut_buffer_size(saved));
        else
            while (result.size() < 8) result.push_back(bytes.byte());
        const std::uint8_t change = bytes.byte();
        if (change % 4 == 0 && !result.empty())
            result[change * 37u % result.size()] ^= static_cast<std::uint8_t>(1u << change % 8);
        if (change % 4 == 1) result.resize(result.size() * change / 256);
        return result;
    }

    void check(abut_code code) {
        fuzz::require(code == ABUT_OK || abut_last_error()[0] != '\0', "an error without a message");
    }

    fuzz::Bytes& bytes;
    std::tuple<std::vector<abut_buffer*>, std::vector<abut_thread_pool*>, std::vector<abut_shape2*>,
               std::vector<abut_shape3*>, std::vector<abut_world2*>, std::vector<abut_world3*>,
               std::vector<abut_field2*>, std::vector<abut_field3*>, std::vector<abut_walk_mesh*>,
               std::vector<abut_shapes2*>, std::vector<abut_shapes3*>>
        pools;
};

void fill(Caller& caller, float& value) {
    value = caller.number();
}
void fill(Caller& caller, double& value) {
    value = static_cast<double>(caller.number());
}
void fill(Caller& caller, std::uint32_t& value) {
    value = caller.integer();
}
void fill(Caller& caller, std::int32_t& value) {
    value = static_cast<std::int32_t>(caller.integer());
}
void fill(Caller& caller, std::uint64_t& value) {
    value = std::uint64_t{caller.integer()} << caller.bytes.byte() % 33;
}
void fill(Caller& caller, std::uint8_t& value) {
    value = caller.bytes.byte() % 20;
}
void fill(Caller& caller, bool& value) {
    value = caller.bytes.byte() % 2 == 1;
}
bool accepts(void*, abut_id id) {
    return id.index % 4 != 0;
}
bool accepts_pair(void*, abut_id a, abut_id b) {
    return (a.index + b.index) % 4 != 0;
}
void fill(Caller& caller, abut_accepts& value) {
    value = caller.bytes.byte() % 2 == 1 ? &accepts : nullptr;
}

#include "c_api_calls.hpp"

void release_all(Caller& caller) {
    std::apply(
        [&](auto&... pools) { (std::ranges::for_each(pools, [&](auto* handle) { release(caller, handle); }), ...); },
        caller.pools);
}

}  // namespace

/// Two bytes select a function, and those that follow are its arguments.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::Bytes bytes(data, size);
    Caller caller(bytes);
    for (std::size_t calls = 0; !bytes.empty() && calls < max_calls; ++calls) {
        const std::uint32_t high = bytes.byte();
        call(caller, high << 8 | bytes.byte());
    }
    return 0;
}
