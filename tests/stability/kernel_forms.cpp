#include "kernel_forms.h"

#include "interop/model.h"
#include "interop/shading.h"
#include "library_dispatch.h"
#include "spirv/test/stability/kernel.comp.glsl.h"

namespace vsgl::test {

std::vector<float> call_kernel(gpu::Device& device, std::uint32_t number, const std::vector<Row>& rows,
                               std::size_t values, std::uint32_t lobe, bool rough) {
  return call_on_device(
      device, kernel_comp_spv, number, rows, values, {},
      {.rough = rough,
       .constants = {{interop::SHADING_RECEIVER_ID, interop::NDF_ANY}, {interop::SHADING_LOBE_ID, lobe}}});
}

}  // namespace vsgl::test
