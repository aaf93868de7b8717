// Which variants of sin, exp and the others this process has: they differ between CPUs in the last
// bit, and a replay with others than the recording's soon differs, too.
#pragma once

#include <cmath>
#include <cstdint>

#include "gateway/recording/bytes.h"

namespace drover::gateway {

/// Equal numbers: equal variants, as far as a thousand values of each tell.
inline std::uint64_t mathematics_fingerprint() {
  std::uint64_t print = 0;
  const auto take = [&print](double value) {
    print = (print ^ bits_of(value)) * 0x100000001B3U + (print >> 29U);
  };
  for (int i = 1; i <= 1000; ++i) {
    volatile double opaque = 0.00137 * i;  // the compiler must not work it out itself
    const double x = opaque;
    take(std::sin(x));
    take(std::cos(10 * x));
    take(std::tan(x));
    take(std::atan2(x, 0.7));
    take(std::exp(x));
    take(std::log(x));
  }
  return print;
}

}  // namespace drover::gateway
