#pragma once

// Structural similarity [Wang 2004] of radiance.

#include "stages/metrics/grid.h"
#include "stages/metrics/layer.h"

namespace vsgl::metrics {

// [Wang 2004, Eq. (13)] in a Gaussian window of 11 x 11 pixels, sigma 1.5; K1 = 0.01, K2 = 0.03. `range`: the
// values' range L, > 0. -1..1 per pixel; 1 only where the windows are equal.
// Deviation: every pixel has a window; beyond the border the border's values go on.
Grid ssim(const Grid& test, const Grid& reference, double range);

// Luminance as an observer perceives it: after `exposure` (stops), 1 is shown at 100 cd/m^2; PU21-encoded.
Grid perceived_luminance(const std::vector<Colour>& image, int width, int height, double exposure);

// SSIM of the perceived luminances with range 256, PU21's value of 100 cd/m^2, as [Mantiuk 2021] has it. All
// values must be finite; negative luminances count as black.
Grid ssim(const LayerPair& layer, double exposure);

}  // namespace vsgl::metrics
