#pragma once

#include <vector>

namespace vsgl {

// Stops that bring the 95th percentile of the positive luminances to 0.8; 0 where none is positive. Values
// that are not finite do not count.
double automatic_exposure(std::vector<double> luminances);

}  // namespace vsgl
