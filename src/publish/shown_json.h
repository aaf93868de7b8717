// A visitor of describe.h that writes what is shown as members of a JSON object: texts for states,
// null for what is absent, ages for times. Parts have no object of their own.
#pragma once

#include <cmath>
#include <cstdio>
#include <string_view>
#include <type_traits>

#include "drover/describe.h"
#include "json/json_text.h"
#include "publish/names.h"

namespace drover::publish {

class ShownJson {
 public:
  /// `now`: what ages count up to.
  ShownJson(json::JsonText& out, Time now) : out_(out), now_(now) {}

  template <class T>
  void value(const char*, const T&) {}
  template <class T>
  void value(const char* name, const T& value, const Shown& shown) {
    out_.key(shown.as != nullptr ? shown.as : name);
    if constexpr (std::is_same_v<T, Time>) {
      number(value == kNever ? kAbsent : to_s(now_ - value));
    } else if constexpr (std::is_same_v<T, bool>) {
      out_.boolean(value);
    } else if constexpr (std::is_floating_point_v<T>) {
      number(heard_ ? value : kAbsent);
    } else if constexpr (std::is_integral_v<T>) {
      if (shown.hexadecimal) return hexadecimal(value);
      heard_ ? out_.integer(static_cast<std::int64_t>(value)) : out_.null();
    } else if constexpr (std::is_enum_v<T>) {
      out_.text(word(value));
    } else {
      out_.text(value.view());
    }
  }
  template <class Visit>
  void inside(const char*, const Visit& visit) {
    visit();
  }
  template <class Visit>
  void measured(const char*, Time time, const Visit& visit) {
    heard_ = time != kNever;
    visit();
    heard_ = true;
  }
  void vector(const char* name, const Vector3& vector, const Shown&, bool known) {
    out_.key(name).open('[');
    for (const double each : {vector.x, vector.y, vector.z})
      number(known && heard_ ? each : kAbsent);
    out_.close(']');
  }

 protected:
  void number(double value) { std::isfinite(value) ? out_.number(value) : out_.null(); }
  json::JsonText& out_;

 private:
  void hexadecimal(std::uint64_t value) {
    char text[24];
    std::snprintf(text, sizeof text, "0x%llX", static_cast<unsigned long long>(value));
    out_.text(text);
  }
  Time now_;
  bool heard_ = true;  ///< what is visited was measured at all
};

}  // namespace drover::publish
