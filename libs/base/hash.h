#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace vsgl {

// SHA-256 as 64 lower-case hex digits (OpenSSL).
std::string sha256(std::span<const std::byte> bytes);
// The same of a file's bytes. Throws file_not_found or read_failed.
std::string sha256_file(const std::filesystem::path& path);

}  // namespace vsgl
