#include "stages/shading/accumulate.h"

#include "base/error.h"
#include "math/interop_vec.h"

namespace vsgl {
namespace {

constexpr const char* kRemedy = "; shade all passes of the same G-buffer with the same options";

void move_towards(float& mean, float next, int pass) {
  const double before = mean;
  mean = static_cast<float>(before + (static_cast<double>(next) - before) / pass);
}

void move_towards(interop::vec3& mean, interop::vec3 next, int pass) {
  move_towards(mean.x, next.x, pass);
  move_towards(mean.y, next.y, pass);
  move_towards(mean.z, next.z, pass);
}

template <class Value>
void move_layer(const char* name, std::vector<Value>& mean, const std::vector<Value>& next, int pass) {
  if (mean.size() != next.size())
    throw Error(ErrorCode::invalid_data,
                std::string("accumulate: only one of the images has the layer ") + name + kRemedy);
  for (std::size_t i = 0; i < mean.size(); ++i) move_towards(mean[i], next[i], pass);
}

}  // namespace

Indirect accumulate(Indirect mean, const Indirect& next, int pass) {
  if (mean.passes != pass - 1)
    throw Error(ErrorCode::bad_value, "accumulate: the image is the mean of " + std::to_string(mean.passes) +
                                          " passes, and this is pass " + std::to_string(pass) +
                                          "; take the passes in their order");
  if (mean.width != next.width || mean.height != next.height)
    throw Error(ErrorCode::wrong_size, std::string("accumulate: the images differ in size") + kRemedy);
  move_layer("diffuse", mean.diffuse, next.diffuse, pass);
  move_layer("specular", mean.specular, next.specular, pass);
  move_layer("direct", mean.direct, next.direct, pass);
  move_layer("cancellation", mean.cancellation, next.cancellation, pass);
  move_layer("cut_size", mean.cut_size, next.cut_size, pass);
  move_layer("error_estimate", mean.error_estimate, next.error_estimate, pass);
  mean.passes = pass;
  return mean;
}

}  // namespace vsgl
