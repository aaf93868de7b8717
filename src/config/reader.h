// Visitor that reads one JSON object into a configuration struct and collects every problem.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/fields.h"
#include "config/load.h"
#include "json/located_json.h"

namespace drover::config {

class Reader final {
 public:
  Reader(const json::Node& node, std::string path, std::vector<Problem>& problems);

  void number(std::string_view key, double& into, Range range, std::string_view text,
              Presence presence = Presence::optional);
  void integer(std::string_view key, int& into, Range range, std::string_view text,
               Presence presence = Presence::optional);
  void flag(std::string_view key, bool& into, std::string_view text,
            Presence presence = Presence::optional);
  void text(std::string_view key, std::string& into, std::string_view text,
            Presence presence = Presence::optional);
  void choice(std::string_view key, std::string& into, const std::vector<std::string>& choices,
              std::string_view text, Presence presence = Presence::optional);
  void names(std::string_view key, std::vector<std::string>& into, Count count,
             std::string_view text, Presence presence = Presence::optional);
  /// A register's address: a whole number, or a text like "0x1290".
  void address(std::string_view key, int& into, std::string_view text,
               Presence presence = Presence::optional);
  void numbers(std::string_view key, std::vector<double>& into, Count count, Range range,
               std::string_view text, Presence presence = Presence::optional);
  void options(std::string_view key, Options& into, const std::string& driver);
  /// The keys that only some kinds of device have: this driver's are there, the others' are not.
  void keys_of_kind(const std::string& driver);
  /// The same of the base: what a base with wheels needs, and what one that takes a twist.
  void keys_of_base(const std::string& kind);

  template <class T>
  void object(std::string_view key, T& into, std::string_view text,
              Presence presence = Presence::optional) {
    const auto* node = find(key, presence, text);
    if (node == nullptr) return;
    if (node->object() == nullptr) return wrong_type(*node, key, "an object");
    Reader inner(*node, path_of(key), problems_);
    visit(inner, into);
    inner.finish();
  }
  template <class T>
  void list(std::string_view key, std::vector<T>& into, Count count, std::string_view text,
            Presence presence = Presence::optional) {
    const auto* node = find(key, presence, text);
    if (node == nullptr) return;
    if (node->list() == nullptr) return wrong_type(*node, key, "a list");
    check_count(*node, key, count);
    for (const auto& item : *node->list()) {
      const auto path = path_of(key) + "[" + std::to_string(into.size()) + "]";
      into.emplace_back();
      if (item.object() == nullptr) {
        add(item, path, "is " + std::string(item.kind()) + ", but an object is expected");
        continue;
      }
      Reader inner(item, path, problems_);
      visit(inner, into.back());
      inner.finish();
    }
  }
  /// An object whose keys are names of the user's own; `into` keeps the order of the file.
  template <class T>
  void table(std::string_view key, std::vector<T>& into, Count count, std::string_view text,
             Presence presence = Presence::optional) {
    const auto* node = find(key, presence, text);
    if (node == nullptr) return;
    if (node->list() != nullptr)
      return add(*node, path_of(key), "is a list, but an object is expected",
                 "each entry by its name: {\"NAME\": {...}}");
    if (node->object() == nullptr) return wrong_type(*node, key, "an object");
    check_count(*node, key, count);
    for (const auto& member : *node->object()) row(member, path_of(key) + "." + member.key, into);
  }
  /// As a table: the members of this object that nobody asked for before.
  template <class T>
  void others(std::vector<T>& into, std::size_t most, std::string_view /*text*/) {
    for (const auto& member : *node_.object()) {
      if (std::find(known_.begin(), known_.end(), member.key) != known_.end()) continue;
      known_.push_back(member.key);
      if (into.size() == most) {
        add(member.node, path_of(member.key),
            "is one too many: there may be " + std::to_string(most) + " beside " + known_[0]);
        return;
      }
      row(member, path_of(member.key), into);
    }
  }
  /// Reports the members that nobody asked for.
  void finish();

 private:
  template <class T>
  void row(const json::Member& member, const std::string& path, std::vector<T>& into) {
    check_name(member, path);
    into.emplace_back();
    into.back().name = member.key;
    if (member.node.object() == nullptr) {
      add(member.node, path,
          "is " + std::string(member.node.kind()) + ", but an object is expected");
      return;
    }
    Reader inner(member.node, path, problems_);
    visit(inner, into.back());
    inner.finish();
  }
  const json::Node* find(std::string_view key, Presence presence, std::string_view text);
  std::string path_of(std::string_view key) const;
  void wrong_type(const json::Node& node, std::string_view key, std::string_view expected);
  /// Where one of the choices was expected.
  void no_text(const json::Node& node, std::string_view key,
               const std::vector<std::string>& choices);
  void out_of_range(const json::Node& node, std::string_view key, Range range,
                    std::string_view what = {});
  /// Of a list or an object.
  void check_count(const json::Node& node, std::string_view key, Count count);
  void check_name(const json::Member& member, const std::string& path);
  void check_alternatives();
  void add(const json::Node& place, std::string path, std::string message,
           std::string suggestion = {});
  bool is_told(const std::string& path) const;
  void option(const OptionSpec& spec, const json::Node& node, Options& into);
  void key_of_kind(std::string_view key, bool has, bool needs, const std::string& whose);

  const json::Node& node_;
  std::string path_;
  std::vector<Problem>& problems_;
  std::vector<std::string> known_;
  std::vector<std::string> alternatives_;
  std::span<const OptionSpec> options_;  ///< of the device's driver, which stand one level deeper
};

}  // namespace drover::config
