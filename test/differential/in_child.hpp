#pragma once

// Runs work that may crash or never end in child processes.

#include <csignal>
#include <cstddef>
#include <functional>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

namespace abut::differential {

struct Losses {
    std::size_t crashes = 0;
    std::size_t hangs = 0;
};

/// Calls work(i) for 0 to count - 1 in child processes. A child that crashes, or uses more than `milliseconds` (below
/// 1000) of processor time for an item, is replaced, and its item is skipped. Only writes to shared memory remain.
inline Losses in_children(std::size_t count, int milliseconds, const std::function<void(std::size_t)>& work) {
    Losses losses;
    void* memory = mmap(nullptr, sizeof(std::size_t), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return losses;
    auto* next = static_cast<volatile std::size_t*>(memory);  // the item at work
    for (std::size_t first = 0; first < count;) {
        *next = first;
        const pid_t child = fork();
        if (child < 0) break;
        if (child == 0) {
            const int nowhere = open("/dev/null", O_WRONLY);
            dup2(nowhere, STDERR_FILENO);
            dup2(nowhere, STDOUT_FILENO);
            const itimerval limit{{0, 0}, {0, milliseconds * 1000}};
            for (std::size_t i = first; i < count;) {
                setitimer(ITIMER_PROF, &limit, nullptr);  // ends in SIGPROF, which ends the process
                work(i);
                *next = ++i;
            }
            _exit(0);
        }
        int status = 0;
        waitpid(child, &status, 0);
        if (*next >= count) break;
        (WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF ? losses.hangs : losses.crashes) += 1;
        first = *next + 1;
    }
    munmap(memory, sizeof(std::size_t));
    return losses;
}

}  // namespace abut::differential
