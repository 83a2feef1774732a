#pragma once

// Text that is numbers and letters, as attributes of XML hold it.

#include <cstddef>
#include <optional>
#include <string_view>

namespace abut {

/// Goes through text that is numbers and letters, with blanks and commas between them.
class Scanner {
public:
    explicit Scanner(std::string_view text) : text_(text) {}

    bool at_end();
    /// The next character but blanks and commas, which is not taken; 0 at the end.
    char peek();
    /// Takes the next character, whatever it is.
    void skip() { ++at_; }
    /// A finite number, which may follow without a blank; nothing where there is none.
    std::optional<double> number();
    /// 0 or 1, alone: numbers may follow without a blank.
    std::optional<bool> flag();
    /// Letters; empty where there are none.
    std::string_view word();
    /// How many characters were taken.
    std::size_t place() const { return at_; }

private:
    void skip_blanks();

    std::string_view text_;
    std::size_t at_ = 0;
};

/// Without blanks at its ends.
std::string_view trimmed(std::string_view text);

}  // namespace abut
