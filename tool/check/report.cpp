#include "tool/check/report.hpp"

#include "tool/faults/faults_report.hpp"
#include "tool/shared/format.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace abut::tool {
namespace {

// Limits of the text report; --json lists all.
constexpr std::size_t max_listed_pairs = 100;
constexpr std::size_t max_listed_times = 5;

template <int D>
using PairFindings = std::vector<const ContactFinding<D>*>;

template <int D>
Vec<D> middle(const std::vector<Vec<D>>& points) {
    Vec<D> sum{};
    for (const Vec<D>& point : points) sum += point / static_cast<float>(points.size());
    return sum;
}

template <int D>
bool collides(const ContactFinding<D>& finding) {
    return finding.distance < 0;
}

// Findings grouped by pair; the pair with the deepest one first.
template <int D>
std::vector<PairFindings<D>> by_pair(const std::vector<ContactFinding<D>>& findings) {
    std::map<std::pair<std::size_t, std::size_t>, PairFindings<D>> pairs;
    for (const ContactFinding<D>& finding : findings) pairs[{finding.a, finding.b}].push_back(&finding);
    std::vector<PairFindings<D>> result;
    for (auto& [pair, pair_findings] : pairs) {
        std::sort(pair_findings.begin(), pair_findings.end(), [](const ContactFinding<D>* x, const ContactFinding<D>* y) {
            return std::tie(x->distance, x->first) < std::tie(y->distance, y->first);
        });
        result.push_back(std::move(pair_findings));
    }
    std::stable_sort(result.begin(), result.end(), [](const PairFindings<D>& x, const PairFindings<D>& y) {
        return x.front()->distance < y.front()->distance;
    });
    return result;
}

template <int D>
std::string how(const ContactFinding<D>& finding) {
    if (finding.inside) return fmt::format("one inside the other, {} to get out", number(-finding.distance));
    if (collides(finding)) return fmt::format("{} deep", number(-finding.distance));
    return fmt::format("{} apart", number(finding.distance));
}

template <int D>
std::string when(const Report<D>& report, const ContactFinding<D>& finding) {
    if (finding.between)
        return fmt::format(" at {} s, between frames {} and {}: they touch at {} s (fraction {})",
                           number(finding.deepest_time), finding.first, finding.first + 1, number(finding.time),
                           number(fraction(report, finding)));
    const auto time = [&](std::size_t frame) { return number(report.times[frame]); };
    if (report.times.size() == 1) return {};
    if (finding.first == finding.last) return fmt::format(" at {} s (frame {})", time(finding.first), finding.first);
    const std::string deepest = fmt::format(" at {} s (frame {})", time(finding.deepest), finding.deepest);
    if (finding.first == 0 && finding.last + 1 == report.times.size()) return deepest + ", all the time";
    return fmt::format("{}, from {} s to {} s (frames {} to {})", deepest, time(finding.first), time(finding.last),
                       finding.first, finding.last);
}

template <int D>
std::string finding_line(const Report<D>& report, const ContactFinding<D>& finding) {
    std::string line =
        fmt::format("        {}{}, near {}", how(finding), when(report, finding), vector(middle(finding.points)));
    // For a mesh the normal separates a single triangle and not the whole mesh.
    const bool both_solid = report.objects[finding.a].solid && report.objects[finding.b].solid;
    if (collides(finding) && both_solid)
        line += fmt::format("; moving {} by {} separates them", report.objects[finding.b].name,
                            vector(finding.normal * -finding.distance));
    return line + "\n";
}

template <int D>
std::string pair(const Report<D>& report, const PairFindings<D>& pair_findings, std::size_t rank) {
    const ContactFinding<D>& worst = *pair_findings.front();
    std::string text =
        fmt::format("{:4}. {}  and  {}\n", rank, report.objects[worst.a].path, report.objects[worst.b].path);
    for (std::size_t i = 0; i < pair_findings.size() && i < max_listed_times; ++i)
        text += finding_line(report, *pair_findings[i]);
    if (pair_findings.size() > max_listed_times)
        text += fmt::format("        and {} more times\n", pair_findings.size() - max_listed_times);
    return text;
}

template <int D>
std::string summary(const Report<D>& report, std::size_t pairs) {
    const std::size_t solids = report.objects.count_solids();
    const CheckResult<D>& result = report.result;
    const double share =
        result.possible == 0 ? 0 : 100.0 * static_cast<double>(result.tested) / static_cast<double>(result.possible);
    std::string text;
    text += fmt::format("objects   {}: {} taken as convex solids, {} as {}\n", report.objects.size(), solids,
                        report.objects.size() - solids, not_solids<D>);
    if (!report.left_out.empty()) text += "left out  " + text_of(report.left_out) + "\n";
    text += fmt::format("frames    {}", report.times.size());
    if (report.times.size() > 1)
        text += fmt::format(", from {} s to {} s", number(report.times.front()), number(report.times.back()));
    text += fmt::format("\npairs     {} tested of {} possible ({} %)", result.tested, result.possible, number(share));
    if (result.swept > 0) text += fmt::format(", {} swept between frames", result.swept);
    text += fmt::format("\ncontacts  {} between {}", result.findings.size(), counted(pairs, "pair", "pairs"));
    if (result.left_out > 0) text += fmt::format(", and {} more, no deeper, that are left out", result.left_out);
    if (report.has_baseline) text += fmt::format(", and {} that the baseline has", report.known);
    text += "\n" + summary_of(report.faults);
    text += fmt::format("seconds   read {:.3f}, build {:.3f}, check {:.3f}, level {:.3f}\n", report.seconds.read,
                        report.seconds.build, report.seconds.check, report.seconds.level);
    return text;
}

template <int D>
std::string verdict(const Report<D>& report, const std::vector<PairFindings<D>>& pairs) {
    const char* suffix = report.has_baseline ? " that didn't before" : "";
    std::size_t colliding = 0;
    for (const PairFindings<D>& pair_findings : pairs) colliding += collides(*pair_findings.front()) ? 1 : 0;
    const std::size_t near = pairs.size() - colliding;
    std::vector<std::string> parts;
    if (colliding > 0) parts.push_back(counted(colliding, "pair collides", "pairs collide"));
    if (near > 0) parts.push_back(counted(near, "pair comes too near", "pairs come too near"));
    for (std::string& part : verdicts_of(report.faults)) parts.push_back(std::move(part));
    if (parts.empty()) return fmt::format("CLEAN: no pair collides{}\n", suffix);
    return fmt::format("FAULTS FOUND: {}{}\n", fmt::join(parts, ", "), suffix);
}

}  // namespace

template <int D>
std::string text_report(const Report<D>& report, const std::string& scene_name) {
    const std::vector<PairFindings<D>> pairs = by_pair(report.result.findings);
    std::string text = scene_name + "\n\n";
    for (std::size_t i = 0; i < pairs.size() && i < max_listed_pairs; ++i) text += pair(report, pairs[i], i + 1);
    if (pairs.size() > max_listed_pairs)
        text += fmt::format("      and {} more pairs (--json lists them all)\n", pairs.size() - max_listed_pairs);
    if (!pairs.empty()) text += "\n";
    text += text_of(report.faults, report.level);
    for (const std::string& note : report.notes) text += "note: " + note + "\n";
    if (!report.notes.empty()) text += "\n";
    return text + summary(report, pairs.size()) + "\n" + verdict(report, pairs);
}

template std::string text_report(const Report<2>& report, const std::string& scene_name);
template std::string text_report(const Report<3>& report, const std::string& scene_name);

}  // namespace abut::tool
