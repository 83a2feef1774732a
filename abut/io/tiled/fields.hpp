#pragma once

// Reads the attributes of Tiled's elements, from XML and JSON alike.

#include <abut/io/tiled/files.hpp>
#include <abut/io/tiled/map.hpp>
#include <abut/math/result.hpp>

#include <optional>
#include <string>

namespace abut::tiled {

/// Records the first error; reading continues with default values.
struct Defects {
    std::optional<Problem> first;

    void fail(ProblemCode code, std::string message) {
        if (!first) first = Problem{code, std::move(message)};
    }
};

/// Named values of one element, and its location in the file.
class Fields {
public:
    virtual ~Fields() = default;

    virtual bool has(const char* key) const = 0;
    /// Empty if there is no such value.
    virtual std::string text(const char* key) const = 0;
    /// Nothing if the value has another type.
    virtual std::optional<double> as_number(const char* key) const = 0;
    virtual std::optional<bool> as_flag(const char* key) const = 0;
    /// The location that begins a message: "line 12: ", "layers[2].objects[5]: ".
    virtual std::string where() const = 0;

    /// `default_value` if there is no such value; an error if it is not a finite number.
    double number(const char* key, double default_value, Defects& defects) const;
    bool flag(const char* key, bool default_value, Defects& defects) const;
    /// An integer from `min` to `max`.
    std::int64_t whole(const char* key, std::int64_t default_value, std::int64_t min, std::int64_t max,
                       Defects& defects) const;
    std::uint32_t count(const char* key, std::uint32_t default_value, Defects& defects) const;
};

// Each function changes only members that the element has values for.
void read_map(const Fields& fields, Map& map, Defects& defects);
void read_layer(const Fields& fields, Layer& layer, Defects& defects);
void read_tileset(const Fields& fields, Tileset& tileset, Defects& defects);
void read_object(const Fields& fields, Object& object, Defects& defects);
void read_type(const Fields& fields, std::string& type);

/// Adds a property, or replaces its value.
void set_property(std::vector<LevelProperty>& properties, LevelProperty property);

/// The shortest text that parses to the same number.
std::string shortest(double number);

/// Counts tiles and objects of a map against the limits.
class Budget {
public:
    /// Counts a rectangle of tiles, before memory for it is allocated.
    bool take_tiles(const Cells& cells, const std::string& where, Defects& defects);
    bool take_object(const std::string& where, Defects& defects);

private:
    std::uint64_t tiles_ = 0;
    std::size_t objects_ = 0;
};

/// Creates an object from its template, with its gid converted to this map's numbering. Adds the template's tileset to
/// the map if necessary.
Object instantiate_template(const std::string& name, Map& map, Files& files, const std::string& where,
                            Defects& defects);

/// Adds a tileset from a file of its own to the map.
void add_tileset(const std::string& name, std::uint32_t first_gid, Map& map, Files& files, const std::string& where,
                 Defects& defects);

}  // namespace abut::tiled
