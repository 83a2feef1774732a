#include "tool/page/page_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace abut::tool {
namespace {

// Limits of the page's size. A triangle takes about 20 bytes, a pose 64, an object about 100.
constexpr std::size_t max_party_facets = 100'000, max_context_facets = 40'000, max_facets_of_context = 500;
constexpr std::size_t max_poses = 20'000, max_samples = 240, max_objects = 10'000, max_party = 50;
// Objects nearest to these findings are shown first.
constexpr std::size_t max_places = 200;

template <int D>
Vec<D> position_of(const Finding& finding) {
    Vec<D> result{};
    for (int i = 0; i < D && static_cast<std::size_t>(i) < finding.position.size(); ++i)
        result[i] = static_cast<float>(finding.position[static_cast<std::size_t>(i)]);
    return result;
}

template <int D>
float distance(const Aabb<D>& box, const Vec<D>& point) {
    return glm::distance(point, glm::clamp(point, box.min, box.max));
}

// Collects what the page shows, the objects of findings first.
template <int D>
class Selection {
public:
    Selection(PageScene<D>& scene, std::span<const Finding> findings)
        : scene_(scene), findings_(findings), entries_(scene.size()) {}

    Json json(std::vector<std::vector<std::vector<std::uint32_t>>>& parties);

private:
    struct Entry {
        bool is_party = false;
        std::size_t facets = 0;  // the number shown; 0: its box
        float distance = std::numeric_limits<float>::infinity();
        std::vector<Vec<D>> places;  // of findings, in its own coordinates
        Aabb<D> box;
        std::vector<float> poses;
    };

    std::vector<std::size_t> objects_at(const std::string& path) const;
    void find_parties();
    void find_places();
    void choose_facets();
    std::vector<double> samples();

    PageScene<D>& scene_;
    std::span<const Finding> findings_;
    std::vector<Entry> entries_;
    std::vector<std::vector<std::vector<std::size_t>>> parties_;
};

// Paths are sorted, and those below "A" begin with "A/".
template <int D>
std::vector<std::size_t> Selection<D>::objects_at(const std::string& path) const {
    const auto first_from = [&](const std::string& from) {
        std::size_t low = 0, high = scene_.size();
        while (low < high) {
            const std::size_t middle = (low + high) / 2;
            if (scene_.path(middle) < from)
                low = middle + 1;
            else
                high = middle;
        }
        return low;
    };
    std::vector<std::size_t> result;
    if (const std::size_t i = first_from(path); i < scene_.size() && scene_.path(i) == path) result.push_back(i);
    const std::string below = path + "/";
    for (std::size_t i = first_from(below); i < scene_.size() && scene_.path(i).starts_with(below); ++i)
        if (result.size() < max_party) result.push_back(i);
    return result;
}

template <int D>
void Selection<D>::find_parties() {
    for (const Finding& finding : findings_) {
        auto& parties = parties_.emplace_back();
        for (const ObjectName& object : finding.objects) {
            if (parties.size() == max_party) break;
            parties.push_back(objects_at(object.path));
            for (const std::size_t i : parties.back()) entries_[i].is_party = true;
        }
    }
}

template <int D>
void Selection<D>::find_places() {
    std::map<double, std::vector<std::size_t>> at_time;
    for (std::size_t i = 0; i < findings_.size(); ++i) at_time[findings_[i].time].push_back(i);
    for (const auto& [time, findings] : at_time) {
        scene_.go_to(time);
        for (const std::size_t finding : findings) {
            const Vec<D> position = position_of<D>(findings_[finding]);
            for (const auto& party : parties_[finding])
                for (const std::size_t i : party)
                    if (const std::optional<Vec<D>> local = scene_.local(i, position))
                        entries_[i].places.push_back(*local);
        }
    }
    scene_.go_to(scene_.times().front());
    for (std::size_t i = 0; i < scene_.size(); ++i) {
        entries_[i].box = scene_.box(i);
        for (std::size_t finding = 0; finding < std::min(findings_.size(), max_places); ++finding)
            entries_[i].distance =
                std::min(entries_[i].distance, distance(entries_[i].box, position_of<D>(findings_[finding])));
    }
}

// Parties share the facets: what a small one leaves, the larger ones have. Then others, the nearest first.
template <int D>
void Selection<D>::choose_facets() {
    std::vector<std::size_t> of_parties, others;
    for (std::size_t i = 0; i < scene_.size(); ++i) (entries_[i].is_party ? of_parties : others).push_back(i);
    std::stable_sort(of_parties.begin(), of_parties.end(),
                     [&](std::size_t i, std::size_t j) { return scene_.count_facets(i) < scene_.count_facets(j); });
    std::size_t left = max_party_facets;
    for (std::size_t n = 0; n < of_parties.size(); ++n) {
        Entry& entry = entries_[of_parties[n]];
        entry.facets = std::min(scene_.count_facets(of_parties[n]), left / (of_parties.size() - n));
        left -= entry.facets;
    }
    std::stable_sort(others.begin(), others.end(),
                     [&](std::size_t i, std::size_t j) { return entries_[i].distance < entries_[j].distance; });
    left = max_context_facets;
    for (const std::size_t i : others) {
        const std::size_t facets = scene_.count_facets(i);
        if (facets > max_facets_of_context || facets > left) continue;
        entries_[i].facets = facets;
        left -= facets;
    }
}

// Stores the poses of all objects that have a shape, at some of the times and those of findings.
template <int D>
std::vector<double> Selection<D>::samples() {
    std::vector<double> times = scene_.times();
    for (const Finding& finding : findings_)
        if (times.size() > 1) times.push_back(std::clamp(finding.time, times.front(), scene_.times().back()));
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    std::size_t shapes = 0;
    for (const Entry& entry : entries_) shapes += entry.facets > 0 ? 1 : 0;
    const std::size_t count = std::clamp(max_poses / std::max<std::size_t>(shapes, 1), std::size_t{2}, max_samples);
    std::vector<double> result;
    for (std::size_t i = 0; i < std::min(count, times.size()); ++i)
        result.push_back(times.size() <= count ? times[i] : times[i * (times.size() - 1) / (count - 1)]);
    for (const double time : result) {
        scene_.go_to(time);
        for (std::size_t i = 0; i < scene_.size(); ++i) {
            if (entries_[i].facets == 0) continue;
            const std::vector<float> pose = scene_.pose(i);
            entries_[i].poses.insert(entries_[i].poses.end(), pose.begin(), pose.end());
        }
    }
    for (Entry& entry : entries_) {
        const std::size_t size = entry.poses.size() / std::max<std::size_t>(result.size(), 1);
        bool rests = true;
        for (std::size_t i = size; i < entry.poses.size(); ++i)
            rests = rests && entry.poses[i] == entry.poses[i - size];
        if (rests) entry.poses.resize(size);
    }
    return result;
}

template <int D>
Json Selection<D>::json(std::vector<std::vector<std::vector<std::uint32_t>>>& parties) {
    find_parties();
    find_places();
    choose_facets();
    const std::vector<double> times = samples();

    std::vector<std::size_t> order(scene_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
        const auto rank = [&](std::size_t k) {
            return std::pair(entries_[k].is_party ? 0 : entries_[k].facets > 0 ? 1 : 2, entries_[k].distance);
        };
        return rank(i) < rank(j);
    });
    order.resize(std::min(order.size(), max_objects));
    std::vector<std::uint32_t> number_of(scene_.size(), max_objects);
    Json objects = Json::array();
    for (const std::size_t i : order) {
        const Entry& entry = entries_[i];
        number_of[i] = static_cast<std::uint32_t>(objects.size());
        Json box = numbers(entry.box.min);
        for (const Json& number : numbers(entry.box.max)) box.push_back(number);
        Json& object = objects.emplace_back(Json{{"name", entry.is_party ? scene_.path(i) : ""}, {"box", box}});
        if (entry.facets == 0) continue;
        const Facets<D> shape = scene_.shape(i);
        object["mesh"] = mesh_json(shape, nearest_facets(shape, entry.places, entry.facets));
        if (scene_.is_filled(i)) object["mesh"]["filled"] = true;
        if (!entry.poses.empty()) object["poses"] = base64_floats(entry.poses);
    }
    parties.clear();
    for (const auto& of_finding : parties_) {
        auto& lists = parties.emplace_back();
        for (const std::vector<std::size_t>& party : of_finding) {
            std::vector<std::uint32_t>& list = lists.emplace_back();
            for (const std::size_t i : party)
                if (number_of[i] < max_objects) list.push_back(number_of[i]);
        }
    }
    return {{"objects", std::move(objects)}, {"objects_left_out", scene_.size() - order.size()}, {"samples", times}};
}

}  // namespace

PageScene3::PageScene3(const Scene& scene, const SceneObjects& objects, const std::vector<double>& times)
    : scene_(scene), objects_(objects), times_(times), nodes_(objects.size()) {
    std::map<std::string_view, std::size_t> object_at;
    for (std::size_t i = 0; i < objects.size(); ++i) object_at[objects[i].path] = i;
    for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
        const auto found = object_at.find(abut::path(scene, node));
        if (found != object_at.end()) nodes_[found->second] = node;
    }
    go_to(times.front());
}

Facets<3> PageScene3::shape(std::size_t object) const {
    const Welded& surface = objects_.surface(object);
    Facets<3> result{surface.points, {}};
    result.facets.reserve(surface.triangles.size());
    for (const glm::uvec3& t : surface.triangles) result.facets.push_back({t.x, t.y, t.z});
    return result;
}

std::vector<float> PageScene3::pose(std::size_t object) const {
    std::vector<float> result;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row) result.push_back(static_cast<float>(matrix(object)[column][row]));
    return result;
}

std::optional<Vec3> PageScene3::local(std::size_t object, const Vec3& point) const {
    const Vec3 local(glm::inverse(matrix(object)) * glm::dvec4(glm::dvec3(point), 1.0));
    if (!detail::is_finite(local)) return std::nullopt;
    return local;
}

Aabb3 PageScene3::box(std::size_t object) const {
    Aabb3 result = Aabb3::empty();
    for (const Vec3& point : objects_.surface(object).points) {
        const Vec3 p(matrix(object) * glm::dvec4(glm::dvec3(point), 1.0));
        result = merged(result, Aabb3{p, p});
    }
    return result;
}

template <int D>
Json scene_json(PageScene<D>& scene, std::span<const Finding> findings,
                std::vector<std::vector<std::vector<std::uint32_t>>>& parties) {
    return Selection<D>(scene, findings).json(parties);
}

template Json scene_json(PageScene<2>&, std::span<const Finding>,
                         std::vector<std::vector<std::vector<std::uint32_t>>>&);
template Json scene_json(PageScene<3>&, std::span<const Finding>,
                         std::vector<std::vector<std::vector<std::uint32_t>>>&);

}  // namespace abut::tool
