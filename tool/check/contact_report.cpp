#include "tool/check/contact_report.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace abut::tool {
namespace {

template <int D>
Rule rule_of(const ContactFinding<D>& contact) {
    if (contact.distance >= 0) return Rule::too_near;
    if (contact.between) return Rule::between_frames;
    return contact.inside ? Rule::inside : Rule::overlap;
}

template <int D>
Vec<D> middle(const std::vector<Vec<D>>& points) {
    Vec<D> sum{};
    for (const Vec<D>& point : points) sum += point / static_cast<float>(points.size());
    return sum;
}

// A contact, the objects and the times that it refers to.
template <int D>
class ContactText {
public:
    ContactText(const ContactFinding<D>& contact, const Objects<D>& objects, const std::vector<double>& times)
        : contact_(contact), a_(objects[contact.a]), b_(objects[contact.b]), times_(times) {}

    std::string text() const {
        std::string line = fmt::format("{}{}, near {}", how(), when(), vector(middle(contact_.points)));
        // For a mesh the normal separates a single triangle and not the whole mesh.
        if (contact_.distance < 0 && a_.solid && b_.solid)
            line +=
                fmt::format("; moving {} by {} separates them", b_.name, vector(contact_.normal * -contact_.distance));
        return line;
    }

    Json data() const {
        Json points = Json::array();
        for (const Vec<D>& point : contact_.points) points.push_back(numbers(point));
        Json result = {{"a", a_.path},
                       {"b", b_.path},
                       {"frame", contact_.first},
                       {"last_frame", contact_.last},
                       {"distance", contact_.distance},
                       {"allowed", contact_.allow},
                       {"normal", numbers(contact_.normal)},
                       {"points", std::move(points)},
                       {"deepest_frame", contact_.deepest},
                       {"time", contact_.between ? contact_.time : times_[contact_.first]},
                       {"last_time", contact_.between ? contact_.last_time : times_[contact_.last]},
                       {"deepest_time", deepest_time()}};
        if (contact_.between) {
            result["between"] = true;
            result["fraction"] = fraction();
        }
        if (contact_.inside) result["inside"] = true;
        return result;
    }

    double deepest_time() const { return contact_.between ? contact_.deepest_time : times_[contact_.deepest]; }

private:
    // The time of a contact between frames, as a fraction from its frame to the next one.
    double fraction() const {
        const double from = times_[contact_.first], to = times_[contact_.first + 1];
        return (contact_.time - from) / (to - from);
    }

    std::string how() const {
        const std::string distance = number(static_cast<double>(std::abs(contact_.distance)));
        if (contact_.inside) return "one inside the other, " + distance + " to get out";
        return distance + (contact_.distance < 0 ? " deep" : " apart");
    }

    std::string when() const {
        if (contact_.between)
            return fmt::format(" at {} s, between frames {} and {}: they touch at {} s (fraction {})",
                               number(contact_.deepest_time), contact_.first, contact_.first + 1, number(contact_.time),
                               number(fraction()));
        if (times_.size() == 1) return {};
        const std::string deepest =
            fmt::format(" at {} s (frame {})", number(times_[contact_.deepest]), contact_.deepest);
        if (contact_.first == contact_.last) return deepest;
        if (contact_.first == 0 && contact_.last + 1 == times_.size()) return deepest + ", all the time";
        return fmt::format("{}, from {} s to {} s (frames {} to {})", deepest, number(times_[contact_.first]),
                           number(times_[contact_.last]), contact_.first, contact_.last);
    }

    const ContactFinding<D>& contact_;
    const Object<D>&a_, &b_;
    const std::vector<double>& times_;
};

template <int D>
Finding finding_of(const Pile<D>& pile, const Objects<D>& objects, const std::vector<double>& times) {
    Finding finding;
    finding.rule = Rule::pile;
    Json names = Json::array();
    for (const std::uint32_t i : pile.objects) {
        finding.objects.push_back({objects[i].path, objects[i].name, objects[i].type});
        names.push_back(objects[i].path);
    }
    const std::uint64_t count = pile.objects.size(), pairs = count * (count - 1) / 2;
    finding.text =
        fmt::format("{} objects are in one place, at {}: each two of them overlap", count, vector(pile.point));
    if (pile.last > pile.first || pile.first > 0)
        finding.text += fmt::format(", from {} s to {} s", number(times[pile.first]), number(times[pile.last]));
    finding.position = coordinates(pile.point);
    finding.time = times[pile.first];
    finding.badness = std::numeric_limits<double>::max();
    finding.data = {{"objects", std::move(names)},
                    {"pairs", pairs},
                    {"position", numbers(pile.point)},
                    {"depth", 2 * pile.depth},
                    {"frame", pile.first},
                    {"last_frame", pile.last},
                    {"time", times[pile.first]},
                    {"last_time", times[pile.last]}};
    return finding;
}

}  // namespace

template <int D>
std::vector<Finding> findings_of(const CheckResult<D>& result, const Objects<D>& objects,
                                 const std::vector<double>& times, const Severities& severities) {
    std::vector<Finding> findings;
    for (const Pile<D>& pile : result.piles)
        if (severities.of(Rule::pile) != Severity::off) {
            findings.push_back(finding_of(pile, objects, times));
            findings.back().severity = severities.of(Rule::pile);
        }
    for (const ContactFinding<D>& contact : result.findings) {
        const Rule rule = rule_of(contact);
        if (severities.of(rule) == Severity::off) continue;
        const ContactText<D> text(contact, objects, times);
        Finding& finding = findings.emplace_back();
        finding.rule = rule;
        finding.severity = severities.of(rule);
        for (const std::size_t i : {contact.a, contact.b})
            finding.objects.push_back({objects[i].path, objects[i].name, objects[i].type});
        finding.text = text.text();
        finding.position = coordinates(middle(contact.points));
        finding.time = text.deepest_time();
        finding.badness = static_cast<double>(-contact.distance);
        finding.data = text.data();
    }
    return findings;
}

template std::vector<Finding> findings_of(const CheckResult<2>&, const Objects<2>&, const std::vector<double>&,
                                          const Severities&);
template std::vector<Finding> findings_of(const CheckResult<3>&, const Objects<3>&, const std::vector<double>&,
                                          const Severities&);

}  // namespace abut::tool
