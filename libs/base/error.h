#pragma once

#include <stdexcept>
#include <string>

namespace vsgl {

// Exit statuses of every tool. `differs` is returned by `compare` only.
enum class Exit : int { ok = 0, differs = 1, usage = 2, input = 3, io = 4, device = 5, internal = 70 };

// Numbered errors. The thousands digit is the exit status (7xxx: 70); docs/errors.md describes each number
// and a test of the command line is named after each.
enum class ErrorCode : int {
  unknown_option = 2001,       // flag or config key that the tool does not have
  bad_value = 2002,            // flag or config value of the wrong type or not one of the choices
  out_of_range = 2003,         // number outside the documented range
  missing_option = 2004,       // required flag or positional not given
  conflicting_options = 2005,  // flags that exclude each other
  output_exists = 2006,        // output is there and --overwrite was not given

  file_not_found = 3001,      // input file does not exist or cannot be opened
  exr_unreadable = 3002,      // not an EXR, truncated or corrupt
  missing_channel = 3003,     // required channel absent
  wrong_channel_type = 3004,  // channel of another pixel type
  wrong_size = 3005,          // image, level or part sizes that do not belong together
  non_finite = 3006,          // NaN or infinity, with channel and pixel
  wrong_schema = 3007,        // artifact of another kind or of an unknown schema version
  missing_part = 3008,        // part or mip level absent
  missing_attribute = 3009,   // header attribute absent or of another type
  json_syntax = 3010,         // not JSON
  json_unknown_key = 3011,    // key that the schema does not know
  json_wrong_type = 3012,     // value of another type
  json_out_of_range = 3013,   // number, length or choice outside the range
  json_missing_key = 3014,    // required key absent
  mesh_unreadable = 3015,     // mesh file that cannot be loaded or has broken indices or buffers
  mesh_invalid = 3016,        // mesh loads but holds non-finite values or nothing to render
  texture_unreadable = 3017,  // image file missing or broken
  bad_material = 3018,        // material parameter outside the model
  bad_camera = 3019,          // no camera, or a degenerate one
  bad_light = 3020,           // no light, or a degenerate one
  invalid_data = 3021,        // artifact holds values outside their documented range

  write_failed = 4001,  // output cannot be created, written or renamed
  read_failed = 4002,   // input turned unreadable half-way
  memory = 4003,        // not enough memory for the requested sizes

  no_device = 5001,     // no Vulkan device matches --device
  device_limit = 5002,  // the device lacks a feature or limit that the stage needs
  device_lost = 5003,   // a Vulkan call failed

  internal = 7001,  // a broken invariant: a bug in the tool
};

constexpr Exit exit_of(ErrorCode code) {
  const int thousands = static_cast<int>(code) / 1000;
  return thousands == 7 ? Exit::internal : static_cast<Exit>(thousands);
}

// An error that its reader can act upon: `message` names file, field and remedy.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ErrorCode code() const { return code_; }
  Exit exit() const { return exit_of(code_); }

 private:
  ErrorCode code_;
};

}  // namespace vsgl
