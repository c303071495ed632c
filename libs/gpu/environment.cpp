#include "gpu/environment.h"

#include <cstdlib>
#include <filesystem>
#include <optional>

namespace vsgl::gpu {
namespace {

std::optional<std::string> get(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  if (value == nullptr || *value == '\0') return std::nullopt;
  return value;
}

bool cpu_has_avx512() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx512f") != 0;
#else
  return false;
#endif
}

// Where compiled shaders of 512 bits are kept; empty when the user has no cache folder.
std::filesystem::path wide_cache_folder() {
  if (const auto mesa = get("MESA_SHADER_CACHE_DIR")) return std::filesystem::path(*mesa) / "vsgltools-512";
  if (const auto xdg = get("XDG_CACHE_HOME")) return std::filesystem::path(*xdg) / "vsgltools" / "mesa-512";
  if (const auto home = get("HOME"))
    return std::filesystem::path(*home) / ".cache" / "vsgltools" / "mesa-512";
  return {};
}

}  // namespace

ScopedEnvironment::~ScopedEnvironment() {
  for (auto saved = saved_.rbegin(); saved != saved_.rend(); ++saved) {
    if (saved->was_set) {
      setenv(saved->name.c_str(), saved->value.c_str(), 1);
    } else {
      unsetenv(saved->name.c_str());
    }
  }
}

void ScopedEnvironment::set(const std::string& name, const std::string& value) {
  const char* old = std::getenv(name.c_str());
  saved_.push_back({name, old == nullptr ? "" : old, old != nullptr});
  setenv(name.c_str(), value.c_str(), 1);
}

void set_lavapipe_threads(ScopedEnvironment& environment, int threads) {
  if (threads > 0) environment.set("LP_NUM_THREADS", std::to_string(threads));
}

void set_lavapipe_wide(ScopedEnvironment& environment) {
  if (get("LP_NATIVE_VECTOR_WIDTH") || !cpu_has_avx512()) return;
  environment.set("LP_NATIVE_VECTOR_WIDTH", "512");
  const std::filesystem::path folder = wide_cache_folder();
  std::error_code failed;
  if (!folder.empty()) std::filesystem::create_directories(folder, failed);
  if (folder.empty() || failed) {
    environment.set("MESA_SHADER_CACHE_DISABLE", "true");
  } else {
    environment.set("MESA_SHADER_CACHE_DIR", folder.string());
  }
}

}  // namespace vsgl::gpu
