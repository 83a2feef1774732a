#pragma once

// Tests that run once for each SIMD target of Highway (AVX2, SSE4, ...) that this machine supports.

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <hwy/targets.h>

namespace abut::oracle {

// Where Highway is its headers alone, there is one target, chosen when it compiles.
inline std::vector<std::int64_t> supported_simd_targets() {
#ifdef HWY_COMPILE_ONLY_STATIC
    return {HWY_STATIC_TARGET};
#else
    return hwy::SupportedAndGeneratedTargets();
#endif
}

/// While it lives, Highway dispatches to this SIMD target only.
class ForcedSimdTarget {
public:
    explicit ForcedSimdTarget(std::int64_t target) { force(target); }
    ~ForcedSimdTarget() { force(0); }
    ForcedSimdTarget(const ForcedSimdTarget&) = delete;
    ForcedSimdTarget& operator=(const ForcedSimdTarget&) = delete;

private:
    /// 0 restores the best target.
    static void force([[maybe_unused]] std::int64_t target) {
#ifndef HWY_COMPILE_ONLY_STATIC
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
#endif
    }
};

class BySimdTarget : public testing::TestWithParam<std::int64_t> {
    ForcedSimdTarget only_{GetParam()};
};

inline auto simd_targets() {
    return testing::ValuesIn(supported_simd_targets());
}
inline std::string simd_target_name(const testing::TestParamInfo<std::int64_t>& unit) {
    return hwy::TargetName(unit.param);
}

}  // namespace abut::oracle
