// Reads an object's members once each, and refuses what nobody asked for.
#pragma once

#include <nlohmann/json.hpp>

#include <cmath>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "drover/options.h"

namespace drover::sim {

/// View of one JSON object with the path that leads to it. Every problem is a std::runtime_error
/// that begins with the path.
class JsonReader {
 public:
  JsonReader(const nlohmann::json& object, std::string path);

  bool has(std::string_view key);
  double number(std::string_view key, double fallback);
  double number(std::string_view key);
  std::string text(std::string_view key, std::string_view fallback);
  std::string text(std::string_view key);
  std::vector<std::string> texts(std::string_view key);
  bool flag(std::string_view key, bool fallback);
  JsonReader object(std::string_view key);
  std::vector<JsonReader> list(std::string_view key);
  /// The object's keys, in the order of the alphabet; the caller takes each.
  std::vector<std::string> keys() const;
  /// The member's values go into `options`, each checked against `specs`.
  void options(std::string_view key, std::span<const OptionSpec> specs, Options& options);
  void ignore(std::string_view key) { asked_.emplace(key); }
  /// Refuses members that were not asked for, and names those that may stand there.
  void done() const;

  [[noreturn]] void fail(std::string_view key, const std::string& problem) const;

 private:
  const nlohmann::json* find(std::string_view key);
  const nlohmann::json& need(std::string_view key);
  std::string place(std::string_view key) const;

  const nlohmann::json* object_;
  std::string path_;
  std::set<std::string> asked_;
};

/// Parses with comments allowed; refuses duplicate keys.
nlohmann::json parse_json(std::string_view text);

}  // namespace drover::sim
