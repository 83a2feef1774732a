#pragma once

// The answers of the cheap queries of a pair of shapes, hashed.

#include "hash.hpp"
#include "whole_numbers.hpp"
#include <abut/query/certify.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/overlaps.hpp>

namespace abut {

template <int D>
void add_cheap_answers(Hash& hash, WholeNumbers<D>& make, const View<D>& a, const View<D>& b, Cache& cache) {
    hash.add(std::uint64_t{overlaps(a, b)});
    const Closest<D> found = closest(a, b);
    add_closest(hash, found);
    add_closest(hash, closest(a, b, {.cache = &cache}));
    hash.add(std::uint64_t{certify(a, b, found).holds});
    add_contact(hash, contact(a, b));
    add_contact(hash, contact(a, b, {.margin = 1}));
    hash.add(std::uint64_t{contains(a, make.point())});
    add_closest(hash, closest(a, make.point()));
    const Vec<D> from = make.point() * 4.0f;
    add_hit(hash, raycast(Ray<D>::between(from, make.point()), a));
}

}  // namespace abut
