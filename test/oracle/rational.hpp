#pragma once

// The exact numbers of the oracles: GMP's, by Boost.Multiprecision. Boost's own rationals take five times as long, and
// serve platforms without GMP.

#if __has_include(<gmp.h>)
#include <boost/multiprecision/gmp.hpp>
#else
#include <boost/multiprecision/cpp_int.hpp>
#endif

namespace abut::oracle {

#if __has_include(<gmp.h>)
using Integer = boost::multiprecision::mpz_int;
using Rational = boost::multiprecision::mpq_rational;
#else
using Integer = boost::multiprecision::cpp_int;
using Rational = boost::multiprecision::cpp_rational;
#endif

}  // namespace abut::oracle
