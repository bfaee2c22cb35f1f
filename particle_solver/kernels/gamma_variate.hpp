#pragma once
// A Gamma(shape, 1) variate, shape > 0 [Marsaglia & Tsang, ACM Trans. Math. Softw. 26 (2000) 363, sec. 3 and, for shape
// < 1, sec. 6].
#include <cmath>

#include "coupling/base/counter_random.hpp"

namespace standoff::particles {

inline double gamma_variate(double shape, CounterRandom& random) {
  if (shape < 1.0) {
    const double larger = gamma_variate(shape + 1.0, random);
    return larger * std::pow(random.uniform(), 1.0 / shape);
  }
  const double d = shape - 1.0 / 3.0, c = 1.0 / std::sqrt(9.0 * d);
  for (;;) {
    const double x = random.normal(), v = (1.0 + c * x) * (1.0 + c * x) * (1.0 + c * x);
    if (v <= 0.0) continue;
    if (std::log(random.uniform()) < 0.5 * x * x + d - d * v + d * std::log(v)) return d * v;
  }
}

}  // namespace standoff::particles
