#pragma once

#include <cstdlib>

namespace abut::oracle {

/// Whether the environment sets ABUT_LONG: the tests then run more cases, for minutes.
inline bool is_long() {
    return std::getenv("ABUT_LONG") != nullptr;
}

}  // namespace abut::oracle
