#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "shader_library.h"

// Functions of shaders/test/stability/kernel.comp.glsl: those that the shading kernels run, and published
// ones.

namespace vsgl::test {

inline constexpr std::uint32_t kernel_incoming = 0, kernel_cosine = 1, kernel_receive = 2,
                               kernel_specular = 3;
inline constexpr std::uint32_t published_sg_form = 4, published_asg_form = 5, published_asg_asg_form = 6,
                               published_ndf_filter_form = 7, published_normalised_form = 8,
                               published_cosine_mean_form = 10, published_cosine_difference_form = 11,
                               pulled_out_form = 12, sg_cosine_form = 13, hemisphere_form = 14,
                               cosine_mean_form = 15, library_incoming = 9, published_fluence_form = 16,
                               unscaled_incoming_form = 17;

// `lobe`: interop::SPECULAR_LOBE_*.
std::vector<float> call_kernel(gpu::Device& device, std::uint32_t number, const std::vector<Row>& rows,
                               std::size_t values, std::uint32_t lobe = 0, bool rough = false);

}  // namespace vsgl::test
