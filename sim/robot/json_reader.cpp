#include "sim/robot/json_reader.h"

#include "text/suggestion.h"

namespace drover::sim {
namespace {

OptionValue option_value(const JsonReader& reader, const OptionSpec& spec,
                         const nlohmann::json& value) {
  const std::string name(spec.name);
  if (std::holds_alternative<bool>(spec.default_value)) {
    if (!value.is_boolean()) reader.fail(name, "must be true or false");
    return value.get<bool>();
  }
  if (std::holds_alternative<std::string>(spec.default_value)) {
    if (!value.is_string()) reader.fail(name, "must be a text");
    const auto text = value.get<std::string>();
    std::string known;
    for (const auto choice : spec.choices) {
      if (choice == text) return text;
      known += (known.empty() ? "" : ", ") + std::string(choice);
    }
    if (!spec.choices.empty()) reader.fail(name, "must be one of " + known);
    return text;
  }
  if (!value.is_number()) reader.fail(name, "must be a number");
  const double number = value.get<double>();
  if (spec.integer && number != std::floor(number)) reader.fail(name, "must be an integer");
  if (spec.min < spec.max && !(number >= spec.min && number <= spec.max)) {
    char range[80];
    std::snprintf(range, sizeof range, "must be from %g to %g", spec.min, spec.max);
    reader.fail(name, range);
  }
  return number;
}

}  // namespace

JsonReader::JsonReader(const nlohmann::json& object, std::string path)
    : object_(&object), path_(std::move(path)) {
  if (!object.is_object())
    throw std::runtime_error((path_.empty() ? "the scenario" : path_) + ": must be an object");
}

std::string JsonReader::place(std::string_view key) const {
  if (key.empty()) return path_.empty() ? "the scenario" : path_;  // of the object itself
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

void JsonReader::fail(std::string_view key, const std::string& problem) const {
  throw std::runtime_error(place(key) + ": " + problem);
}

const nlohmann::json* JsonReader::find(std::string_view key) {
  asked_.emplace(key);
  const auto it = object_->find(std::string(key));
  return it == object_->end() ? nullptr : &*it;
}

const nlohmann::json& JsonReader::need(std::string_view key) {
  const auto* value = find(key);
  if (value != nullptr) return *value;
  const auto near = text::nearest(key, keys());
  fail(key, near.empty() ? "is missing" : "is missing (is \"" + near + "\" meant to be it?)");
}

bool JsonReader::has(std::string_view key) {
  return find(key) != nullptr;
}

double JsonReader::number(std::string_view key) {
  const auto& value = need(key);
  if (!value.is_number()) fail(key, "must be a number");
  return value.get<double>();
}

double JsonReader::number(std::string_view key, double fallback) {
  return has(key) ? number(key) : fallback;
}

std::string JsonReader::text(std::string_view key) {
  const auto& value = need(key);
  if (!value.is_string()) fail(key, "must be a text");
  return value.get<std::string>();
}

std::string JsonReader::text(std::string_view key, std::string_view fallback) {
  return has(key) ? text(key) : std::string(fallback);
}

std::vector<std::string> JsonReader::texts(std::string_view key) {
  const auto& value = need(key);
  if (!value.is_array() || value.empty()) fail(key, "must be a list of texts");
  std::vector<std::string> texts;
  for (const auto& item : value) {
    if (!item.is_string()) fail(key, "must be a list of texts");
    texts.push_back(item.get<std::string>());
  }
  return texts;
}

bool JsonReader::flag(std::string_view key, bool fallback) {
  if (!has(key)) return fallback;
  const auto& value = need(key);
  if (!value.is_boolean()) fail(key, "must be true or false");
  return value.get<bool>();
}

JsonReader JsonReader::object(std::string_view key) {
  return {need(key), place(key)};
}

std::vector<JsonReader> JsonReader::list(std::string_view key) {
  const auto& value = need(key);
  if (!value.is_array()) fail(key, "must be a list");
  std::vector<JsonReader> items;
  for (std::size_t i = 0; i < value.size(); ++i)
    items.emplace_back(value[i], place(key) + "[" + std::to_string(i) + "]");
  return items;
}

std::vector<std::string> JsonReader::keys() const {
  std::vector<std::string> keys;
  for (const auto& item : object_->items()) keys.push_back(item.key());
  return keys;
}

void JsonReader::options(std::string_view key, std::span<const OptionSpec> specs,
                         Options& options) {
  static const nlohmann::json kNone = nlohmann::json::object();
  const auto* given = find(key);
  JsonReader reader(given == nullptr ? kNone : *given, place(key));
  for (const auto& spec : specs) {
    const auto* value = reader.find(spec.name);
    if (value != nullptr)
      options.set(spec.name, option_value(reader, spec, *value));
    else if (spec.required)
      reader.fail(spec.name, "is missing");
    else
      options.set(spec.name, spec.default_value);
  }
  reader.done();
}

void JsonReader::done() const {
  for (const auto& item : object_->items()) {
    if (asked_.count(item.key()) != 0) continue;
    std::string known;
    for (const auto& name : asked_) known += (known.empty() ? "" : ", ") + name;
    fail(item.key(), "unknown key; known here: " + (known.empty() ? "none" : known));
  }
}

nlohmann::json parse_json(std::string_view text) {
  std::vector<std::set<std::string>> open;  // keys of the objects that are being read
  const auto watch = [&open](int, nlohmann::json::parse_event_t event, nlohmann::json& parsed) {
    using Told = nlohmann::json::parse_event_t;
    if (event == Told::object_start) open.emplace_back();
    if (event == Told::object_end) open.pop_back();
    if (event == Told::key && !open.back().insert(parsed.get<std::string>()).second)
      throw std::runtime_error(parsed.get<std::string>() + ": the key stands there twice");
    return true;
  };
  return nlohmann::json::parse(text, watch, true, true);
}

}  // namespace drover::sim
