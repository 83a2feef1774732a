// A library without a main function: JavaScript calls the functions of the C API.
#include <abut/c/abut.h>
