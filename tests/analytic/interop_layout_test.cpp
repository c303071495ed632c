// The structs that C++ and GLSL share have the same layout on both sides: offsets of C++ against those in the
// SPIR-V of a shader that holds each struct in a `scalar` block (tests/analytic/interop_layout.py writes
// both).
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "interop_layout.comp.h"

namespace {

struct Member {
  std::string type, name;
  std::size_t offset;
};

#include "interop_layout.h"

// The instructions of the SPIR-V specification, section 3.42, that carry names and offsets.
constexpr std::uint32_t op_name = 5, op_member_name = 6, op_type_runtime_array = 29, op_decorate = 71,
                        op_member_decorate = 72;
constexpr std::uint32_t decoration_array_stride = 6, decoration_offset = 35;

std::string text_of(std::span<const std::uint32_t> words) {
  return reinterpret_cast<const char*>(words.data());  // zero-terminated, little-endian
}

// Of the structs that lie in blocks.
struct Layout {
  std::map<std::pair<std::string, std::string>, std::size_t> offsets;  // (struct, member)
  std::map<std::string, std::size_t> strides;                          // of arrays of the struct
};

Layout layout_of(std::span<const std::uint32_t> spirv) {
  std::map<std::uint32_t, std::string> names;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> member_names;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> offsets;
  std::map<std::uint32_t, std::size_t> strides;          // array type
  std::map<std::uint32_t, std::uint32_t> element_types;  // array type
  for (std::size_t i = 5; i < spirv.size(); i += spirv[i] >> 16) {
    const std::span<const std::uint32_t> words = spirv.subspan(i, spirv[i] >> 16);
    switch (words[0] & 0xffff) {
      case op_name:
        names[words[1]] = text_of(words.subspan(2));
        break;
      case op_member_name:
        member_names[{words[1], words[2]}] = text_of(words.subspan(3));
        break;
      case op_type_runtime_array:
        element_types[words[1]] = words[2];
        break;
      case op_decorate:
        if (words[2] == decoration_array_stride) strides[words[1]] = words[3];
        break;
      case op_member_decorate:
        if (words[3] == decoration_offset) offsets[{words[1], words[2]}] = words[4];
        break;
      default:
        break;
    }
  }
  Layout layout;
  for (const auto& [member, offset] : offsets)
    layout.offsets[{names[member.first], member_names[member]}] = offset;
  for (const auto& [array, element] : element_types) layout.strides[names[element]] = strides[array];
  return layout;
}

TEST(InteropLayout, MembersHaveTheSameOffsetsInCppAndGlsl) {
  const Layout layout = layout_of(interop_layout_comp_spv);
  ASSERT_GT(members.size(), 50u);
  for (const Member& member : members) {
    const auto found = layout.offsets.find({member.type, member.name});
    ASSERT_NE(found, layout.offsets.end()) << member.type << "." << member.name << " is not in the SPIR-V";
    EXPECT_EQ(found->second, member.offset) << member.type << "." << member.name;
  }
  for (const auto& [type, size] : sizes) {
    ASSERT_TRUE(layout.strides.contains(type)) << type;
    EXPECT_EQ(layout.strides.at(type), size) << type;
  }
}

}  // namespace
