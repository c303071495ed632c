#include "flags.h"

#include <algorithm>

#include "base/option_json.h"
#include "base/usage.h"

namespace vsgl::app {

void allow_only(Tool& tool, const std::string& mode, const std::vector<std::string>& allowed) {
  for (const CLI::Option* option : tool.app().get_options()) {
    const std::string name = options::long_name(*option);
    if (option->count() == 0 || option->get_group() == usage::kCommonGroup) continue;
    if (std::find(allowed.begin(), allowed.end(), name) == allowed.end())
      throw Error(ErrorCode::conflicting_options, name + ": does not go with " + mode);
  }
}

void refuse(Tool& tool, const std::vector<std::string>& flags, const std::string& need) {
  for (const std::string& flag : flags)
    if (tool.app().count(flag) > 0) throw Error(ErrorCode::conflicting_options, flag + ": needs " + need);
}

}  // namespace vsgl::app
