# The platforms of `./dev everywhere`, which sources this file. It uses need, step and fail of ./dev.

# name | Debian packages | compiler, for the table | how a program is run, or "objects" where it isn't even linked
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
clang-cl|clang-22 lld-22 llvm-22 libc++-22-dev-wasm32 mingw-w64-common|clang-cl-22|objects
wasm32|clang-22 lld-22 llvm-22 libc++-22-dev-wasm32 libc++abi-22-dev-wasm32 libclang-rt-22-dev-wasm32 wasi-libc nodejs|clang++-22|node
TABLE
}

# Builds test/everywhere for a platform, in build/everywhere/NAME. The first platform is built as a game builds the library. The
# others precompile headers, and those that are emulated take -O1: both save compile time. With the word "tests" it builds the test
# programs as well.
everywhere_build() {
    local name=$1 compiler=$2 folder=build/everywhere/$1 options=() targets=(golden) launcher=ccache with_tests=OFF
    if [ "${3:-}" = tests ]; then
        with_tests=ON
        targets+=(test_programs)
    fi
    mkdir -p build/everywhere/headers
    ln -sfn /usr/include/{glm,hwy,boost} build/everywhere/headers/
    case $name in
        x86_64-*-O0) options=(-D "CMAKE_CXX_COMPILER=${compiler% *}" -D "CMAKE_CXX_FLAGS_RELEASE=-O0" -D ABUT_PRECOMPILE=ON) ;;
        x86_64-gcc) options=(-D "CMAKE_CXX_COMPILER=$compiler") ;;
        x86_64-*) options=(-D "CMAKE_CXX_COMPILER=$compiler" -D ABUT_PRECOMPILE=ON) ;;
        clang-cl)
            options=(-D "CMAKE_TOOLCHAIN_FILE=$PWD/test/everywhere/clang_cl/toolchain.cmake"
                -D "ABUT_HEADERS=$PWD/build/everywhere/headers")
            targets=(abut_core abut_bake abut_draw abut_c)
            launcher=  # ccache writes its options where clang-cl expects files
            ;;
        *)
            options=(-D "CMAKE_TOOLCHAIN_FILE=$PWD/cmake/platforms/$name.cmake" -D "ABUT_HEADERS=$PWD/build/everywhere/headers"
                -D "CMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG" -D ABUT_PRECOMPILE=ON)
            ;;
    esac
    step "building $folder"
    cmake -S test/everywhere -B "$folder" -G Ninja --log-level=NOTICE -D CMAKE_BUILD_TYPE=Release \
        -D ABUT_WERROR=OFF -D ABUT_TESTS=$with_tests -D "CMAKE_CXX_COMPILER_LAUNCHER=$launcher" "${options[@]}" >&2 || fail "cmake stopped ($name)"
    # Without the sloppiness ccache passes over files that include precompiled headers.
    CCACHE_DEPEND=1 CCACHE_SLOPPINESS=pch_defines,time_macros \
        cmake --build "$folder" --parallel "$(nproc)" --target "${targets[@]}" >&2 || fail "it doesn't build ($name)"
}

# The instructions that must not be in our objects: multiply-add in one rounding, and those of vector units that are switched off.
everywhere_forbidden() {
    case $1 in
        x86_64-* | i386 | mingw64 | clang-cl) echo 'vfn?m(add|sub)' ;;
        aarch64) echo 'fn?m(add|sub)|fml[as]|fcmla|[^<]*[ \t,{]z[0-9]+[.][bhsd]' ;;
        armv7) echo 'vfn?m[as]|v[a-z]+[.]f32[ \t]+[dq]' ;;
        ppc64le) echo 'fn?m(add|sub)|xsn?m(add|sub)|xvn?m(add|sub)|vmaddfp|vnmsubfp' ;;
        riscv64) echo 'fn?m(add|sub)|vset' ;;
        s390x) echo 'm[as][ed]br?[ \t]|[vw]fn?m[as][sdx]b' ;;
        wasm32) echo 'f(32x4|64x2)[.]relaxed' ;;
    esac
}

# Names each function of a platform's objects that has such an instruction, and fails then. LLVM's objdump knows all processors, and
# takes a second where that of binutils takes minutes.
everywhere_check_code() {
    local name=$1 folder=build/everywhere/$1 options=(-dC --no-show-raw-insn)
    # The newest vector instructions, which it leaves out otherwise.
    [ "$name" != s390x ] || options+=(--mcpu=arch13)
    find "$folder/abut" "$folder/CMakeFiles" \( -name '*.o' -o -name '*.obj' \) -exec llvm-objdump-22 "${options[@]}" {} + |
        awk -v forbidden="^ *[0-9a-f]+:[ \t]+($(everywhere_forbidden "$name"))" '
            /^[0-9a-f]+ <[^.].*>:$/ { name = $0; ++functions }
            # On ppc64le tables of jumps are among the instructions, and their entries read like some on register 31.
            $0 ~ forbidden && !/[ \t]31, 31, / && name != last { print name "\n" $0 > "/dev/stderr"; last = name; found = 1 }
            END { exit found || functions < 1000 }'
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

# The names of the tests of a program that took longer than a number of seconds in the last tests of build/release, for
# --gtest_filter. Those of a template have a type in their name there, and a number in the program.
everywhere_slow_tests() {
    awk -v program="$1" -v limit="$2" '
        $1 ~ /\// && $2 == "Test" && $NF == "sec" && $(NF - 1) > limit {
            name = $3 ~ /:$/ ? $4 : $5
            if (index(name, program ".") != 1) next
            name = substr(name, length(program) + 2)
            if (sub(/<.*/, "", name)) sub(/[.]/, "/*.", name)
            print name
        }' build/release/test.log | paste -sd:
}

# Runs the test programs of a platform, without the tests that would take too long there, and adds a row to the table of ./dev.
everywhere_tests() {
    local name=$1 with=$2 limit=$3 folder=build/everywhere/$1 start=$EPOCHSECONDS program log run skipped failed=0 here
    [ -s build/release/test.log ] || fail "build/release has no log of tests, which says how long each takes: run ./dev test"
    rm -rf "$folder/test-logs"
    mkdir -p "$folder/test-logs"
    step "testing $folder: what took less than $limit s on this machine"
    for program in "$folder"/abut/test/test_*; do
        [ -x "$program" ] && [[ $program == *.exe || $program != *.* ]] || continue
        log=$(basename "$program" .exe)
        printf '%s\0' "$program" "$folder/test-logs/$log" "-$(everywhere_slow_tests "${log#test_}" "$limit")"
    done | WINEDEBUG=-all xargs -0 -n 3 -P "$(nproc)" bash -c "$with"' "$1" --gtest_brief=1 --gtest_filter="$3" >"$2" 2>&1 || touch "$2.failed"' _
    for log in "$folder"/test-logs/*.failed; do
        [ -e "$log" ] || break
        cat "${log%.failed}" >&2
        here=$(sed -nE 's/^\[  FAILED  \] ([0-9]+) tests?, listed below:$/\1/p' "${log%.failed}")
        failed=$((failed + ${here:-1}))  # 1: the program crashed
    done
    run=$(awk '/^\[=+\] [0-9]+ tests? from .* ran/ { sum += $2 } END { print sum + 0 }' "$folder"/test-logs/*)
    skipped=$(awk '/^\[  SKIPPED \] [0-9]+ test/ { sum += $4 } END { print sum + 0 }' "$folder"/test-logs/*)
    count=$((count + run)) failures=$((failures + failed))
    add_row "$name" "$run" "$failed" "$skipped" $((EPOCHSECONDS - start))
}
