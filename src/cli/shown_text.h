// How values are written for people: the name without its unit, so many decimals, the unit; "-" for
// what is absent. Names and decimals are the vocabulary's (drover/describe.h).
#pragma once

#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <type_traits>

#include "drover/describe.h"
#include "json/located_json.h"
#include "publish/names.h"

namespace drover::cli {

/// "-0.00" is written as "0.00", what is not finite as "-".
std::string fixed(double value, int decimals);
/// " m/s" of "speed_mps", which becomes "speed"; empty when the name has none.
std::string take_unit(std::string_view& name);

/// A number of droverd's answer with its decimals and unit: "23.149652472 deg"; "-" when it is
/// absent. Throws std::logic_error for a name that describe*.h does not show.
std::string said(const json::Node& object, std::string_view name);
/// The same behind a label.
std::string said(std::string_view label, const json::Node& object, std::string_view name);
/// Of three numbers: "x   -0.019  y    0.048  z    9.730  m/s2".
std::string said_vector(const json::Node& object, std::string_view name);

/// A visitor of describe.h: "  latitude 23.149652472 deg  longitude ...".
class ShownText final {
 public:
  template <class T>
  void value(const char*, const T&) {}
  template <class T>
  void value(const char* name, const T& value, const Shown& shown) {
    std::string_view label = shown.as != nullptr ? shown.as : name;
    if constexpr (std::is_same_v<T, bool>) {
      add(shown, label, value ? "yes" : "no");
    } else if constexpr (std::is_enum_v<T>) {
      add(shown, label, std::string(publish::word(value)));
    } else if constexpr (std::is_arithmetic_v<T>) {
      const auto unit = take_unit(label);
      const bool known = std::isfinite(static_cast<double>(value));
      add(shown, label,
          shown.hexadecimal ? hexadecimal(static_cast<std::uint64_t>(value))
          : known           ? fixed(static_cast<double>(value), shown.decimals) + unit
                            : "");
    } else {
      add(shown, label, std::string(value.view()));
    }
  }
  template <class Visit>
  void inside(const char*, const Visit& visit) {
    visit();
  }
  void vector(const char* name, const Vector3& v, const Shown& shown, bool) {
    std::string_view label = name;
    const auto unit = take_unit(label);
    const int decimals = shown.decimals;
    add(shown, label,
        fixed(v.x, decimals) + " " + fixed(v.y, decimals) + " " + fixed(v.z, decimals) + unit);
  }
  void derived(const char* name, double angle, const Shown& shown) { value(name, angle, shown); }

  std::string take() { return first_ + rest_; }

 private:
  static std::string hexadecimal(std::uint64_t value);
  void add(const Shown& shown, std::string_view label, const std::string& value);

  std::string first_;  ///< what people read before the rest
  std::string rest_;
};

}  // namespace drover::cli
