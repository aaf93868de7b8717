// Strict JSON (RFC 8259, with // and /* */ comments) into a tree that knows where each value stood.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "drover/result.h"

namespace drover::json {

struct Member;

/// One value. Integers stay integers: 1 is one, 1.0 and 1e0 are not.
struct Node {
  std::variant<std::monostate, bool, std::int64_t, std::uint64_t, double, std::string,
               std::vector<Node>, std::vector<Member>>
      value;
  std::uint32_t line = 0;    ///< from 1
  std::uint32_t column = 0;  ///< from 1, in characters
  std::uint32_t begin = 0;   ///< byte of the text at which it begins

  bool is_null() const { return std::holds_alternative<std::monostate>(value); }
  const bool* boolean() const { return std::get_if<bool>(&value); }
  /// May contain NUL characters (from \u0000): never pass it on as a C string.
  const std::string* text() const { return std::get_if<std::string>(&value); }
  const std::vector<Node>* list() const { return std::get_if<std::vector<Node>>(&value); }
  const std::vector<Member>* object() const { return std::get_if<std::vector<Member>>(&value); }
  /// Only for a number that was written as an integer and fits.
  std::optional<std::int64_t> integer() const;
  /// Any number; always finite.
  std::optional<double> number() const;
  /// A number as it was written in `text`, which this was parsed from; empty for anything else.
  std::string_view spelling(std::string_view text) const;
  /// Member of an object; nullptr when there is none, or when this is no object.
  const Node* find(std::string_view key) const;
  /// "a text", "an object", ... for messages.
  std::string_view kind() const;
};

struct Member {
  std::string key;
  std::uint32_t line = 0;  ///< of the key
  std::uint32_t column = 0;
  Node node;
};

struct Document {
  Node root;
};

struct Limits {
  std::size_t max_bytes = std::size_t{1} << 20;
  std::size_t max_depth = 16;
  std::size_t max_values = 200'000;
  /// Integers beyond 64 bits are numbers all the same, though no Node::integer().
  bool long_integers = false;
};

struct JsonError {
  std::size_t line = 0;  ///< from 1
  std::size_t column = 0;
  std::string path;  ///< like `data.points[3].x`; empty at the top
  std::string message;
  /// "line 3, column 7 (data.name): ..."
  std::string text() const;
};

/// Foreign text for a message or a log line: at most `max_bytes`, cut between characters, control
/// characters as '?', so that it cannot forge a line.
std::string shown(std::string_view text, std::size_t max_bytes);

/// Refuses, while parsing: depth, size and number of values beyond `limits`, duplicate keys,
/// integers beyond 64 bits (but for `limits.long_integers`), numbers beyond a double, invalid
/// UTF-8, lone surrogates, a byte order mark, NUL bytes, and anything after the value.
Result<Document, JsonError> parse(std::string_view text, const Limits& limits = {});

}  // namespace drover::json
