#include "config/reader.h"

#include <charconv>
#include <cmath>
#include <optional>

#include "config/key_hint.h"
#include "config/register_map.h"
#include "text/control.h"
#include "text/number.h"
#include "text/suggestion.h"

namespace drover::config {

using text::did_you_mean;
using text::number_text;

namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// What is said of an option that is missing.
std::string what_it_is(const OptionSpec& spec) {
  std::string text(spec.text);
  if (!spec.choices.empty())
    text += "; one of: " + joined({spec.choices.begin(), spec.choices.end()});
  return text;
}

/// "0x1f": nothing but addresses of a register map is read so.
std::optional<unsigned> hexadecimal(std::string_view text) {
  constexpr std::string_view kBegin = "0x";
  unsigned value = 0;
  if (!text.starts_with(kBegin) && !text.starts_with("0X")) return {};
  text.remove_prefix(kBegin.size());
  const auto* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value, 16);
  return error == std::errc{} && end == last ? std::optional(value) : std::nullopt;
}

/// What to write instead, for the usual slips.
std::string right_type(const json::Node& node, std::string_view key, std::string_view expected) {
  if (const auto* text = node.text(); text != nullptr) {
    const auto hex = hexadecimal(*text);
    if (hex && expected.ends_with("number"))
      return "write " + std::to_string(*hex) + ", without quotes";
    const auto inner = json::parse(*text);
    const bool number = inner && inner->root.number() && expected.ends_with("number");
    const bool flag = inner && inner->root.boolean() != nullptr && expected == "true or false";
    return number || flag ? "write it without quotes" : "";
  }
  if (node.number() && expected == "a text") return "write it in quotes";
  if (node.number() && expected == "a whole number") {
    const bool in_seconds = key.ends_with("_ms") && std::abs(*node.number()) < 10;
    return in_seconds ? "it is in milliseconds: " + number_text(*node.number()) + " s are " +
                            number_text(std::round(*node.number() * 1000))
                      : "write it without a fraction";
  }
  if (node.is_null()) return "leave the key out for its default";
  return "";
}

std::string counted(std::size_t n) {
  return text::counted(n, "entry", "entries");
}

/// People write what stands on the device.
std::string driver_meant(const std::string& written, const std::vector<std::string>& drivers) {
  auto near = did_you_mean(written, drivers);
  if (!near.empty()) return near;
  if (const auto* entry = find_by_product(written))
    return "\"" + std::string(entry->name) + "\" speaks with it: " + std::string(entry->summary);
  return is_spoken_by_none(written) ? "no driver speaks with it" : "";
}

std::string kind_meant(const std::string& written, const std::vector<std::string>& kinds) {
  for (const auto* const sideways : {"omni", "holonomic", "swerve"})
    if (written.starts_with(sideways))
      return "\"" + std::string(kMecanumKind) +
             "\" goes sideways, on four wheels with rollers at 45 degrees; other wheels that do "
             "are "
             "not driven";
  return did_you_mean(written, kinds);
}

std::string choice_meant(std::string_view key, const std::string& written,
                         const std::vector<std::string>& choices) {
  if (key == "driver") return driver_meant(written, choices);
  return key == "kind" ? kind_meant(written, choices) : did_you_mean(written, choices);
}

}  // namespace

Reader::Reader(const json::Node& node, std::string path, std::vector<Problem>& problems)
    : node_(node), path_(std::move(path)), problems_(problems) {}

std::string Reader::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

void Reader::add(const json::Node& place, std::string path, std::string message,
                 std::string suggestion) {
  problems_.push_back(
      {place.line, place.column, std::move(path), std::move(message), std::move(suggestion), ""});
}

bool Reader::is_told(const std::string& path) const {
  return std::any_of(problems_.begin(), problems_.end(),
                     [&path](const auto& problem) { return problem.path == path; });
}

const json::Node* Reader::find(std::string_view key, Presence presence, std::string_view text) {
  known_.emplace_back(key);
  const auto* node = node_.find(key);
  if (node == nullptr && presence == Presence::required)
    add(node_, path_of(key), "is missing", std::string(text));
  if (presence == Presence::alternative) alternatives_.emplace_back(key);
  return node;
}

void Reader::wrong_type(const json::Node& node, std::string_view key, std::string_view expected) {
  add(node, path_of(key),
      "is " + std::string(node.kind()) + ", but " + std::string(expected) + " is expected",
      right_type(node, key, expected));
}

void Reader::no_text(const json::Node& node, std::string_view key,
                     const std::vector<std::string>& choices) {
  const bool is_choice = node.number() && std::find(choices.begin(), choices.end(),
                                                    number_text(*node.number())) != choices.end();
  if (choices.empty() || is_choice || node.is_null()) return wrong_type(node, key, "a text");
  add(node, path_of(key), "is " + std::string(node.kind()) + ", but a text is expected",
      "one of: " + joined(choices));
}

void Reader::check_count(const json::Node& node, std::string_view key, Count count) {
  const auto size = node.list() != nullptr ? node.list()->size() : node.object()->size();
  if (size < count.min)
    add(node, path_of(key), "has " + counted(size) + ", but needs at least " + counted(count.min));
  if (size > count.max)
    add(node, path_of(key),
        "has " + counted(size) + ", but may have at most " + counted(count.max));
}

/// People read it in the status and in the log.
void Reader::check_name(const json::Member& member, const std::string& path) {
  const auto& name = member.key;
  const auto told = [&](const char* message) {
    problems_.push_back({member.line, member.column, path, message, "", ""});
  };
  if (name.empty()) {
    told("the name is empty");
  } else if (text::has_control(name)) {
    told("the name holds a control character");
  } else if (Name(name).view() != name) {
    told("the name is too long");
  }
}

void Reader::check_alternatives() {
  std::vector<std::string> given;
  for (const auto& key : alternatives_)
    if (node_.find(key) != nullptr) given.push_back(key);
  if (!alternatives_.empty() && given.empty())
    add(node_, path_, "has none of: " + joined(alternatives_));
  for (std::size_t i = 1; i < given.size(); ++i)
    add(*node_.find(given[i]), path_of(given[i]), "is given beside " + given[0],
        "one of: " + joined(alternatives_));
}

namespace {

/// " metres", by the end of a key that has a unit; it is what people write otherwise.
std::string unit_of(std::string_view key) {
  constexpr std::pair<std::string_view, std::string_view> kUnits[] = {
      {"_mps", " m/s"}, {"_mps2", " m/s2"}, {"_radps", " rad/s"}, {"_deg", " degrees"},
      {"_ms", " ms"},   {"_s", " s"},       {"_Hz", " Hz"},       {"_m", " metres"}};
  for (const auto& [end, unit] : kUnits)
    if (key.ends_with(end)) return std::string(unit);
  return "";
}

}  // namespace

void Reader::out_of_range(const json::Node& node, std::string_view key, Range range,
                          std::string_view what) {
  add(node, path_of(key),
      "is " + number_text(*node.number()) + ", but must be between " + number_text(range.min) +
          " and " + number_text(range.max) + unit_of(key),
      std::string(what));
}

void Reader::number(std::string_view key, double& into, Range range, std::string_view text,
                    Presence presence) {
  const auto* node = find(key, presence, text);
  if (node == nullptr) return;
  const auto value = node->number();
  if (!value) return wrong_type(*node, key, "a number");
  if (*value < range.min || *value > range.max) return out_of_range(*node, key, range);
  into = *value;
}

void Reader::integer(std::string_view key, int& into, Range range, std::string_view text,
                     Presence presence) {
  const auto* node = find(key, presence, text);
  if (node == nullptr) return;
  const auto value = node->integer();
  if (!value) return wrong_type(*node, key, "a whole number");
  if (*value < static_cast<std::int64_t>(range.min) ||
      *value > static_cast<std::int64_t>(range.max))
    return out_of_range(*node, key, range);
  into = static_cast<int>(*value);
}

void Reader::flag(std::string_view key, bool& into, std::string_view text, Presence presence) {
  const auto* node = find(key, presence, text);
  if (node == nullptr) return;
  if (node->boolean() == nullptr) return wrong_type(*node, key, "true or false");
  into = *node->boolean();
}

void Reader::text(std::string_view key, std::string& into, std::string_view what,
                  Presence presence) {
  const auto* node = find(key, presence, what);
  if (node == nullptr) return;
  if (node->text() == nullptr) return wrong_type(*node, key, "a text");
  if (node->text()->find('\0') != std::string::npos)
    return add(*node, path_of(key), "holds a NUL character");
  if (presence != Presence::optional && presence != Presence::of_kind && node->text()->empty())
    return add(*node, path_of(key), "is empty", std::string(what));
  into = *node->text();
}

void Reader::choice(std::string_view key, std::string& into,
                    const std::vector<std::string>& choices, std::string_view what,
                    Presence presence) {
  std::string value = into;
  const auto before = problems_.size();
  const auto* node = node_.find(key);
  if (node != nullptr && node->text() == nullptr) {
    known_.emplace_back(key);
    return no_text(*node, key, choices);
  }
  text(key, value, what, presence);
  if (node == nullptr || problems_.size() != before) return;
  if (std::find(choices.begin(), choices.end(), value) == choices.end())
    return add(*node, path_of(key), "\"" + value + "\" is not one of: " + joined(choices),
               choice_meant(key, value, choices));
  into = value;
}

void Reader::names(std::string_view key, std::vector<std::string>& into, Count count,
                   std::string_view text, Presence presence) {
  const auto* node = find(key, presence, text);
  if (node == nullptr) return;
  if (node->list() == nullptr) return wrong_type(*node, key, "a list of texts");
  check_count(*node, key, count);
  for (const auto& item : *node->list()) {
    if (item.text() == nullptr) {
      wrong_type(item, key, "a list of texts");
    } else {
      into.push_back(*item.text());
    }
  }
}

void Reader::address(std::string_view key, int& into, std::string_view text, Presence presence) {
  constexpr Range kRegisters{0, 65535};
  const auto* node = find(key, presence, text);
  if (node == nullptr) return;
  std::optional<std::int64_t> value = node->integer();
  if (const auto* word = node->text(); word != nullptr && word->size() <= 6)
    if (const auto hex = hexadecimal(*word)) value = *hex;
  if (!value) return wrong_type(*node, key, "an address like 40 or \"0x28\"");
  if (*value < 0 || *value > 65535) return out_of_range(*node, key, kRegisters);
  into = static_cast<int>(*value);
}

void Reader::numbers(std::string_view key, std::vector<double>& into, Count count, Range range,
                     std::string_view text, Presence presence) {
  const auto* node = find(key, presence, text);
  if (node == nullptr) return;
  if (node->list() == nullptr) return wrong_type(*node, key, "a list of numbers");
  check_count(*node, key, count);
  for (const auto& item : *node->list()) {
    const auto value = item.number();
    if (!value) {
      wrong_type(item, key, "a list of numbers");
    } else if (*value < range.min || *value > range.max) {
      out_of_range(item, key, range);
    } else {
      into.push_back(*value);
    }
  }
}

void Reader::options(std::string_view key, Options& into, const std::string& driver) {
  known_.emplace_back(key);
  const auto* entry = find_driver(driver);
  if (entry == nullptr) return;
  into = Options(entry->options);
  options_ = entry->options;
  static const json::Node kEmpty{std::vector<json::Member>{}, 0, 0};
  const auto* given = node_.find(key);
  json::Node none = kEmpty;
  none.line = node_.line;
  none.column = node_.column;
  const auto& node = given != nullptr ? *given : none;
  if (node.object() == nullptr) return wrong_type(node, key, "an object");
  Reader inner(node, path_of(key), problems_);
  for (const auto& spec : entry->options) {
    const auto* value = spec.required ? inner.find(spec.name, Presence::required, what_it_is(spec))
                                      : inner.find(spec.name, Presence::optional, spec.text);
    if (value != nullptr) inner.option(spec, *value, into);
  }
  inner.finish();
}

void Reader::keys_of_kind(const std::string& driver) {
  const auto* entry = find_driver(driver);
  if (entry == nullptr) return;
  for (const auto& each : kKindKeys)
    key_of_kind(each.key, has_key(*entry, each), each.presence == Presence::required, driver);
}

void Reader::keys_of_base(const std::string& kind) {
  if (std::find(std::begin(kBaseKinds), std::end(kBaseKinds), kind) == std::end(kBaseKinds)) return;
  for (const auto& each : kBaseKeys)
    key_of_kind(each.key, each.is_of(kind), true, "a base of kind \"" + kind + "\"");
}

void Reader::key_of_kind(std::string_view key, bool has, bool needs, const std::string& whose) {
  const auto* node = node_.find(key);
  if (!has && node != nullptr) add(*node, path_of(key), "is of no use to " + whose, "leave it out");
  if (!has || !needs) return;
  if (node == nullptr)
    add(node_, path_of(key), "is missing",
        whose + " needs it" +
            (key == "is" ? "; one of: " + joined({kLineKeys.begin(), kLineKeys.end()})
             : key == "map"
                 ? "; one of: " + joined(known_register_maps()) + ", or a file of your own"
                 : ""));
  else if (node->text() != nullptr && node->text()->empty() && !is_told(path_of(key)))
    add(*node, path_of(key), "is empty");
}

void Reader::option(const OptionSpec& spec, const json::Node& node, Options& into) {
  if (std::holds_alternative<bool>(spec.default_value)) {
    if (node.boolean() == nullptr) return wrong_type(node, spec.name, "true or false");
    into.set(spec.name, *node.boolean());
  } else if (std::holds_alternative<double>(spec.default_value)) {
    if (spec.integer && !node.integer()) return wrong_type(node, spec.name, "a whole number");
    if (!node.number()) return wrong_type(node, spec.name, "a number");
    const double number = *node.number();
    if (spec.min < spec.max && (number < spec.min || number > spec.max))
      return out_of_range(node, spec.name, {spec.min, spec.max}, spec.text);
    into.set(spec.name, number);
  } else {
    const std::vector<std::string> choices(spec.choices.begin(), spec.choices.end());
    if (node.text() == nullptr) return no_text(node, spec.name, choices);
    const auto& value = *node.text();
    if (!choices.empty() && std::find(choices.begin(), choices.end(), value) == choices.end())
      return add(node, path_of(spec.name), "\"" + value + "\" is not one of: " + joined(choices),
                 did_you_mean(value, choices));
    into.set(spec.name, value);
  }
}

void Reader::finish() {
  check_alternatives();
  for (const auto& member : *node_.object()) {
    if (std::find(known_.begin(), known_.end(), member.key) != known_.end()) continue;
    if (path_.empty() && member.key == "$schema") continue;  // for the editor
    const auto path = path_of(member.key);
    problems_.push_back({member.line, member.column, path, "is no known key",
                         key_hint(path, member.key, known_, options_), ""});
  }
}

}  // namespace drover::config
