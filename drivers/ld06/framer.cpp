#include "drivers/ld06/framer.h"

#include <algorithm>

namespace drover::ld06 {

bool Framer::could_begin() const {
  if (size_ >= 1 && buffer_[0] != kHeader) return false;
  return size_ < 2 || buffer_[1] == kKind;
}

void Framer::drop_one() {
  std::copy(buffer_.begin() + 1, buffer_.begin() + static_cast<long>(size_), buffer_.begin());
  --size_;
}

Framer::Event Framer::push(std::uint8_t byte) {
  buffer_[size_++] = byte;
  while (!could_begin()) drop_one();
  if (size_ < kPacketSize) return Event::none;
  if (crc8({buffer_.data(), kPacketSize - 1}) == buffer_.back()) {
    found_ = buffer_;
    size_ = 0;
    return Event::packet;
  }
  // What is left is shorter than a packet, so a byte never ends more than one.
  do drop_one();
  while (!could_begin());
  return Event::dropped;
}

}  // namespace drover::ld06
