#include "stages/metrics/pairing.h"

#include <algorithm>
#include <set>

#include "base/error.h"

namespace vsgl::metrics {
namespace {

std::set<std::string> channel_names(const ExrFile& a, const ExrFile& b) {
  std::set<std::string> names;
  for (const ExrFile* file : {&a, &b})
    for (const ExrPart& part : file->parts)
      for (const auto& [name, plane] : part.levels.front().channels) names.insert(name);
  return names;
}

const ExrPart* find_part(const ExrFile& file, const std::string& name) {
  const auto it =
      std::find_if(file.parts.begin(), file.parts.end(), [&](const ExrPart& p) { return p.name == name; });
  return it == file.parts.end() ? nullptr : &*it;
}

}  // namespace

bool names_channel(const std::string& name, const std::string& channel) {
  return channel == name || channel.starts_with(name + ".");
}

bool is_selected(const Options& options, const std::string& channel) {
  const auto named = [&](const std::string& name) { return names_channel(name, channel); };
  const bool wanted =
      options.channels.empty() || std::any_of(options.channels.begin(), options.channels.end(), named);
  return wanted && std::none_of(options.exclude.begin(), options.exclude.end(), named);
}

void check_selection(const Options& options, const ExrFile& test, const ExrFile& reference) {
  const std::set<std::string> there = channel_names(test, reference);
  const auto check = [&](const std::string& flag, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      if (std::any_of(there.begin(), there.end(),
                      [&](const std::string& c) { return names_channel(name, c); }))
        continue;
      std::string list;
      for (const std::string& channel : there) list += (list.empty() ? "" : ", ") + channel;
      throw Error(ErrorCode::bad_value,
                  flag + " " + name + ": neither file has such a channel or layer; choose from " + list);
    }
  };
  check("--channels", options.channels);
  check("--exclude", options.exclude);
}

std::vector<PartPair> pair_parts(const ExrFile& test, const ExrFile& reference) {
  if (test.parts.size() == 1 && reference.parts.size() == 1) return {{&test.parts[0], &reference.parts[0]}};
  std::vector<PartPair> pairs;
  for (const ExrPart& part : reference.parts) pairs.push_back({find_part(test, part.name), &part});
  for (const ExrPart& part : test.parts)
    if (!find_part(reference, part.name)) pairs.push_back({&part, nullptr});
  return pairs;
}

}  // namespace vsgl::metrics
