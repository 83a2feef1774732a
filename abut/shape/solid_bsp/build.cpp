#include <abut/shape/solid_bsp/tree.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::detail {
namespace {

constexpr std::size_t max_candidates = 24;               ///< faces whose planes are candidates
constexpr std::size_t max_samples = 192;                 ///< faces on which a candidate is evaluated
constexpr double cut_cost = 4;                           ///< cost of a cut face, relative to one face of imbalance
constexpr std::size_t max_faces_without_axis_plane = 8;  ///< up to this count no axis-aligned plane is tried

template <int D>
class Builder {
public:
    using Fragment = SolidFragment<D>;

    Builder(SolidTree<D>& tree, SolidBuild<D>& build) : tree_(tree), build_(build) {}

    std::uint32_t grow(std::vector<Fragment> here, std::size_t depth) {
        tree_.depth = std::max(tree_.depth, depth + 1);
        const auto index = static_cast<std::uint32_t>(tree_.nodes.size());
        tree_.nodes.emplace_back();
        Parts parts = part(std::move(here));
        tree_.nodes[index].plane = parts.plane;
        tree_.nodes[index].first_piece = static_cast<std::uint32_t>(tree_.pieces.size());
        tree_.nodes[index].pieces = static_cast<std::uint32_t>(parts.in_plane.size());
        for (const Fragment& fragment : parts.in_plane) add_piece(fragment);

        // A side without faces is uniformly solid or open; any face in the plane decides.
        const bool last = depth + 1 == solid_depth;
        SolidSides sides;
        if (last || parts.front.empty() || parts.back.empty()) sides = beside(parts);
        const auto child = [&](std::vector<Fragment>& faces, bool solid) {
            if (last || faces.empty()) return solid ? solid_leaf : open_leaf;
            return grow(std::move(faces), depth + 1);
        };
        const std::uint32_t front = child(parts.front, sides.front);
        const std::uint32_t back = child(parts.back, sides.back);
        tree_.nodes[index].front = front;
        tree_.nodes[index].back = back;
        return index;
    }

private:
    struct Parts {
        SolidPlane<D> plane;
        std::vector<Fragment> front, back, in_plane;
    };
    struct Candidate {
        SolidPlane<D> plane;
        std::uint32_t face = no_index;  ///< face in the plane
        double cost = std::numeric_limits<double>::infinity();
    };

    Parts part(std::vector<Fragment> here) const {
        const Candidate face = best_face(here);
        Candidate across;
        if (here.size() > max_faces_without_axis_plane) across = best_across(here);
        if (across.cost < face.cost) {
            Parts parts = part_by(across, std::vector<Fragment>(here));
            // If a face lies in the plane, the face's own plane is better.
            if (!parts.in_plane.empty()) return part_by(candidate(parts.in_plane[0].face), std::move(here));
            const std::size_t max_side = here.size() - here.size() / 8;
            if (!parts.front.empty() && !parts.back.empty() && parts.front.size() < max_side &&
                parts.back.size() < max_side)
                return parts;
        }
        return part_by(face, std::move(here));
    }

    Candidate candidate(std::uint32_t face) const { return {build_.plane(face), face}; }

    Parts part_by(const Candidate& candidate, std::vector<Fragment> here) const {
        Parts parts;
        parts.plane = candidate.plane;
        CutFragment<D> pieces;
        for (Fragment& fragment : here) {
            // A face lies in its own plane, regardless of rounding.
            if (fragment.face == candidate.face) {
                parts.in_plane.push_back(std::move(fragment));
                continue;
            }
            cut(tree_, parts.plane, build_.margin, std::move(fragment), pieces);
            if (pieces.in_plane) {
                parts.in_plane.push_back(std::move(pieces.front));
                continue;
            }
            if (!pieces.front.corners.empty()) parts.front.push_back(std::move(pieces.front));
            if (!pieces.back.corners.empty()) parts.back.push_back(std::move(pieces.back));
        }
        return parts;
    }

    /// The cost of a plane, by sampling faces in double arithmetic.
    double cost(const SolidPlane<D>& plane, const std::vector<Fragment>& here) const {
        const std::size_t stride = here.size() / max_samples | 1u;
        const double tolerance = build_.margin * length(plane.normal);
        double front = 0, back = 0, cuts = 0;
        for (std::size_t i = 0; i < here.size(); i += stride) {
            double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
            for (const SolidCorner<D>& corner : here[i].corners) {
                const double height = dot(plane.normal, corner.position) - plane.offset;
                lowest = std::min(lowest, height);
                highest = std::max(highest, height);
            }
            front += highest > tolerance ? 1 : 0;
            back += lowest < -tolerance ? 1 : 0;
            cuts += highest > tolerance && lowest < -tolerance ? 1 : 0;
        }
        return std::abs(front - back) + cut_cost * cuts;
    }

    Candidate best_face(const std::vector<Fragment>& here) const {
        Candidate best;
        const std::size_t tries = std::min(here.size(), max_candidates);
        for (std::size_t i = 0; i < tries; ++i) {
            Candidate next = candidate(here[i * here.size() / tries].face);
            next.cost = cost(next.plane, here);
            if (next.cost < best.cost) best = next;
        }
        return best;
    }

    /// The best axis-aligned plane through the median. It costs an eighth of the faces more, since it resolves none.
    Candidate best_across(const std::vector<Fragment>& here) const {
        Candidate best;
        std::vector<double> middles;
        const std::size_t stride = here.size() / max_samples | 1u;
        for (int axis = 0; axis < D; ++axis) {
            middles.clear();
            for (std::size_t i = 0; i < here.size(); i += stride) {
                double sum = 0;
                for (const SolidCorner<D>& corner : here[i].corners) sum += corner.position[axis];
                middles.push_back(sum / static_cast<double>(here[i].corners.size()));
            }
            const auto half = middles.begin() + static_cast<std::ptrdiff_t>(middles.size() / 2);
            std::nth_element(middles.begin(), half, middles.end());
            Candidate next{plane_across<D>(axis, static_cast<float>(*half))};
            next.cost = cost(next.plane, here) + static_cast<double>(middles.size()) / 8;
            if (next.cost < best.cost) best = next;
        }
        return best;
    }

    SolidSides beside(const Parts& parts) const {
        constexpr std::size_t tries = 5;
        for (std::size_t i = 0; i < tries; ++i)
            for (const Fragment& fragment : parts.in_plane)
                if (const auto sides = build_.sides(inner_point(fragment, i), parts.plane)) return *sides;
        return {};
    }

    /// Sample point `which` inside a piece.
    static DVec<D> inner_point(const Fragment& fragment, std::size_t which) {
        DVec<D> sum(0.0);
        double weights = 0;
        for (std::size_t i = 0; i < fragment.corners.size(); ++i) {
            const double weight = which == 0 ? 1.0 : 1.0 + static_cast<double>((7 * i + 3 * which) % 5);
            sum += fragment.corners[i].position * weight;
            weights += weight;
        }
        return sum / weights;
    }

    void add_piece(const Fragment& fragment) {
        tree_.pieces.push_back({fragment.face, static_cast<std::uint32_t>(tree_.corners.size()),
                                static_cast<std::uint32_t>(fragment.corners.size())});
        for (const SolidCorner<D>& corner : fragment.corners) tree_.corners.push_back(to_float(corner.position));
    }

    SolidTree<D>& tree_;
    SolidBuild<D>& build_;
};

}  // namespace

template <int D>
void build_tree(SolidTree<D>& tree, SolidBuild<D> build) {
    if (build.fragments.empty()) return;
    for (const SolidFragment<D>& fragment : build.fragments)
        for (const SolidCorner<D>& corner : fragment.corners) {
            const Vec<D> point = to_float(corner.position);
            tree.bounds = merged(tree.bounds, Aabb<D>{point, point});
        }
    std::vector<SolidFragment<D>> fragments = std::move(build.fragments);
    tree.root = Builder<D>(tree, build).grow(std::move(fragments), 0);
}

template void build_tree(SolidTree<2>&, SolidBuild<2>);
template void build_tree(SolidTree<3>&, SolidBuild<3>);

}  // namespace abut::detail
