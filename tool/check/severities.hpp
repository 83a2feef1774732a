#pragma once

// The severity of each rule, as options set it.

#include "tool/check/rule.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace abut::tool {

class Severities {
public:
    Severities() {
        for (const RuleInfo& rule : all_rules()) of(rule.rule) = rule.severity;
    }

    Severity& of(Rule rule) { return severities_[static_cast<std::size_t>(rule)]; }
    Severity of(Rule rule) const { return severities_[static_cast<std::size_t>(rule)]; }

    /// Sets all rules that the word names.
    void set(std::string_view word, Severity severity) {
        for (const RuleInfo& rule : all_rules())
            if (names_rule(word, rule)) of(rule.rule) = severity;
    }

    /// True if a rule of the kind is not off.
    bool checks(Kind kind) const {
        return std::any_of(all_rules().begin(), all_rules().end(),
                           [&](const RuleInfo& rule) { return rule.kind == kind && of(rule.rule) != Severity::off; });
    }

private:
    std::array<Severity, count_rules> severities_{};
};

}  // namespace abut::tool
