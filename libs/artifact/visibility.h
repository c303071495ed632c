#pragma once

// The kinds of visibility, from files that read_artifact() gave. Private to this library.

#include "artifact/artifact.h"
#include "image/exr.h"

namespace vsgl::artifact {

ShadowMaps unpack_shadow_maps(const ExrFile& file);
VisibilityBits unpack_visibility_bits(const ExrFile& file);
Cut unpack_cut(const ExrFile& file);
Unshadowed unpack_unshadowed(const ExrFile& file);

}  // namespace vsgl::artifact
