// Memory that a message's texts and lists point to, until it was sent.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory_resource>
#include <new>
#include <string_view>

namespace drover::ros2 {

class Arena final {
 public:
  Arena() = default;
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  /// With a NUL behind; one inside would cut it on the wire.
  char* text(std::string_view value) {
    auto* chars = static_cast<char*>(memory_.allocate(value.size() + 1, 1));
    std::copy(value.begin(), value.end(), chars);
    chars[value.size()] = '\0';
    return chars;
  }
  /// Gives a sequence of generated code so many elements, all zero, and returns the first.
  template <class Sequence>
  auto* fill(Sequence& sequence, std::size_t count) {
    using Pointer = decltype(sequence._buffer);
    using Element = std::remove_pointer_t<Pointer>;
    static_assert(std::is_trivial_v<Element>);
    sequence._length = sequence._maximum = static_cast<std::uint32_t>(count);
    sequence._release = false;
    sequence._buffer = nullptr;
    if (count == 0) return sequence._buffer;
    void* place = memory_.allocate(count * sizeof(Element), alignof(Element));
    sequence._buffer = new (place) Element[count]();
    return sequence._buffer;
  }
  /// Nothing that was given points anywhere any more.
  void clear() { memory_.release(); }

 private:
  std::pmr::monotonic_buffer_resource memory_{std::size_t{16} * 1024};
};

}  // namespace drover::ros2
