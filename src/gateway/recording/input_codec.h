// Inputs as bytes and back.
#pragma once

#include <functional>

#include "gateway/input.h"
#include "gateway/recording/bytes.h"
#include "gateway/slots.h"

namespace drover::gateway {

/// The kind of a record that holds this input; from 0, as the variant counts.
inline std::uint8_t kind_of(const Input& input) {
  return static_cast<std::uint8_t>(input.body.index());
}
inline constexpr std::uint8_t kInputKinds = std::variant_size_v<InputBody>;

/// `before` is the time of the input before it. Allocates nothing.
void write_input(const Input& input, Time before, ByteWriter& out);

/// A path by its number; nullptr when there is none.
using FindPath = std::function<const Path*(std::uint64_t)>;

/// The reader is bad when it is no such input; bytes of BytesHeard are the reader's own.
Input read_input(std::uint8_t kind, Time before, const FindPath& find_path, ByteReader& in);

/// For people: `at 1.690000128 s: frame on can0: 021#0000000008000000`.
std::string text_of(const Input& input, const Wiring& wiring);

}  // namespace drover::gateway
