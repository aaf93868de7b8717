// Finds WitMotion frames in a stream of bytes, one byte at a time.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "drivers/witmotion/codec.h"

namespace drover::witmotion {

/// Which frames the device sends: of 11 bytes with a sum, or of 20 bytes without one.
enum class Format : std::uint8_t { standard, combined };

/// The header's byte may stand in the data and an 8-bit sum is weak, so a frame that does not fit
/// costs one byte and no more: the next may begin inside it.
///
/// Frames of 20 bytes have no sum at all: one counts when the frame before it ended where it
/// begins. The first after a gap is therefore lost.
class Framer final {
 public:
  explicit Framer(Format format) : format_(format) {}

  enum class Event : std::uint8_t {
    none,     ///< nothing finished with this byte
    frame,    ///< frame() holds one
    dropped,  ///< what began as a frame is none: wrong sum, or no frame after it
  };

  Event push(std::uint8_t byte);
  /// After Event::frame and until the next push().
  std::span<const std::uint8_t> frame() const { return {found_.data(), found_size_}; }
  void reset();

 private:
  Event examine();
  bool could_begin() const;
  void drop_one();
  void take(std::size_t size);

  Format format_;
  // A frame of 20 bytes and the two that begin the next one.
  std::array<std::uint8_t, kCombinedFrameSize + 2> buffer_{};
  std::size_t size_ = 0;
  bool locked_ = false;  ///< combined: the buffer begins where a frame ended
  std::array<std::uint8_t, kCombinedFrameSize> found_{};
  std::size_t found_size_ = 0;
};

}  // namespace drover::witmotion
