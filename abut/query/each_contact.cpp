#include <abut/query/contact_among.hpp>
#include <abut/query/each_contact.hpp>
#include <abut/query/one_sided.hpp>
#include <abut/query/told_contacts.hpp>
#include <abut/query/write_answer.hpp>

namespace abut {
namespace {

/// So often the parts are looked at again for the ghosts that come next in their order; what is left then is told in
/// the order of the parts.
constexpr int most_looks = 16;

/// The pairs of parts of a composite shape and a convex one, found once however often they are looked at.
template <int D>
class KeptPairs {
public:
    /// False where they can't be kept. `sight`: so far from where the two touch the parts are wanted too.
    bool keep(const View<D>& a, const View<D>& b, double margin, double sight) {
        const auto *of_a = std::get_if<Composite<D>>(&a), *of_b = std::get_if<Composite<D>>(&b);
        a_is_composite_ = of_a != nullptr;
        convex_ = std::get_if<Convex<D>>(a_is_composite_ ? &b : &a);
        const Composite<D>* const composite = a_is_composite_ ? of_a : of_b;
        if (composite == nullptr || convex_ == nullptr) return false;
        const Aabb<D> box = bounds(*convex_);
        near_ = grown(box, static_cast<float>(margin));
        return parts_.keep(*composite, grown(box, static_cast<float>(margin + sight)));
    }

    const KeptParts<D>& parts() const { return parts_; }

    /// visit(part_a, index_a, part_b, index_b); false stops.
    template <class Visit>
    void each(const Visit& visit) const {
        for (std::uint32_t i = 0; i < parts_.size(); ++i) {
            if (!overlaps(parts_.box(i), near_)) continue;
            const bool go_on = a_is_composite_ ? visit(parts_.part(i), parts_.index(i), *convex_, 0u)
                                               : visit(*convex_, 0u, parts_.part(i), parts_.index(i));
            if (!go_on) return;
        }
    }

private:
    KeptParts<D> parts_;
    const Convex<D>* convex_ = nullptr;
    Aabb<D> near_;
    bool a_is_composite_ = false;
};

/// What is felt as it is, in the order of the parts; then what stands in for the rest and isn't told by that, in an
/// order of its own, so that it doesn't matter how the parts are numbered.
template <int D>
class Telling {
public:
    Telling(const View<D>& a, const View<D>& b, const QueryOptions<D>& options, const Others<D>& others,
            FunctionRef<bool(const Contact<D>&, const FeltBy&)> visit)
        : a_(a), b_(b), options_(options), pair_(a, b, others), visit_(visit) {
        is_kept_ = kept_.keep(a, b, static_cast<double>(options.margin), pair_.sight());
        if (is_kept_) pair_.look_among(kept_.parts());
    }

    void tell() {
        look(
            [&](const PartContact<D>& found, const Contact<D>& contact) {
                felt_.add(found.distance.normal, -found.distance.distance);
                return go_on_ = visit_(contact, FeltBy{});
            },
            [&](const Ghost<D>& ghost) {
                if (!is_told(ghost)) first_.add(ghost);
                return true;
            });
        for (int looks = 0; go_on_ && !first_.all().empty(); ++looks) {
            if (felt_.is_full()) mark_told();
            tell_first();
            if (!go_on_ || !first_.has_left_out()) return;
            if (looks == most_looks) return tell_all_after(first_.all().back());
            find_next(Ghost<D>(first_.all().back()));
        }
    }

private:
    /// at_felt(found, contact) or at_ghost(ghost) for each pair of parts; they return false to stop.
    template <class AtFelt, class AtGhost>
    void look(const AtFelt& at_felt, const AtGhost& at_ghost) {
        const SearchOptions<D> search = search_options(a_, b_, options_);
        const auto look_at = [&](const auto& part_a, std::uint32_t index_a, const auto& part_b, std::uint32_t index_b) {
            return look(part_a, index_a, part_b, index_b, search, at_felt, at_ghost);
        };
        if (is_kept_)
            kept_.each(look_at);
        else
            each_part_pair(a_, b_, options_.margin, look_at);
    }
    template <class PartA, class PartB, class AtFelt, class AtGhost>
    bool look(const PartA& part_a, std::uint32_t index_a, const PartB& part_b, std::uint32_t index_b,
              const SearchOptions<D>& search, const AtFelt& at_felt, const AtGhost& at_ghost) {
        const double margin = static_cast<double>(options_.margin);
        PartContact<D> found;
        if (!part_touch(part_a, part_b, margin, margin, search, found)) return true;
        if (!meet_at_fronts(part_a, part_b, found.distance.normal)) return true;
        const auto manifold = [&]() -> const Manifold<D>& {
            add_points(part_a, part_b, margin, search, found);
            return found.manifold;
        };
        const auto write_to = [&](Contact<D>& contact) {
            write(found.distance, found.manifold, contact);
            name_features(part_a, part_b, found.distance, index_a, index_b, contact);
        };
        const FeltBy by = pair_.felt_by(part_a, part_b, found.distance, manifold);
        if (by) {
            manifold();
            Contact<D> contact;
            write_to(contact);
            return at_felt(found, contact);
        }
        if (!pair_.replace(part_a, part_b, by, found)) manifold();
        if (found.distance.distance > margin) return true;
        Ghost<D> ghost{{}, by, found.distance.normal, -found.distance.distance, false};
        write_to(ghost.contact);
        return at_ghost(ghost);
    }

    bool is_told(const Ghost<D>& ghost) const {
        return felt_.has(ghost.normal, ghost.depth, pair_.size()) ||
               instead_.has(ghost.normal, ghost.depth, pair_.size());
    }
    bool tell(const Ghost<D>& ghost) {
        if (ghost.told || is_told(ghost)) return true;
        instead_.add(ghost.normal, ghost.depth);
        return go_on_ = visit_(ghost.contact, ghost.felt);
    }
    void tell_first() {
        for (const Ghost<D>& ghost : first_.all())
            if (!tell(ghost)) return;
    }

    /// By what is felt and was not kept.
    void mark_told() {
        look(
            [&](const PartContact<D>& found, const Contact<D>&) {
                const SignedDistance<D>& distance = found.distance;
                for (Ghost<D>& ghost : first_.all())
                    ghost.told = ghost.told ||
                                 tells_of(distance.normal, -distance.distance, ghost.normal, ghost.depth, pair_.size());
                return true;
            },
            [](const Ghost<D>&) { return true; });
    }
    void find_next(const Ghost<D>& last) {
        first_.clear();
        look([](const PartContact<D>&, const Contact<D>&) { return true; },
             [&](const Ghost<D>& ghost) {
                 if (comes_before(last, ghost) && !is_told(ghost)) first_.add(ghost);
                 return true;
             });
    }
    void tell_all_after(const Ghost<D>& last) {
        look([](const PartContact<D>&, const Contact<D>&) { return true; },
             [&](const Ghost<D>& ghost) { return !comes_before(last, ghost) || tell(ghost); });
    }

    const View<D>&a_, &b_;
    const QueryOptions<D>& options_;
    FeltPair<D> pair_;
    KeptPairs<D> kept_;
    FunctionRef<bool(const Contact<D>&, const FeltBy&)> visit_;
    ToldNormals<D> felt_, instead_;
    FirstGhosts<D> first_;
    bool go_on_ = true;
    bool is_kept_ = false;
};

}  // namespace

template <int D>
void each_contact_among(const View<D>& a, const View<D>& b, const QueryOptions<D>& options, const Others<D>& others,
                        FunctionRef<bool(const Contact<D>&, const FeltBy&)> visit) {
    const bool finite = is_finite(a) && is_finite(b);
    ABUT_ASSERT(finite);
    if (finite) Telling<D>(a, b, options, others, visit).tell();
}

template <int D>
void each_contact_of(const View<D>& a, const View<D>& b, const QueryOptions<D>& options,
                     FunctionRef<bool(const Contact<D>&)> visit) {
    each_contact_among<D>(a, b, options, {}, [&](const Contact<D>& contact, const FeltBy&) { return visit(contact); });
}

#define ABUT_INSTANTIATE(D)                                                                                    \
    template void each_contact_among(const View<D>&, const View<D>&, const QueryOptions<D>&, const Others<D>&, \
                                     FunctionRef<bool(const Contact<D>&, const FeltBy&)>);                     \
    template void each_contact_of(const View<D>&, const View<D>&, const QueryOptions<D>&,                      \
                                  FunctionRef<bool(const Contact<D>&)>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
