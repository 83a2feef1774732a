#pragma once

// Writes numbers, vectors, lists and objects as JSON. Floats are written by the shortest text that reads as the same
// bits.

#include <abut/c/detail/handles.hpp>

#include <charconv>
#include <string>
#include <string_view>

namespace abut::play {

class Json {
public:
    Json& begin(char bracket) {
        separate();
        text_ += bracket;
        is_first_ = true;
        return *this;
    }
    Json& end(char bracket) {
        text_ += bracket;
        is_first_ = false;
        return *this;
    }
    Json& key(std::string_view name) {
        string(name);
        text_ += ':';
        is_first_ = true;
        return *this;
    }
    Json& string(std::string_view text) {
        separate();
        text_ += '"';
        text_ += text;
        text_ += '"';
        return *this;
    }
    /// What is not finite becomes null.
    Json& number(float value) {
        separate();
        if (!std::isfinite(value)) {
            text_ += "null";
            return *this;
        }
        char digits[64];
        text_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
        return *this;
    }
    Json& count(std::size_t value) {
        separate();
        text_ += std::to_string(value);
        return *this;
    }
    template <int D>
    Json& vec(const Vec<D>& v) {
        begin('[');
        for (int i = 0; i < D; ++i) number(v[i]);
        return end(']');
    }
    template <int D>
    Json& vecs(std::span<const Vec<D>> points) {
        begin('[');
        for (const Vec<D>& point : points) vec<D>(point);
        return end(']');
    }

    void write(abut_buffer& out) const {
        const auto bytes = std::as_bytes(std::span(text_));
        out.bytes.assign(bytes.begin(), bytes.end());
    }

private:
    void separate() {
        if (!is_first_) text_ += ',';
        is_first_ = false;
    }

    std::string text_;
    bool is_first_ = true;
};

}  // namespace abut::play
