// Visitors of the output's fields: their names, their values, and what changed of them.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "gateway/recording/fields.h"
#include "gateway/recording/format.h"

namespace drover::gateway {

template <class T>
constexpr FieldKind kind_of_value() {
  if constexpr (std::is_floating_point_v<T>) return FieldKind::real;
  if constexpr (std::is_convertible_v<T, std::string_view>) return FieldKind::text;
  return FieldKind::whole;
}

inline std::uint64_t whole(Time value) {
  return static_cast<std::uint64_t>(value.time_since_epoch().count());
}
template <class T>
std::uint64_t whole(T value) {
  return static_cast<std::uint64_t>(value);
}

/// FNV-1a: whether a text changed.
inline std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const char c : text) hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x100000001B3U;
  return hash;
}

/// A value as it is compared: bits of the number, or the text.
struct FieldValue {
  std::uint64_t bits = 0;
  std::string text;
  bool operator==(const FieldValue&) const = default;
};

class FieldNames final {
 public:
  explicit FieldNames(std::vector<FieldName>& into) : into_(into) {}
  template <class T>
  void value(const char* name, const T&, const Shown& = {}) {
    into_.push_back({kind_of_value<T>(), prefix_ + name});
  }
  template <class Visit>
  void inside(const char* name, const Visit& visit) {
    within(prefix_ + name + ".", visit);
  }
  template <class Visit>
  void inside(const char* name, std::size_t index, const Visit& visit) {
    within(prefix_ + name + "[" + std::to_string(index) + "].", visit);
  }

 private:
  template <class Visit>
  void within(std::string prefix, const Visit& visit) {
    std::swap(prefix_, prefix);
    visit();
    std::swap(prefix_, prefix);
  }
  std::vector<FieldName>& into_;
  std::string prefix_;
};

class FieldValues final {
 public:
  explicit FieldValues(std::vector<FieldValue>& into) : into_(into) {}
  template <class T>
  void value(const char*, const T& value, const Shown& = {}) {
    FieldValue& field = next();
    if constexpr (kind_of_value<T>() == FieldKind::text) {
      field.text = std::string_view(value);
    } else if constexpr (kind_of_value<T>() == FieldKind::real) {
      field.bits = bits_of(value);
    } else {
      field.bits = whole(value);
    }
  }
  template <class Visit>
  void inside(const char*, const Visit& visit) {
    visit();
  }
  template <class Visit>
  void inside(const char*, std::size_t, const Visit& visit) {
    visit();
  }

 private:
  FieldValue& next() {
    if (count_ == into_.size()) into_.emplace_back();
    return into_[count_++];
  }
  std::vector<FieldValue>& into_;
  std::size_t count_ = 0;
};

/// Writes what is not as it was, each with its distance from the one before it; 0 ends them.
class FieldChanges final {
 public:
  FieldChanges(std::span<std::uint64_t> last, ByteWriter& out) : last_(last), out_(out) {}
  template <class T>
  void value(const char*, const T& value, const Shown& = {}) {
    if (index_ == last_.size()) return out_.fail();
    std::uint64_t& last = last_[index_++];
    if constexpr (kind_of_value<T>() == FieldKind::text) {
      const std::string_view text = value;
      const auto hash = text.empty() ? 0 : hash_of(text);
      if (differs(last, hash)) out_.text(text);
    } else if constexpr (kind_of_value<T>() == FieldKind::real) {
      const auto bits = bits_of(value);
      if (differs(last, bits)) out_.raw(bits);
    } else {
      const auto before = last;
      const auto now = whole(value);
      if (differs(last, now)) out_.signed_number(static_cast<std::int64_t>(now - before));
    }
  }
  template <class Visit>
  void inside(const char*, const Visit& visit) {
    visit();
  }
  template <class Visit>
  void inside(const char*, std::size_t, const Visit& visit) {
    visit();
  }
  void end() { out_.number(0); }

 private:
  bool differs(std::uint64_t& last, std::uint64_t now) {
    if (last == now) return false;
    last = now;
    out_.number(index_ - written_);
    written_ = index_;
    return true;
  }
  std::span<std::uint64_t> last_;
  ByteWriter& out_;
  std::size_t index_ = 0;
  std::size_t written_ = 0;
};

}  // namespace drover::gateway
