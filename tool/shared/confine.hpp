#pragma once

// Takes rights from a process that only has to read files and to write to a pipe.

namespace abut::tool {

/// From now on this process can't write, create, rename or remove a file, start a process or a program, open a socket
/// or trace another process: the system refuses such calls. Of its open descriptors it keeps the standard streams and
/// `pipe`. Returns false where the system can't filter calls (other than Linux on x86-64 and AArch64, or a container
/// that forbids it); then a file that is written has the size 0, and the rest is possible.
bool confine(int pipe);

}  // namespace abut::tool
