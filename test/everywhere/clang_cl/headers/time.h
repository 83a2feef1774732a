// What libc++ takes from the C library, and MinGW-w64's headers don't declare.
#pragma once
#include_next <time.h>
extern "C" int timespec_get(struct timespec*, int);
