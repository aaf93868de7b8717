// The options that motors in MIT mode have in common, whoever makes them, checked once at start-up.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "drivers/mit/joint.h"
#include "drover/options.h"
#include "drover/time.h"

namespace drover::mit {

/// A motor, and its ranges as its maker delivers it.
struct Model {
  std::string_view name;
  Ranges ranges;
};

/// The choices of a driver's option `model`.
template <std::size_t size>
constexpr std::array<std::string_view, size> names_of(const std::array<Model, size>& models) {
  std::array<std::string_view, size> names;
  for (std::size_t i = 0; i < size; ++i) names[i] = models[i].name;
  return names;
}

struct Settings {
  Joint joint;
  std::uint32_t master_id = 0;   ///< its answers come under it
  std::uint32_t timeout_ms = 0;  ///< left alone for so long it goes limp; 0: none is known
  Duration stale_after{};        ///< without an answer for longer it counts as silent
  Duration setpoint_period{};    ///< set points are not sent closer together
  Duration settle{};             ///< from when it is heard to when it may be enabled
};

// Rows of the option table.
/// The end of a range that the model gives, unless it is stated: `p_max_rad`, `v_max_radps` or
/// `t_max_Nm`.
OptionSpec range_row(std::string_view name, std::string_view text);
OptionSpec reversed_row();
OptionSpec zero_row();
OptionSpec timeout_row(double default_ms, std::string_view text);
OptionSpec damping_row();
OptionSpec max_effort_row();
OptionSpec stale_row(std::string_view text);
OptionSpec setpoint_period_row();
OptionSpec settle_row(double default_s, std::string_view text);

/// Of a table with these rows and `id` and `model`; all but the master id. A time-out below
/// `shortest_timeout_ms` would let the joint go when a frame is lost. Throws std::runtime_error
/// naming the option.
Settings read_settings(const Options& options, std::span<const OptionSpec> table,
                       std::span<const Model> models, unsigned shortest_timeout_ms);

}  // namespace drover::mit
