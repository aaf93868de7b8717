// Writes the JSON schema from the tables in fields.h.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "config/fields.h"
#include "config/fields_map.h"
#include "config/register_map.h"

namespace drover::config {

namespace {

using Json = nlohmann::ordered_json;

void put_range(Json& schema, Range range, bool integer) {
  if (integer) {
    schema["minimum"] = std::llround(range.min);
    schema["maximum"] = std::llround(range.max);
  } else {
    schema["minimum"] = range.min;
    schema["maximum"] = range.max;
  }
}

Json option_schema(const OptionSpec& spec) {
  Json schema;
  schema["description"] = std::string(spec.text);
  if (std::holds_alternative<bool>(spec.default_value)) {
    schema["type"] = "boolean";
  } else if (std::holds_alternative<double>(spec.default_value)) {
    schema["type"] = spec.integer ? "integer" : "number";
    if (spec.min < spec.max) {
      put_range(schema, {spec.min, spec.max}, spec.integer);
    }
  } else {
    schema["type"] = "string";
    for (const auto choice : spec.choices) schema["enum"].push_back(std::string(choice));
  }
  if (spec.required) return schema;
  std::visit([&schema](const auto& value) { schema["default"] = value; }, spec.default_value);
  if (spec.integer) schema["default"] = std::llround(std::get<double>(spec.default_value));
  return schema;
}

class SchemaWriter final {
 public:
  void number(std::string_view key, const double& value, Range range, std::string_view text,
              Presence presence = Presence::optional) {
    auto& p = property(key, "number", text, presence);
    put_range(p, range, false);
    if (presence == Presence::optional) p["default"] = value;
  }
  void integer(std::string_view key, const int& value, Range range, std::string_view text,
               Presence presence = Presence::optional) {
    auto& p = property(key, "integer", text, presence);
    put_range(p, range, true);
    if (presence == Presence::optional) p["default"] = value;
  }
  void flag(std::string_view key, const bool& value, std::string_view text,
            Presence presence = Presence::optional) {
    property(key, "boolean", text, presence)["default"] = value;
  }
  void text(std::string_view key, const std::string& value, std::string_view text,
            Presence presence = Presence::optional) {
    auto& p = property(key, "string", text, presence);
    if (presence == Presence::optional) {
      p["default"] = value;
    } else {
      p["minLength"] = 1;
    }
    if (presence != Presence::alternative) return;
    Json alternative;
    alternative["required"] = {std::string(key)};
    schema_["oneOf"].push_back(alternative);  // moves the properties
  }
  void choice(std::string_view key, const std::string& value,
              const std::vector<std::string>& choices, std::string_view text,
              Presence presence = Presence::optional) {
    this->text(key, value, text, presence);
    auto& p = schema_["properties"][std::string(key)];
    if (std::find(choices.begin(), choices.end(), value) == choices.end()) p.erase("default");
    p["enum"] = choices;
  }
  void names(std::string_view key, const std::vector<std::string>&, Count count,
             std::string_view text, Presence presence = Presence::optional) {
    auto& p = property(key, "array", text, presence);
    p["minItems"] = count.min;
    p["maxItems"] = count.max;
    p["items"]["type"] = "string";
  }
  void address(std::string_view key, const int&, std::string_view text,
               Presence presence = Presence::optional) {
    Json whole;
    whole["type"] = "integer";
    put_range(whole, Range{0, 65535}, true);
    Json hex;
    hex["type"] = "string";
    hex["pattern"] = "^0x[0-9A-Fa-f]{1,4}$";
    Json schema;
    schema["anyOf"] = {whole, hex};
    insert(key, schema, text, presence);
  }
  void numbers(std::string_view key, const std::vector<double>&, Count count, Range range,
               std::string_view text, Presence presence = Presence::optional) {
    auto& p = property(key, "array", text, presence);
    p["minItems"] = count.min;
    p["maxItems"] = count.max;
    p["items"]["type"] = "number";
    put_range(p["items"], range, false);
  }
  template <class T>
  void object(std::string_view key, T value, std::string_view text,
              Presence presence = Presence::optional) {
    SchemaWriter inner;
    visit(inner, value);
    insert(key, inner.finish(), text, presence);
  }
  template <class T>
  void list(std::string_view key, const std::vector<T>&, Count count, std::string_view text,
            Presence presence = Presence::optional) {
    Json schema;
    schema["type"] = "array";
    schema["minItems"] = count.min;
    schema["maxItems"] = count.max;
    schema["items"] = of_one<T>();
    insert(key, schema, text, presence);
  }
  template <class T>
  void table(std::string_view key, const std::vector<T>&, Count count, std::string_view text,
             Presence presence = Presence::optional) {
    Json schema;
    schema["type"] = "object";
    schema["minProperties"] = count.min;
    schema["maxProperties"] = count.max;
    schema["propertyNames"] = {{"minLength", 1}, {"maxLength", Name::capacity()}};
    schema["additionalProperties"] = of_one<T>();
    insert(key, schema, text, presence);
  }
  template <class T>
  void others(const std::vector<T>&, std::size_t most, std::string_view text) {
    schema_["maxProperties"] = schema_["properties"].size() + most;
    schema_["propertyNames"] = {{"minLength", 1}, {"maxLength", Name::capacity()}};
    schema_["additionalProperties"] = of_one<T>();
    schema_["additionalProperties"]["description"] = std::string(text);
  }
  /// They depend on the driver.
  void options(std::string_view key, const Options&, const std::string&) {
    property(key, "object", "options of the driver", Presence::optional);
    for (const auto& entry : driver_registry()) {
      Json options;
      options["type"] = "object";
      options["additionalProperties"] = false;
      options["properties"] = Json::object();
      for (const auto& spec : entry.options) {
        options["properties"][std::string(spec.name)] = option_schema(spec);
        if (spec.required) options["required"].push_back(std::string(spec.name));
      }
      auto& then = where("driver", entry.name)["then"];
      then["properties"][std::string(key)] = options;
      if (options.contains("required")) then["required"].push_back(std::string(key));
    }
  }
  void keys_of_kind(const std::string&) {
    for (const auto& entry : driver_registry()) {
      auto& then = where("driver", entry.name)["then"];
      for (const auto& each : kKindKeys) {
        if (!has_key(entry, each)) {
          then["properties"][std::string(each.key)] = false;
        } else if (each.presence == Presence::required) {
          then["required"].push_back(std::string(each.key));
          then["properties"][std::string(each.key)] = {{"minLength", 1}};
        }
      }
    }
  }
  void keys_of_base(const std::string&) {
    for (const auto kind : kBaseKinds) {
      auto& then = where("kind", kind)["then"];
      for (const auto& each : kBaseKeys) {
        if (each.is_of(kind)) {
          then["required"].push_back(std::string(each.key));
        } else {
          then["properties"][std::string(each.key)] = false;
        }
      }
    }
  }
  Json finish() {
    Json schema;
    schema["type"] = "object";
    schema["additionalProperties"] = false;
    schema.update(schema_);
    return schema;
  }

 private:
  /// Of an item of a list, or of a table.
  template <class T>
  static Json of_one() {
    SchemaWriter inner;
    T item;
    visit(inner, item);
    return inner.finish();
  }
  /// What holds where this key has this value: one condition for each.
  Json& where(const char* key, std::string_view value) {
    auto& all = schema_["allOf"];
    for (auto& condition : all)
      if (condition["if"]["properties"][key]["const"] == value) return condition;
    Json condition;
    condition["if"]["properties"][key]["const"] = std::string(value);
    all.push_back(condition);
    return all.back();
  }
  Json& property(std::string_view key, const char* type, std::string_view text, Presence presence) {
    Json schema;
    schema["type"] = type;
    insert(key, schema, text, presence);
    return schema_["properties"][std::string(key)];
  }
  void insert(std::string_view key, const Json& schema, std::string_view text, Presence presence) {
    Json with_text;
    with_text["description"] = std::string(text);
    with_text.update(schema);
    schema_["properties"][std::string(key)] = with_text;
    if (presence == Presence::required) schema_["required"].push_back(std::string(key));
  }
  Json schema_ = Json::object();
};

}  // namespace

std::string schema_text() {
  DroverConfig config;
  GroupNames groups;
  groups.base.base = &config.engine.base;
  SchemaWriter writer;
  visit(writer, config, groups);
  Json schema;
  schema["$schema"] = "http://json-schema.org/draft-07/schema#";
  schema["title"] = "Configuration of droverd";
  schema.update(writer.finish());
  schema["properties"]["$schema"] = {{"type", "string"}, {"description", "for the editor"}};
  return schema.dump(2) + "\n";
}

std::string register_map_schema_text() {
  MapFile file;
  SchemaWriter writer;
  visit(writer, file);
  Json schema;
  schema["$schema"] = "http://json-schema.org/draft-07/schema#";
  schema["title"] = "Register map of a battery";
  schema.update(writer.finish());
  return schema.dump(2) + "\n";
}

}  // namespace drover::config
