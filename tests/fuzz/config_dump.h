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
    require_(value >= range.min && value <= range.max);
    put_number(key, value);
  }
  void integer(std::string_view key, int value, config::Range range, std::string_view,
               config::Presence = config::Presence::optional) {
    require_(value >= range.min && value <= range.max);
    out_.key(key).integer(value);
  }
  void flag(std::string_view key, bool value, std::string_view,
            config::Presence = config::Presence::optional) {
    out_.key(key).boolean(value);
  }
  void text(std::string_view key, const std::string& value, std::string_view,
            config::Presence presence = config::Presence::optional) {
    require_(presence == config::Presence::optional || !value.empty());
    // Everything that uses a text takes it for a C string.
    require_(value.find('\0') == std::string::npos);
    out_.key(key).text(value);
  }
  void choice(std::string_view key, const std::string& value, const std::vector<std::string>& all,
              std::string_view, config::Presence = config::Presence::optional) {
    require_(std::find(all.begin(), all.end(), value) != all.end());
    out_.key(key).text(value);
  }
  void names(std::string_view key, const std::vector<std::string>& value, config::Count count,
             std::string_view, config::Presence = config::Presence::optional) {
    require_(value.size() >= count.min && value.size() <= count.max);
    out_.key(key).open('[');
    for (const auto& name : value) out_.text(name);
    out_.close(']');
  }
  void options(std::string_view key, const Options& value, const std::string& driver,
               SlotKind kind) {
    const auto* entry = find_driver(driver, kind);
    require_(entry != nullptr);
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
      if (value.chip.empty()) return;
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
  void finish() { out_.close('}'); }

 private:
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
  config::BaseNames base;
  base.base = &config.engine.base;
  base.hold = word_of(config.engine.base.hold);
  for (const AxisId axis : config.engine.base.left) base.left.push_back(config.drives[axis].joint);
  for (const AxisId axis : config.engine.base.right)
    base.right.push_back(config.drives[axis].joint);
  json::JsonText out;
  Dump writer(out, require);
  config::visit(writer, config, base);
  writer.finish();
  return out.take();
}

}  // namespace drover::fuzz
