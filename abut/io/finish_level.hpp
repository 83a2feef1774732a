#pragma once

// What every reader's level goes through, and how readers say what they left out.

#include <abut/io/level.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace abut {

/// One line for each kind of thing that is left out, with how many there were and the first of them.
class LeftOut {
public:
    /// `one` and `many` begin the line: "text object is", "text objects are".
    void add(const char* one, const char* many, const char* what, const std::string& such_as);
    std::vector<std::string> lines() const;

private:
    struct Kind {
        const char *one, *many, *what;
        std::size_t count = 0;
        std::string first;
    };
    std::vector<Kind> kinds_;
};

/// Makes paths unique ("Crate", "Crate#2"), each object's and point's own. A Problem where there is nothing in it.
Result<Level> finish_level(Level level);

}  // namespace abut
