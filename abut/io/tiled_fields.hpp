#pragma once

// What the elements of a Tiled file tell of themselves, read from XML and JSON alike.

#include <abut/io/tiled_files.hpp>
#include <abut/io/tiled_map.hpp>
#include <abut/math/result.hpp>

#include <optional>
#include <string>

namespace abut::tiled {

/// The first defect that was found; what is read after it is read as if it weren't there.
struct Defects {
    std::optional<Problem> first;

    void fail(ProblemCode code, std::string message) {
        if (!first) first = Problem{code, std::move(message)};
    }
};

/// The values of one element by their names, and where it is in its file.
class Fields {
public:
    virtual ~Fields() = default;

    virtual bool has(const char* key) const = 0;
    /// Empty where there is none.
    virtual std::string text(const char* key) const = 0;
    /// Nothing where the value is none.
    virtual std::optional<double> as_number(const char* key) const = 0;
    virtual std::optional<bool> as_flag(const char* key) const = 0;
    /// The begin of a message: "line 12: ", "layers[2].objects[5]: ".
    virtual std::string where() const = 0;

    /// `otherwise` where there is none; a defect where it is none, or not finite.
    double number(const char* key, double otherwise, Defects& defects) const;
    bool flag(const char* key, bool otherwise, Defects& defects) const;
    /// A whole number from `least` to `most`.
    std::int64_t whole(const char* key, std::int64_t otherwise, std::int64_t least, std::int64_t most,
                       Defects& defects) const;
    std::uint32_t count(const char* key, std::uint32_t otherwise, Defects& defects) const;
};

// Each changes only what the element tells.
void read_map(const Fields& fields, Map& map, Defects& defects);
void read_layer(const Fields& fields, Layer& layer, Defects& defects);
void read_tileset(const Fields& fields, Tileset& tileset, Defects& defects);
void read_object(const Fields& fields, Object& object, Defects& defects);
void read_type(const Fields& fields, std::string& type);

/// A property is set, or set anew.
void set_property(std::vector<LevelProperty>& properties, LevelProperty property);

/// The shortest text that is read as this number.
std::string shortest(double number);

/// Counts what a map asks for, against the limits.
class Budget {
public:
    /// For a rectangle of tiles, before anything is made of it.
    bool take_tiles(const Cells& cells, const std::string& where, Defects& defects);
    bool take_object(const std::string& where, Defects& defects);

private:
    std::uint64_t tiles_ = 0;
    std::size_t objects_ = 0;
};

/// Begins an object as its template has it, with the gid that it has in this map, whose tilesets may become one more.
Object from_template(const std::string& name, Map& map, Files& files, const std::string& where, Defects& defects);

/// Takes a tileset into the map that is in a file of its own.
void take_tileset(const std::string& name, std::uint32_t first_gid, Map& map, Files& files, const std::string& where,
                  Defects& defects);

}  // namespace abut::tiled
