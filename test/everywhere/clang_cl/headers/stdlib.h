// What libc++ takes from the C library, and MinGW-w64's headers don't declare.
#pragma once
#include_next <stdlib.h>
extern "C" {
int at_quick_exit(void (*)());
void quick_exit(int);
void* aligned_alloc(size_t, size_t);
float _strtof_l(const char*, char**, _locale_t);
long double _strtold_l(const char*, char**, _locale_t);
}
