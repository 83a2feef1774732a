#pragma once

// Tokenizer for attribute text: numbers and words separated by blanks and commas.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace abut::detail {

/// Whether the character is an ASCII letter.
inline bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// The text with its ASCII letters in lower case.
std::string lower_case(std::string text);

/// Reads numbers, flags and words from left to right and skips blanks and commas between them.
class Scanner {
public:
    explicit Scanner(std::string_view text) : text_(text) {}

    bool at_end();
    /// The next character after blanks and commas, which is not consumed; 0 at the end.
    char peek();
    /// Consumes the next character.
    void skip() { ++position_; }
    /// Reads a finite number; nothing if the text continues with anything else. A separator after it is optional.
    std::optional<double> number();
    /// Reads a single digit 0 or 1. The next number may follow without a separator, as SVG's arc flags allow.
    std::optional<bool> flag();
    /// Reads a word of ASCII letters; empty if there is none.
    std::string_view word();
    /// Count of characters consumed so far.
    std::size_t position() const { return position_; }

private:
    void skip_blanks();

    std::string_view text_;
    std::size_t position_ = 0;
};

/// The text without leading and trailing blanks.
std::string_view trimmed(std::string_view text);

}  // namespace abut::detail
