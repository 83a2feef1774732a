#pragma once

// The report of `abut check` as one HTML page, which shows each finding in its place.

#include "tool/check/finding.hpp"
#include "tool/page/page_scene.hpp"
#include <abut/math/vec.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace abut::tool {

/// The page shows this number of findings and counts the others.
inline constexpr std::size_t max_page_findings = 1000;

/// The data of the page: the interface Report of play/viewer/src/report.ts.
template <int D>
Json page_json(const FileReport& report, PageScene<D>& scene, const Vec3& up, std::string_view version);

/// The whole page. Text from files is escaped. Empty in builds without npm.
std::string page(const Json& data);

}  // namespace abut::tool
