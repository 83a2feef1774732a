#pragma once

// Runs the work of a bake on several threads and reports its progress to the user. For .cpp files.

#include <abut/bake/field.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/math/result.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace abut::detail {

class BakeJob {
public:
    template <int D>
    explicit BakeJob(const FieldOptions<D>& options) : executor_(options.executor), progress_(options.progress) {}

    /// Begins a stage that takes about this share of the total work. Returns false if the user cancels.
    bool begin(double share) {
        done_ = std::min(1.0, done_ + share_);
        share_ = share;
        return report(0);
    }

    /// Calls item(0) to item(count - 1), each once, in any order and on any thread. Returns false if the user cancels.
    bool each(std::size_t count, FunctionRef<void(std::size_t)> item) {
        constexpr std::size_t reports = 32;
        const std::size_t workers = executor_ != nullptr ? std::max(1u, executor_->workers()) : 1;
        const std::size_t batch = std::max<std::size_t>(count / reports, 64 * workers);
        for (std::size_t begin = 0; begin < count; begin += batch) {
            if (!report(static_cast<double>(begin) / static_cast<double>(count))) return false;
            const std::size_t end = std::min(count, begin + batch);
            if (workers == 1) {
                for (std::size_t i = begin; i < end; ++i) item(i);
                continue;
            }
            const std::size_t parts = std::min(end - begin, 4 * workers);
            executor_->run(static_cast<std::uint32_t>(parts), [&](std::uint32_t part) {
                const std::size_t first = begin + (end - begin) * part / parts;
                const std::size_t last = begin + (end - begin) * (part + 1) / parts;
                for (std::size_t i = first; i < last; ++i) item(i);
            });
        }
        return report(1);
    }

    /// Reports that all work is done. Returns false if the user cancels even now.
    bool finish() {
        done_ = 1;
        share_ = 0;
        return report(0);
    }

    static Problem cancelled() { return {ProblemCode::cancelled, "cancelled", 0}; }

private:
    bool report(double part) {
        reported_ = std::max(reported_, std::min(1.0, done_ + share_ * part));
        return !progress_ || (*progress_)(reported_);
    }

    Executor* executor_;
    std::optional<FunctionRef<bool(double)>> progress_;
    double done_ = 0, share_ = 0, reported_ = 0;
};

}  // namespace abut::detail
