# How every target of ours is compiled.
include(GNUInstallDirs)

# Multiplying and adding in one rounding gives other bits on other machines. Users need the flag too, for what our headers
# put inline into their code. Only C++ of compilers that know it: an `enable_language(CUDA)` next door must not see it.
if(NOT MSVC)
    set(ABUT_SAME_BITS $<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>:-ffp-contract=off>)
else()
    # clang-cl takes the flag in this form. cl joins products and sums for AVX2 by default, in versions before Visual Studio 2022,
    # and has no flag against that alone.
    set(ABUT_SAME_BITS
        $<$<COMPILE_LANG_AND_ID:CXX,Clang>:/clang:-ffp-contract=off>
        $<$<COMPILE_LANG_AND_ID:CXX,MSVC>:/fp:strict>)
endif()

# i386 has its numbers in SSE registers: those of x87 are wider, and are rounded when the compiler happens to store them.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(i[3-6]86|x86|x86_64|AMD64)$" AND CMAKE_SIZEOF_VOID_P EQUAL 4 AND NOT EMSCRIPTEN)
    list(APPEND ABUT_SAME_BITS $<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang>:-msse2;-mfpmath=sse>)
endif()

# The vector units that Highway doesn't compile for, by its own macros. Those of x86 between SSE2 and AVX2 gain little. g++ for
# Windows aligns no stack for AVX (its bug 54412). The NEON of 32-bit ARM takes denormals as zero. SVE and RISC-V's are not tested.
set(ABUT_DISABLED_VECTOR_UNITS HWY_SSSE3|HWY_SSE4)
if(WIN32 AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    string(APPEND ABUT_DISABLED_VECTOR_UNITS |HWY_AVX2|HWY_AVX3)
elseif(APPLE OR NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(i[3-6]86|x86|x86_64|AMD64)$")
    string(APPEND ABUT_DISABLED_VECTOR_UNITS |HWY_NEON*HWY_ARCH_ARM_V7|HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128|HWY_RVV)
endif()

# Our own sources are held to the warnings; who uses the library is not. g++ 12 warns of std::string's own copying (its bug
# 105651), and from -O2 on it takes two neighbours from double to float and back for no change at all
# (test/math/rounding_test.cpp): our headers don't do that, our sources do. Nobody reads errno after a root of ours, nor the
# flags of the floating-point unit: without the promise to set them, a root is one instruction and no call.
function(abut_strict target)
    # Without a vector unit Highway computes lane by lane with g++ 12.2, and emulates 128 bits with other compilers. We have the former
    # with all of them: clang compiles it in a quarter of the time where it adds a sanitizer.
    target_compile_definitions(${target} PRIVATE
        "HWY_DISABLED_TARGETS=(${ABUT_DISABLED_VECTOR_UNITS})" HWY_BROKEN_EMU128=1)
    if(MSVC)
        # Unknown attributes, such as [[gnu::always_inline]], are for other compilers.
        target_compile_options(${target} PRIVATE /W4 $<$<CXX_COMPILER_ID:MSVC>:/wd5030> $<$<BOOL:${ABUT_WERROR}>:/WX>)
        return()
    endif()
    # On Windows g++ 12 takes it that all objects have the same code of a header's function, and so which registers it leaves
    # alone. A game's object without optimisation has other code, and the linker may choose that.
    if(MINGW)
        target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-ipa-ra>)
    endif()
    target_compile_options(${target} PRIVATE
        $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>
        $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-fno-math-errno;-fno-trapping-math>
        $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall;-Wextra;-Wconversion;-Wshadow>
        $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
        $<$<AND:$<BOOL:${ABUT_WERROR}>,$<CXX_COMPILER_ID:GNU,Clang,AppleClang>>:-Werror>)
endfunction()

# The headers that most files of a target include are read once for all of them. Inside somebody else's build, what is
# compiled beforehand is his to choose: he sets ABUT_PRECOMPILE. So do our tests, where ABUT_UNITY=OFF.
#   abut_precompile(abut_core PRIVATE <vector> <abut/math/pose.hpp>)
#   abut_precompile(abut_bake REUSE_FROM abut_core)
function(abut_precompile target)
    if(ABUT_PRECOMPILE OR (ABUT_UNITY AND ABUT_TOP_LEVEL))
        target_precompile_headers(${target} ${ARGN})
        # Where <string> is precompiled, g++ 12 warns of std::string's own copying (its bug 105651).
        target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread>)
    endif()
endfunction()

# Neighbours are compiled together, about eight in one translation unit, so that what they include is read once. Sources that
# Highway compiles for each vector unit stay alone. ABUT_UNITY=OFF compiles each file as it stands, without headers compiled beforehand.
function(abut_unity target)
    if(NOT ABUT_UNITY)
        return()
    endif()
    get_target_property(sources ${target} SOURCES)
    set(together)
    foreach(source IN LISTS sources)
        file(STRINGS ${source} per_target REGEX "foreach_target\\.h" LIMIT_COUNT 1)
        get_source_file_property(alone ${source} SKIP_UNITY_BUILD_INCLUSION)
        if(NOT per_target AND NOT alone)
            list(APPEND together ${source})
        endif()
    endforeach()
    list(LENGTH together count)
    math(EXPR units "(${count} + 7) / 8")
    set(index 0)
    foreach(source IN LISTS together)
        math(EXPR unit "${index} * ${units} / ${count}")
        set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${unit})
        math(EXPR index "${index} + 1")
    endforeach()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    # In a unit the types of a .cpp count as those of a header, which must not hold what is local to one file.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

# With BUILD_SHARED_LIBS the libraries are shared ones, where the platform has such.
get_property(ABUT_HAS_SHARED_LIBRARIES GLOBAL PROPERTY TARGET_SUPPORTS_SHARED_LIBS)
if(BUILD_SHARED_LIBS AND ABUT_HAS_SHARED_LIBRARIES)
    set(ABUT_LIBRARY_TYPE SHARED)
else()
    set(ABUT_LIBRARY_TYPE STATIC)
endif()

# A shared library exports all its functions, since the public templates call those of detail as well (docs/decisions/0014). Its
# own calls are as direct as in a static one. Before 1.0 a minor version may break, so the name of the file holds it.
function(abut_shared target)
    # Without the symbol that CMake defines for each library, they share precompiled headers.
    set_target_properties(${target} PROPERTIES
        DEFINE_SYMBOL "" CXX_VISIBILITY_PRESET default WINDOWS_EXPORT_ALL_SYMBOLS ON
        VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
        INSTALL_RPATH $<$<PLATFORM_ID:Linux>:$ORIGIN>)
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU,Clang>:-fno-semantic-interposition>)
    target_link_options(${target} PRIVATE $<$<PLATFORM_ID:Linux>:LINKER:-Bsymbolic-functions>)
endfunction()

# A library of the .cpp files in the given folders of abut/, known as abut::NAME; of headers alone where there are none.
#   abut_library(abut_bake EXPORT_NAME bake FOLDERS bake LINK abut_core)  ->  abut::bake
# LINK is what users of the library need as well.
function(abut_library target)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "EXPORT_NAME" "FOLDERS;LINK")
    set(sources)
    foreach(folder IN LISTS arg_FOLDERS)
        file(GLOB_RECURSE found CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/abut/${folder}/*.cpp)
        list(APPEND sources ${found})
    endforeach()
    if(sources)
        set(scope PUBLIC)
        add_library(${target} ${ABUT_LIBRARY_TYPE} ${sources})
        # A shared library can hold it, such as that of the C API or a game's plug-in. With hidden symbols, calls within the
        # library are as direct as without.
        set_target_properties(${target} PROPERTIES
            POSITION_INDEPENDENT_CODE ${ABUT_HAS_SHARED_LIBRARIES} CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
        if(ABUT_LIBRARY_TYPE STREQUAL "SHARED")
            abut_shared(${target})
        endif()
        abut_strict(${target})
        abut_unity(${target})
    else()
        set(scope INTERFACE)
        add_library(${target} INTERFACE)
    endif()
    # NEON is part of each AArch64 processor. Without the header that Highway asks for others by, it takes the flags as they are;
    # else it compiles for "+crypto", and g++ then rejects classes with vectors and an implicit constructor. Its vectors for
    # WebAssembly have no doubles before version 1.1; clang makes vectors of the emulated ones.
    set(highway)
    if(EMSCRIPTEN OR CMAKE_SYSTEM_PROCESSOR MATCHES "^wasm")
        set(highway HWY_BROKEN_TARGETS=HWY_WASM|HWY_WASM_EMU256)
    elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm)")
        set(highway TOOLCHAIN_MISS_SYS_AUXV_H)
    endif()
    foreach(source IN LISTS sources)
        file(STRINGS ${source} per_target REGEX "foreach_target\\.h" LIMIT_COUNT 1)
        if(per_target AND highway)
            set_source_files_properties(${source} PROPERTIES COMPILE_DEFINITIONS "${highway}")
        endif()
    endforeach()
    add_library(abut::${arg_EXPORT_NAME} ALIAS ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${arg_EXPORT_NAME})
    target_link_libraries(${target} ${scope} ${arg_LINK})
    target_compile_features(${target} ${scope} cxx_std_20)
    target_compile_options(${target} ${scope} ${ABUT_SAME_BITS})
    if(ABUT_ASSERTS)
        # The library's headers are compiled by its users: they must agree.
        target_compile_definitions(${target} ${scope} ABUT_ENABLE_ASSERTS)
    endif()
    target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endfunction()
