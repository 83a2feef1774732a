#pragma once

// The exact numbers of the oracles: GMP's, by Boost.Multiprecision. Boost's own rationals take five times as long.

#include <boost/multiprecision/gmp.hpp>

namespace abut::oracle {

using Integer = boost::multiprecision::mpz_int;
using Rational = boost::multiprecision::mpq_rational;

}  // namespace abut::oracle
