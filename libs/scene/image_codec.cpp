#include "scene/image_codec.h"

#include <dlfcn.h>

#include "base/error.h"

namespace vsgl::scene {
namespace {

const ImageCodec& load() {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  const std::filesystem::path path = program.parent_path().parent_path() / VSGL_IMAGE_CODEC;
  void* library = dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
  void* codec = library == nullptr ? nullptr : dlsym(library, "vsgl_image_codec");
  if (codec == nullptr)
    throw Error(ErrorCode::texture_unreadable,
                std::string("the library that reads images cannot be loaded: ") + dlerror() +
                    "; install the tools as a whole");
  return reinterpret_cast<const ImageCodec& (*)()>(codec)();
}

}  // namespace

const ImageCodec& image_codec() {
  static const ImageCodec& codec = load();
  return codec;
}

}  // namespace vsgl::scene
