#include "tool/shared/version.hpp"

namespace abut::tool {

const char* version() {
    return ABUT_VERSION;
}

}  // namespace abut::tool
