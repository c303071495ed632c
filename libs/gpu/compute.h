#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/report.h"
#include "gpu/buffer.h"
#include "gpu/device.h"

namespace vsgl::gpu {

// How a shader sees a buffer: `buffer` blocks, `uniform` blocks, `uniform samplerBuffer` (RGBA32F) or
// `usamplerBuffer` (R32UI, RGBA32UI).
enum class Binding { storage, uniform, texel_rgba32f, texel_r32ui, texel_rgba32ui };

using SpecializationConstants =
    std::map<std::uint32_t, std::uint32_t>;  // constant_id -> 32-bit value (bit-cast floats)

// A compute shader with the bindings 0..n-1 of set 0 and push constants of `push_bytes`. A handle: the device
// builds each pipeline once, and keeps it.
class ComputePipeline {
 public:
  ComputePipeline(Device& device, std::span<const std::uint32_t> spirv, std::vector<Binding> bindings,
                  std::size_t push_bytes = 0, const SpecializationConstants& constants = {});

 private:
  friend class Commands;
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

// Where a binding's data lies; size 0 means to the end of the buffer.
struct BufferRange {
  BufferRange(Buffer& b) : buffer(&b) {}  // NOLINT: implicit, so that plain buffers can be listed
  BufferRange(Buffer& b, std::size_t o, std::size_t s) : buffer(&b), offset(o), size(s) {}
  Buffer* buffer;
  std::size_t offset = 0, size = 0;
};

// A list of dispatches, recorded and then run by submit(), which waits. Each dispatch sees the writes of
// those before it. A label names the phase whose device time submit() adds to the report: by timestamps, or
// on the CPU by the clock. Group counts above the device's limit throw device_limit.
class Commands {
 public:
  explicit Commands(Device& device);
  ~Commands();
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;

  void dispatch(const std::string& label, const ComputePipeline& pipeline,
                const std::vector<BufferRange>& buffers, std::span<const std::byte> push,
                std::array<std::uint32_t, 3> groups);
  template <class Push>
  requires(!std::convertible_to<const Push&, std::span<const std::byte>>) void dispatch(
      const std::string& label, const ComputePipeline& pipeline, const std::vector<BufferRange>& buffers,
      const Push& push, std::array<std::uint32_t, 3> groups) {
    dispatch(label, pipeline, buffers, std::span<const std::byte>(std::as_bytes(std::span(&push, 1))),
             groups);
  }
  // Runs everything recorded so far and waits; may be called again after more dispatches.
  void submit(Report& report);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Rounds up: how many groups of `size` cover `count`.
constexpr std::uint32_t groups_for(std::size_t count, std::uint32_t size) {
  return static_cast<std::uint32_t>((count + size - 1) / size);
}

}  // namespace vsgl::gpu
