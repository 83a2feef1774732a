# 64-bit Windows by clang-cl, as far as objects: there is no Windows SDK among Debian's packages. The C library is that of
# MinGW-w64, the C++ library clang's, which headers/ joins.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR AMD64)
set(CMAKE_CXX_COMPILER clang-cl-22)
set(CMAKE_CXX_COMPILER_TARGET x86_64-pc-windows-msvc)
set(CMAKE_AR llvm-lib-22)
set(CMAKE_MT llvm-mt-22)
set(CMAKE_RC_COMPILER llvm-rc-22)
set(CMAKE_LINKER lld-link-22)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(flags -nobuiltininc -D_LIBCPP_NO_VCRUNTIME -D_CRT_CONST_CORRECT_OVERLOADS)
foreach(folder IN ITEMS ${CMAKE_CURRENT_LIST_DIR}/headers /usr/lib/llvm-22/include/wasm32-wasi/c++/v1
        /usr/lib/llvm-22/lib/clang/22/include /usr/share/mingw-w64/include)
    list(APPEND flags -imsvc${folder})
endforeach()
list(JOIN flags " " CMAKE_CXX_FLAGS_INIT)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE NEVER)
