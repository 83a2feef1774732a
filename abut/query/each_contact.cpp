#include <abut/query/each_contact.hpp>
#include <abut/query/felt_contact.hpp>
#include <abut/query/one_sided.hpp>
#include <abut/query/write_answer.hpp>

namespace abut {
namespace {

/// What has been told of, as far as there is room: what is left out for it is told of twice.
template <int D>
class ToldNormals {
public:
    void add(const DVec<D>& normal, double depth) {
        if (count_ < told_.size()) told_[count_++] = {normal, depth};
    }
    /// Whether that tells of this one as well.
    bool has(const DVec<D>& normal, double depth, double size) const {
        return std::any_of(told_.begin(), told_.begin() + static_cast<std::ptrdiff_t>(count_),
                           [&](const Told& told) { return tells_of(told.normal, told.depth, normal, depth, size); });
    }

private:
    struct Told {
        DVec<D> normal;
        double depth;
    };
    std::array<Told, 16> told_;
    std::size_t count_ = 0;
};

}  // namespace

template <int D>
void each_contact_of(const View<D>& a, const View<D>& b, const QueryOptions<D>& options,
                     FunctionRef<bool(const Contact<D>&)> visit) {
    const bool finite = is_finite(a) && is_finite(b);
    ABUT_ASSERT(finite);
    if (!finite) return;
    const double margin = static_cast<double>(options.margin);
    const SearchOptions<D> search = search_options(a, b, options);
    const FeltPair<D> felt(a, b);
    ToldNormals<D> told;
    bool go_on = true;
    std::size_t ghosts = 0;
    // First what is felt as it is; then, if there are others, what those stand for.
    const auto look = [&](bool at_ghosts) {
        each_part_pair(
            a, b, options.margin,
            [&](const auto& part_a, std::uint32_t index_a, const auto& part_b, std::uint32_t index_b) {
                PartContact<D> found;
                if (!part_contact(part_a, part_b, margin, margin, search, found)) return true;
                if (!meet_at_fronts(part_a, part_b, found.distance.normal)) return true;
                const bool is_ghost = !felt.is_felt(part_a, part_b, found.distance);
                if (is_ghost && !at_ghosts) ++ghosts;
                if (is_ghost != at_ghosts) return true;
                if (is_ghost) {
                    felt.replace(part_a, part_b, found);
                    const SignedDistance<D>& distance = found.distance;
                    if (distance.distance > margin || told.has(distance.normal, -distance.distance, felt.size()))
                        return true;
                }
                told.add(found.distance.normal, -found.distance.distance);
                Contact<D> contact;
                write(found.distance, found.manifold, contact);
                name_features(part_a, part_b, found.distance, index_a, index_b, contact);
                return go_on = visit(contact);
            });
    };
    look(false);
    if (go_on && ghosts > 0) look(true);
}

template void each_contact_of(const View<2>&, const View<2>&, const QueryOptions<2>&,
                              FunctionRef<bool(const Contact<2>&)>);
template void each_contact_of(const View<3>&, const View<3>&, const QueryOptions<3>&,
                              FunctionRef<bool(const Contact<3>&)>);

}  // namespace abut
