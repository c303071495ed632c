#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "base/error.h"

namespace vsgl {

// The row of a registry (each row with a `name`) that is called `name`. Throws bad_value, which names the
// parameter `field` and lists the names.
template <class Method>
const Method& find_method(const std::vector<Method>& registry, const std::string& name,
                          const std::string& field = "method") {
  const auto found =
      std::find_if(registry.begin(), registry.end(), [&](const Method& row) { return row.name == name; });
  if (found != registry.end()) return *found;
  std::string names;
  for (const Method& row : registry) names += (names.empty() ? "" : ", ") + row.name;
  throw Error(ErrorCode::bad_value, field + ": \"" + name + "\" is none of " + names);
}

}  // namespace vsgl
