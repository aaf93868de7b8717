#include "drivers/gt01/serial/framer.h"

#include <algorithm>

namespace drover::gt01::serial {

void Framer::drop(std::size_t count) {
  std::copy(buffer_.begin() + count, buffer_.begin() + size_, buffer_.begin());
  size_ -= count;
}

Framer::Look Framer::examine() {
  if (size_ == 0) return Look::wait;
  if (buffer_[0] != kHead[0] || (size_ > 1 && buffer_[1] != kHead[1])) {
    drop(1);
    return Look::noise;
  }
  if (size_ < kBeforeData) return Look::wait;
  const std::span<const std::uint8_t> all(buffer_.data(), size_);
  const std::size_t size = packet_size(all);
  if (size != 0 && size_ < size) return Look::wait;
  const bool whole = size != 0 && is_whole(all.first(size));
  packet_.clear();
  for (std::size_t i = 0; whole && i < size; ++i) (void)packet_.push_back(buffer_[i]);
  drop(whole ? size : 1);
  return whole ? Look::packet : Look::bad;
}

}  // namespace drover::gt01::serial
