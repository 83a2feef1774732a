// The names that headers give users in namespace abut are those of public_names.txt, one a line, sorted: adding a name
// is a decision. The test reads declarations by their tokens, as far as the headers of abut need it.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = ABUT_SOURCE_FOLDER;

std::string content_of(const fs::path& file) {
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

// The headers that a user can include, and those that these include in turn.
std::set<std::string> installed_headers() {
    std::vector<std::string> unread{"abut/abut.hpp", "abut/bake.hpp", "abut/draw.hpp", "abut/io.hpp",
                                    "abut/recast.hpp"};
    std::set<std::string> found;
    while (!unread.empty()) {
        const std::string header = unread.back();
        unread.pop_back();
        if (!found.insert(header).second) continue;
        std::istringstream lines(content_of(kRoot / header));
        constexpr std::string_view kInclude = "#include <abut/";
        for (std::string line; std::getline(lines, line);)
            if (line.starts_with(kInclude)) unread.push_back(line.substr(10, line.find('>') - 10));
    }
    return found;
}

bool is_word(const std::string& token) {
    return std::isalpha(static_cast<unsigned char>(token[0])) != 0 || token[0] == '_';
}

// Words and single characters, but "::" and "->" whole; without comments, literals and lines of the preprocessor.
std::vector<std::string> tokens_of(const std::string& text) {
    std::vector<std::string> result;
    const auto skip_to = [&](std::size_t from, std::string_view end) {
        const std::size_t at = text.find(end, from);
        return at == std::string::npos ? text.size() : at + end.size();
    };
    for (std::size_t i = 0; i < text.size();) {
        const std::string_view rest = std::string_view(text).substr(i);
        const auto is_part = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
        if (rest[0] == '#') {
            while (i < text.size() && text[i] != '\n') i += text[i] == '\\' ? 2 : 1;
        } else if (rest.starts_with("//")) {
            i = skip_to(i, "\n");
        } else if (rest.starts_with("/*")) {
            i = skip_to(i, "*/");
        } else if (rest[0] == '"' || rest[0] == '\'') {
            for (++i; i < text.size() && text[i] != rest[0]; ++i) i += text[i] == '\\' ? 1 : 0;
            ++i;
        } else if (is_part(rest[0])) {
            const auto end = std::find_if_not(rest.begin(), rest.end(), is_part);
            result.emplace_back(rest.begin(), end);
            i += result.back().size();
        } else {
            const bool is_pair = rest.starts_with("::") || rest.starts_with("->");
            if (std::isspace(static_cast<unsigned char>(rest[0])) == 0)
                result.emplace_back(rest.substr(0, is_pair ? 2 : 1));
            i += is_pair ? 2 : 1;
        }
    }
    return result;
}

class Declarations {
public:
    Declarations(const std::vector<std::string>& tokens, std::set<std::string>& names)
        : tokens_(tokens), names_(names) {}

    // The declarations of a namespace, up to its closing brace. Names count where the namespace is abut.
    void read_namespace(bool is_abut) {
        while (at_ < tokens_.size() && !is("}")) {
            if (is("namespace"))
                read_inner_namespace(is_abut);
            else
                read_declaration(is_abut);
        }
        ++at_;
    }

private:
    bool is(std::string_view token) const { return at_ < tokens_.size() && tokens_[at_] == token; }

    // From an opening bracket to behind its partner.
    void skip_brackets(std::string_view open, std::string_view close) {
        int depth = 0;
        do {
            depth += is(open) ? 1 : is(close) ? -1 : 0;
            ++at_;
        } while (depth > 0 && at_ < tokens_.size());
    }

    void read_inner_namespace(bool is_abut) {
        std::string name;
        for (++at_; at_ < tokens_.size() && !is("{") && !is(";"); ++at_) name += tokens_[at_];
        if (is(";")) {
            ++at_;
            return;
        }
        ++at_;
        read_namespace(!is_abut && name == "abut");
    }

    void skip_template_prefix() {
        while (is("template") || is("[") || is("inline") || is("constexpr") || is("alignas")) {
            const bool is_template = is("template");
            ++at_;
            if (is_template && is("<")) skip_brackets("<", ">");
            if (is_template && is("requires")) skip_requirements();
            if (tokens_[at_ - 1] == "[") {
                --at_;
                skip_brackets("[", "]");
            } else if (is("(")) {
                skip_brackets("(", ")");
            }
        }
    }

    // Such as: requires(D > 1) && is_number<T>
    void skip_requirements() {
        do {
            ++at_;
            if (is("&") || is("|")) ++at_;
            while (is("::") ||
                   (is_word(tokens_[at_]) && (!is_word(tokens_[at_ - 1]) || tokens_[at_ - 1] == "requires")))
                ++at_;
            if (is("<")) skip_brackets("<", ">");
            if (is("(")) skip_brackets("(", ")");
        } while (is("&") || is("|"));
    }

    void read_declaration(bool counts) {
        skip_template_prefix();
        const bool is_type = is("class") || is("struct") || is("enum") || is("union");
        std::string name;
        if (is_type || is("using") || is("concept")) {
            ++at_;
            if (is("class") || is("namespace")) ++at_;
            while (is("[")) skip_brackets("[", "]");
            if (is("alignas")) {
                ++at_;
                skip_brackets("(", ")");
            }
            name = tokens_[at_++];
            if (is("<") || is("::")) name.clear();  // a specialization, or the member of a class
        }
        const bool is_known = !name.empty() || is_type;
        const std::string found = rest_of_declaration(is_type);
        if (!is_known) name = found;
        if (counts && !name.empty() && !name.starts_with("ABUT_")) names_.insert(name);
    }

    // Behind the declaration; returns the name that stands before its parameters or its initial value.
    std::string rest_of_declaration(bool is_type) {
        std::string name, last_word;
        bool has_parameters = false, in_initializers = false, is_qualified = false;
        while (at_ < tokens_.size() && !is(";") && !is("}")) {
            const std::string& before = tokens_[at_ == 0 ? 0 : at_ - 1];
            if (is("{")) {
                if (!has_parameters && name.empty()) name = last_word;
                const bool is_body = has_parameters && !(in_initializers && (is_word(before) || before == ">"));
                skip_brackets("{", "}");
                if (is_body && !is_type) return is_qualified ? "" : name;
            } else if (is("(")) {
                const bool is_type_of = before == "decltype" || before == "noexcept" || before == "requires";
                if (!has_parameters && !is_type_of) {
                    name = before == last_word ? last_word : "";  // none of an operator
                    is_qualified = at_ > 1 && tokens_[at_ - 2] == "::";
                    has_parameters = true;
                }
                skip_brackets("(", ")");
            } else if (is("<") && is_word(before) && before != "operator") {
                skip_brackets("<", ">");
            } else {
                if (is("=") && !has_parameters && name.empty()) name = last_word;
                in_initializers = in_initializers || (has_parameters && is(":"));
                if (is_word(tokens_[at_])) last_word = tokens_[at_];
                ++at_;
            }
        }
        at_ += is(";") ? 1 : 0;
        if (name.empty() && !has_parameters) name = last_word;
        return is_qualified || name == "static_assert" ? "" : name;
    }

    const std::vector<std::string>& tokens_;
    std::set<std::string>& names_;
    std::size_t at_ = 0;
};

std::set<std::string> names_in(const std::string& text) {
    std::set<std::string> names;
    const std::vector<std::string> tokens = tokens_of(text);
    Declarations(tokens, names).read_namespace(false);
    return names;
}

TEST(House, PublicNamesAreRead) {
    EXPECT_EQ(names_in(R"(
#define MACRO(x) \
    int x;
namespace abut {
struct Ball { float radius{1}; void grow(); };
template <int D> requires(D > 1) class alignas(8) Box final : Base<D> { int inner; };
template <> struct Box<2>;
enum class Kind : char { none };
using Number = float;
template <class S> concept Shape = requires(S s) { s.bounds(); };
inline constexpr double pi{3.14};
constexpr int limit = 3;
template <int D> bool overlaps(const Ball& a, Box<D> b = {}) { return true; }
Box(int) -> Box<2>;
template <int D> Ball::Ball(int a) : radius{a} {}
Ball operator*(Ball a, Ball b);
extern int count;
namespace detail { int hidden(); }
}
int outside();
)"),
              (std::set<std::string>{"Ball", "Box", "Kind", "Number", "Shape", "count", "limit", "overlaps", "pi"}));
}

TEST(House, PublicNamesAreThoseOfTheList) {
    std::map<std::string, std::string> found;
    for (const std::string& header : installed_headers())
        for (const std::string& name : names_in(content_of(kRoot / header))) found.emplace(name, header);
    std::set<std::string> listed;
    std::istringstream lines(content_of(kRoot / "test/house/public_names.txt"));
    for (std::string line; std::getline(lines, line);) listed.insert(line);
    EXPECT_GT(found.size(), 100u);
    for (const auto& [name, header] : found)
        EXPECT_TRUE(listed.contains(name)) << header << " declares " << name << ", which public_names.txt doesn't list";
    for (const std::string& name : listed) EXPECT_TRUE(found.contains(name)) << "no installed header declares " << name;
}

}  // namespace
