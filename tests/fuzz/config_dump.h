// A configuration as JSON again: every value of the tables in src/config/fields.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "config/fields.h"
#include "json/json_text.h"

namespace drover::fuzz {

/// Visitor that writes one object; `require` is told whether each number is inside its own range.
template <class Require>
class Dump final {
 public:
  Dump(json::JsonText& out, Require require) : out_(out), require_(require) { out_.open('{'); }

  void number(std::string_view key, double value, config::Range range, std::string_view,
              config::Presence = config::Presence::optional) {
    if (!is_of_this_kind(key)) return;
    require_(value >= range.min && value <= range.max);
    put_number(key, value);
  }
  void integer(std::string_view key, int value, config::Range range, std::string_view,
               config::Presence = config::Presence::optional) {
    if (!is_of_this_kind(key) || (is_link_ && value == 0)) return;
    require_(value >= range.min && value <= range.max);
    out_.key(key).integer(value);
  }
  void flag(std::string_view key, bool value, std::string_view,
            config::Presence = config::Presence::optional) {
    out_.key(key).boolean(value);
  }
  void text(std::string_view key, const std::string& value, std::string_view,
            config::Presence presence = config::Presence::optional) {
    if (presence == config::Presence::alternative) is_link_ = true;
    if (!is_of_this_kind(key) || (presence == config::Presence::alternative && value.empty()))
      return;
    require_(presence == config::Presence::optional || !value.empty());
    // Everything that uses a text takes it for a C string.
    require_(value.find('\0') == std::string::npos);
    out_.key(key).text(value);
  }
  void choice(std::string_view key, const std::string& value, const std::vector<std::string>& all,
              std::string_view, config::Presence = config::Presence::optional) {
    if (!is_of_this_kind(key) || (is_link_ && value == "none")) return;
    require_(std::find(all.begin(), all.end(), value) != all.end());
    if (key == "kind") base_kind_ = value;
    out_.key(key).text(value);
  }
  void names(std::string_view key, const std::vector<std::string>& value, config::Count count,
             std::string_view, config::Presence = config::Presence::optional) {
    if (!is_of_this_kind(key)) return;
    require_(value.size() >= count.min && value.size() <= count.max);
    out_.key(key).open('[');
    for (const auto& name : value) out_.text(name);
    out_.close(']');
  }
  void options(std::string_view key, const Options& value, const std::string& driver) {
    const auto* entry = find_driver(driver);
    require_(entry != nullptr);
    driver_ = entry;
    out_.key(key).open('{');
    for (const auto& spec : entry->options) option(spec, value);
    out_.close('}');
  }
  template <class T>
  void object(std::string_view key, T value, std::string_view,
              config::Presence = config::Presence::optional) {
    // Whether it is there stands in the object, but its table is what says so.
    if constexpr (requires { value.configured; })
      if (!value.configured) return;
    if constexpr (requires { value.chip; })
      if (value.link.empty()) return;
    out_.key(key);
    Dump inner(out_, require_);
    config::visit(inner, value);
    inner.finish();
  }
  template <class T>
  void list(std::string_view key, const std::vector<T>& values, config::Count count,
            std::string_view, config::Presence = config::Presence::optional) {
    require_(values.size() >= count.min && values.size() <= count.max);
    out_.key(key).open('[');
    for (T value : values) {
      Dump inner(out_, require_);
      config::visit(inner, value);
      inner.finish();
    }
    out_.close(']');
  }
  template <class T>
  void table(std::string_view key, const std::vector<T>& values, config::Count count,
             std::string_view, config::Presence = config::Presence::optional) {
    if (!is_of_this_kind(key)) return;
    require_(values.size() >= count.min && values.size() <= count.max);
    out_.key(key).open('{');
    rows(values);
    out_.close('}');
  }
  template <class T>
  void others(const std::vector<T>& values, std::size_t most, std::string_view) {
    require_(values.size() <= most);
    rows(values);
  }
  void keys_of_kind(const std::string&) {}
  void keys_of_base(const std::string&) {}
  void finish() { out_.close('}'); }

 private:
  template <class T>
  void rows(const std::vector<T>& values) {
    for (T value : values) {
      out_.key(value.name);
      Dump inner(out_, require_);
      config::visit(inner, value);
      inner.finish();
    }
  }
  /// What a device or a base of another kind may not have.
  bool is_of_this_kind(std::string_view key) const {
    for (const auto& each : config::kKindKeys)
      if (driver_ != nullptr && each.key == key && !config::has_key(*driver_, each)) return false;
    for (const auto& each : config::kBaseKeys)
      if (!base_kind_.empty() && each.key == key && !each.is_of(base_kind_)) return false;
    return true;
  }
  void put_number(std::string_view key, double value) {
    require_(std::isfinite(value));
    out_.key(key).number(value + 0.0);  // -0 would come back as 0
  }
  void option(const OptionSpec& spec, const Options& value) {
    require_(value.has(spec.name));
    if (std::holds_alternative<bool>(spec.default_value)) {
      out_.key(spec.name).boolean(value.flag(spec.name));
    } else if (std::holds_alternative<double>(spec.default_value)) {
      const double number = value.number(spec.name);
      require_(!(spec.min < spec.max) || (number >= spec.min && number <= spec.max));
      if (spec.integer) {
        require_(number == std::floor(number));
        out_.key(spec.name).integer(static_cast<std::int64_t>(number));
      } else {
        put_number(spec.name, number);
      }
    } else {
      out_.key(spec.name).text(value.text(spec.name));
    }
  }

  json::JsonText& out_;
  Require require_;
  const DriverEntry* driver_ = nullptr;  ///< of a device
  std::string base_kind_;                ///< of the base
  bool is_link_ = false;                 ///< what is as usual is left out: not every link has it
};

inline std::string word_of(engine::HoldBy hold) {
  switch (hold) {
    case engine::HoldBy::brake: return "brake";
    case engine::HoldBy::worm_gear: return "worm_gear";
    case engine::HoldBy::level_ground_only: break;
  }
  return "level_ground_only";
}

/// The text that gives `config` again when it is read.
template <class Require>
std::string dump(config::DroverConfig config, Require require) {
  config::GroupNames groups;
  auto& base = groups.base;
  base.base = &config.engine.base;
  base.kind = config::kBaseKinds[static_cast<std::size_t>(config.engine.base.kind)];
  for (const auto& device : config.devices)
    if (const auto* entry = find_driver(device.driver); entry && takes_twist(*entry))
      base.device = device.name;
  base.hold = word_of(config.engine.base.hold);
  for (const auto& [axes, names] :
       {std::pair{&config.engine.base.left, &base.left}, {&config.engine.base.right, &base.right}})
    for (const AxisId axis : *axes) names->emplace_back(config.engine.joints[axis].view());
  for (const engine::GroupConfig& group : config.engine.groups) {
    config::JointGroup& given = groups.others.emplace_back();
    given.name = group.name.view();
    for (const engine::JointRules& rules : group.joints) {
      config::GroupJoint& joint = given.joints.emplace_back();
      joint.rules = rules;
      joint.follows = config::kFollowsWords[static_cast<std::size_t>(rules.follows)];
      joint.on_silence = config::kSilenceWords[static_cast<std::size_t>(rules.on_silence)];
      joint.name = config.engine.joints[rules.axis].view();
    }
  }
  json::JsonText out;
  Dump writer(out, require);
  config::visit(writer, config, groups);
  writer.finish();
  return out.take();
}

}  // namespace drover::fuzz
