#include "tool/shared/confine.hpp"

#include <sys/resource.h>
#include <unistd.h>

#if defined(__linux__) && (defined(__x86_64__) || defined(__aarch64__))
#define ABUT_FILTERS_CALLS 1
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#endif

namespace abut::tool {
namespace {

void close_all_but(int pipe) {
    const auto first = static_cast<unsigned>(STDERR_FILENO + 1), middle = static_cast<unsigned>(pipe);
#if defined(SYS_close_range)
    if ((middle == first || syscall(SYS_close_range, first, middle - 1, 0) == 0) &&
        syscall(SYS_close_range, middle + 1, ~0u, 0) == 0)
        return;
#endif
    constexpr int usual_limit = 1024;
    for (int descriptor = STDERR_FILENO + 1; descriptor < usual_limit; ++descriptor)
        if (descriptor != pipe) close(descriptor);
}

#if defined(ABUT_FILTERS_CALLS)

#if defined(__x86_64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#else
constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#endif

/// Calls that are refused, whatever their arguments.
constexpr std::array refused {
#if defined(__x86_64__)
    SYS_fork, SYS_vfork, SYS_creat, SYS_unlink, SYS_rename, SYS_mkdir, SYS_rmdir, SYS_link, SYS_symlink, SYS_chmod,
        SYS_chown, SYS_mknod,
#endif
        SYS_clone, SYS_execve, SYS_execveat, SYS_ptrace, SYS_process_vm_readv, SYS_process_vm_writev, SYS_socket,
        SYS_connect, SYS_unlinkat, SYS_renameat2, SYS_mkdirat, SYS_linkat, SYS_symlinkat, SYS_fchmodat, SYS_fchownat,
        SYS_mknodat, SYS_truncate, SYS_open_by_handle_at, SYS_mount, SYS_bpf, SYS_keyctl, SYS_userfaultfd,
        SYS_perf_event_open, SYS_renameat
};

/// Newer calls, whose arguments lie in memory. As if the system didn't have them: the C library uses the older ones.
constexpr std::array unknown{SYS_clone3, SYS_openat2, SYS_io_uring_setup};

sock_filter load(std::size_t offset) {
    return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
}
sock_filter answer(std::uint32_t action) {
    return BPF_STMT(BPF_RET | BPF_K, action);
}
sock_filter fail(int error) {
    return answer(SECCOMP_RET_ERRNO | static_cast<std::uint32_t>(error));
}

/// The lower half of an argument of a call. Both processors are little-endian.
std::size_t argument(std::size_t i) {
    return offsetof(seccomp_data, args) + i * sizeof(std::uint64_t);
}

/// A program for the system: it reads the number of a call and the flags of those that open files.
std::vector<sock_filter> filter() {
    std::vector<sock_filter> program;
    const auto at_call = [&](auto number, const std::vector<sock_filter>& then) {
        program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(number), 0,
                                   static_cast<std::uint8_t>(then.size())));
        program.insert(program.end(), then.begin(), then.end());
    };
    const auto refuse_writing = [&](auto number, std::size_t flags) {
        constexpr std::uint32_t writing = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;
        at_call(number, {load(argument(flags)), BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, writing, 0, 1), fail(EPERM),
                         answer(SECCOMP_RET_ALLOW)});
    };
    program.push_back(load(offsetof(seccomp_data, arch)));
    program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0));
    program.push_back(answer(SECCOMP_RET_KILL_PROCESS));
    program.push_back(load(offsetof(seccomp_data, nr)));
#if defined(__x86_64__)
    constexpr std::uint32_t first_of_x32 = 0x40000000;
    program.push_back(BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, first_of_x32, 0, 1));
    program.push_back(fail(EPERM));
    refuse_writing(SYS_open, 1);
#endif
    refuse_writing(SYS_openat, 2);
    for (const auto number : refused) at_call(number, {fail(EPERM)});
    for (const auto number : unknown) at_call(number, {fail(ENOSYS)});
    program.push_back(answer(SECCOMP_RET_ALLOW));
    return program;
}

bool filter_calls() {
    std::vector<sock_filter> instructions = filter();
    const sock_fprog program{static_cast<unsigned short>(instructions.size()), instructions.data()};
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

#else

bool filter_calls() {
    return false;
}

#endif

}  // namespace

bool confine(int pipe) {
    close_all_but(pipe);
    const rlimit none{0, 0};
    setrlimit(RLIMIT_FSIZE, &none);
    return filter_calls();
}

}  // namespace abut::tool
