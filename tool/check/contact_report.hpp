#pragma once

// Contacts as findings of a report.

#include "tool/check/check.hpp"
#include "tool/check/finding.hpp"
#include "tool/check/severities.hpp"

#include <vector>

namespace abut::tool {

/// The contacts of a check at the given times. Rules that are off are left out.
template <int D>
std::vector<Finding> findings_of(const CheckResult<D>& result, const Objects<D>& objects,
                                 const std::vector<double>& times, const Severities& severities);

}  // namespace abut::tool
