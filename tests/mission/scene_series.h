// Many short drives of one run, judged: tests/mission/scenes.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "mission/scene_log.h"

namespace drover::mission {

/// A thing that appeared while the robot drove.
struct Appeared {
  enum class Where {
    beside,   ///< never met, and farther than the margin
    grazing,  ///< never met, but nearer than that
    far,      ///< beyond stopping distance and margin
    between,
    near,  ///< nearer than a ramp to zero takes, and the margin
    at_rest
  };
  std::string name;
  std::string kind;
  Time time = kNever;
  Time gone = kNever;
  double v_mps = 0;
  double way_m = -1;  ///< along the track to the contact; below 0: none
  double stood_m = -1;
  Where where = Where::beside;
};

struct SeriesReport {
  std::size_t drives = 0;
  std::size_t accepted = 0;  ///< starts
  std::size_t poses = 0;
  std::size_t touches = 0;           ///< felt by the mechanics
  std::size_t excused_contacts = 0;  ///< with what appeared too near to stop
  double least_gap_m = std::numeric_limits<double>::infinity();  ///< moving, of all others
  std::vector<Appeared> appeared;
  std::vector<std::string> problems;

  std::size_t count(Appeared::Where where) const;
};
SeriesReport judge_series(const Record& record);

/// What all runs of a series have proved together.
struct SeriesProof {
  std::size_t drives = 0;
  std::size_t far = 0;    ///< things that it could stop before
  std::size_t stood = 0;  ///< of them those before which it was seen to stand
  std::size_t near = 0;   ///< judged by how soon zero was commanded

  void add(const SeriesReport& report);
  /// In a series of 100 drives and more, which of them never happened: without it well is not well.
  std::vector<std::string> lacks() const;
};

}  // namespace drover::mission
