#include <abut/io/finish_level.hpp>

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace abut::detail {
namespace {

class Paths {
public:
    // The first object or point with a path keeps it; later ones get a number as suffix.
    template <class Named>
    void make_unique(Named& named) {
        if (taken_.insert(named.path).second) return;
        std::size_t& number = numbers_.try_emplace(named.path, 2).first->second;
        std::string suffix;
        do suffix = "#" + std::to_string(number++);
        while (!taken_.insert(named.path + suffix).second);
        named.path += suffix;
        named.name += suffix;
    }

private:
    std::unordered_set<std::string> taken_;
    std::unordered_map<std::string, std::size_t> numbers_;  ///< the next suffix to try
};

}  // namespace

void LeftOut::add(const char* one, const char* many, const char* what, const std::string& such_as) {
    const auto known = std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& kind) {
        return std::string_view(kind.one) == one && std::string_view(kind.what) == what;
    });
    if (known != kinds_.end())
        ++known->count;
    else
        kinds_.push_back({one, many, what, 1, such_as});
}

std::vector<std::string> LeftOut::lines() const {
    std::vector<std::string> result;
    for (const Kind& kind : kinds_)
        result.push_back(std::to_string(kind.count) + " " + (kind.count == 1 ? kind.one : kind.many) + " " + kind.what +
                         (kind.count == 1 ? ": '" : ", such as '") + kind.first + "'");
    return result;
}

Result<Level> finish_level(Level level) {
    if (level.objects.empty() && level.points.empty())
        return Problem{ProblemCode::empty_input, "no shapes in it: 0 objects"};
    Paths paths;
    for (LevelObject& object : level.objects) paths.make_unique(object);
    for (LevelPoint& point : level.points) paths.make_unique(point);
    return level;
}

}  // namespace abut::detail
