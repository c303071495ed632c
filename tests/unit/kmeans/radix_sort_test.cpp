#include "kmeans/radix_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "math/sampling.h"

namespace vsgl {
namespace {

using Words = std::vector<std::uint32_t>;

gpu::Device& device() {
  static gpu::Device instance({.compute_only = true});
  return instance;
}

// `count` keys below 2^bits, hashed; few values where there are few bits.
Words hashed_keys(std::uint32_t count, int bits) {
  Words keys(count);
  for (std::uint32_t i = 0; i < count; ++i)
    keys[i] = pcg3d({i, count, static_cast<std::uint32_t>(bits)})[0] >> (32 - bits);
  return keys;
}

// Values in the order of their keys.
Words sort(const Words& keys, const Words& values, int bits) {
  RadixSort sorter(device(), keys.size(), bits);
  sorter.keys().write(0, std::as_bytes(std::span(keys)));
  sorter.values().write(0, std::as_bytes(std::span(values)));
  gpu::Commands commands(device());
  sorter.record(commands, "sort");
  Report report;
  commands.submit(report);
  const auto sorted_keys = sorter.sorted_keys().download<std::uint32_t>(keys.size());
  EXPECT_TRUE(std::ranges::is_sorted(sorted_keys));
  return sorter.sorted_values().download<std::uint32_t>(keys.size());
}

TEST(RadixSort, IsAStableSort) {
  for (const std::uint32_t count : {1u, 2u, 63u, 1024u, 1025u, 100000u})
    for (const int bits : {1, 4, 11, 30, 32}) {
      const Words keys = hashed_keys(count, bits);
      Words values(count);
      std::iota(values.begin(), values.end(), 0u);
      Words expected = values;
      std::ranges::stable_sort(expected, {}, [&](std::uint32_t i) { return keys[i]; });
      EXPECT_EQ(sort(keys, values, bits), expected) << count << " keys of " << bits << " bits";
    }
}

TEST(RadixSort, LeavesEqualKeysAlone) {
  Words values(3000);
  std::iota(values.rbegin(), values.rend(), 7u);
  EXPECT_EQ(sort(Words(3000, 5), values, 10), values);
}

}  // namespace
}  // namespace vsgl
