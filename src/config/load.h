// Reads drover.json: every problem at once, each with its place and a suggestion.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/config.h"

namespace drover::config {

struct Problem {
  std::size_t line = 0;  ///< from 1; 0 when it has no place
  std::size_t column = 0;
  std::string path;  ///< "devices.left.options.node"
  std::string message;
  std::string suggestion;  ///< empty when there is none
  std::string file;        ///< empty: the configuration; otherwise the register map it names
  /// "drover.json:12:7: devices.left.options.node: ... (did you mean ...?)"
  std::string text(std::string_view given_file) const;
};

struct Loaded {
  DroverConfig config;  ///< to be used only when there are no problems
  std::vector<Problem> problems;
  // As they were read: a recording carries them.
  std::string text;
  /// Of the batteries, in the order in which they are named first, kMapsEnd between them; empty:
  /// none.
  std::string register_map;
  std::vector<Problem> warnings;  ///< what a person should know and may accept by name
  /// When it has sections of the first form, which are problems: the same in today's form.
  std::string new_sections;
};

/// Between the texts of register maps; in JSON it stands nowhere.
inline constexpr char kMapsEnd = '\x1e';

/// Files that the configuration names are looked for below `folder`; register maps only when their
/// texts are not given.
Loaded load_text(std::string_view text, const std::string& folder = "",
                 std::string register_map = "");
/// A file that cannot be read is a problem without a place.
Loaded load_file(const std::string& path);

/// Reads a whole file of at most 1 MiB and a byte; empty, or why not.
std::string read_text(const std::string& path, std::string& text);

/// JSON schema (draft 7) of the configuration, from the same tables.
std::string schema_text();

}  // namespace drover::config
