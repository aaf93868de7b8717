#include "cli/shown_text.h"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <utility>

#include "cli/layout.h"
#include "drover/describe_snapshot.h"

namespace drover::cli {

namespace {

/// Suffix of a value's name, and how people write that unit.
constexpr std::array<std::pair<std::string_view, std::string_view>, 16> kUnits{{
    {"_Nmprad", "Nm/rad"},
    {"_Nmsprad", "Nms/rad"},
    {"_deg", "deg"},
    {"_m", "m"},
    {"_s", "s"},
    {"_mps", "m/s"},
    {"_mps2", "m/s2"},
    {"_rad", "rad"},
    {"_radps", "rad/s"},
    {"_V", "V"},
    {"_A", "A"},
    {"_Nm", "Nm"},
    {"_Ah", "Ah"},
    {"_degC", "C"},
    {"_percent", "%"},
    {"_Hz", "Hz"},
}};

/// The decimals of each number that is shown, by its name.
class Decimals final {
 public:
  Decimals() {
    describe(*this, GnssSnapshot{});
    describe(*this, ImuSnapshot{});
    describe(*this, BatterySnapshot{});
    describe(*this, AxisSnapshot{});
    describe(*this, BaseSnapshot{});
    describe(*this, Pose{});
    describe(*this, NavSnapshot{});
    known_["rate_Hz"] = 1;  // not the vocabulary's: two answers make it
  }
  template <class T>
  void value(const char*, const T&) {}
  template <class T>
  void value(const char* name, const T&, const Shown& shown) {
    known_.emplace(shown.as != nullptr ? shown.as : name, shown.decimals);
  }
  template <class Visit>
  void inside(const char*, const Visit& visit) {
    visit();
  }
  void vector(const char* name, const Vector3&, const Shown& shown, bool) {
    known_.emplace(name, shown.decimals);
  }
  int of(std::string_view name) const {
    const auto found = known_.find(name);
    if (found == known_.end()) throw std::logic_error("nobody shows " + std::string(name));
    return found->second;
  }

 private:
  std::map<std::string, int, std::less<>> known_;
};

int decimals_of(std::string_view name) {
  static const Decimals kDecimals;
  return kDecimals.of(name);
}

}  // namespace

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  char out[64];
  std::snprintf(out, sizeof out, "%.*f", decimals, value);
  // What rounds to zero is zero.
  const bool zero = std::string_view(out).find_first_of("123456789") == std::string_view::npos;
  return zero && out[0] == '-' ? out + 1 : out;
}

std::string take_unit(std::string_view& name) {
  for (const auto& [suffix, unit] : kUnits) {
    if (!name.ends_with(suffix)) continue;
    name.remove_suffix(suffix.size());
    return " " + std::string(unit);
  }
  return "";
}

std::string said(const json::Node& object, std::string_view name) {
  const int decimals = decimals_of(name);
  const auto value = at(object, name).number();
  return value ? fixed(*value, decimals) + take_unit(name) : "-";
}

std::string said(std::string_view label, const json::Node& object, std::string_view name) {
  return std::string(label) + " " + said(object, name);
}

std::string said_vector(const json::Node& object, std::string_view name) {
  constexpr std::size_t kColumn = 8;
  const int decimals = decimals_of(name);
  const auto* list = at(object, name).list();
  std::string out;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = list != nullptr && i < list->size() ? (*list)[i].number() : std::nullopt;
    std::string number = value ? fixed(*value, decimals) : "-";
    if (value && number.size() < kColumn) number.insert(0, kColumn - number.size(), ' ');
    out += std::string(1, "xyz"[i]) + " " + number + "  ";
  }
  return out + take_unit(name).substr(1);
}

std::string ShownText::hexadecimal(std::uint64_t value) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%llX", static_cast<unsigned long long>(value));
  return text;
}

void ShownText::add(const Shown& shown, std::string_view label, const std::string& value) {
  std::string name(label);
  std::replace(name.begin(), name.end(), '_', ' ');
  (shown.first ? first_ : rest_) += "  " + name + " " + (value.empty() ? "-" : value);
}

}  // namespace drover::cli
