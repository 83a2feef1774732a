# WebAssembly with SIMD, for WASI: clang with the libc++ of its version for wasm32, and wasi-libc. There are no exceptions and no
# threads.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER clang++-22)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_AR llvm-ar-22)
set(CMAKE_RANLIB llvm-ranlib-22)
# The compiler prefers another name of the target, by which Debian's headers are not found.
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -fno-exceptions -Wno-deprecated")
# The stack lies below all data, so that an overflow traps. Where wasm-opt is installed, the compiler would run it after each link.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-Wl,--stack-first -Wl,-z,stack-size=1048576 --no-wasm-opt")
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE NEVER)
