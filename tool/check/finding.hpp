#pragma once

// A finding of `abut check`, of any rule and dimension, and all findings of a file. All reports are made from these.

#include "tool/check/rule.hpp"
#include "tool/shared/format.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace abut::tool {

/// The names of an object, or of a spawn.
struct ObjectName {
    std::string path;
    std::string name;  ///< last component of the path
    std::string type;  ///< class assigned by the author, if the format has classes
};

struct Finding {
    Rule rule = Rule::overlap;
    Severity severity = Severity::error;
    /// A pair; all equal objects; a spawn and the object that it is in or below; or one object.
    std::vector<ObjectName> objects;
    std::string text;              ///< what is wrong with them and where: "0.25 deep, near (1, 2, 3)"
    std::vector<double> position;  ///< D numbers
    double time = 0;               ///< seconds: when it is worst
    double badness = 0;            ///< orders the findings of a kind, the greatest first
    Json data = Json::object();    ///< the entry of the JSON report, with "code" and "severity"
};

/// What is found in one file, and how it was checked.
struct FileReport {
    std::string file;
    int dimension = 3;
    std::string units;              ///< of lengths: "m", "px", or "file" if the format doesn't say
    std::vector<Finding> findings;  ///< errors first; within a severity by kind, and the worst first
    std::size_t known = 0;          ///< count of findings left out because the baseline has them
    std::size_t ignored = 0;        ///< count of findings left out because an option says so
    bool has_baseline = false;
    std::vector<std::string> mended;  ///< what the baseline has and is found no longer, one line each
    std::vector<std::string> stale;   ///< what the baseline has of objects that the file no longer has
    std::vector<std::string> notes;
    std::string summary;            ///< lines of text: counts, and seconds
    Json details = Json::object();  ///< the same for the JSON report
    std::string page, picture;      ///< documents of --report and --svg; empty if the plan wants none

    std::size_t count(Severity severity) const {
        std::size_t result = 0;
        for (const Finding& finding : findings) result += finding.severity == severity ? 1 : 0;
        return result;
    }
};

/// "errors", "warnings" or "clean".
const char* verdict(const FileReport& report);

/// What the finding is about: a pair, or the first object; "within A" for a gap of one object.
std::string subject(const Finding& finding, const char* between = " and ");

/// A sentence for one line: the subject, and what is wrong with it.
std::string sentence(const Finding& finding);

/// Sorts as FileReport says.
void sort_findings(std::vector<Finding>& findings);

}  // namespace abut::tool
