#pragma once

// Tests that run once by each kind of vector unit that this machine has.

#include <string>

#include <gtest/gtest.h>
#include <hwy/targets.h>

namespace abut::oracle {

class ByVectorUnit : public testing::TestWithParam<std::int64_t> {
protected:
    void SetUp() override { force(GetParam()); }
    void TearDown() override { force(0); }

private:
    /// Only this one; 0: the best there is.
    static void force(std::int64_t target) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
};

inline auto vector_units() {
    return testing::ValuesIn(hwy::SupportedAndGeneratedTargets());
}
inline std::string name_of_unit(const testing::TestParamInfo<std::int64_t>& unit) {
    return hwy::TargetName(unit.param);
}

}  // namespace abut::oracle
