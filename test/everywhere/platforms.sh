# The platforms of `./dev everywhere`, which sources this file. It uses need, step and fail of ./dev.

# name | Debian packages | compiler, for the table | how a program is run
everywhere_platforms() {
    cat <<'TABLE'
x86_64-gcc|g++ libhwy-dev|g++|
x86_64-gcc-O0|g++ libhwy-dev|g++ -O0|
x86_64-clang|clang libhwy-dev|clang++|
x86_64-clang-19|clang-19 libhwy-dev|clang++-19|
i386|g++-i686-linux-gnu|i686-linux-gnu-g++|
aarch64|g++-aarch64-linux-gnu qemu-user-static|aarch64-linux-gnu-g++|qemu-aarch64-static
armv7|g++-arm-linux-gnueabihf qemu-user-static|arm-linux-gnueabihf-g++|qemu-arm-static
ppc64le|g++-powerpc64le-linux-gnu qemu-user-static|powerpc64le-linux-gnu-g++|qemu-ppc64le-static
riscv64|g++-riscv64-linux-gnu qemu-user-static|riscv64-linux-gnu-g++|qemu-riscv64-static
s390x|g++-s390x-linux-gnu qemu-user-static|s390x-linux-gnu-g++|qemu-s390x-static
mingw64|g++-mingw-w64-x86-64-posix wine64 wine|x86_64-w64-mingw32-g++-posix|wine
wasm32|clang-22 lld-22 llvm-22 libc++-22-dev-wasm32 libc++abi-22-dev-wasm32 libclang-rt-22-dev-wasm32 wasi-libc nodejs|clang++-22|node
TABLE
}

# Builds test/everywhere for a platform, in build/everywhere/NAME. Those that are emulated take -O1, which compiles in half the time.
everywhere_build() {
    local name=$1 compiler=$2 folder=build/everywhere/$1 options=()
    case $name in
        x86_64-*-O0) options=(-D "CMAKE_CXX_COMPILER=${compiler% *}" -D "CMAKE_CXX_FLAGS_RELEASE=-O0") ;;
        x86_64-*) options=(-D "CMAKE_CXX_COMPILER=$compiler") ;;
        *)
            mkdir -p build/everywhere/headers
            ln -sfn /usr/include/glm /usr/include/hwy build/everywhere/headers/
            options=(-D "CMAKE_TOOLCHAIN_FILE=$PWD/cmake/platforms/$name.cmake" -D "ABUT_HEADERS=$PWD/build/everywhere/headers"
                -D "CMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG")
            ;;
    esac
    step "building $folder"
    cmake -S test/everywhere -B "$folder" -G Ninja --log-level=NOTICE -D CMAKE_BUILD_TYPE=Release \
        -D CMAKE_CXX_COMPILER_LAUNCHER=ccache "${options[@]}" >&2 || fail "cmake stopped ($name)"
    cmake --build "$folder" --parallel "$(nproc)" --target golden >&2 || fail "it doesn't build ($name)"
}

# Runs the program of a platform with arguments.
everywhere_run() {
    local name=$1 with=$2 golden=build/everywhere/$1/golden
    shift 2
    case $with in
        '') "$golden" "$@" ;;
        wine) WINEDEBUG=-all wine "$golden.exe" "$@" | tr -d '\r' ;;
        node) node --no-warnings test/everywhere/run_wasm.mjs "$golden" "$@" ;;
        *) "$with" "$golden" "$@" ;;
    esac
}

# Prints a row of the table: name, compiler, how it ran, seconds, hash, and whether it loads what the first platform saved.
everywhere_row() {
    local name=$1 compiler=$2 with=$3 target=$4 start=$EPOCHREALTIME hash loads=differ arguments=()
    [ -z "$target" ] || arguments=(--target "$target")
    hash=$(everywhere_run "$name" "$with" "${arguments[@]}") || hash=failed
    local seconds=$(((${EPOCHREALTIME/./} - ${start/./}) / 100000))
    ! everywhere_run "$name" "$with" "${arguments[@]}" --load build/everywhere/blobs >&2 || loads=same
    printf '%-16s %-30s %-22s %5d.%d  %-16s  %s\n' "$name" "$compiler" "${with:-native}${target:+ $target}" \
        $((seconds / 10)) $((seconds % 10)) "$hash" "$loads"
}
