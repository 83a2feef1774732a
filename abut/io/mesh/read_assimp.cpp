#include <abut/io/mesh/assimp_files-inl.h>
#include <abut/io/mesh/read_assimp.hpp>

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

namespace abut::detail {
namespace {

// Assimp's default if a file has no rate of its own.
constexpr double default_ticks_per_second = 25;

std::string text(const aiString& string) {
    return {string.data, string.length};
}

Vec3 vec(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

glm::dmat4 matrix(const aiMatrix4x4& from) {
    glm::dmat4 result;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            result[column][row] = static_cast<double>(from[static_cast<unsigned>(row)][column]);
    return result;
}

glm::dvec3 value(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}
glm::dquat value(const aiQuaternion& q) {
    return glm::dquat(glm::qua<float>(q.w, q.x, q.y, q.z));
}

// Some Assimp importers return keys out of order.
template <class Value, class Key>
void read_track(KeyTrack<Value>& track, std::span<Key> keys, double ticks_per_second) {
    std::stable_sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) { return a.mTime < b.mTime; });
    for (const Key& key : keys) {
        track.times.push_back(key.mTime / ticks_per_second);
        track.values.push_back(value(key.mValue));
    }
}

template <class Value>
double end_of(const KeyTrack<Value>& track) {
    return track.times.empty() ? 0 : track.times.back();
}

// Assimp's messages may span several lines.
Problem importer_problem(const Assimp::Importer& importer) {
    std::string reason = importer.GetErrorString();
    std::replace_if(
        reason.begin(), reason.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    if (reason == std::bad_alloc().what()) return {ProblemCode::too_large, "needs more memory than there is"};
    while (!reason.empty() && (reason.back() == ' ' || reason.back() == '.')) reason.pop_back();
    return {ProblemCode::bad_format, reason.empty() ? "can't be read" : reason};
}

// True if all corners of the polygon are collinear. Checked before Assimp triangulates it.
bool has_no_area(const aiMesh& mesh, const aiFace& face) {
    const Vec3 first = vec(mesh.mVertices[face.mIndices[0]]);
    Vec3 farthest = first;
    const auto distance = [&](const Vec3& p) { return std::hypot(p.x - first.x, p.y - first.y, p.z - first.z); };
    for (unsigned i = 1; i < face.mNumIndices; ++i) {
        const Vec3 corner = vec(mesh.mVertices[face.mIndices[i]]);
        if (distance(corner) > distance(farthest)) farthest = corner;
    }
    for (unsigned i = 1; i < face.mNumIndices; ++i)
        if (!has_zero_area(first, farthest, vec(mesh.mVertices[face.mIndices[i]]))) return false;
    return true;
}

class Reader {
public:
    Reader(const aiScene& from, std::string extension, std::string stem, const ReadOptions& options)
        : from_(from), extension_(std::move(extension)), stem_(std::move(stem)), options_(options) {}

    // Call in this order; Assimp triangulates between the two calls.
    std::optional<Problem> check_faces();
    Scene read();

private:
    std::string name_of(const aiMesh& mesh) const { return mesh.mName.length == 0 ? stem_ : text(mesh.mName); }
    std::string name_of(const aiNode& node) const;
    void warn_once(const std::string& warning) {
        if (std::find(scene_.warnings.begin(), scene_.warnings.end(), warning) == scene_.warnings.end())
            scene_.warnings.push_back(warning);
    }
    void read_mesh(const aiMesh& mesh, bool was_cut, std::uint64_t left_out);
    void read_nodes();
    void read_animation(const aiAnimation& animation);

    const aiScene& from_;
    std::string extension_;
    std::string stem_;
    const ReadOptions& options_;
    Scene scene_;
    std::vector<bool> was_cut_;            // for each mesh: true if it has polygons
    std::vector<std::uint64_t> left_out_;  // for each such mesh: count of polygons of zero area
    struct Named {
        std::uint32_t first = 0;
        bool is_unique = true;
    };
    std::unordered_map<std::string, Named> node_named_;  // Assimp's animations refer to nodes by name
};

std::optional<Problem> Reader::check_faces() {
    for (unsigned m = 0; m < from_.mNumMeshes; ++m) {
        const aiMesh& mesh = *from_.mMeshes[m];
        was_cut_.push_back(false);
        std::uint64_t without_area = 0;
        for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
            const aiFace& face = mesh.mFaces[i];
            for (unsigned k = 0; k < face.mNumIndices; ++k)
                if (face.mIndices[k] >= mesh.mNumVertices)
                    return Problem{ProblemCode::index_out_of_range,
                                   "mesh '" + name_of(mesh) + "', face " + std::to_string(i) + ": index " +
                                       std::to_string(face.mIndices[k]) + " is out of range (" +
                                       std::to_string(mesh.mNumVertices) + " vertices)",
                                   i};
            if (face.mNumIndices > 3) was_cut_.back() = true;
            if (options_.keep_degenerate || face.mNumIndices < 3 || !has_no_area(mesh, face)) continue;
            if (options_.strict)
                return Problem{ProblemCode::degenerate,
                               "mesh '" + name_of(mesh) + "', " + (face.mNumIndices == 3 ? "triangle " : "polygon ") +
                                   std::to_string(i) + ": zero area",
                               i};
            ++without_area;
        }
        // finish_scene counts those of meshes without polygons.
        left_out_.push_back(was_cut_.back() ? without_area : 0);
    }
    return std::nullopt;
}

void Reader::read_mesh(const aiMesh& mesh, bool was_cut, std::uint64_t left_out) {
    Geometry geometry{name_of(mesh), {}, {}};
    geometry.left_out = left_out;
    geometry.points.reserve(mesh.mNumVertices);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) geometry.points.push_back(vec(mesh.mVertices[i]));
    if (options_.normals && mesh.HasNormals())
        for (unsigned i = 0; i < mesh.mNumVertices; ++i) geometry.normals.push_back(vec(mesh.mNormals[i]));
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        if (face.mNumIndices != 3) {
            warn_once("points and lines are left out: only triangles collide");
            continue;
        }
        const glm::uvec3 t{face.mIndices[0], face.mIndices[1], face.mIndices[2]};
        // Triangulating a polygon with collinear corners yields such triangles; the others cover the polygon.
        if (!options_.keep_degenerate && was_cut &&
            has_zero_area(geometry.points[t.x], geometry.points[t.y], geometry.points[t.z]))
            continue;
        geometry.triangles.push_back(t);
    }
    if (mesh.HasBones()) warn_once("skinned meshes are taken in their bind pose");
    if (mesh.mNumAnimMeshes > 0) warn_once("morph targets are left out: such meshes are taken in their base shape");
    scene_.geometries.push_back(std::move(geometry));
}

// Empty for a node without a name from the author: roots that importers add, and the helper nodes of FBX transforms.
std::string Reader::name_of(const aiNode& node) const {
    std::string name = text(node.mName);
    if (name.find("_$AssimpFbx$_") != std::string::npos) return {};
    const bool bracketed = name.size() >= 2 && name.front() == '<' && name.back() == '>';
    if (bracketed) return {};
    if (node.mParent != nullptr || node.mNumMeshes > 0) return name;
    const bool collada = extension_ == ".dae" || extension_ == ".zae";
    const bool synthetic = collada || name == "ROOT" || name == "RootNode" || name == "Root" || name == stem_ ||
                           name == stem_ + extension_ || name.starts_with('$');
    return synthetic ? std::string() : name;
}

void Reader::read_nodes() {
    struct StackEntry {
        const aiNode* node;
        std::uint32_t parent;
    };
    std::vector<StackEntry> stack{{from_.mRootNode, SceneNode::no_parent}};
    while (!stack.empty()) {
        const auto [from, parent] = stack.back();
        stack.pop_back();
        SceneNode node;
        node.name = name_of(*from);
        node.parent = parent;
        node.local = matrix(from->mTransformation);
        for (unsigned i = 0; i < from->mNumMeshes; ++i)
            if (from->mMeshes[i] < from_.mNumMeshes) node.geometries.push_back(from->mMeshes[i]);
        const auto index = static_cast<std::uint32_t>(scene_.nodes.size());
        const auto [named, is_new] = node_named_.try_emplace(text(from->mName), Named{index});
        named->second.is_unique = is_new;
        for (unsigned i = from->mNumChildren; i-- > 0;) stack.push_back({from->mChildren[i], index});
        scene_.nodes.push_back(std::move(node));
    }
}

void Reader::read_animation(const aiAnimation& from) {
    const double ticks = from.mTicksPerSecond > 0 ? from.mTicksPerSecond : default_ticks_per_second;
    Animation animation;
    animation.name = text(from.mName);
    for (unsigned i = 0; i < from.mNumChannels; ++i) {
        const aiNodeAnim& channel = *from.mChannels[i];
        const auto node = node_named_.find(text(channel.mNodeName));
        if (node == node_named_.end()) continue;
        if (!node->second.is_unique)
            warn_once("several nodes are named '" + node->first + "': the first is taken for the one that moves");
        NodeMotion motion{.node = node->second.first, .translation = {}, .rotation = {}, .scale = {}};
        read_track(motion.translation, std::span(channel.mPositionKeys, channel.mNumPositionKeys), ticks);
        read_track(motion.rotation, std::span(channel.mRotationKeys, channel.mNumRotationKeys), ticks);
        read_track(motion.scale, std::span(channel.mScalingKeys, channel.mNumScalingKeys), ticks);
        animation.length =
            std::max({animation.length, end_of(motion.translation), end_of(motion.rotation), end_of(motion.scale)});
        animation.motions.push_back(std::move(motion));
    }
    if (!animation.motions.empty()) scene_.animations.push_back(std::move(animation));
}

Scene Reader::read() {
    for (unsigned i = 0; i < from_.mNumMeshes; ++i) read_mesh(*from_.mMeshes[i], was_cut_[i], left_out_[i]);
    read_nodes();
    for (unsigned i = 0; i < from_.mNumAnimations; ++i) read_animation(*from_.mAnimations[i]);
    return std::move(scene_);
}

// `import` passes the file or the bytes to Assimp. Without a file, Assimp opens none.
template <class ReadFile>
Result<ReadScene> read_with(const std::filesystem::path& file, const std::string& extension, const std::string& stem,
                            const ReadOptions& options, ReadFile import) {
    auto* const files = new AssimpFiles(file, options.allow_outside);
    Assimp::Importer importer;
    importer.SetIOHandler(files);  // takes ownership
    importer.SetPropertyBool(AI_CONFIG_IMPORT_MD3_LOAD_SHADERS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
    const aiScene* scene = import(importer);
    if (!file.empty() && files->refused()) return *files->refused();
    if (scene == nullptr || scene->mRootNode == nullptr) return importer_problem(importer);
    Reader reader(*scene, extension, stem, options);
    if (std::optional<Problem> problem = reader.check_faces()) return *std::move(problem);
    if (scene->mNumMeshes > 0 && importer.ApplyPostProcessing(aiProcess_Triangulate) == nullptr)
        return importer_problem(importer);
    return ReadScene{reader.read(), {}};
}

}  // namespace

bool assimp_knows(const std::string& extension) {
    return Assimp::Importer().IsExtensionSupported(extension);
}

Result<ReadScene> read_assimp(const std::filesystem::path& file, const ReadOptions& options) {
    return read_with(file, file.extension().string(), file.stem().string(), options,
                     [&](Assimp::Importer& importer) { return importer.ReadFile(file.string(), 0); });
}

Result<ReadScene> read_assimp(std::span<const std::byte> bytes, const std::string& extension,
                              const ReadOptions& options) {
    return read_with({}, extension, "scene", options, [&](Assimp::Importer& importer) {
        return importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, extension.c_str());
    });
}

}  // namespace abut::detail
