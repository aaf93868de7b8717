// A look along a whole track, part by part.
#pragma once

#include <optional>
#include <vector>

#include "scene/constraint/at_start.h"
#include "scene/keeper/keeper_impl.h"
#include "scene/keeper/way_line.h"
#include "scene/look/sweeper.h"

namespace drover::scene {

struct TrackCheck::Impl {
  /// What is being looked at.
  struct Part {
    WayLine line;
    std::vector<Step> steps;
    WayEnd found;
    TrackJudge judge;  ///< of the steps before that
  };

  Impl(const Keeper::Impl& given, const Path& track, std::uint32_t target);

  bool advance(const TimeLeft& time_left);
  /// Why there is nothing to look along; empty: there is.
  Reason find_problem(std::uint32_t target) const;
  /// Before it drives off: what holds at this moment only.
  void look_here();
  Sweeper sweeper() const;
  /// Sweeps it; its poses are to be judged.
  void begin_part();
  /// All of its poses were.
  void end_part();
  void end(std::size_t point, double way_m, std::string_view what);

  const Keeper::Impl& keeper;
  const Path& path;
  std::uint64_t number = 0;
  bool begun = false;
  bool done = false;
  std::optional<TrackOffence> offence;
  WayLeft way;       ///< of the part that comes next
  Pose2 pose;        ///< there
  double way_m = 0;  ///< until there
  std::optional<Part> part;
};

}  // namespace drover::scene
