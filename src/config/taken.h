// What two may not share: a name, an address, a port.
#pragma once

#include <map>
#include <string>

#include "config/findings.h"

namespace drover::config {

class Taken final {
 public:
  explicit Taken(Findings& found) : found_(found) {}

  /// Tells at `path` when somebody has it. Empty ones were told already. `shown`: as it is written.
  void take(const std::string& thing, const std::string& path, const std::string& shown) {
    if (shown.empty()) return;
    const auto [it, inserted] = first_.emplace(thing, path);
    if (!inserted) found_.add(path, "\"" + shown + "\" is used by " + it->second + " already");
  }
  void take(const std::string& thing, const std::string& path) { take(thing, path, thing); }

 private:
  Findings& found_;
  std::map<std::string, std::string> first_;
};

}  // namespace drover::config
