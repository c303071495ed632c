#pragma once

#include "math/pyramid.h"  // IWYU pragma: export
