#include "drivers/witmotion/framer.h"

#include <algorithm>

namespace drover::witmotion {

void Framer::reset() {
  size_ = 0;
  locked_ = false;
}

bool Framer::could_begin() const {
  if (size_ >= 1 && buffer_[0] != kHeader) return false;
  if (size_ < 2) return true;
  return format_ == Format::standard ? is_standard_type(buffer_[1]) : is_combined_type(buffer_[1]);
}

void Framer::drop_one() {
  std::copy(buffer_.begin() + 1, buffer_.begin() + size_, buffer_.begin());
  --size_;
  locked_ = false;
}

void Framer::take(std::size_t size) {
  std::copy_n(buffer_.begin(), size, found_.begin());
  found_size_ = size;
  std::copy(buffer_.begin() + size, buffer_.begin() + size_, buffer_.begin());
  size_ -= size;
}

Framer::Event Framer::push(std::uint8_t byte) {
  buffer_[size_++] = byte;
  while (!could_begin()) drop_one();
  const Event event = examine();
  if (event == Event::dropped) {
    do drop_one();
    while (!could_begin());
  }
  return event;
}

// After one dropped byte the rest is shorter than a frame, so a byte never ends more than one.
Framer::Event Framer::examine() {
  if (format_ == Format::standard) {
    if (size_ < kFrameSize) return Event::none;
    const std::span<const std::uint8_t> all(buffer_.data(), kFrameSize);
    if (checksum(all.first(kFrameSize - 1)) != all.back()) return Event::dropped;
    take(kFrameSize);
    return Event::frame;
  }
  if (locked_ && size_ == kCombinedFrameSize) {
    take(kCombinedFrameSize);
    return Event::frame;
  }
  if (size_ < kCombinedFrameSize + 2) return Event::none;
  if (buffer_[kCombinedFrameSize] != kHeader || !is_combined_type(buffer_[kCombinedFrameSize + 1]))
    return Event::dropped;
  take(kCombinedFrameSize);
  locked_ = true;
  return Event::none;
}

}  // namespace drover::witmotion
