// MinGW-w64's headers take clang-cl for Microsoft's compiler, but put attributes where that allows none.
#pragma once
#include_next <_mingw.h>
#undef __attribute__
#undef __MINGW_ATTRIB_NORETURN
#undef __MINGW_ATTRIB_DEPRECATED
#undef __MINGW_NOTHROW
#define __MINGW_ATTRIB_NORETURN
#define __MINGW_ATTRIB_DEPRECATED
#define __MINGW_NOTHROW
