#include <abut/io/file/scanner.hpp>

#include <charconv>
#include <cmath>
#include <system_error>

namespace abut::detail {
namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
}  // namespace

std::string lower_case(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

void Scanner::skip_blanks() {
    while (position_ < text_.size() && (is_blank(text_[position_]) || text_[position_] == ',')) ++position_;
}

bool Scanner::at_end() {
    skip_blanks();
    return position_ >= text_.size();
}

char Scanner::peek() {
    return at_end() ? '\0' : text_[position_];
}

std::optional<double> Scanner::number() {
    if (at_end()) return std::nullopt;
    std::size_t first = position_;
    if (text_[first] == '+') ++first;
    const std::size_t digits = first + (first < text_.size() && first == position_ && text_[first] == '-' ? 1 : 0);
    // std::from_chars also reads "inf" and "nan": require a digit or a point first.
    if (digits >= text_.size() || !(is_digit(text_[digits]) || text_[digits] == '.')) return std::nullopt;
    double value = 0;
    const auto [stopped, error] = std::from_chars(text_.data() + first, text_.data() + text_.size(), value);
    if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
    position_ = static_cast<std::size_t>(stopped - text_.data());
    return value;
}

std::optional<bool> Scanner::flag() {
    const char c = peek();
    if (c != '0' && c != '1') return std::nullopt;
    skip();
    return c == '1';
}

std::string_view Scanner::word() {
    skip_blanks();
    const std::size_t first = position_;
    while (position_ < text_.size() && is_letter(text_[position_])) ++position_;
    return text_.substr(first, position_ - first);
}

}  // namespace abut::detail
