#include <abut/broad_phase/k_nearest.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::detail {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

}  // namespace

template <int D>
NearestItems<D>::NearestItems(const Vec<D>& point, std::size_t k, std::vector<NearItem>& out)
    : point_(point), k_(k), out_(out) {
    out.clear();
}

template <int D>
float NearestItems<D>::offer(std::uint32_t item, const Aabb<D>& box) {
    if (k_ == 0) return -1;
    double squared = 0;
    BoxReach<D>({point_, point_}, infinity).measure(box, squared);
    const NearItem offered{static_cast<float>(square_root(squared)), item};
    if (out_.size() == k_) {
        if (!(offered < out_.front())) return infinity;
        std::pop_heap(out_.begin(), out_.end());
        out_.back() = offered;
    } else {
        out_.push_back(offered);
    }
    std::push_heap(out_.begin(), out_.end());
    // The next float includes all distances that round to that of the farthest item.
    return out_.size() < k_ ? infinity : std::nextafter(out_.front().distance, infinity);
}

template <int D>
void NearestItems<D>::sort() {
    std::sort_heap(out_.begin(), out_.end());
}

template class NearestItems<2>;
template class NearestItems<3>;

}  // namespace abut::detail
