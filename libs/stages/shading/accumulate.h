#pragma once

#include "artifact/artifact.h"

namespace vsgl {

// The mean of the passes so far, `mean`, and of the image `next` of pass number `pass`, layer by layer:
// mean + (next - mean) / pass. [Welford 1962] Throws bad_value unless `mean` is of pass - 1 passes,
// wrong_size when the images differ in size, invalid_data when they have not the same layers.
Indirect accumulate(Indirect mean, const Indirect& next, int pass);

}  // namespace vsgl
