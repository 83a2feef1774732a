#pragma once

// XML documents parsed by pugixml, with line numbers for messages. Included by .cpp files only.

#include <abut/math/result.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

namespace abut::detail {

class Xml {
public:
    /// Returns a Problem (`bad_format`) with the line number if the document is not well-formed.
    static Result<std::unique_ptr<Xml>> parse(std::span<const std::byte> bytes) {
        auto xml = std::unique_ptr<Xml>(new Xml);
        for (std::size_t i = 0; i < bytes.size(); ++i)
            if (bytes[i] == std::byte{'\n'}) xml->line_ends_.push_back(static_cast<std::ptrdiff_t>(i));
        const pugi::xml_parse_result result = xml->document_.load_buffer(bytes.data(), bytes.size());
        if (result) return xml;
        if (result.status == pugi::status_out_of_memory)
            return Problem{ProblemCode::too_large, "needs more memory than there is"};
        return Problem{ProblemCode::bad_format, xml->line(result.offset) + "XML: " + lower_first(result.description())};
    }

    pugi::xml_node root() const { return document_.document_element(); }

    /// "line 12: ", or empty if the line is unknown.
    std::string line(const pugi::xml_node& node) const { return line(node.offset_debug()); }

private:
    Xml() = default;

    std::string line(std::ptrdiff_t offset) const {
        if (offset < 0) return {};
        const auto after = std::lower_bound(line_ends_.begin(), line_ends_.end(), offset);
        return "line " + std::to_string(after - line_ends_.begin() + 1) + ": ";
    }
    static std::string lower_first(std::string text) {
        if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') text[0] = static_cast<char>(text[0] - 'A' + 'a');
        return text;
    }

    pugi::xml_document document_;
    std::vector<std::ptrdiff_t> line_ends_;
};

}  // namespace abut::detail
