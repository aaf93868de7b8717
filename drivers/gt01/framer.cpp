#include "drivers/gt01/framer.h"

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
  report_ = size == 0 ? std::nullopt : decode(all.first(size));
  drop(report_ ? size : 1);
  return report_ ? Look::packet : Look::bad;
}

}  // namespace drover::gt01::serial
