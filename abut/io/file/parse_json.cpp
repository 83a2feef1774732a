#include <abut/io/file/parse_json-inl.h>

#include <cstddef>
#include <string>
#include <utility>

namespace abut::detail {
namespace {

using Json = nlohmann::json;

// nlohmann's id of numbers that no double can hold.
constexpr int out_of_range = 406;

// Finds the first error.
class FirstError final : public nlohmann::json_sax<Json> {
public:
    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool start_object(std::size_t) override { return true; }
    bool key(string_t&) override { return true; }
    bool end_object() override { return true; }
    bool start_array(std::size_t) override { return true; }
    bool end_array() override { return true; }
    bool parse_error(std::size_t position, const std::string&, const Json::exception& error) override {
        const bool is_syntax = error.id != out_of_range;
        problem = is_syntax ? Problem{ProblemCode::bad_format, "JSON: syntax error at byte " + std::to_string(position),
                                      position}
                            : Problem{ProblemCode::bad_format, "JSON: a number is too large"};
        return false;
    }

    Problem problem;
};

}  // namespace

Result<Json> parse_json(std::string_view text) {
    Json json = Json::parse(text, nullptr, false);
    if (!json.is_discarded()) return json;
    // Without exceptions the parser that builds a value does not report where it failed.
    FirstError error;
    Json::sax_parse(text, &error);
    return std::move(error.problem);
}

}  // namespace abut::detail
