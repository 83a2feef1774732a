#pragma once

// Reports in formats that other programs read: SARIF 2.1.0, JUnit's XML, and annotations of GitHub's workflows.

#include "tool/check/report_text.hpp"

#include <string>
#include <vector>

namespace abut::tool {

/// One run with all rules, and one result per finding. https://docs.oasis-open.org/sarif/sarif/v2.1.0/
std::string sarif_of(const std::vector<CheckedFile>& files);

/// A suite per file and a case per kind; errors fail it, warnings are its output.
std::string junit_of(const std::vector<CheckedFile>& files);

/// A line per finding: "::error file=level.glb,title=ABUT101 overlap::A and B: 0.25 deep".
std::string github_of(const std::vector<CheckedFile>& files);

}  // namespace abut::tool
