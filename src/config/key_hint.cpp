#include "config/key_hint.h"

#include <algorithm>
#include <utility>

#include "text/suggestion.h"

namespace drover::config {
namespace {

using text::did_you_mean;

bool is_known(const std::vector<std::string>& known, std::string_view key) {
  return std::find(known.begin(), known.end(), key) != known.end();
}

/// The right key in the wrong place; empty: it is none.
std::string belongs_elsewhere(std::string_view path, const std::string& key,
                              std::span<const OptionSpec> options) {
  const bool is_option = std::any_of(options.begin(), options.end(),
                                     [&](const OptionSpec& spec) { return spec.name == key; });
  if (is_option) return "it belongs into \"options\"";
  if (path.starts_with("devices.") && key == "carries_weight")
    return "it belongs into groups.NAME.joints";
  if (!path.starts_with("groups.")) return "";
  if (key == "accept") return "it belongs into the device, or to the top of the file";
  for (const auto* const option : {"reversed", "id", "model", "zero_rad", "gear_ratio"})
    if (key == option) return "it belongs into the options of the device";
  return "";
}

/// What people look for in the file and comes another way; empty: nothing of that.
std::string comes_otherwise(std::string_view path) {
  for (const auto* const fence : {"scene.fence", "scene.fences", "scene.zone", "scene.zones",
                                  "scene.keep_in", "scene.keep_out"})
    if (path == fence)
      return "zones are imported: drover zone import FILE --keep-in, or --keep-out";
  if (path.starts_with("links.") &&
      (path.ends_with(".bitrate") || path.ends_with(".bit_rate") || path.ends_with(".speed")))
    return "the system sets the bit rate of a CAN bus (80-can0.network, config/README.md); a "
           "serial "
           "line's is \"baud\"";
  if (path == "scene.object" || path == "scene.objects")
    return "objects come as messages of the topic collision_object";
  return "";
}

/// An angle in degrees where radians are meant; empty: none.
std::string radians_meant(const std::string& key, const std::vector<std::string>& known) {
  constexpr std::string_view kDegrees = "_deg";
  if (!key.ends_with(kDegrees)) return "";
  const auto meant = key.substr(0, key.size() - kDegrees.size()) + "_rad";
  if (!is_known(known, meant)) return "";
  return "\"" + meant + "\" is in radians: one degree is 0.01745";
}

/// What others call a joint's gains.
std::string gain_meant(const std::string& key, const std::vector<std::string>& known) {
  for (const auto& [theirs, ours] :
       {std::pair{"kp", "stiffness_Nmprad"}, {"kd", "damping_Nmsprad"}})
    if (key == theirs && is_known(known, ours))
      return "did you mean \"" + std::string(ours) + "\"?";
  return "";
}

/// One of several, each with a number.
std::string numbered_meant(const std::string& key, const std::vector<std::string>& known) {
  std::string all;
  int n = 0;
  for (const auto& each : known) {
    const bool is_one = each.starts_with(key + "_") && each.size() == key.size() + 2 &&
                        each.back() >= '1' && each.back() <= '9';
    if (!is_one) continue;
    all += (n++ == 0 ? "" : ", ") + each;
  }
  return n < 2 ? "" : "each motor has its own: " + all;
}

/// A height above the ground is a z here.
std::string height_meant(const std::string& written, const std::vector<std::string>& known) {
  constexpr std::string_view kHeight = "height";
  const auto at = written.find(kHeight);
  if (at == std::string::npos) return "";
  auto as_z = written;
  as_z.replace(at, kHeight.size(), "z");
  return text::nearest(as_z, known).starts_with(as_z) ? did_you_mean(as_z, known) : "";
}

}  // namespace

std::string key_hint(std::string_view path, const std::string& key,
                     const std::vector<std::string>& known, std::span<const OptionSpec> options) {
  for (auto hint :
       {belongs_elsewhere(path, key, options), comes_otherwise(path), radians_meant(key, known),
        gain_meant(key, known), height_meant(key, known), numbered_meant(key, known)})
    if (!hint.empty()) return hint;
  return did_you_mean(key, known);
}

}  // namespace drover::config
