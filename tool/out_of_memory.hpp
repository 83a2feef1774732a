#pragma once

// Memory that there isn't.

#include <string>

namespace abut::tool {

/// From now on the program ends with this line on stderr and exit code 2 where it asks for more memory than there is,
/// in whichever thread and below whatever promises not to throw. Control characters are written as blanks.
void exit_when_out_of_memory(const std::string& line);

/// From now on std::bad_alloc is thrown there, as usual: for a child that reports it in another way.
void throw_when_out_of_memory();

}  // namespace abut::tool
