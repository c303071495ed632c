#pragma once

#include <filesystem>

namespace vsgl {

// Names of sequences of files: "%04d" (or another width, 1 to 9) in the file's name stands for the frame.

bool names_frames(const std::filesystem::path& path);
// The file of one frame, 0 or more: "out/image.%04d.exr" -> "out/image.0012.exr". Every mark is replaced.
std::filesystem::path frame_path(const std::filesystem::path& path, int frame);

}  // namespace vsgl
