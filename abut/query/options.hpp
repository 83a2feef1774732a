#pragma once

// What every question takes as its optional last argument.

namespace abut {

struct QueryOptions {
    /// Contacts: points whose surfaces are up to this far apart count too, with a depth below zero.
    float margin = 0;
};

}  // namespace abut
