#include <abut/io/file/scanner.hpp>
#include <abut/io/godot/scene_text.hpp>

#include <charconv>
#include <optional>
#include <system_error>
#include <utility>

namespace abut::godot {
namespace {

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}
bool is_word(char c) {
    return detail::is_letter(c) || c == '_' || (c >= '0' && c <= '9');
}
bool opens(char c) {
    return c == '(' || c == '[' || c == '{';
}
bool closes(char c) {
    return c == ')' || c == ']' || c == '}';
}

class Parser {
public:
    explicit Parser(std::string_view text) : text_(text) {}

    Result<std::vector<Section>> parse() {
        std::vector<Section> sections;
        for (skip_spaces(); !at_end(); skip_spaces()) {
            if (peek() == ';') {
                while (!at_end() && peek() != '\n') ++at_;
            } else if (peek() == '[') {
                ++at_;
                Section section;
                section.line = line();
                section.kind = word();
                if (!read_properties(']', section.attributes)) return problem();
                sections.push_back(std::move(section));
            } else {
                if (sections.empty()) return fail("is no scene of Godot");
                if (!read_property(sections.back().properties)) return problem();
            }
        }
        return sections;
    }

private:
    bool at_end() const { return at_ >= text_.size(); }
    char peek() const { return at_end() ? '\0' : text_[at_]; }
    void skip_spaces() {
        while (!at_end() && is_space(peek())) ++at_;
    }
    bool skip(char c) {
        skip_spaces();
        if (peek() != c || at_end()) return false;
        ++at_;
        return true;
    }
    std::string word() {
        const std::size_t first = at_;
        while (!at_end() && is_word(peek())) ++at_;
        return std::string(text_.substr(first, at_ - first));
    }

    // Counts from where it counted last.
    std::size_t line() {
        for (; counted_ < at_ && counted_ < text_.size(); ++counted_) lines_ += text_[counted_] == '\n' ? 1 : 0;
        return lines_ + 1;
    }
    Problem fail(const char* what) { return {ProblemCode::bad_format, "line " + std::to_string(line()) + ": " + what}; }
    bool stop(const char* what) {
        failed_ = what;
        return false;
    }
    Problem problem() { return fail(failed_); }

    bool read_properties(char end, Properties& out) {
        while (!skip(end)) {
            if (at_end()) return stop("a section doesn't end");
            if (!read_property(out)) return false;
        }
        return true;
    }

    bool read_property(Properties& out) {
        const std::size_t first = at_, equals = text_.find_first_of("=\n", at_);
        if (equals == std::string_view::npos || text_[equals] == '\n') return stop("has no '='");
        std::string name(detail::trimmed(text_.substr(first, equals - first)));
        at_ = equals + 1;
        Value value;
        if (!read_value(value)) return false;
        out.insert_or_assign(std::move(name), std::move(value));
        return true;
    }

    bool read_value(Value& value) {
        skip_spaces();
        if (peek() == '&' || peek() == '^') ++at_;  // names of nodes and of signals
        if (peek() == '"') return read_string(value.text);
        if (opens(peek())) return skip_brackets();
        if (const std::optional<double> number = read_number()) {
            value.numbers = {*number};
            return true;
        }
        const std::string word = this->word();
        if (word.empty()) return stop("has no value after '='");
        if (peek() == '[' && !skip_brackets()) return false;  // the type of an array
        if (peek() != '(') {
            value.text = word;
            return true;
        }
        value.name = word;
        ++at_;
        return read_arguments(value);
    }

    bool read_arguments(Value& value) {
        while (!skip(')')) {
            skip_spaces();
            if (at_end()) return stop("parentheses don't end");
            if (peek() == ',') {
                ++at_;
            } else if (peek() == '"') {
                std::string text;
                if (!read_string(text)) return false;
                if (value.text.empty()) value.text = std::move(text);
            } else if (opens(peek())) {
                if (!skip_brackets()) return false;
            } else if (const std::optional<double> number = read_number()) {
                value.numbers.push_back(*number);
            } else if (word().empty()) {
                return stop("has a character that belongs to no value");
            }
        }
        return true;
    }

    std::optional<double> read_number() {
        const char* const end = text_.data() + text_.size();
        double number = 0;
        if (!(peek() == '-' || peek() == '.' || (peek() >= '0' && peek() <= '9'))) return std::nullopt;
        const auto [stopped, error] = std::from_chars(text_.data() + at_, end, number);
        if (error != std::errc()) return std::nullopt;
        at_ = static_cast<std::size_t>(stopped - text_.data());
        return number;
    }

    bool read_string(std::string& out) {
        for (++at_; !at_end() && peek() != '"'; ++at_) {
            if (peek() == '\\') ++at_;
            if (!at_end()) out.push_back(peek());
        }
        if (at_end()) return stop("a string doesn't end");
        ++at_;
        return true;
    }

    // From an opening bracket to the one that closes it.
    bool skip_brackets() {
        std::size_t depth = 0;
        std::string ignored;
        while (!at_end()) {
            if (peek() == '"') {
                if (!read_string(ignored)) return false;
                ignored.clear();
                continue;
            }
            if (opens(peek())) ++depth;
            const bool is_last = closes(peek()) && --depth == 0;
            ++at_;
            if (is_last) return true;
        }
        return stop("brackets don't end");
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t counted_ = 0, lines_ = 0;
    const char* failed_ = "";
};

}  // namespace

std::string_view Section::attribute(std::string_view name) const {
    const auto found = attributes.find(name);
    return found != attributes.end() ? std::string_view(found->second.text) : std::string_view();
}

const Value* Section::property(std::string_view name) const {
    const auto found = properties.find(name);
    return found != properties.end() ? &found->second : nullptr;
}

std::optional<glm::dvec3> Section::vector(std::string_view name) const {
    const Value* const value = property(name);
    if (value == nullptr || value->numbers.size() != 3) return std::nullopt;
    return glm::dvec3(value->numbers[0], value->numbers[1], value->numbers[2]);
}

Result<std::vector<Section>> parse(std::string_view text) {
    return Parser(text).parse();
}

}  // namespace abut::godot
