#pragma once

// Tests that run once for each SIMD target of Highway (AVX2, SSE4, ...) that this machine supports.

#include <cstdint>
#include <string>

#include <gtest/gtest.h>
#include <hwy/targets.h>

namespace abut::oracle {

/// While it lives, Highway dispatches to this SIMD target only.
class ForcedSimdTarget {
public:
    explicit ForcedSimdTarget(std::int64_t target) { force(target); }
    ~ForcedSimdTarget() { force(0); }
    ForcedSimdTarget(const ForcedSimdTarget&) = delete;
    ForcedSimdTarget& operator=(const ForcedSimdTarget&) = delete;

private:
    /// 0 restores the best target.
    static void force(std::int64_t target) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
};

class BySimdTarget : public testing::TestWithParam<std::int64_t> {
    ForcedSimdTarget only_{GetParam()};
};

inline auto simd_targets() {
    return testing::ValuesIn(hwy::SupportedAndGeneratedTargets());
}
inline std::string simd_target_name(const testing::TestParamInfo<std::int64_t>& unit) {
    return hwy::TargetName(unit.param);
}

}  // namespace abut::oracle
