// What the control thread does for a recording: inputs and outputs as records. Allocates nothing
// after construction.
#pragma once

#include <array>
#include <vector>

#include "gateway/gateway.h"
#include "gateway/recording/format.h"
#include "gateway/recording/mathematics.h"

namespace drover::gateway {

class RecordEncoder final {
 public:
  /// The record of the input, without its length; good until the next call. Empty: it did not fit.
  std::span<const std::uint8_t> input(const Input& input);
  /// The same of what the last Tick gave.
  std::span<const std::uint8_t> output(const Gateway& gateway);

 private:
  std::array<std::uint8_t, kMaxRecord> buffer_{};
  Time before_{};
  std::array<std::uint64_t, kMaxFields> fields_{};  ///< as last written
};

/// In the order in which their values are recorded.
std::vector<FieldName> field_names(const Gateway& gateway);

}  // namespace drover::gateway
