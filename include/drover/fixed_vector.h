// A vector with a fixed capacity inside itself: for code that must not allocate.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

namespace drover {

/// To make, clear and copy one costs what is in it, not what could be: beyond size() there are no
/// values, and nothing is there to be read.
template <class T, std::size_t N>
class FixedVector {
  static_assert(std::is_trivially_destructible_v<T>, "clear() only forgets");

 public:
  FixedVector() {}  // NOLINT(modernize-use-equals-default): the items stay as they are
  FixedVector(const FixedVector& other) : size_(other.size_) {
    std::uninitialized_copy_n(other.items_.data(), size_, items_.data());
  }
  FixedVector& operator=(const FixedVector& other) {
    if (this == &other) return *this;
    size_ = other.size_;
    std::uninitialized_copy_n(other.items_.data(), size_, items_.data());
    return *this;
  }
  ~FixedVector() = default;

  /// Appends; returns false and changes nothing when full.
  [[nodiscard]] bool push_back(const T& value) {
    if (size_ == N) return false;
    std::construct_at(items_.data() + size_, value);
    ++size_;
    return true;
  }
  /// The same of what `make` returns, which is made in its place.
  template <class Make>
  [[nodiscard]] bool push_made(const Make& make) {
    if (size_ == N) return false;
    ::new (static_cast<void*>(items_.data() + size_)) T(make());
    ++size_;
    return true;
  }
  void clear() { size_ = 0; }
  /// What is new is T{}.
  void resize(std::size_t size) {
    if (size > N) size = N;
    for (; size_ < size; ++size_) std::construct_at(items_.data() + size_);
    size_ = size;
  }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  bool full() const { return size_ == N; }
  static constexpr std::size_t capacity() { return N; }
  T& operator[](std::size_t i) { return items_[i]; }
  const T& operator[](std::size_t i) const { return items_[i]; }
  T& back() { return items_[size_ - 1]; }
  const T& back() const { return items_[size_ - 1]; }
  T* data() { return items_.data(); }
  const T* data() const { return items_.data(); }
  T* begin() { return items_.data(); }
  T* end() { return items_.data() + size_; }
  const T* begin() const { return items_.data(); }
  const T* end() const { return items_.data() + size_; }
  operator std::span<const T>() const { return {items_.data(), size_}; }
  operator std::span<T>() { return {items_.data(), size_}; }

 private:
  // The only member of a union is not begun with its owner.
  union {
    std::array<T, N> items_;
  };
  std::size_t size_ = 0;
};

}  // namespace drover
