#pragma once

// Tests that run once by each kind of vector unit that this machine has.

#include <cstdint>
#include <string>

#include <gtest/gtest.h>
#include <hwy/targets.h>

namespace abut::oracle {

/// While it lives, only this kind of vector unit is taken.
class OnlyVectorUnit {
public:
    explicit OnlyVectorUnit(std::int64_t target) { force(target); }
    ~OnlyVectorUnit() { force(0); }
    OnlyVectorUnit(const OnlyVectorUnit&) = delete;
    OnlyVectorUnit& operator=(const OnlyVectorUnit&) = delete;

private:
    /// 0: the best there is.
    static void force(std::int64_t target) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
};

class ByVectorUnit : public testing::TestWithParam<std::int64_t> {
    OnlyVectorUnit only_{GetParam()};
};

inline auto vector_units() {
    return testing::ValuesIn(hwy::SupportedAndGeneratedTargets());
}
inline std::string name_of_unit(const testing::TestParamInfo<std::int64_t>& unit) {
    return hwy::TargetName(unit.param);
}

}  // namespace abut::oracle
