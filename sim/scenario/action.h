// What a step of a mission does.
#pragma once

#include <nlohmann/json.hpp>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/robot/json_reader.h"
#include "sim/scenario/command_stream.h"
#include "sim/scenario/scene_object.h"
#include "sim/scenario/scene_zone.h"

namespace drover::sim {

inline constexpr std::array<std::string_view, 4> kPrograms{"mosquitto", "drover-sim",
                                                           "drover-guard", "droverd"};

struct Action {
  enum class Kind {
    sim,
    kill,
    freeze,
    thaw,
    start,
    publish,
    cancel,
    save,
    start_task,
    cli,
    joint_commands,
    object,
    zone
  };
  Kind kind = Kind::sim;
  std::string text{};                ///< command, name of the program, or payload
  std::vector<std::string> words{};  ///< cli: the arguments
  std::string topic{};               ///< publish
  bool retain = false;
  int signal = 0;
  std::string thread{};             ///< freeze
  std::optional<std::size_t> id{};  ///< start_task
  std::optional<double> speed_mps{};
  CommandStreamSpec stream{};  ///< joint_commands
  ObjectSpec object{};
  ZoneSpec zone{};
  bool in_sim_frame = false;              ///< publish: its places in `map` are the simulator's
  std::optional<double> stamped_s_ago{};  ///< publish: each header's stamp is made so old
};

/// As a person types them: `traj show 'row 7'`.
std::string shown_words(const std::vector<std::string>& words);
/// Of a point of the track, from 1 up. Throws std::runtime_error naming the key.
std::size_t read_id(JsonReader& reader, std::string_view key);
/// `raw` is what the reader reads; messages go out as they stand there. Throws std::runtime_error
/// naming the key.
Action read_action(JsonReader& reader, const nlohmann::json& raw);

}  // namespace drover::sim
