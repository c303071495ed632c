#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vsgl {

// Lights as the uniform block of a kernel holds them, in the order of the artifact.
class PackedLights {
 public:
  PackedLights() = default;
  // `Record`: a struct of shaders/interop with a member `ndf`, NDF_* of the specular emission.
  template <class Record>
  PackedLights(const std::vector<Record>& records)  // NOLINT: implicit, so that packers can return vectors
      : stride_(sizeof(Record)) {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(records));
    bytes_.assign(bytes.begin(), bytes.end());
    ndfs_.reserve(records.size());
    for (const Record& record : records) ndfs_.push_back(record.ndf);
  }

  std::size_t size() const { return ndfs_.size(); }
  std::size_t stride() const { return stride_; }  // bytes of a record
  std::uint32_t ndf(std::size_t light) const { return ndfs_[light]; }
  std::span<const std::byte> record(std::size_t light) const {
    return std::span(bytes_).subspan(light * stride_, stride_);
  }

 private:
  std::size_t stride_ = 0;
  std::vector<std::byte> bytes_;
  std::vector<std::uint32_t> ndfs_;
};

}  // namespace vsgl
