// What the checks of a configuration find, each with its place in the text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/load.h"
#include "json/located_json.h"

namespace drover::config {

/// Problems and warnings go into `loaded`, whose configuration the checks read and complete.
class Findings final {
 public:
  Findings(const json::Node& root, Loaded& loaded) : root_(root), loaded_(loaded) {}

  DroverConfig& config() { return loaded_.config; }
  Loaded& loaded() { return loaded_; }

  /// `path` is like "devices.left.options.node". Of what should be in a value that is of another
  /// kind nothing is told: what stands in its place is not what was written.
  void add(std::string path, std::string message, std::string hint = {});
  /// Not when a person accepted it by this word. `mend` is what may be done instead.
  void warn(const std::string& path, const std::string& message, const std::string& word,
            const std::string& mend = {});
  /// A warning that needs no word: what is written runs, but hardly means what it says.
  void hint_at(const std::string& path, const std::string& message, const std::string& mend);
  /// Whether a person accepted it by this word at the top of the file.
  bool accepts(const std::string& word) const;
  /// Whether the text says anything of this key.
  bool given(std::string_view path) const;
  /// Whether something was found already at a path that begins so.
  bool has_problem(std::string_view path) const;
  /// Whether something was found at this very path: the value there is not what was written.
  bool is_wrong(std::string_view path) const;

 private:
  const json::Node& root_;
  Loaded& loaded_;
};

/// "devices.left.options.node"; without a key the device's own.
std::string device_path(const DeviceConfig& device, std::string_view key = {});
std::string link_path(const LinkConfig& link, std::string_view key = {});

template <class T, class Get>
std::vector<std::string> collect(const std::vector<T>& items, Get get) {
  std::vector<std::string> names;
  names.reserve(items.size());
  for (const auto& item : items) names.push_back(get(item));
  return names;
}

}  // namespace drover::config
